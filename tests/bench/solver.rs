//! Iterations, factorizations and seconds of the solver, from Tutte starts.
//!
//! `cargo bench --bench solver -- [FILE.obj …]`; without arguments three meshes of `../shared/data/disk`. Counts are
//! exact and repeatable, seconds are wall time of one thread.

use std::cell::RefCell;
use std::hint::black_box;
use std::time::Instant;

use unwrapd::barrier::{Barrier, BarrierKind, MapEnergy, map_energy};
use unwrapd::charts::{Chart, Cut, charts};
use unwrapd::embed::{Options, optimize, rest_shapes, start};
use unwrapd::energy::EnergyKind;
use unwrapd::mesh::{Surface, io::obj};
use unwrapd::solver::{Control, Iterate, Objective, Settings, Summary};

const DATA: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/data/disk");

fn main() {
    // Cargo passes `--bench`.
    let mut files: Vec<String> = std::env::args()
        .skip(1)
        .filter(|a| !a.starts_with('-'))
        .collect();
    if files.is_empty() {
        let names = ["bimba_11k", "face", "lucy_o_f24136"];
        files = names.map(|name| format!("{DATA}/{name}.obj")).to_vec();
    }
    for file in files {
        match chart(&file) {
            Ok(chart) => report(&file, &chart),
            Err(reason) => println!("{file}: {reason}"),
        }
    }
}

/// The file's first component, opened to a disk.
fn chart(file: &str) -> Result<Chart, String> {
    let bytes = std::fs::read(file).map_err(|error| error.to_string())?;
    let mesh = obj::read(&bytes).map_err(|error| error.to_string())?.mesh;
    let surface =
        Surface::new(&mesh.positions, &mesh.triangles).map_err(|error| error.to_string())?;
    charts(&surface, Cut::Disk)
        .into_iter()
        .next()
        .ok_or("no triangles".to_owned())
}

fn report(file: &str, chart: &Chart) {
    let clock = Instant::now();
    let uv = start(&chart.disk, &chart.positions);
    println!(
        "{file}: {} triangles, start {:.3} s",
        chart.disk.triangles.len(),
        clock.elapsed().as_secs_f64()
    );
    for energy in [
        EnergyKind::Arap,
        EnergyKind::SymmetricDirichlet,
        EnergyKind::Lscm,
    ] {
        let (draft, trace) = run(chart, &uv, energy, Settings::draft());
        let (normal, _) = run(chart, &uv, energy, Settings::normal());
        let within = |share: f64| {
            let reached = |&(e, _): &(f64, f64)| e <= normal.energy_last * (1.0 + share);
            let found = trace.iter().position(reached);
            found.map_or("not".to_owned(), |i| format!("{i} it {:.3} s", trace[i].1))
        };
        println!(
            "  {energy:?}: to 10 % {}, 1 % {}; draft {:?} {} it {} fact {:.3} s E {:.6e}; normal {:?} {} it {} fact E {:.6e}",
            within(0.1),
            within(0.01),
            draft.status,
            draft.iterations,
            draft.factorizations,
            trace.last().map_or(0.0, |last| last.1),
            draft.energy_last,
            normal.status,
            normal.iterations,
            normal.factorizations,
            normal.energy_last,
        );
    }
    split(chart, &uv);
}

/// Minimizes and tells energy and seconds of every iterate.
fn run(
    chart: &Chart,
    uv: &[[f64; 2]],
    energy: EnergyKind,
    solver: Settings,
) -> (Summary, Vec<(f64, f64)>) {
    let trace = RefCell::new(Vec::new());
    let clock = Instant::now();
    let watch = |i: &Iterate| {
        trace
            .borrow_mut()
            .push((i.energy, clock.elapsed().as_secs_f64()));
        Control::Continue
    };
    let options = Options {
        energy,
        solver,
        ..Options::default()
    };
    let embedding = optimize(&chart.disk, &chart.positions, uv, &options, &watch);
    let summary = embedding.expect("a start without flips").summary;
    (summary, trace.into_inner())
}

/// Where the time of an iteration goes: least of five.
fn split(chart: &Chart, uv: &[[f64; 2]]) {
    let rest = rest_shapes(&chart.positions, &chart.disk.triangles);
    let parameters = MapEnergy {
        energy: EnergyKind::Arap,
        barrier: Barrier {
            kind: BarrierKind::InverseSpline,
            beta: 0.01,
            s: 1.0,
            epsilon: 0.0,
        },
    };
    let clock = Instant::now();
    let term = map_energy(&chart.disk.triangles, &rest.shapes, &parameters);
    let mut objective = Objective::new(chart.disk.n_vertices, term);
    let setup = 1e3 * clock.elapsed().as_secs_f64();
    let x = uv.as_flattened();
    let mut direction = vec![0.0; x.len()];
    let assembly = least(|| objective.linearize(x, 0.0));
    let solve = least(|| {
        black_box(objective.newton_direction(&mut direction).is_ok());
    });
    let value = least(|| {
        black_box(objective.value(x));
    });
    let step = least(|| {
        black_box(objective.largest_step(x, &direction));
    });
    println!(
        "  ms: set-up {setup:.1}; assembly {assembly:.2}, factor and solve {solve:.2}, value {value:.2}, largest step {step:.2}"
    );
}

fn least(mut action: impl FnMut()) -> f64 {
    let times = (0..5).map(|_| {
        let clock = Instant::now();
        action();
        1e3 * clock.elapsed().as_secs_f64()
    });
    times.fold(f64::INFINITY, f64::min)
}
