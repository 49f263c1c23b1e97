//! In which order charts are placed, and how each is turned.
use std::f64::consts::TAU;

use super::copies::{Shape, copies};
use super::outline::{Enclosure, Outline, direction};
use super::page::Texture;
use super::{AtlasOptions, Rotation};
use unwrapd_method::numerics::hull::convex_hull;

/// The share of a page that charts are hoped to fill.
pub(super) const HOPE: f64 = 0.75;

/// Largest difference between the angles of copies that lie alike, in radians.
const ALIKE: f64 = 1e-2;

/// Number of charts per copy that a shape must have: among thousands of charts, some are equal by chance.
const CHARTS_PER_COPY: usize = 100;

/// What a layout is made from.
#[derive(Clone, Debug)]
pub(super) struct Plan {
    /// The charts, each turned to an angle.
    pub outlines: Vec<Outline>,
    /// For each chart the quarter turns beyond that: one, or what the layout finds best.
    pub turns: Vec<QuarterTurns>,
    /// Indices of the charts that have triangles, in the order in which they are placed.
    pub order: Vec<usize>,
    /// Where the charts lie about, if that is known.
    pub near: Option<Near>,
}

/// A layout on a coarser raster, near which a finer one is looked for.
#[derive(Clone, Debug)]
pub(super) struct Near {
    /// For each chart its page, and how far to the right and up it lies there at least, as shares of the longer side.
    pub corners: Vec<(u32, [f64; 2])>,
    /// How much farther it may lie before it is looked for elsewhere.
    pub window: f64,
    /// Mesh units along the longer side.
    pub extent: f64,
}

/// The quarter turns that a chart may be placed with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum QuarterTurns {
    Any,
    Only(u32),
}

impl Plan {
    /// The largest first, each in the smallest rectangle.
    pub(super) fn largest_first(outlines: &[Outline], options: &AtlasOptions) -> Self {
        let texture = options.texture;
        let total: f64 = outlines.iter().map(|o| o.size * o.size).sum();
        let is_alone = outlines.iter().filter(|o| o.n_triangles > 0).count() == 1;
        let page = total / f64::from(texture.pages);
        let level = |outline: &Outline| match options.rotation {
            Rotation::Any => outline
                .upright()
                .filter(|_| is_alone)
                .unwrap_or_else(|| level(outline, page, texture)),
            rotation => outline.clone().limited_to(rotation),
        };
        let mut outlines = alike(outlines.to_vec(), 0, options.rotation, level);
        mark_copies(&mut outlines);
        let turns = match options.rotation {
            Rotation::Any | Rotation::Quarter => QuarterTurns::Any,
            Rotation::None => QuarterTurns::Only(0),
        };
        Self {
            order: by_size(&outlines.iter().collect::<Vec<_>>()),
            turns: vec![turns; outlines.len()],
            near: None,
            outlines,
        }
    }

    /// The longest side of a chart's bounding rectangle, in mesh units.
    pub(super) fn longest(&self) -> f64 {
        let extents = self.outlines.iter().flat_map(|outline| outline.extent);
        extents.fold(0.0, f64::max)
    }

    /// Sum of the charts' areas, in mesh units.
    pub(super) fn area(&self) -> f64 {
        self.outlines.iter().map(|o| o.size * o.size).sum()
    }
}

/// Turns the charts from index `n_level` on: copies like the first of their kind, others by `level`.
pub(super) fn alike(
    mut outlines: Vec<Outline>,
    n_level: usize,
    rotation: Rotation,
    level: impl Fn(&Outline) -> Outline,
) -> Vec<Outline> {
    let shapes: Vec<Shape> = outlines.iter().map(|outline| outline.shape).collect();
    for (i, (first, angle)) in copies(&shapes).into_iter().enumerate().skip(n_level) {
        outlines[i] = if first < i && rotation == Rotation::Any {
            outlines[i].turned_like(&outlines[first], angle)
        } else {
            level(&outlines[i])
        };
    }
    outlines
}

/// Marks the charts that have copies. Returns the first copy of each chart, possibly itself.
pub(super) fn mark_copies(outlines: &mut [Outline]) -> Vec<usize> {
    let kinds = kinds(outlines);
    let mut n_alike = vec![0; outlines.len()];
    for &first in &kinds {
        n_alike[first] += 1;
    }
    let least = outlines.len().div_ceil(CHARTS_PER_COPY).max(2);
    for (outline, &first) in outlines.iter_mut().zip(&kinds) {
        outline.has_copies = n_alike[first] >= least;
    }
    kinds
}

/// Returns for each chart the first copy that lies alike, possibly itself.
fn kinds(outlines: &[Outline]) -> Vec<usize> {
    let shapes: Vec<Shape> = outlines.iter().map(|outline| outline.shape).collect();
    let lies_like = |(i, (first, _)): (usize, (usize, f64))| {
        let turned = (outlines[i].lean() - outlines[first].lean()).rem_euclid(TAU);
        if turned.min(TAU - turned) < ALIKE {
            first
        } else {
            i
        }
    };
    copies(&shapes)
        .into_iter()
        .enumerate()
        .map(lies_like)
        .collect()
}

/// A chart turned upright, or else to its smallest rectangle; one that is longer than the side of a
/// page with charts of an area of `total` may lie across it. One that is most of such a page decides its side, and is
/// turned to the smallest page.
pub(super) fn level(outline: &Outline, total: f64, texture: Texture) -> Outline {
    let is_most = 2.0 * outline.size * outline.size > total;
    let outline = outline.upright_within((total / HOPE).sqrt());
    if outline.rotation() != Rotation::Any {
        return outline;
    }
    turned(
        &outline,
        if is_most {
            Enclosure::Page(texture.resolution.halvings())
        } else {
            Enclosure::Rectangle
        },
    )
}

fn turned(outline: &Outline, enclosure: Enclosure) -> Outline {
    let hull = convex_hull(outline.corners());
    outline.turned(direction(&hull, enclosure))
}

/// The charts that have triangles, the largest first.
pub(super) fn by_size(outlines: &[&Outline]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..outlines.len())
        .filter(|&i| outlines[i].n_triangles > 0)
        .collect();
    let half_perimeter = |i: usize| outlines[i].extent[0] + outlines[i].extent[1];
    order.sort_by(|&i, &j| half_perimeter(j).total_cmp(&half_perimeter(i)));
    order
}
