//! Packing of equal charts in other forms.
//!
//! `cargo bench -p unwrapd-layout --bench stable -- [--as-given] [--around] [--variants N] FILE.obj …`. The charts of each file
//! with UVs are packed as they are, then in other orders of the charts, vertices and triangles, each chart rotated by an angle of its own, at other scales, and with one vertex moved
//! by 1e-4 of the longest side of its chart. `--as-given` also tries the layout that the UVs form, as `repack` does; the charts are then not
//! rotated. With `--around`, every third chart then stays on the page, and the others are packed around them once more. N is the number of variants of each kind, 3 by default.
//!
//! Prints for each file the charts, the fill, the milliseconds of the processor, and for each kind of variant the mean number of charts of
//! which a vertex lies more than two texels elsewhere at 1024, and the smallest and the largest change of the fill.

#[expect(dead_code, reason = "only processor time is wanted")]
mod clock;

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use clock::Clock;
use unwrapd_layout::atlas::{
    Atlas, AtlasOptions, ChartMap, Constraints, GRID_BITS, Positions, Stay, pack, pack_within,
};
use unwrapd_maps::mesh::UnionFind;
use unwrapd_method::numerics::bounds::bounds_of;
use unwrapd_method::numerics::random::Random;
use unwrapd_method::solver::Control;

/// Positions and triangles of a chart.
type Chart = (Vec<[f64; 2]>, Vec<[u32; 3]>);

const KINDS: [Kind; 4] = [Kind::Order, Kind::Rotation, Kind::Scale, Kind::Vertex];
/// Scales of the variants, in turn.
const SCALES: [f64; 3] = [37.0, 0.11, 1e-3];
/// Distance in texels at 1024 beyond which a vertex lies elsewhere.
const ELSEWHERE: f64 = 2.0;
/// Distance by which one vertex is moved, in longest sides of its chart.
const MOVED: f64 = 1e-4;

/// Change of the charts that leaves the problem as it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Order,
    Rotation,
    Scale,
    Vertex,
}

fn main() {
    let mut options = AtlasOptions::default();
    let (mut files, mut variants, mut is_around) = (Vec::new(), 3, false);
    let mut arguments = std::env::args().skip(1).filter(|it| it != "--bench");
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--as-given" => options.positions = Positions::Layout,
            "--around" => is_around = true,
            "--variants" => {
                let number = arguments.next().and_then(|it| it.parse().ok());
                variants = number.expect("a number");
            }
            _ => files.push(argument),
        }
    }
    for file in files {
        let charts = charts(&std::fs::read_to_string(&file).expect("a file"));
        if is_around {
            report_around(&file, &charts, &options);
        } else {
            report(&file, &charts, &options, variants);
        }
    }
}

/// Prints one line about the charts of a file.
fn report(file: &str, charts: &[Chart], options: &AtlasOptions, variants: u64) {
    let clock = Clock::start();
    let atlas = packed(charts, options);
    let milliseconds = 1e3 * clock.seconds().processor;
    let name = file.rsplit('/').next().unwrap_or(file);
    let fill = atlas.utilization;
    print!("{name:32} {:4} {fill:.4} {milliseconds:5.0}", charts.len());
    for kind in KINDS.into_iter().filter(|_| variants > 0) {
        if kind == Kind::Rotation && options.positions == Positions::Layout {
            continue;
        }
        let (mut elsewhere, mut least, mut most) = (0, f64::INFINITY, f64::NEG_INFINITY);
        for seed in 0..variants {
            let variant = Variant::new(charts, kind, seed);
            let other = packed(&variant.charts, options);
            elsewhere += variant.n_elsewhere(&atlas, &other);
            least = least.min(other.utilization - fill);
            most = most.max(other.utilization - fill);
        }
        let mean = elsewhere as f64 / variants as f64;
        print!("  {kind:?} {mean:.1} {least:+.4} {most:+.4}");
    }
    println!();
}

fn map((uv, triangles): &Chart) -> ChartMap<'_> {
    ChartMap { uv, triangles }
}

/// Prints one line about the charts of a file. Every third chart stays where it was first packed.
fn report_around(file: &str, charts: &[Chart], options: &AtlasOptions) {
    let unit = f64::from(1 << GRID_BITS);
    let atlas = packed(charts, options);
    let placed = charts.iter().zip(&atlas.placed);
    let placed: Vec<Chart> = placed
        .map(|((_, triangles), placed)| {
            let uv = placed.grid.iter().map(|p| p.map(|x| f64::from(x) / unit));
            (uv.collect(), triangles.clone())
        })
        .collect();
    let (mut stays, mut others) = (Vec::new(), Vec::new());
    for (chart, placed) in placed.iter().enumerate() {
        if chart % 3 == 0 {
            let map = map(placed);
            stays.push(Stay { map, island: chart });
        } else {
            others.push(map(placed));
        }
    }
    let constraints = Constraints {
        stays: &stays,
        ..Constraints::default()
    };
    let clock = Clock::start();
    let around = pack_within(&others, &constraints, options, &|_| Control::Continue);
    let milliseconds = 1e3 * clock.seconds().processor;
    let name = file.rsplit('/').next().unwrap_or(file);
    let fill = around.map_or(0.0, |around| around.utilization);
    println!("{name:32} {:4} {fill:.4} {milliseconds:5.0}", charts.len());
}

fn packed(charts: &[Chart], options: &AtlasOptions) -> Atlas {
    let maps: Vec<ChartMap> = charts.iter().map(map).collect();
    pack(&maps, options).expect("a layout")
}

/// Changed charts, with their places in the original.
struct Variant {
    charts: Vec<Chart>,
    /// Chart of the original at each place, and the vertex of that chart at each of its places.
    origin: Vec<(usize, Vec<usize>)>,
}

impl Variant {
    fn new(charts: &[Chart], kind: Kind, seed: u64) -> Self {
        let mut random = Random::new(seed + 1);
        let whole = |chart: usize| (chart, (0..charts[chart].0.len()).collect());
        let mut variant = Self {
            charts: charts.to_vec(),
            origin: (0..charts.len()).map(whole).collect(),
        };
        match kind {
            Kind::Order => variant.shuffle(&mut random),
            Kind::Rotation => {
                for (uv, _) in &mut variant.charts {
                    let (sin, cos) = (TAU * random.unit()).sin_cos();
                    for [x, y] in uv {
                        [*x, *y] = [cos * *x - sin * *y, sin * *x + cos * *y];
                    }
                }
            }
            Kind::Scale => {
                let scale = SCALES[seed as usize % SCALES.len()];
                let coordinates = variant.charts.iter_mut().flat_map(|(uv, _)| uv);
                coordinates.flatten().for_each(|x| *x *= scale);
            }
            Kind::Vertex => {
                let chart = random.below(charts.len());
                let uv = &mut variant.charts[chart].0;
                let [low, high] = bounds_of(uv);
                let by = MOVED * (high[0] - low[0]).max(high[1] - low[1]);
                let (sin, cos) = (TAU * random.unit()).sin_cos();
                let vertex = random.below(uv.len());
                uv[vertex] = [uv[vertex][0] + cos * by, uv[vertex][1] + sin * by];
            }
        }
        variant
    }

    /// Reorders the charts, the vertices and the triangles of each.
    fn shuffle(&mut self, random: &mut Random) {
        let mut charts = std::mem::take(&mut self.charts);
        let order = shuffled(charts.len(), random);
        self.origin.clear();
        for chart in order {
            let (uv, triangles) = std::mem::take(&mut charts[chart]);
            let vertices = shuffled(uv.len(), random);
            let mut place = vec![0; uv.len()];
            for (new, &old) in vertices.iter().enumerate() {
                place[old] = new as u32;
            }
            let faces = shuffled(triangles.len(), random);
            let renumbered = faces
                .iter()
                .map(|&t| triangles[t].map(|v| place[v as usize]));
            let moved = vertices.iter().map(|&v| uv[v]).collect();
            self.charts.push((moved, renumbered.collect()));
            self.origin.push((chart, vertices));
        }
    }

    /// Counts the charts with a vertex that lies elsewhere.
    fn n_elsewhere(&self, atlas: &Atlas, other: &Atlas) -> usize {
        let most = ELSEWHERE / 1024.0 * f64::from(1_u32 << GRID_BITS);
        let placed = self.origin.iter().zip(&other.placed);
        placed
            .filter(|((chart, vertices), placed)| {
                let first = &atlas.placed[*chart].grid;
                vertices.iter().zip(&placed.grid).any(|(&old, new)| {
                    let [x, y] = [0, 1].map(|k| f64::from(first[old][k] - new[k]));
                    x.hypot(y) > most
                })
            })
            .count()
    }
}

/// Returns the numbers below `n` in random order.
fn shuffled(n: usize, random: &mut Random) -> Vec<usize> {
    let mut order: Vec<usize> = (0..n).collect();
    for i in (1..n).rev() {
        order.swap(i, random.below(i + 1));
    }
    order
}

/// Returns the connected parts of the UVs of an OBJ file. Faces are fans of triangles.
fn charts(text: &str) -> Vec<Chart> {
    let mut uv: Vec<[f64; 2]> = Vec::new();
    let mut triangles: Vec<[usize; 3]> = Vec::new();
    for line in text.lines() {
        let mut words = line.split_whitespace();
        match words.next() {
            Some("vt") => {
                let mut number = || words.next().and_then(|word| word.parse().ok());
                uv.push([number().expect("u"), number().expect("v")]);
            }
            Some("f") => {
                let corner = |word: &str| {
                    let index: Option<isize> =
                        word.split('/').nth(1).and_then(|it| it.parse().ok());
                    let index = index.expect("UVs");
                    (if index < 0 {
                        uv.len() as isize + index
                    } else {
                        index - 1
                    }) as usize
                };
                let face: Vec<usize> = words.map(corner).collect();
                triangles.extend((1..face.len() - 1).map(|k| [face[0], face[k], face[k + 1]]));
            }
            _ => {}
        }
    }
    let mut sets = UnionFind::new(uv.len());
    for &[a, b, c] in &triangles {
        sets.unite(a as u32, b as u32);
        sets.unite(b as u32, c as u32);
    }
    let mut parts: BTreeMap<u32, (BTreeMap<usize, u32>, Chart)> = BTreeMap::new();
    for triangle in triangles {
        let part = sets.find(triangle[0] as u32);
        let (numbers, (positions, faces)) = parts.entry(part).or_default();
        faces.push(triangle.map(|v| {
            *numbers.entry(v).or_insert_with(|| {
                positions.push(uv[v]);
                positions.len() as u32 - 1
            })
        }));
    }
    parts.into_values().map(|(_, chart)| chart).collect()
}
