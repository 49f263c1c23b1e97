//! All charts mapped, from one queue.

use rayon::prelude::*;
use std::cmp::Reverse;

use super::observer::Tracker;
use super::options::Settings;
use crate::barrier::BarrierKind;
use crate::charts::{Chart, Cut, Folds, MappedChart, charts, charts_under_bound, map_chart};
use crate::embed::{self, Pins};
use crate::mesh::Surface;
use crate::solver;

/// The charts of every surface with their maps.
pub(super) fn mapped_charts(
    surfaces: &[Surface],
    settings: &Settings,
    tracker: &Tracker,
) -> Vec<Vec<MappedChart>> {
    let is_promised = settings.barrier != BarrierKind::None;
    if settings.cut == Cut::Auto && is_promised {
        tracker.charts(
            surfaces.len(),
            surfaces.iter().map(|s| s.triangles.len()).sum(),
        );
        let options = options(settings);
        return surfaces
            .par_iter()
            .map(|surface| {
                let charts = charts_under_bound(surface, settings.quality, &options, tracker);
                tracker.chart_done(surface.triangles.len());
                charts
            })
            .collect();
    }
    let charts: Vec<Vec<Chart>> = surfaces
        .par_iter()
        .map(|surface| charts(surface, settings.cut))
        .collect();
    map_charts(charts, settings, tracker)
}

/// Maps every chart of every mesh, the largest first.
fn map_charts(
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
    queue.sort_by_key(|entry| (Reverse(n_faces(entry)), entry.0));
    let (options, folds) = (options(settings), folds(settings));
    let mut mapped: Vec<((usize, usize), Vec<MappedChart>)> = queue
        .into_par_iter()
        .with_max_len(1)
        .map(|(id, chart)| {
            let faces = chart.disk.triangles.len();
            let parts = map_chart(chart, &options, folds, tracker);
            tracker.chart_done(faces);
            (id, parts)
        })
        .collect();
    mapped.sort_by_key(|(id, _)| *id);
    for ((mesh, _), parts) in mapped {
        maps[mesh].extend(parts);
    }
    maps
}

/// Whoever asks for one chart per component wants no other seams, and without a barrier nothing is promised.
pub(super) fn folds(settings: &Settings) -> Folds {
    if settings.cut == Cut::Disk || settings.barrier == BarrierKind::None {
        Folds::Keep
    } else {
        Folds::Cut
    }
}

fn options(settings: &Settings) -> embed::Options {
    embed::Options {
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
    }
}
