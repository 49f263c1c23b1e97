//! Packing of generated crowds of charts.
//!
//! `cargo bench --bench packing -- [--gap TEXELS] [--patience N] [--rotate any|quarter|none] [--drag] [KIND:N …]`; without arguments all kinds,
//! with 10 to 10,000 charts. Kinds: `squares` and `bricks` of one size, `planks` whose sides vary by a fifth, `blobs` of one size,
//! and a `scatter` of blobs whose areas vary over four decades. Prints the share of the page that is filled, the smallest distance
//! of two charts in texels at 1024, millions of words read, processor seconds and peak megabytes so far. With `--drag`, the first chart
//! is then dragged across the page in a thousand moves: prints processor milliseconds per move, the smallest scale of the other
//! charts, and the smallest distance of two charts at any move.

#[expect(dead_code, reason = "only processor time is wanted")]
mod clock;

use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::sync::atomic::{AtomicU64, Ordering};

use clock::{Clock, peak_megabytes};
use unwrapd_layout::atlas::{
    Atlas, AtlasOptions, ChartMap, CoarseLayout, GRID_BITS, LiveLayout, Rotation, pack_coarse,
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
    let mut is_dragged = false;
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
            "--drag" => is_dragged = true,
            case => cases.push(case.to_owned()),
        }
    }
    if cases.is_empty() {
        let of_kind = |kind| NUMBERS.map(|n| format!("{kind}:{n}"));
        cases = KINDS.into_iter().flat_map(of_kind).collect();
    }
    for case in cases {
        report(&case, &options, is_dragged);
    }
}

fn report(case: &str, options: &AtlasOptions, is_dragged: bool) {
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
        gap(&on_page(&charts, &atlas)),
        words.into_inner() as f64 / 1e6,
        clock.seconds().processor,
        peak_megabytes()
    );
    if is_dragged {
        drag(case, &on_page(&charts, &atlas), options);
    }
}

/// Number of moves of a drag.
const MOVES: u32 = 1000;

/// Drags the first chart across the page, and reports how the others make room.
fn drag(case: &str, islands: &[Chart], options: &AtlasOptions) {
    let maps: Vec<ChartMap> = (islands.iter())
        .map(|(uv, triangles)| ChartMap { uv, triangles })
        .collect();
    let mut live = LiveLayout::new(&maps[1..], &maps[..1], 1.0, options).expect("islands");
    let (mut milliseconds, mut scale, mut least_gap) = (Vec::new(), 1.0_f64, f64::INFINITY);
    for step in 0..MOVES {
        let angle = TAU * f64::from(step) / f64::from(MOVES);
        let to = [
            0.5 + 0.3 * (2.0 * angle).cos(),
            0.5 + 0.3 * (3.0 * angle).sin(),
        ];
        let clock = Clock::start();
        live.drag(0, to, 0.0);
        let followers = live.make_room();
        milliseconds.push(1e3 * clock.seconds().processor);
        scale = scale.min(followers.scale);
        let mut all = vec![moved(&islands[0], to, 1.0)];
        let others = islands[1..].iter().zip(&followers.middles);
        all.extend(others.map(|(island, &to)| moved(island, to, followers.scale)));
        least_gap = least_gap.min(gap(&all));
    }
    milliseconds.sort_by(f64::total_cmp);
    let share = |share: f64| milliseconds[(share * f64::from(MOVES - 1)) as usize];
    println!(
        "{case:16} drag: median {:.1} ms, 95 of 100 {:.1} ms, worst {:.1} ms; smallest scale {scale:.3}, smallest gap {least_gap:.3}",
        share(0.5),
        share(0.95),
        share(1.0)
    );
}

/// The chart scaled and moved to another center.
fn moved((uv, triangles): &Chart, to: [f64; 2], scale: f64) -> Chart {
    let [low, high] = bounds_of(uv);
    let place =
        |p: &[f64; 2]| [0, 1].map(|k| to[k] + scale * (p[k] - f64::midpoint(low[k], high[k])));
    (uv.iter().map(place).collect(), triangles.clone())
}

/// The charts as they lie on the page, whose side is 1.
fn on_page(charts: &[Chart], atlas: &Atlas) -> Vec<Chart> {
    let unit = f64::from(1 << GRID_BITS);
    let placed = charts.iter().zip(&atlas.placed);
    placed
        .map(|((_, triangles), placed)| {
            let uv = placed.grid.iter().map(|p| p.map(|x| f64::from(x) / unit));
            (uv.collect(), triangles.clone())
        })
        .collect()
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

/// The smallest distance of two charts on a page, in texels at 1024.
fn gap(charts: &[Chart]) -> f64 {
    let mut edges: Vec<Segment> = Vec::new();
    let mut owners = Vec::new();
    for (owner, (uv, triangles)) in (0..).zip(charts) {
        let mut sides: BTreeMap<[u32; 2], usize> = BTreeMap::new();
        for [a, b, c] in triangles {
            for [p, q] in [[a, b], [b, c], [c, a]] {
                *sides.entry([*p.min(q), *p.max(q)]).or_default() += 1;
            }
        }
        let at = |v: u32| uv[v as usize].map(|x| 1024.0 * x);
        let border = sides.into_iter().filter(|(_, n)| *n == 1);
        edges.extend(border.map(|(ends, _)| ends.map(at)));
        owners.resize(edges.len(), owner);
    }
    let boxes: Vec<_> = edges.iter().map(|edge| bounds_of(edge)).collect();
    let distance = |i: u32, j: u32| segment_distance(edges[i as usize], edges[j as usize]);
    let budget = search_budget(edges.len());
    BoxIndex::new(&boxes).closest(&owners, budget, distance).0
}
