//! Charts mapped to the plane.

use rayon::prelude::*;

use super::observer::Tracker;
use super::options::Settings;
use crate::barrier::BarrierKind;
use crate::charts::{Chart, halves};
use crate::embed::{self, Embedding, Pins};
use crate::numerics::vec2::doubled_area;
use crate::solver::{self, Iterate};

/// A chart, its map and the seconds of the observer's clock it took.
pub(super) struct MappedChart {
    pub(super) chart: Chart,
    pub(super) embedding: Embedding,
    pub(super) seconds: f64,
}

impl MappedChart {
    /// Area in the plane of the triangles that the surface winds as the chart does, less that of the others.
    ///
    /// Charts are wound as most of their area is in space. Where that is a tie, as in a wall modelled from both sides, the
    /// map decides.
    fn area_facing(&self) -> f64 {
        let area = |(t, triangle): (usize, &[u32; 3])| {
            let [a, b, c] = triangle.map(|v| self.embedding.uv[v as usize]);
            let doubled = doubled_area(a, b, c);
            if self.chart.is_wound_as_surface(t) {
                doubled
            } else {
                -doubled
            }
        };
        self.chart.disk.triangles.iter().enumerate().map(area).sum()
    }

    fn turn_over(&mut self) {
        self.chart.turn_over();
        for p in &mut self.embedding.uv {
            p[0] = -p[0];
        }
    }
}

/// Maps every chart of every mesh, the largest first.
pub(super) fn map_charts(
    charts: Vec<Vec<Chart>>,
    settings: &Settings,
    tracker: &Tracker,
) -> Vec<Vec<MappedChart>> {
    let mut maps: Vec<Vec<MappedChart>> = charts
        .iter()
        .map(|of_mesh| Vec::with_capacity(of_mesh.len()))
        .collect();
    let mut queue: Vec<((usize, usize), Chart)> = (charts.into_iter().enumerate())
        .flat_map(|(mesh, of_mesh)| (0..).zip(of_mesh).map(move |(c, chart)| ((mesh, c), chart)))
        .collect();
    let n_faces = |(_, chart): &(_, Chart)| chart.disk.triangles.len();
    tracker.charts(queue.len(), queue.iter().map(n_faces).sum());
    queue.sort_by_key(|entry| (std::cmp::Reverse(n_faces(entry)), entry.0));
    let mut mapped: Vec<((usize, usize), Vec<MappedChart>)> = queue
        .into_par_iter()
        .with_max_len(1)
        .map(|(id, chart)| (id, map_chart(chart, settings, tracker)))
        .collect();
    mapped.sort_by_key(|(id, _)| *id);
    for ((mesh, _), parts) in mapped {
        maps[mesh].extend(parts);
    }
    maps
}

/// A chart with its map; in several parts, each of them mapped, if floating point finds no valid map of the whole.
fn map_chart(chart: Chart, settings: &Settings, tracker: &Tracker) -> Vec<MappedChart> {
    let faces = chart.disk.triangles.len();
    let is_promised = settings.barrier != BarrierKind::None;
    let mut mapped = Vec::new();
    let mut pending = vec![chart];
    while let Some(chart) = pending.pop() {
        let begin = tracker.elapsed();
        let embedding = embedding(&chart, settings, tracker);
        let is_valid = embed::is_positive(&chart.disk.triangles, &embedding.uv);
        if is_promised && !is_valid && chart.disk.triangles.len() > 1 {
            pending.extend(halves(&chart));
            continue;
        }
        let mut whole = MappedChart {
            chart,
            embedding,
            seconds: tracker.elapsed().saturating_sub(begin).as_secs_f64(),
        };
        if whole.area_facing() < 0.0 {
            whole.turn_over();
        }
        mapped.push(whole);
    }
    tracker.chart_done(faces);
    mapped
}

fn embedding(chart: &Chart, settings: &Settings, tracker: &Tracker) -> Embedding {
    let options = embed::Options {
        energy: settings.energy,
        barrier: settings.barrier,
        beta: settings.barrier_strength,
        s: settings.barrier_support,
        pins: if settings.pin == 0 {
            Pins::None
        } else {
            Pins::Two
        },
        solver: solver::Settings::default(),
    };
    let faces = chart.disk.triangles.len();
    let watch = |iterate: &Iterate| tracker.iterate(faces, iterate);
    embed::parameterize(&chart.disk, &chart.positions, &options, &watch)
}
