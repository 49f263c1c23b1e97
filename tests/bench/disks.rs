//! One chart per mesh: energy against seconds of the processor, and where the seconds go.
//!
//! `cargo bench --bench disks -- [--out DIR] [FILE …]`; without files every mesh of `../shared/data/disk`. Prints a line of JSON for
//! each mesh and energy: every iterate on the finest level with the seconds since the triangle list was handed over, and the
//! parts of one iteration. With `--out` the map is written beside it as OBJ, which `tests/bench/slim.py` judges and sets
//! beside libigl's SLIM. Runs on one thread if `RAYON_NUM_THREADS=1`.

#[expect(dead_code, reason = "only seconds of the processor are told here")]
mod clock;
#[expect(dead_code, reason = "disks are not subdivided here")]
mod meshes;

use std::cell::RefCell;
use std::fmt::Write;
use std::hint::black_box;
use std::path::{Path, PathBuf};

use clock::Clock;
use serde_json::json;
use unwrapd::barrier::{Barrier, BarrierKind};
use unwrapd::charts::{Chart, Cut, charts};
use unwrapd::embed::{Embedding, Options, parameterize, rest_shapes};
use unwrapd::energy::{DensityKind, Triangles};
use unwrapd::solver::{Control, Iterate, Objective, Settings};

fn main() {
    let mut arguments = std::env::args().skip(1).filter(|a| a != "--bench");
    let (mut out, mut files) = (None, Vec::new());
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--out" => out = Some(PathBuf::from(arguments.next().expect("a folder"))),
            _ => files.push(argument),
        }
    }
    if files.is_empty() {
        files = meshes::of("disk");
    }
    for file in files {
        let Some(chart) = chart(&file) else {
            println!("{}", json!({"file": file, "error": "not read"}));
            continue;
        };
        for energy in [DensityKind::SymmetricDirichlet, DensityKind::Arap] {
            report(&file, &chart, &energy, out.as_deref());
        }
    }
}

/// The file's largest component, opened to a disk.
fn chart(file: &str) -> Option<Chart> {
    let disks = charts(&meshes::read(file)?, Cut::Disk).into_iter();
    disks.max_by_key(|chart| chart.disk.triangles.len())
}

fn report(file: &str, chart: &Chart, energy: &DensityKind, out: Option<&Path>) {
    let options = Options {
        density: energy.planar().expect("an energy of the plane"),
        barrier: kind(energy),
        solver: Settings::exact(),
        ..Options::default()
    };
    let clock = Clock::start();
    let trace = RefCell::new(Vec::new());
    let watch = |i: &Iterate| {
        trace
            .borrow_mut()
            .push((clock.seconds().processor, i.energy));
        Control::Continue
    };
    let map = parameterize(&chart.disk, &chart.positions, &options, &watch);
    let stem = Path::new(file)
        .file_stem()
        .unwrap_or_default()
        .to_string_lossy();
    let written = out.map(|folder| {
        let path = folder.join(format!("{stem}.{energy:?}.obj"));
        std::fs::write(&path, obj(chart, &map)).expect("a folder to write to");
        path
    });
    let summary = map.summary;
    println!(
        "{}",
        json!({
            "file": file, "energy": format!("{energy:?}"), "triangles": chart.disk.triangles.len(),
            "status": format!("{:?}", summary.status), "iterations": summary.iterations,
            "factorizations": summary.factorizations, "obj": written,
            // Per triangle: the rest shapes have a mean area of 1.
            "trace": trace.into_inner().iter().map(|&(seconds, energy)| (seconds, energy / chart.disk.triangles.len() as f64)).collect::<Vec<_>>(),
            "iteration_ms": parts(chart, energy, &map),
        })
    );
}

/// The symmetric Dirichlet energy needs none.
fn kind(energy: &DensityKind) -> BarrierKind {
    match energy {
        DensityKind::SymmetricDirichlet => BarrierKind::None,
        _ => BarrierKind::InverseSpline,
    }
}

/// The surface and its map, 17 digits.
fn obj(chart: &Chart, map: &Embedding) -> String {
    let mut text = String::new();
    for [x, y, z] in &chart.positions {
        let _ = writeln!(text, "v {x:e} {y:e} {z:e}");
    }
    for [u, v] in &map.uv {
        let _ = writeln!(text, "vt {u:e} {v:e}");
    }
    for [a, b, c] in chart.disk.triangles.iter().map(|t| t.map(|v| v + 1)) {
        let _ = writeln!(text, "f {a}/{a} {b}/{b} {c}/{c}");
    }
    text
}

/// What the parts of one iteration cost, in milliseconds: least of five.
fn parts(chart: &Chart, energy: &DensityKind, map: &Embedding) -> serde_json::Value {
    let rest = rest_shapes(&chart.positions, &chart.disk.triangles);
    let barrier = Barrier {
        kind: kind(energy),
        beta: 0.01,
        s: 1.0,
        epsilon: 0.0,
    };
    let density = energy.planar().expect("an energy of the plane");
    let clock = Clock::start();
    let term = Triangles::shared(&chart.disk.triangles, &rest.shapes, density, barrier);
    let mut objective = Objective::new(chart.disk.n_vertices, Box::new(term));
    let scale = (chart.disk.triangles.len() as f64 / rest.area.max(f64::MIN_POSITIVE)).sqrt();
    let x: Vec<f64> = map.uv.as_flattened().iter().map(|u| scale * u).collect();
    let mut direction = vec![0.0; x.len()];
    objective.linearize(&x, 0.0);
    black_box(objective.newton_direction(&mut direction).is_ok());
    let first = 1e3 * (clock.seconds().processor);
    json!({
        "order, symbolic analysis and first": first,
        "assembly": least(|| objective.linearize(&x, 0.0)),
        "factor and solve": least(|| {
            black_box(objective.newton_direction(&mut direction).is_ok());
        }),
        "value": least(|| {
            black_box(objective.value(&x));
        }),
        "largest step": least(|| {
            black_box(objective.largest_step(&x, &direction));
        }),
    })
}

fn least(mut action: impl FnMut()) -> f64 {
    let times = (0..5).map(|_| {
        let clock = Clock::start();
        action();
        1e3 * (clock.seconds().processor)
    });
    times.fold(f64::INFINITY, f64::min)
}
