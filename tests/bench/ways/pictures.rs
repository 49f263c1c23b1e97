//! Pictures pulled by many handles.

use unwrapd::certificate::certify_planar;
use unwrapd::deform::warp::{PictureHandle, PictureWarp, WarpOptions, warp_picture};
use unwrapd::deform::{Boundary, Model};
use unwrapd::numerics::random::Random;
use unwrapd::picture::Image;

use crate::clock::Clock;
use crate::go_on;
use crate::outcome::{Outcome, conclude};

/// Pixels of a picture along either side.
const SIDE: f64 = 512.0;

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
    let clock = Clock::start();
    let warp = warp_picture(&image, handles, options, &go_on).expect("a warp");
    (warp, clock.seconds().processor)
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

fn outcome(handles: &[PictureHandle], warp: &PictureWarp, seconds: f64) -> Outcome {
    Outcome {
        handles: handles.len(),
        reached: handles.len() - warp.summary.unreached.len(),
        seconds,
    }
}

/// Forty handles, each to a place far away.
pub fn crowded(n: u64) {
    let mut all = Vec::new();
    for seed in 0..n {
        let mut random = Random::new(seed);
        let at = places(&mut random, 40, 0.06, &|_| None);
        let to = places(&mut random, 40, 0.06, &|_| None);
        let handles = paired(&at, &to);
        let (warp, seconds) = warped(&handles, &WarpOptions::default());
        report(&format!("crowd {seed}"), &warp, seconds);
        all.push(outcome(&handles, &warp, seconds));
    }
    conclude("crowded", &all);
}

fn paired(at: &[[f64; 2]], to: &[[f64; 2]]) -> Vec<PictureHandle> {
    let pairs = at.iter().zip(to);
    pairs
        .map(|(&at, &to)| PictureHandle::Point {
            at,
            to,
            weight: None,
        })
        .collect()
}

/// Random pictures.
pub fn warps(n: u64) {
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
            ..WarpOptions::default()
        };
        let handles = paired(&at, &to);
        let (warp, seconds) = warped(&handles, &options);
        let proof = certify_planar(&warp.deformed, warp.grid.triangles());
        assert_eq!(proof.inverted, 0, "warp {seed}");
        if seed % 3 != 0 {
            wanted += 1;
            bijective += usize::from(proof.is_bijective());
        }
        let name =
            format!("warp {seed}, grid {grid}, {n_handles} handles, {boundary:?}, {is_bijective}");
        report(&name, &warp, seconds);
        all.push(outcome(&handles, &warp, seconds));
    }
    conclude("warps", &all);
    println!("bijective where asked: {bijective} of {wanted}");
}
