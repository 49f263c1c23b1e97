//! Textures aligned with surfaces inside fixed boundaries: bijective, whatever the anchors ask for.

use std::f64::consts::TAU;

use unwrapd_deform::Model;
use unwrapd_deform::uv::{self, Anchor, UvEditOptions, UvRest, edit_uvs};
use unwrapd_maps::certificate::{Overlap, certify};
use unwrapd_method::solver::{Control, Iterate, Status};

use crate::random::Random;
use crate::uv_meshes::UvMesh;
use unwrapd_method::energy::{DensityKind, DisplacementKind, EnergyKind};

const SIDE: u32 = 7;

const ENERGIES: [EnergyKind; 6] = [
    EnergyKind::Density(DensityKind::Arap),
    EnergyKind::Density(DensityKind::SymmetricDirichlet),
    EnergyKind::Density(DensityKind::Green),
    EnergyKind::Density(DensityKind::Mips),
    EnergyKind::Density(DensityKind::Lscm),
    EnergyKind::Displacement(DisplacementKind::Laplacian),
];

/// A surface over the unit square and its place in the texture.
fn sheet(height: fn([f64; 2]) -> f64, place: fn([f64; 2]) -> [f64; 2]) -> UvMesh {
    let mut mesh = UvMesh::grid(SIDE);
    for p in &mut mesh.positions {
        p[2] = height([p[0], p[1]]);
    }
    mesh.map_uvs(place)
}

fn hill([x, y]: [f64; 2]) -> f64 {
    8.0 * x * (1.0 - x) * y * (1.0 - y)
}

/// Seven eighths of a ring, whose ends nearly meet.
fn ring([x, y]: [f64; 2]) -> [f64; 2] {
    let (sin, cos) = (0.875 * TAU * x).sin_cos();
    let radius = 0.5 - 0.3 * y;
    [0.5 + radius * cos, 0.5 + radius * sin]
}

/// A square with a notch almost through it.
fn notched([x, y]: [f64; 2]) -> [f64; 2] {
    let depth = (1.0 - 4.0 * (x - 0.5).abs()).max(0.0);
    [x, y * (1.0 - 0.85 * depth)]
}

/// An anchor at an inner vertex or at a place, and a target somewhere in the chart or anywhere.
fn anchor(mesh: &UvMesh, random: &mut Random) -> Anchor {
    let to = if random.next() < 0.7 {
        place(mesh, random)
    } else {
        [0, 1].map(|_| 1.5 * random.next() - 0.25)
    };
    if random.next() < 0.5 {
        let inner = |random: &mut Random| 1 + (random.next() * f64::from(SIDE - 1)) as u32;
        let vertex = inner(random) * (SIDE + 1) + inner(random);
        return Anchor::Vertex {
            vertex,
            to,
            weight: None,
        };
    }
    let at = place(mesh, random);
    Anchor::Place {
        at,
        to,
        weight: None,
    }
}

/// A UV in a face.
fn place(mesh: &UvMesh, random: &mut Random) -> [f64; 2] {
    let face = mesh.uvs[(random.next() * mesh.uvs.len() as f64) as usize];
    let weights = [0; 3].map(|_| 0.1 + random.next());
    let sum: f64 = weights.iter().sum();
    [0, 1].map(|k| (0..3).map(|c| weights[c] / sum * face[c][k]).sum())
}

#[test]
fn extreme_moves_within_a_fixed_boundary_are_bijective() {
    const RUNS: usize = 240;
    let sheets = [
        sheet(hill, |p| p),
        sheet(hill, ring),
        sheet(|p| p[0], notched),
    ];
    let mut random = Random::new(2_013);
    let (mut reached, mut unreachable) = (0, 0);
    for run in 0..RUNS {
        let mesh = &sheets[run % sheets.len()];
        let anchors: Vec<Anchor> = (0..=run % 4).map(|_| anchor(mesh, &mut random)).collect();
        let options = UvEditOptions {
            rest: [UvRest::Surface, UvRest::Present][run / 3 % 2],
            model: Model {
                energy: ENERGIES[run / 6 % ENERGIES.len()].clone(),
                ..Model::default()
            },
            ..UvEditOptions::texture()
        };
        let arrays = uv::UvMesh {
            positions: &mesh.positions,
            triangles: &mesh.triangles,
            uvs: &mesh.uvs,
        };
        let edited = match edit_uvs(&arrays, &anchors, &options, &|_: &Iterate| {
            Control::Continue
        }) {
            Ok(edited) => edited,
            Err(error) => {
                let known = ["contradictory_handles", "anchor_on_boundary"];
                assert!(known.contains(&error.code()), "run {run}: {error}");
                continue;
            }
        };
        let summary = &edited.charts[0].summary;
        let context = format!("run {run}: {options:?} {anchors:?} {summary:?}");
        let judged = certify(
            &mesh.positions,
            &mesh.triangles,
            &edited.uvs,
            &Overlap::Test.into(),
        );
        assert!(
            judged.is_valid() && judged.overlapping_pairs == Some(0),
            "{context} {judged:?}"
        );
        if summary.status == Status::TargetsUnreachable {
            unreachable += 1;
        } else {
            assert!(summary.residual <= 1e-10, "{context}");
            reached += 1;
        }
    }
    // Anchors whose targets lie beyond the boundary, or too near to each other, stop short.
    assert!(reached >= 30, "{reached} reached");
    assert!(
        unreachable >= 1 && reached + unreachable >= RUNS * 3 / 4,
        "{unreachable} unreachable"
    );
}
