//! Charts of authored UVs by their faults.

use crate::uv_meshes::UvMesh;
use unwrapd_maps::certificate::{Claims, IslandFault, Islands, Overlap, Stacks, certify};

/// A tile at a corner, `side` wide.
fn tile(corner: [f64; 2], side: f64) -> UvMesh {
    UvMesh::grid(2).map_uvs(|uv| [0, 1].map(|k| corner[k] + side * uv[k]))
}

fn islands(charts: &[UvMesh], claims: &Claims) -> Islands {
    let mut mesh = UvMesh::default();
    for chart in charts {
        mesh.add(chart);
    }
    certify(&mesh.positions, &mesh.triangles, &mesh.uvs, claims).islands
}

fn tested(charts: &[UvMesh]) -> Islands {
    islands(charts, &Overlap::Test.into())
}

#[test]
fn each_island_is_said_to_be_what_it_is() {
    let middle = [0.125, 0.125];
    let folded = tile([0.0, 0.0], 0.25).map_uvs(|uv| if uv == middle { [0.3, 0.125] } else { uv });
    let flat = tile([0.5, 0.0], 0.25).map_uvs(|[u, _]| [u, 0.0]);
    let charts = [
        tile([0.75, 0.75], 0.25),
        folded,
        flat,
        tile([0.0, 0.5], 0.25),
        tile([0.1, 0.6], 0.25),
        tile([2.0, 0.0], 3.0),
        tile([-0.25, 0.25], 0.25),
        tile([1.0, 0.0], 1.0),
    ];
    let found = tested(&charts);
    let faults: Vec<(u32, IslandFault)> = (found.faulty.iter())
        .map(|island| (island.chart, island.fault))
        .collect();
    let expected = [
        (1, IslandFault::Folded),
        (2, IslandFault::WithoutArea),
        (3, IslandFault::Overlapping),
        (4, IslandFault::Overlapping),
        (5, IslandFault::Tiled),
        (6, IslandFault::Outside),
        (7, IslandFault::Outside),
    ];
    assert_eq!(faults, expected);
    assert_eq!(found.faulty[0].face, 8, "its first face");
    let counts = [found.sound, found.folded, found.without_area];
    assert_eq!(counts, [1, 1, 1]);
    assert_eq!([found.overlapping, found.tiled, found.outside], [2, 1, 2]);
}

#[test]
fn an_accepted_stack_is_sound_and_an_untested_overlap_is_not_claimed() {
    let stack = [tile([0.0; 2], 0.25), tile([0.0; 2], 0.25)];
    assert_eq!(tested(&stack).overlapping, 2);
    let accepted = Claims {
        stacks: Stacks::Accepted,
        ..Overlap::Test.into()
    };
    assert_eq!(islands(&stack, &accepted).sound, 2);
    assert_eq!(islands(&stack, &Overlap::Skip.into()).overlapping, 0);
    // What overlaps one chart of a stack overlaps all.
    let beside = [&stack[..], &[tile([0.1; 2], 0.25)]].concat();
    assert_eq!(islands(&beside, &accepted).overlapping, 3);
}
