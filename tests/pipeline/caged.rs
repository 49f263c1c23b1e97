//! Files whose surfaces are deformed in a cage.

use crate::zoo;
use std::fmt::Write;
use unwrapd_deform::cage::{Cage, CagedSurface};
use unwrapd_deform::{Handle, Model, Solution};
use unwrapd_files::document::{Document, OutputFormat, Upload, Written};
use unwrapd_method::barrier::BarrierKind;
use unwrapd_method::energy::DensityKind;
use unwrapd_method::solver::{Control, Iterate, Settings};
use unwrapd_pipeline::{CageOptions, CageReport, CagedDocument, Limits, PipelineError, Surfaces};

fn upload(mesh: &zoo::Mesh) -> Upload {
    let mut text = String::from("OFF\n");
    let (n, m) = (mesh.positions.len(), mesh.triangles.len());
    writeln!(text, "{n} {m} 0").expect("memory");
    for [x, y, z] in &mesh.positions {
        writeln!(text, "{x} {y} {z}").expect("memory");
    }
    for [a, b, c] in &mesh.triangles {
        writeln!(text, "3 {a} {b} {c}").expect("memory");
    }
    Upload::single("mesh.off", text.into_bytes())
}

fn disc(center: [f64; 3], radius: f64, to: [f64; 3]) -> Handle {
    Handle::Disc {
        center: center.to_vec(),
        radius,
        to: to.to_vec(),
        turn: 0.0,
        axis: None,
        weight: None,
    }
}

fn options(n_voxels: u32, format: OutputFormat) -> CageOptions {
    CageOptions {
        n_voxels,
        surfaces: Surfaces::Whole,
        model: Model {
            energy: DensityKind::Arap.into(),
            barrier: BarrierKind::InverseSpline,
            barrier_strength: None,
            barrier_support: 1.0,
            max_conformal: None,
            bijective: false,
        },
        format,
        stem: "out".to_owned(),
        limits: Limits::default(),
    }
}

fn deformed(mesh: &zoo::Mesh, handles: &[Handle]) -> (Solution, Written, CageReport) {
    let options = options(8, OutputFormat::Glb);
    let caged = CagedDocument::read(&upload(mesh), handles, options).expect("a cage");
    let go_on = |_: &Iterate| Control::Continue;
    let solution = caged.problem().solve(&Settings::follow(), &go_on);
    let solution = solution.expect("a map");
    let (written, report) = caged.write(&solution).expect("a file");
    (solution, written, report)
}

fn positions(written: &Written) -> Vec<[f32; 3]> {
    let (name, bytes) = &written.files[0];
    let document = Document::read(&Upload::single(name, bytes.clone())).expect("a document");
    document.primitives()[0].positions.clone()
}

#[track_caller]
fn assert_near(found: [f32; 3], expected: [f32; 3]) {
    for k in 0..3 {
        assert!((found[k] - expected[k]).abs() < 1e-5, "{found:?}");
    }
}

#[test]
fn a_sphere_is_bent_in_its_cage() {
    let sphere = zoo::sphere(16, 12);
    let step = [0.75, 0.0, -0.25];
    let handles = [
        disc([0.0, 0.0, -1.0], 0.75, [0.0, 0.0, -1.0]),
        disc([0.0, 0.0, 1.0], 0.75, [step[0], 0.0, 1.0 + step[2]]),
    ];
    let (solution, written, report) = deformed(&sphere, &handles);
    assert_eq!(solution.quality.inverted, 0);
    assert!(
        solution.quality.residual < 1e-12,
        "{}",
        solution.quality.residual
    );
    assert_eq!(report.tets, 6 * report.voxels);
    assert_eq!(report.surface_vertices, sphere.positions.len());
    assert_eq!(report.idle_parts, 0);
    assert_eq!(report.crossings_before.pairs, 0);
    assert_eq!(report.crossings_after.pairs, 0);
    let after = positions(&written);
    // The poles are the first vertices; all corners of their elements are held.
    assert_near(after[0], [step[0] as f32, 0.0, 1.0 + step[2] as f32]);
    assert_near(after[1], [0.0, 0.0, -1.0]);
    // The equator follows in part.
    let equator = (2..after.len()).filter(|&v| sphere.positions[v][2].abs() < 0.2);
    let moves: Vec<f32> = equator
        .map(|v| after[v][0] - sphere.positions[v][0])
        .collect();
    let mean = moves.iter().sum::<f32>() / moves.len() as f32;
    assert!((0.2..0.55).contains(&mean), "{mean}");
}

#[test]
fn a_part_without_a_handle_stays_at_rest() {
    let sphere = zoo::sphere(8, 5);
    let n = sphere.positions.len();
    let both = sphere.with(&zoo::sphere(8, 5).moved([4.0, 0.5, 0.0]));
    let pulled = Handle::Point {
        at: vec![0.0, 0.0, 0.9],
        to: vec![0.0, 0.0, 1.5],
        weight: None,
    };
    let handles = [disc([0.0, 0.0, -1.0], 1.0, [0.0, 0.0, -1.0]), pulled];
    let (solution, written, report) = deformed(&both, &handles);
    assert_eq!(report.idle_parts, 1);
    assert_eq!(solution.quality.inverted, 0);
    let after = positions(&written);
    assert!(after[0][2] > 1.3, "{:?}", after[0]);
    for v in n..after.len() {
        assert_near(after[v], both.positions[v]);
    }
}

#[test]
fn what_a_cage_cannot_do_is_refused_by_name() {
    let sphere = upload(&zoo::sphere(8, 5));
    let place = disc([0.0; 3], 1.5, [0.0; 3]);
    let vertex = Handle::Vertex {
        vertex: 0,
        to: vec![0.0; 3],
        weight: None,
    };
    let outside = disc([9.0; 3], 0.5, [0.0; 3]);
    let obj = Upload::single("a.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n".to_vec());
    let code = |upload: &Upload, handles: &[Handle], n_voxels: u32| {
        let read = CagedDocument::read(upload, handles, options(n_voxels, OutputFormat::Glb));
        read.err().as_ref().map(PipelineError::code)
    };
    assert_eq!(code(&sphere, std::slice::from_ref(&place), 8), None);
    assert_eq!(
        code(&sphere, &[place.clone(), vertex], 8),
        Some("vertex_of_cage")
    );
    assert_eq!(code(&sphere, &[outside], 8), Some("handle_outside"));
    assert_eq!(code(&sphere, &[], 8), Some("no_handle"));
    assert_eq!(
        code(&sphere, std::slice::from_ref(&place), 0),
        Some("limit_exceeded")
    );
    assert_eq!(code(&obj, &[place], 8), Some("unsupported_output"));
}

/// How far the middle of a triangle of the written surface is from where the cage carries it, at most.
fn largest_gap(surfaces: Surfaces) -> f64 {
    let sphere = zoo::sphere(10, 8);
    let handles = [
        disc([0.0, 0.0, -1.0], 0.75, [0.0, 0.0, -1.0]),
        disc([0.0, 0.0, 1.0], 0.75, [0.75, 0.0, 0.5]),
    ];
    let options = CageOptions {
        surfaces,
        ..options(5, OutputFormat::Glb)
    };
    let caged = CagedDocument::read(&upload(&sphere), &handles, options).expect("a cage");
    let go_on = |_: &Iterate| Control::Continue;
    let solution = caged
        .problem()
        .solve(&Settings::follow(), &go_on)
        .expect("a map");
    let (written, report) = caged.write(&solution).expect("a file");

    let rest: Vec<[f64; 3]> = sphere.positions.iter().map(|p| p.map(f64::from)).collect();
    let surface = CagedSurface {
        positions: &rest,
        triangles: &sphere.triangles,
    };
    let cage = Cage::around(&[surface], 5).expect("a cage");
    let (rest, triangles) = match surfaces {
        Surfaces::Whole => (rest.clone(), sphere.triangles.clone()),
        Surfaces::Split => {
            let split = cage.split(&surface).expect("pieces");
            (split.positions, split.triangles)
        }
    };
    assert_eq!(report.surface_triangles, triangles.len());
    let after: Vec<[f64; 3]> = positions(&written)
        .iter()
        .map(|p| p.map(f64::from))
        .collect();
    let middle = |places: &[[f64; 3]], t: &[u32; 3]| -> [f64; 3] {
        std::array::from_fn(|k| t.iter().map(|&v| places[v as usize][k]).sum::<f64>() / 3.0)
    };
    let middles: Vec<[f64; 3]> = triangles.iter().map(|t| middle(&rest, t)).collect();
    let carried = cage.embed(&middles).expect("places in the cage");
    let carried = cage.interpolate(&carried, solution.x.as_chunks().0);
    let gaps = triangles.iter().zip(&carried).map(|(t, to)| {
        let at = middle(&after, t);
        (0..3).map(|k| (at[k] - to[k]).powi(2)).sum::<f64>().sqrt()
    });
    gaps.fold(0.0, f64::max)
}

#[test]
fn pieces_follow_the_cage_exactly() {
    assert!(largest_gap(Surfaces::Split) < 1e-5);
    assert!(largest_gap(Surfaces::Whole) > 1e-2);
}
