//! The solver's table of goals, each row as "asked / got".
//!
//! `cargo bench --bench goals -- [ROW …]` with rows `factor`, `charts`, `assets`, `disks`, `grown`; all by default. A time is from
//! the triangle list to the first iterate within 1e-4 (1e-2 for the bad start) of the energy that the same run ends with;
//! seconds are wall time on as many threads as there are (`RAYON_NUM_THREADS`), beside them the processor's.

mod clock;
mod meshes;

use std::cell::RefCell;

use clock::{Clock, Seconds};
use rayon::prelude::*;
use unwrapd::barrier::BarrierKind;
use unwrapd::charts::{Cut, charts};
use unwrapd::embed::{Options, parameterize, rest_shapes};
use unwrapd::energy::{DensityKind, SymmetricDirichlet, Triangles};
use unwrapd::mesh::{Disk, Surface};
use unwrapd::pipeline;
use unwrapd::solver::{Control, Iterate, Objective, Settings};

const ROWS: [(&str, fn()); 5] = [
    ("factor", factorizations),
    ("charts", small_charts),
    ("assets", assets),
    ("disks", disks),
    ("grown", grown),
];

fn main() {
    let wanted: Vec<String> = std::env::args()
        .skip(1)
        .filter(|a| !a.starts_with('-'))
        .collect();
    for (name, row) in ROWS {
        if wanted.is_empty() || wanted.iter().any(|w| w == name) {
            row();
        }
    }
}

/// A file of the test data.
fn surface(name: &str) -> Surface {
    let file = meshes::of("disk").into_iter().find(|f| f.contains(name));
    meshes::read(&file.expect("a file of the test data")).expect("a readable one")
}

/// The same, every triangle cut into four `times` times.
fn subdivided(name: &str, times: usize) -> (Disk, Vec<[f64; 3]>) {
    let Surface {
        mut positions,
        mut triangles,
        ..
    } = surface(name);
    for _ in 0..times {
        triangles = meshes::subdivided(&mut positions, &triangles);
    }
    let disk = Disk::new(positions.len(), triangles).expect("a disk");
    (disk, positions)
}

/// One numeric factorization: the least of five.
fn factorizations() {
    for (name, times, asked) in [
        ("camelhead", 0, "8 / 3.5"),
        ("bimba_89k", 0, "40 / 18"),
        ("camelhead", 2, "300 / 150"),
    ] {
        let (disk, positions) = subdivided(name, times);
        let rest = rest_shapes(&positions, &disk.triangles);
        let clock = Clock::start();
        let term = Triangles::new(
            &disk.triangles,
            &rest.shapes,
            SymmetricDirichlet,
            unwrapd::barrier::NoBarrier,
        );
        let mut objective = Objective::new(disk.n_vertices, Box::new(term));
        objective.prepare();
        let set_up = clock.seconds();
        let start = unwrapd::embed::start(&disk, &positions);
        objective.linearize(start.as_flattened(), 0.0);
        let times = (0..5).map(|_| {
            let clock = Clock::start();
            objective.factor().expect("a projected Hessian");
            1e3 * clock.seconds().wall
        });
        let least = times.fold(f64::INFINITY, f64::min);
        println!(
            "factorization, {} unknowns: asked {asked} ms, got {:.1} ms; order and symbolic analysis {:.0} ms",
            objective.n(),
            least,
            1e3 * set_up.wall,
        );
    }
}

/// Strips of squares, bent each in another way, from a work queue on all threads.
fn small_charts() {
    for (width, height, n, asked) in [(5, 5, 20_000, "5 / 1.5 s"), (10, 10, 2_000, "")] {
        let (disk, bent) = strip(width, height);
        let clock = Clock::start();
        let steps: usize = (0..n)
            .into_par_iter()
            .map(|k| {
                parameterize(
                    &disk,
                    &bent(k),
                    &options(&DensityKind::SymmetricDirichlet),
                    &|_: &Iterate| Control::Continue,
                )
                .summary
                .iterations
            })
            .sum();
        let Seconds { wall, processor } = clock.seconds();
        println!(
            "{n} charts of {} triangles: asked {asked}, got {wall:.2} s ({processor:.2} s of the processor), {:.2} ms each on one \
             core (asked of 200 triangles: 1.5 / 0.5 ms), {:.1} steps each",
            disk.triangles.len(),
            1e3 * processor / n as f64,
            steps as f64 / n as f64
        );
    }
}

/// A rectangle of squares, two triangles each, and how the k-th of its kind is bent.
fn strip(width: u32, height: u32) -> (Disk, impl Fn(usize) -> Vec<[f64; 3]>) {
    let index = move |i: u32, j: u32| i * (height + 1) + j;
    let squares = (0..width).flat_map(|i| (0..height).map(move |j| (i, j)));
    let triangles = squares.flat_map(|(i, j)| {
        let [a, b, c, d] = [
            index(i, j),
            index(i + 1, j),
            index(i + 1, j + 1),
            index(i, j + 1),
        ];
        [[a, b, c], [a, c, d]]
    });
    let n_vertices = ((width + 1) * (height + 1)) as usize;
    let disk = Disk::new(n_vertices, triangles.collect()).expect("a disk");
    let bent = move |k: usize| {
        let bend = 0.5 + (k % 97) as f64 / 97.0;
        let position = |v: usize| {
            let (x, y) = (
                (v / (height as usize + 1)) as f64,
                (v % (height as usize + 1)) as f64,
            );
            [x, y, bend * (x * 0.7 + y * 0.4 * bend).sin()]
        };
        (0..n_vertices).map(position).collect()
    };
    (disk, bent)
}

/// Whole meshes of about 2,000 faces from arrays to a certified atlas, one per thread.
fn assets() {
    const N: usize = 32;
    for (name, cut) in [
        ("one chart", Cut::Disk),
        ("more charts in less time", Cut::Fast),
        ("few charts", Cut::Auto),
    ] {
        let surface = surface("hand_lowres");
        let positions: Vec<[f32; 3]> = (surface.positions.iter())
            .map(|p| p.map(|x| x as f32))
            .collect();
        let settings = pipeline::Settings {
            cutting: pipeline::Cutting {
                cut,
                ..pipeline::Cutting::default()
            },
            workers: pipeline::Workers { threads: Some(1) },
            ..pipeline::Settings::default()
        };
        let clock = Clock::start();
        (0..N).into_par_iter().for_each(|_| {
            let atlas = pipeline::unwrap(
                &positions,
                &surface.triangles,
                &settings,
                &pipeline::Unobserved,
            );
            atlas.expect("an atlas");
        });
        let Seconds { wall, processor } = clock.seconds();
        println!(
            "assets of {} faces, {name}: asked 50,000 an hour, got {:.0} ({:.3} s of the processor each)",
            surface.triangles.len(),
            3600.0 * N as f64 / wall,
            processor / N as f64
        );
    }
}

fn options(energy: &DensityKind) -> Options {
    Options {
        density: energy.planar().expect("an energy of the plane"),
        barrier: match energy {
            DensityKind::SymmetricDirichlet => BarrierKind::None,
            _ => BarrierKind::InverseSpline,
        },
        ..Options::default()
    }
}

fn disks() {
    use DensityKind::{Arap, SymmetricDirichlet};
    row("camelhead", 0, &SymmetricDirichlet, 1e-4, "0.4 / 0.12 s");
    row("bimba_89k", 0, &SymmetricDirichlet, 1e-4, "1.5 / 0.6 s");
    row("bimba_89k", 0, &Arap, 1e-4, "4 / 1.5 s");
    row("lucy_o_f24136", 0, &SymmetricDirichlet, 1e-2, "1 / 0.3 s");
}

fn grown() {
    row(
        "camelhead",
        3,
        &DensityKind::SymmetricDirichlet,
        1e-4,
        "40 / 10 s, 3 / 2 GB",
    );
}

/// One disk, opened if it has handles: seconds to within `share` of the end.
fn row(name: &str, times: usize, energy: &DensityKind, share: f64, asked: &str) {
    let (disk, positions) = if times > 0 {
        subdivided(name, times)
    } else {
        let disks = charts(&surface(name), Cut::Disk).into_iter();
        let chart = disks
            .max_by_key(|chart| chart.disk.triangles.len())
            .expect("a chart");
        (chart.disk, chart.positions)
    };
    let exact = Options {
        solver: Settings::exact(),
        ..options(energy)
    };
    let clock = Clock::start();
    let trace = RefCell::new(Vec::new());
    let map = parameterize(&disk, &positions, &exact, &|i: &Iterate| {
        trace.borrow_mut().push((clock.seconds(), i.energy));
        Control::Continue
    });
    let last = map.summary.energy_last;
    let trace = trace.into_inner();
    let there = trace
        .iter()
        .position(|&(_, e)| e <= last * (1.0 + share))
        .expect("the last");
    let Seconds { wall, processor } = trace[there].0;
    println!(
        "{name}, {} triangles, {energy:?} to {share:e}: asked {asked}, got {wall:.2} s ({processor:.2} s of the processor, {:.2} s \
         wall of it before the finest level's first iterate, {there} steps on it); to the end {} steps, {} factorizations; \
         peak {} MB",
        disk.triangles.len(),
        trace[0].0.wall,
        map.summary.iterations,
        map.summary.factorizations,
        clock::peak_megabytes(),
    );
}
