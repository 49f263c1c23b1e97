//! Packing of generated crowds of charts.
//!
//! `cargo bench --bench packing -- [--gap TEXELS] [--patience N] [--rotate any|quarter|none] [KIND:N …]`; without arguments all kinds,
//! with 10 to 10,000 charts. Kinds: `squares` and `bricks` of one size, `planks` whose sides vary by a fifth, `blobs` of one size,
//! and a `scatter` of blobs whose areas vary over four decades. Prints the share of the page that is filled, the smallest distance
//! of two charts in texels at 1024, millions of words read, processor seconds and peak megabytes so far.

#[expect(dead_code, reason = "only processor time is wanted")]
mod clock;

use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::sync::atomic::{AtomicU64, Ordering};

use clock::{Clock, peak_megabytes};
use unwrapd_layout::atlas::{
    Atlas, AtlasOptions, ChartMap, CoarseLayout, GRID_BITS, Rotation, pack_coarse,
};
use unwrapd_maps::plane::{BoxIndex, Segment, search_budget, segment_distance};
use unwrapd_method::numerics::bounds::bounds_of;
use unwrapd_method::numerics::random::Random;
use unwrapd_method::solver::Control;

type Chart = (Vec<[f64; 2]>, Vec<[u32; 3]>);

const KINDS: [&str; 5] = ["squares", "bricks", "planks", "blobs", "scatter"];
const NUMBERS: [usize; 4] = [10, 64, 1_000, 10_000];

fn main() {
    let mut options = AtlasOptions::default();
    let mut cases = Vec::new();
    let mut arguments = std::env::args().skip(1).filter(|it| it != "--bench");
    while let Some(argument) = arguments.next() {
        let mut value = || arguments.next().expect("a value");
        match argument.as_str() {
            "--gap" => options.padding_texels = value().parse().expect("texels"),
            "--patience" => options.patience = value().parse().expect("a number"),
            "--rotate" => {
                options.rotation = match value().as_str() {
                    "any" => Rotation::Any,
                    "quarter" => Rotation::Quarter,
                    _ => Rotation::None,
                }
            }
            case => cases.push(case.to_owned()),
        }
    }
    if cases.is_empty() {
        let of_kind = |kind| NUMBERS.map(|n| format!("{kind}:{n}"));
        cases = KINDS.into_iter().flat_map(of_kind).collect();
    }
    for case in cases {
        report(&case, &options);
    }
}

fn report(case: &str, options: &AtlasOptions) {
    let (kind, number) = case.split_once(':').expect("KIND:N");
    let charts = charts(kind, number.parse().expect("a number of charts"));
    let maps: Vec<ChartMap> = (charts.iter())
        .map(|(uv, triangles)| ChartMap { uv, triangles })
        .collect();
    let words = AtomicU64::new(0);
    let on_read = |read| {
        words.fetch_add(read, Ordering::Relaxed);
        Control::Continue
    };
    let clock = Clock::start();
    let coarse = CoarseLayout::new(&maps, options).expect("charts");
    let atlas = pack_coarse(&maps, coarse.as_ref(), options, &on_read).expect("a layout");
    println!(
        "{case:16} fill {:.3} gap {:6.3} words {:7.1} cpu {:7.3} s, {} MB",
        atlas.utilization,
        gap(&charts, &atlas),
        words.into_inner() as f64 / 1e6,
        clock.seconds().processor,
        peak_megabytes()
    );
}

fn charts(kind: &str, n: usize) -> Vec<Chart> {
    let mut random = Random::new(7);
    let mut chart = || match kind {
        "squares" => rectangle([1.0; 2]),
        "bricks" => rectangle([2.0, 1.0]),
        "planks" => rectangle([2.0 + 0.4 * random.unit(), 1.0 + 0.2 * random.unit()]),
        "blobs" => blob(1.0, &mut random),
        _ => {
            let area = 10_f64.powf(4.0 * random.unit());
            blob(area.sqrt(), &mut random)
        }
    };
    (0..n).map(|_| chart()).collect()
}

fn rectangle([width, height]: [f64; 2]) -> Chart {
    let uv = vec![[0.0, 0.0], [width, 0.0], [width, height], [0.0, height]];
    (uv, vec![[0, 1, 2], [0, 2, 3]])
}

/// A star of twelve random radii, stretched and rotated at random.
fn blob(radius: f64, random: &mut Random) -> Chart {
    let stretch = 0.5 + random.unit();
    let (sin, cos) = (TAU * random.unit()).sin_cos();
    let mut uv = vec![[0.0; 2]];
    for k in 0..12 {
        let angle = TAU * f64::from(k) / 12.0;
        let at = radius * (0.6 + 0.4 * random.unit());
        let [x, y] = [at * angle.cos() * stretch, at * angle.sin() / stretch];
        uv.push([cos * x - sin * y, sin * x + cos * y]);
    }
    (uv, (1..=12).map(|k| [0, k, k % 12 + 1]).collect())
}

/// The smallest distance of two charts, in texels at 1024.
fn gap(charts: &[Chart], atlas: &Atlas) -> f64 {
    let texel = f64::from(1 << GRID_BITS) / 1024.0;
    let mut edges: Vec<Segment> = Vec::new();
    let mut owners = Vec::new();
    for ((owner, (_, triangles)), placed) in (0..).zip(charts).zip(&atlas.placed) {
        let mut sides: BTreeMap<[u32; 2], usize> = BTreeMap::new();
        for [a, b, c] in triangles {
            for [p, q] in [[a, b], [b, c], [c, a]] {
                *sides.entry([*p.min(q), *p.max(q)]).or_default() += 1;
            }
        }
        let at = |v: u32| placed.grid[v as usize].map(|x| f64::from(x) / texel);
        let border = sides.into_iter().filter(|(_, n)| *n == 1);
        edges.extend(border.map(|(ends, _)| ends.map(at)));
        owners.resize(edges.len(), owner);
    }
    let boxes: Vec<_> = edges.iter().map(|edge| bounds_of(edge)).collect();
    let distance = |i: u32, j: u32| segment_distance(edges[i as usize], edges[j as usize]);
    let budget = search_budget(edges.len());
    BoxIndex::new(&boxes).closest(&owners, budget, distance).0
}
