//! Layouts in which charts lie exactly as near to each other as they may.
//!
//! A raster of cells keeps charts up to a cell farther apart than it has to. Here they are squeezed on a raster so fine that their
//! distances are nearly right, measured, and given as much more room as is still missing.
use super::attempt::stretch;
use super::layout::Layout;
use super::outline::Outline;
use super::spot::{Corner, Spot};
use super::squeeze::{Body, Squeezed};
use super::{AtlasOptions, GRID_SIDE};
use crate::certificate::{Bounds, BoxTree, Visit, bounds_of, search_budget, segment_distance};
use rayon::prelude::*;
use std::sync::Arc;

/// Times that charts are given more room, or less.
const ROUNDS: usize = 4;
/// What they are given beyond what is missing, and how far vertices may be moved when they are rounded, in cells.
const SPARE: f64 = 0.03;
const ROUNDED: f64 = 0.01;
/// The share of the words that may be read which each of those rounds reads at most.
const SHARE: u64 = 16;
/// Places to a cell.
const PLACES: f64 = 64.0;

/// A layout near a squeezed one, in cells; none where charts could not be brought as far apart as they must be, or where one is so
/// small that it has to be enlarged.
///
/// `outlines` are turned as the squeezed poses say relative to `level`, of which one mesh unit is `scale` cells.
pub(super) fn layout(
    level: &[&Outline],
    mut squeezed: Squeezed,
    scale: f64,
    options: &AtlasOptions,
) -> Option<(Vec<Outline>, Layout)> {
    let texels = f64::from(options.packed_texels());
    let padding =
        |side: f64| texels * side / (f64::from(options.texture.resolution.longer()) - texels);
    let kept = padding(squeezed.side);
    let bodies: Vec<Arc<Body>> = (level.par_iter())
        .map(|outline| Arc::new(Body::new(outline, scale, kept)))
        .collect();
    let (mut room, mut best) = (0.0, None);
    for _ in 0..ROUNDS {
        if !squeezed.loosen(&bodies, room, options.search_words / SHARE) {
            break;
        }
        let places = Places::new(level, &squeezed, scale);
        let padding = padding(places.side);
        let missing = padding + 2.0 * ROUNDED - places.gap(scale);
        if missing <= 0.0 {
            best = Some((places, padding));
        }
        if (-2.0 * SPARE..=0.0).contains(&missing) {
            break;
        }
        room += missing + SPARE;
    }
    let (places, padding) = best?;
    places.layout(scale, padding, options)
}

/// Charts at rounded places.
struct Places {
    outlines: Vec<Outline>,
    /// Lower left corners, in parts of a cell.
    corners: Vec<[u32; 2]>,
    /// Side of the square around them, in cells.
    side: f64,
}

impl Places {
    fn new(level: &[&Outline], squeezed: &Squeezed, scale: f64) -> Self {
        let posed = level.iter().zip(&squeezed.poses);
        let (outlines, corners) = posed
            .map(|(level, pose)| {
                let outline = level.rotated(pose.angle);
                let middle = outline.place(level.middle());
                let corner = [0, 1].map(|k| pose.middle[k] - middle[k] * scale);
                (
                    outline,
                    corner.map(|x| (x * PLACES).round().max(0.0) as u32),
                )
            })
            .unzip();
        let mut places = Self {
            outlines,
            corners,
            side: 0.0,
        };
        let placed = places.outlines.iter().zip(&places.corners);
        let reach = placed.flat_map(|(outline, corner)| {
            [0, 1].map(|k| f64::from(corner[k]) / PLACES + outline.extent[k] * scale)
        });
        places.side = reach.fold(0.0, f64::max);
        places
    }

    /// The smallest distance of two charts, in cells.
    fn gap(&self, scale: f64) -> f64 {
        let mut edges = Vec::new();
        let mut charts = Vec::new();
        for ((chart, outline), corner) in (0..).zip(&self.outlines).zip(&self.corners) {
            let corner = corner.map(|x| f64::from(x) / PLACES);
            let place = |p: [f64; 2]| [0, 1].map(|k| corner[k] + p[k] * scale);
            edges.extend(outline.edges().map(|edge| edge.map(place)));
            charts.resize(edges.len(), chart);
        }
        let boxes: Vec<Bounds> = edges.iter().map(|edge| bounds_of(edge)).collect();
        let distance = |i: u32, j: u32| segment_distance(edges[i as usize], edges[j as usize]);
        match BoxTree::new(&boxes).closest(&charts, search_budget(edges.len()), distance) {
            (gap, Visit::Complete) => gap,
            (_, Visit::Truncated) => 0.0,
        }
    }

    fn layout(
        self,
        scale: f64,
        padding: f64,
        options: &AtlasOptions,
    ) -> Option<(Vec<Outline>, Layout)> {
        let border = PLACES * (padding / 2.0 + ROUNDED);
        let cell = GRID_SIDE / (PLACES * self.side + 2.0 * border);
        let scale = PLACES * scale * cell;
        let fits = |outline: &Outline| stretch(outline, scale) <= 1.0;
        if !self.outlines.iter().all(fits) {
            return None;
        }
        let spots = self.corners.iter().map(|&[x, y]| {
            let spot = Spot {
                corner: Corner { page: 0, x, y },
                ..Spot::default()
            };
            (spot, 1.0)
        });
        let layout = Layout {
            scale,
            cell,
            border,
            spare: PLACES * ROUNDED,
            padding_texels: f64::from(options.padding_texels),
            charts: spots.collect(),
        };
        Some((self.outlines, layout))
    }
}
