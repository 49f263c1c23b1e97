//! Sheets opened to disks.

use crate::few_vertices::few_vertices;
use crate::zoo::{self, Mesh};
use proptest::prelude::*;
use unwrapd_maps::cut::{Branches, Sheet, open_to_disk, ways_to_open};
use unwrapd_maps::mesh::{CUT, Disk, Surface};

fn sheets(mesh: &Mesh) -> Vec<Sheet> {
    let surface = Surface::new(&mesh.positions, &mesh.triangles).expect("a usable mesh");
    let adjacency = surface.adjacency();
    Sheet::divide(
        (&surface.triangles, &surface.positions),
        &adjacency.twin,
        &adjacency.piece,
        adjacency.n_pieces,
    )
}

/// A one-sheet mesh opened: the total length of its seams and the number of loops after.
fn opened(mesh: &Mesh) -> (f64, usize) {
    let [sheet] = &sheets(mesh)[..] else {
        panic!("{} is not one sheet", mesh.name);
    };
    let seams = open_to_disk(sheet, Branches::ToLimbs);
    let length = seams.iter().map(|&h| sheet.length(h)).sum();
    let surface = Surface::new(&mesh.positions, &mesh.triangles).expect("a usable mesh");
    let mut twin = sheet.twin.clone();
    for h in seams {
        twin[sheet.twin[h as usize] as usize] = CUT;
        twin[h as usize] = CUT;
    }
    let whole = vec![0; sheet.triangles.len()];
    let open = Sheet::divide((&surface.triangles, &surface.positions), &twin, &whole, 1).remove(0);
    let triangles = open.vertex.chunks(3).map(|t| [t[0], t[1], t[2]]).collect();
    let disk = Disk::new(open.positions.len(), triangles).expect("a disk");
    (length, disk.loops.len())
}

#[test]
fn what_is_a_disk_stays_one() {
    assert_eq!(opened(&zoo::grid(4, 3)), (0.0, 1));
    assert_eq!(opened(&zoo::cone(7)), (0.0, 1));
    assert_eq!(opened(&zoo::grid(5, 5).without(&[24, 25])), (0.0, 2));
}

#[test]
fn a_sphere_is_slit_from_end_to_end() {
    let (length, loops) = opened(&zoo::sphere(24, 15));
    assert_eq!(loops, 1);
    assert!((2.8..3.3).contains(&length), "{length}");
}

/// A sphere pressed flat, not quite round, numbered anew from one of its vertices on: each vertex of the rim has another farthest one.
fn pancake(first: u32) -> Mesh {
    let mesh = zoo::sphere(24, 15);
    let n = mesh.positions.len() as u32;
    let mut positions = mesh.positions.clone();
    for (v, &[x, y, z]) in (0..n).zip(&mesh.positions) {
        positions[((v + first) % n) as usize] = [x + 0.1 * y * y, 1.1 * y + 0.07 * x, 0.3 * z];
    }
    let numbered_anew = |of: &[u32; 3]| of.map(|v| (v + first) % n);
    let mut triangles: Vec<[u32; 3]> = mesh.triangles.iter().map(numbered_anew).collect();
    triangles.rotate_left(first as usize);
    Mesh {
        name: format!("pancake from {first}"),
        triangles,
        positions,
    }
}

#[test]
fn where_a_sphere_is_slit_does_not_depend_on_the_order_of_its_vertices() {
    let (length, _) = opened(&pancake(0));
    for first in [1, 50, 100, 180, 300] {
        let (other, _) = opened(&pancake(first));
        assert!(
            (other / length - 1.0).abs() < 1e-6,
            "{first}: {other} {length}"
        );
    }
}

#[test]
fn ways_to_open_a_sphere_are_different_and_others_have_one() {
    let ways = |mesh: &Mesh, most| ways_to_open(&sheets(mesh)[0], Branches::None, most);
    let of_pancake = ways(&pancake(0), 4);
    assert!((2..=4).contains(&of_pancake.len()), "{}", of_pancake.len());
    for (i, way) in of_pancake.iter().enumerate() {
        assert!(!of_pancake[..i].contains(way));
    }
    assert_eq!(ways(&pancake(0), 1), of_pancake[..1]);
    assert_eq!(ways(&zoo::torus(9, 7), 4).len(), 1);
    assert_eq!(ways(&zoo::grid(4, 3), 4), [Vec::<u32>::new()]);
}

#[test]
fn the_smallest_closed_surfaces_are_slit() {
    assert_eq!(opened(&zoo::pillow()).1, 1);
    assert_eq!(opened(&zoo::sphere(3, 1)).1, 1);
}

#[test]
fn a_torus_is_cut_along_its_two_shortest_loops() {
    // Around the tube 4.2 (as polygons), and around the inside of the ring, radius 1.3.
    let (length, loops) = opened(&zoo::torus(48, 20));
    assert_eq!(loops, 1);
    let shortest = 0.7 * std::f64::consts::TAU + 1.3 * std::f64::consts::TAU;
    assert!(length < 1.02 * shortest, "{length} {shortest}");
    assert!(length > 0.95 * shortest, "{length} {shortest}");
}

#[test]
fn handles_are_cut_and_holes_are_left() {
    assert_eq!(opened(&zoo::slab(5)).1, 1);
    assert_eq!(opened(&zoo::torus(9, 7).without(&[0])).1, 1);
    let (_, loops) = opened(&zoo::torus(20, 12).without(&[0, 100, 200, 300]));
    assert!((1..=4).contains(&loops), "{loops}");
}

proptest! {
    #[test]
    fn seams_are_glued_edges(mesh in few_vertices()) {
        for sheet in sheets(&mesh) {
            for h in open_to_disk(&sheet, Branches::ToLimbs) {
                prop_assert!(sheet.twin[h as usize] != CUT);
            }
        }
    }
}
