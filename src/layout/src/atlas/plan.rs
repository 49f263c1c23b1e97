//! Plan of a layout: the order in which charts are placed, and the angle of each.
use std::f64::consts::{FRAC_PI_2, TAU};
use std::sync::Arc;

use super::copies::{Moments, copies};
use super::outline::{Outline, outlines};
use super::page::Texture;
use super::problem::{AtlasError, AtlasOptions, ChartMap, Rotation};
use unwrapd_method::numerics::hull::{convex_hull, smallest_page, smallest_rectangle};

/// Share of a page that charts are expected to fill.
pub(super) const HOPE: f64 = 0.75;

/// Largest difference between the angles of copies that lie alike, in radians.
const ALIKE: f64 = 1e-2;

/// Number of charts for each copy that a shape must have, and at least two: among thousands of charts, some are equal by chance.
const CHARTS_PER_COPY: usize = 100;

/// Maximum number of charts that are searched or squeezed. With more, the large ones leave enough room for the small ones.
pub(super) const MOST_CHARTS: usize = 512;

/// Charts whose area is a smaller share of their room than this count as lines: the difference of roots would be rounding.
pub(super) const SLIVERS: f64 = 1e-9;

/// Charts of a layout, each turned to an angle, and the order in which they are placed.
#[derive(Clone, Debug)]
pub(super) struct Plan {
    pub outlines: Vec<Outline>,
    /// Quarter turns of each chart beyond that, or `None` where the layout finds the best number.
    pub turns: Vec<Option<u32>>,
    /// Indices of the charts that have triangles, the largest first.
    pub order: Vec<usize>,
    /// First chart of its kind for each chart, possibly itself.
    pub kind: Arc<[usize]>,
}

impl Plan {
    /// Plans to place the largest charts first.
    pub(super) fn of(charts: &[ChartMap], options: &AtlasOptions) -> Result<Self, AtlasError> {
        let outlines = outlines(charts)?;
        let (rotation, texture) = (options.rotation, options.texture);
        Ok(Self::leveled(outlines, 0, rotation, texture))
    }

    /// Turns the charts from index `n_level` on, which have yet to be turned. If any angle is permitted, copies lie alike, a chart that
    /// is alone is turned upright if it is straight, and other charts are turned by [`level`].
    pub(super) fn leveled(
        mut outlines: Vec<Outline>,
        n_level: usize,
        rotation: Rotation,
        texture: Texture,
    ) -> Self {
        let is_alone = outlines.iter().filter(|o| o.n_triangles > 0).count() == 1;
        let page = area(&outlines) / f64::from(texture.pages);
        let shapes: Vec<Moments> = outlines.iter().map(|outline| outline.moments).collect();
        for (i, (first, angle)) in copies(&shapes).into_iter().enumerate().skip(n_level) {
            let outline = &outlines[i];
            outlines[i] = match rotation {
                Rotation::Any if first < i => outline.turned_like(&outlines[first], angle),
                Rotation::Any => (outline.upright().filter(|_| is_alone))
                    .unwrap_or_else(|| level(outline, page, texture)),
                _ => outline.clone().limited_to(rotation),
            };
        }
        Self::largest_first(outlines, rotation)
    }

    /// Plans to place charts at their angles, the largest first.
    pub(super) fn largest_first(mut outlines: Vec<Outline>, rotation: Rotation) -> Self {
        let turns = match rotation {
            Rotation::Any | Rotation::Quarter => None,
            Rotation::None => Some(0),
        };
        Self {
            kind: mark_copies(&mut outlines).into(),
            order: by_size(&outlines),
            turns: vec![turns; outlines.len()],
            outlines,
        }
    }

    /// Returns the plan with the leaning charts turned upright; `None` if no chart leans.
    pub(super) fn straightened(&self) -> Option<Self> {
        let straight: Vec<Option<Outline>> =
            self.outlines.iter().map(Outline::straightened).collect();
        straight.iter().any(Option::is_some).then_some(())?;
        let straight = straight.into_iter().zip(&self.outlines);
        let outlines = straight.map(|(it, level)| it.unwrap_or_else(|| level.clone()));
        // Only charts that may lie at any angle lean.
        Some(Self::largest_first(outlines.collect(), Rotation::Any))
    }

    /// Returns the longest side of all bounding rectangles, in mesh units.
    fn longest(&self) -> f64 {
        let extents = self.outlines.iter().flat_map(|outline| outline.extent);
        extents.fold(0.0, f64::max)
    }

    /// Returns whether the charts have an area that a page could be filled with.
    pub(super) fn has_area(&self) -> bool {
        self.area() > SLIVERS * self.longest().powi(2)
    }

    /// Returns the sum of the charts' areas, in square mesh units.
    pub(super) fn area(&self) -> f64 {
        area(&self.outlines)
    }
}

fn area(outlines: &[Outline]) -> f64 {
    outlines.iter().map(|o| o.size * o.size).sum()
}

/// Marks the charts that have enough copies. Returns the first chart of each kind for each chart, possibly itself.
fn mark_copies(outlines: &mut [Outline]) -> Vec<usize> {
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

/// Returns for each chart the first chart that it is a copy of, if both lie alike; otherwise, the chart itself.
fn kinds(outlines: &[Outline]) -> Vec<usize> {
    let shapes: Vec<Moments> = outlines.iter().map(|outline| outline.moments).collect();
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

/// Turns a straight chart upright if it is then no longer than the side of a square page for charts with a total area of `total`.
/// Turns other charts to their smallest enclosing rectangle, so that a longer chart may lie across the page. A chart with more than
/// half of the area decides the size of the page, and is turned to its smallest enclosing page.
fn level(outline: &Outline, total: f64, texture: Texture) -> Outline {
    let is_most = 2.0 * outline.size * outline.size > total;
    let outline = outline.upright_within((total / HOPE).sqrt());
    if outline.rotation() != Rotation::Any {
        return outline;
    }
    let hull = convex_hull(outline.corners());
    let [u, v] = texture.resolution.halvings();
    let around = if is_most {
        smallest_page(&hull, 1.0 / texture.share())
    } else {
        smallest_rectangle(&hull)
    };
    // The longer side lies along u, except on an upright page.
    let angle = around.angle + if is_most && u > v { FRAC_PI_2 } else { 0.0 };
    outline.turned([angle.cos(), angle.sin()])
}

/// Returns the indices of the charts that have triangles, in descending order of the half perimeters of their rectangles.
fn by_size(outlines: &[Outline]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..outlines.len())
        .filter(|&i| outlines[i].n_triangles > 0)
        .collect();
    let half_perimeter = |i: usize| outlines[i].extent[0] + outlines[i].extent[1];
    order.sort_by(|&i, &j| half_perimeter(j).total_cmp(&half_perimeter(i)));
    order
}
