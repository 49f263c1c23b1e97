//! Handles whose straight ways are blocked: how many arrive, and how long it takes.
//!
//! `cargo bench --bench ways --no-default-features --features files -- [woody|crowded|warps|impossible] [COUNT]`; without arguments
//! all.
//! `woody` solves the reference problems of a figure whose limbs change places; `crowded` sends 40 handles of a picture each to a
//! random place, 10 times; `warps` does so with 300 random pictures and shorter ways, a third of them with a fixed border,
//! a third bijective; `impossible` sends one of five handles through a fixed wall, in the plane and in space. Seconds are those on
//! the wall.

#[path = "../core/bodies.rs"]
mod bodies;

use std::path::{Path, PathBuf};
use std::time::Instant;

use bodies::{block, sheet};
use unwrapd::certificate::certify_planar;
use unwrapd::deform::warp::{PictureHandle, PictureWarp, WarpOptions, warp_picture};
use unwrapd::deform::{Body, Boundary, Handle, Model, Problem, ProblemFile};
use unwrapd::mesh::io::ElementFormat;
use unwrapd::numerics::random::Random;
use unwrapd::picture::Image;
use unwrapd::solver::{Control, Iterate, Settings, Status};

/// Pixels of a picture along either side.
const SIDE: f64 = 512.0;

fn main() {
    let arguments: Vec<String> = std::env::args()
        .skip(1)
        .filter(|a| !a.starts_with('-'))
        .collect();
    let count = arguments.get(1).and_then(|n| n.parse().ok());
    let is_wanted = |name: &str| arguments.first().is_none_or(|first| first == name);
    if is_wanted("woody") {
        woody();
    }
    if is_wanted("crowded") {
        crowded(count.unwrap_or(10));
    }
    if is_wanted("warps") {
        warps(count.unwrap_or(300));
    }
    if is_wanted("impossible") {
        impossible(plane());
        impossible(space());
    }
}

fn go_on(_: &Iterate) -> Control {
    Control::Continue
}

fn reference() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/reference/problems")
}

/// Limbs that change places.
fn woody() {
    let files = std::fs::read_dir(reference()).expect("the reference set");
    let mut names: Vec<String> = files
        .map(|file| {
            file.expect("readable")
                .file_name()
                .to_string_lossy()
                .into_owned()
        })
        .filter(|name| name.contains("_swap") && name.ends_with("_spline.json"))
        .collect();
    names.sort();
    let mut all = Vec::new();
    for name in &names {
        let problem = read(name);
        let begun = Instant::now();
        let solution = problem
            .solve(&Settings::follow(), &go_on)
            .expect("a problem");
        let summary = solution.summary;
        let seconds = begun.elapsed().as_secs_f64();
        all.push((summary.status == Status::Converged, seconds));
        println!(
            "{name}: {:?}, {} iterations, {} factorizations, {seconds:.2} s, energy {:.6e}, residual {:.1e}, {} inverted",
            summary.status,
            summary.iterations,
            summary.factorizations,
            solution.worth.energy + solution.worth.barrier,
            solution.worth.residual,
            solution.worth.inverted
        );
    }
    conclude("woody", &all);
}

fn read(name: &str) -> Problem {
    let folder = reference();
    let json = std::fs::read(folder.join(name)).expect("a problem");
    let file = ProblemFile::parse(&json).expect("a problem");
    let format = ElementFormat::of_name(&file.mesh).expect("a known format");
    let bytes = std::fs::read(folder.join(&file.mesh)).expect("a mesh");
    let mesh = format.read(&bytes).expect("a mesh");
    file.with(mesh, None).expect("a sound problem")
}

/// Places of a picture no closer to each other than this share of its side.
fn places(
    random: &mut Random,
    n: usize,
    least: f64,
    near: &dyn Fn(usize) -> Option<[f64; 2]>,
) -> Vec<[f64; 2]> {
    const REACH: f64 = 0.2;
    let mut places: Vec<[f64; 2]> = Vec::new();
    while places.len() < n {
        let drawn = [0.0; 2].map(|_| 2.0 * random.unit() - 1.0);
        let place = match near(places.len()) {
            Some(center) => [0, 1].map(|k| center[k] + REACH * SIDE * drawn[k]),
            None => drawn.map(|x| SIDE * (0.5 + 0.45 * x)),
        };
        let is_inside = place.iter().all(|x| (0.04 * SIDE..0.96 * SIDE).contains(x));
        let distance = |p: &[f64; 2]| (p[0] - place[0]).hypot(p[1] - place[1]);
        if is_inside && places.iter().all(|p| distance(p) > least * SIDE) {
            places.push(place);
        }
    }
    places
}

/// One warp and its seconds.
fn warped(handles: &[PictureHandle], options: &WarpOptions) -> (PictureWarp, f64) {
    let image = Image::transparent(SIDE as usize, SIDE as usize);
    let begun = Instant::now();
    let warp = warp_picture(&image, handles, options, &go_on).expect("a warp");
    (warp, begun.elapsed().as_secs_f64())
}

fn report(name: &str, warp: &PictureWarp, seconds: f64) {
    println!(
        "{name}: {:?}, {} iterations, {} factorizations, {seconds:.2} s, energy {:.4e}, residual {:.1e}, {} unreached",
        warp.summary.status,
        warp.summary.iterations,
        warp.summary.factorizations,
        warp.summary.energy,
        warp.summary.residual,
        warp.summary.unreached.len()
    );
}

/// Forty handles, each to a place far away.
fn crowded(n: u64) {
    let mut all = Vec::new();
    for seed in 0..n {
        let mut random = Random::new(seed);
        let at = places(&mut random, 40, 0.06, &|_| None);
        let to = places(&mut random, 40, 0.06, &|_| None);
        let handles = paired(&at, &to);
        let (warp, seconds) = warped(&handles, &WarpOptions::default());
        report(&format!("crowd {seed}"), &warp, seconds);
        all.push((warp.summary.status == Status::Converged, seconds));
    }
    conclude("crowded", &all);
}

fn paired(at: &[[f64; 2]], to: &[[f64; 2]]) -> Vec<PictureHandle> {
    let pairs = at.iter().zip(to);
    pairs.map(|(&at, &to)| PictureHandle { at, to }).collect()
}

/// Random pictures.
fn warps(n: u64) {
    let mut all = Vec::new();
    let (mut wanted, mut bijective) = (0, 0);
    for seed in 0..n {
        let mut random = Random::new(1000 + seed);
        let grid = 64 + random.below(193);
        let n_handles = 5 + random.below(56);
        let least = 0.3 / (n_handles as f64).sqrt();
        let at = places(&mut random, n_handles, least, &|_| None);
        let to = places(&mut random, n_handles, least, &|i| Some(at[i]));
        let (boundary, is_bijective) = match seed % 3 {
            0 => (Boundary::Free, false),
            1 => (Boundary::Fixed, false),
            _ => (Boundary::Free, true),
        };
        let options = WarpOptions {
            grid,
            boundary,
            model: Model {
                bijective: is_bijective,
                ..Model::default()
            },
        };
        let (warp, seconds) = warped(&paired(&at, &to), &options);
        let proof = certify_planar(&warp.deformed, warp.grid.triangles());
        assert_eq!(proof.inverted, 0, "warp {seed}");
        if seed % 3 != 0 {
            wanted += 1;
            bijective += usize::from(proof.is_bijective());
        }
        let name =
            format!("warp {seed}, grid {grid}, {n_handles} handles, {boundary:?}, {is_bijective}");
        report(&name, &warp, seconds);
        all.push((warp.summary.status == Status::Converged, seconds));
    }
    conclude("warps", &all);
    println!("bijective where asked: {bijective} of {wanted}");
}

fn conclude(name: &str, all: &[(bool, f64)]) {
    let arrived = all.iter().filter(|(arrived, _)| *arrived).count();
    let mut seconds: Vec<f64> = all.iter().map(|(_, seconds)| *seconds).collect();
    seconds.sort_by(f64::total_cmp);
    let (median, worst) = (seconds[seconds.len() / 2], seconds[seconds.len() - 1]);
    println!(
        "{name}: {arrived} of {} arrived, seconds {median:.2} median, {worst:.2} worst",
        all.len()
    );
}

/// A square whose border is held, and five handles in it, the first of which is to leave it.
fn plane() -> (Body, Vec<Handle>) {
    const CELLS: u32 = 60;
    let id = |[x, y]: [u32; 2]| y * (CELLS + 1) + x;
    let mut handles = vec![vertex(id([30, 10]), &[30.0, -15.0])];
    for (at, to) in [
        ([15, 20], [20.0, 30.0]),
        ([45, 20], [42.0, 31.0]),
        ([15, 45], [24.0, 46.0]),
        ([45, 45], [45.0, 36.0]),
    ] {
        handles.push(vertex(id(at), &to));
    }
    let body = Body::from(&sheet(CELLS));
    handles.extend(border(&body, CELLS));
    (body, handles)
}

/// The same in a cube.
fn space() -> (Body, Vec<Handle>) {
    const CELLS: u32 = 12;
    const ROW: u32 = CELLS + 1;
    let id = |[x, y, z]: [u32; 3]| (z * ROW + y) * ROW + x;
    let mut handles = vec![vertex(id([6, 6, 2]), &[6.0, 6.0, -3.0])];
    for (at, to) in [
        ([3, 3, 6], [4.0, 4.0, 7.0]),
        ([9, 3, 6], [8.0, 4.0, 6.0]),
        ([3, 9, 6], [4.0, 9.0, 7.5]),
        ([9, 9, 6], [9.0, 8.0, 5.0]),
    ] {
        handles.push(vertex(id(at), &to));
    }
    let body = Body::from(&block(CELLS));
    handles.extend(border(&body, CELLS));
    (body, handles)
}

/// Handles that hold the border of a sheet or a block of so many cells along a side.
fn border(body: &Body, cells: u32) -> Vec<Handle> {
    let places = body.rest.chunks_exact(body.dim()).zip(0..);
    let is_side = |x: &f64| *x == 0.0 || *x == f64::from(cells);
    let held = places.filter(|(place, _)| place.iter().any(is_side));
    held.map(|(place, v)| vertex(v, place)).collect()
}

fn vertex(vertex: u32, to: &[f64]) -> Handle {
    Handle::Vertex {
        vertex,
        to: to.to_vec(),
    }
}

/// Five handles in a body whose border is held, the first of which cannot be reached.
fn impossible((body, handles): (Body, Vec<Handle>)) {
    let dim = body.dim();
    let problem = Problem::new(body, &handles, &Model::default()).expect("a problem");
    let begun = Instant::now();
    let solution = problem
        .solve(&Settings::follow(), &go_on)
        .expect("a problem");
    let seconds = begun.elapsed().as_secs_f64();
    let unreached = problem.unreached(&solution);
    let distance = |handle: &Handle| match handle {
        Handle::Vertex { vertex, to } => {
            let place = &solution.x[dim * *vertex as usize..];
            let squares = place.iter().zip(to).map(|(x, t)| (x - t) * (x - t));
            squares.sum::<f64>().sqrt()
        }
        Handle::Disc { .. } | Handle::Point { .. } => f64::NAN,
    };
    let easy: Vec<f64> = handles[1..5].iter().map(distance).collect();
    println!(
        "impossible in {dim} dimensions: {:?}, {} iterations, {} factorizations, {seconds:.2} s, {} inverted, unreached {unreached:?}, \
         the easy ones by {easy:?}",
        solution.summary.status,
        solution.summary.iterations,
        solution.summary.factorizations,
        solution.worth.inverted
    );
    assert!(unreached.len() == 1 && unreached[0].handle == 0);
}
