//! In which order charts are placed, and how each is turned.
use super::orientation::{self, Bounds};
use super::outline::Outline;
use super::texture::Texture;
use super::{AtlasOptions, Turns};
use unwrapd_method::numerics::hull::convex_hull;

/// The share of a page that charts are hoped to fill.
pub(super) const HOPE: f64 = 0.75;

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
        let level = |outline: &Outline| match options.turns {
            Turns::Any => level(outline, total / f64::from(texture.pages), texture),
            Turns::Quarters => turned(outline, Bounds::Given),
        };
        let outlines: Vec<Outline> = outlines.iter().map(level).collect();
        Self {
            order: by_size(&outlines.iter().collect::<Vec<_>>()),
            turns: vec![QuarterTurns::Any; outlines.len()],
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

/// A chart turned upright, or else to its smallest rectangle; one that is longer than the side of a
/// page with charts of an area of `total` may lie across it. One that is most of such a page decides its side, and is
/// turned to the smallest page.
pub(super) fn level(outline: &Outline, total: f64, texture: Texture) -> Outline {
    let is_most = 2.0 * outline.size * outline.size > total;
    let outline = outline.upright_within((total / HOPE).sqrt());
    if outline.is_upright() {
        return outline;
    }
    turned(
        &outline,
        if is_most {
            Bounds::Page(texture.resolution.halvings())
        } else {
            Bounds::Rectangle
        },
    )
}

fn turned(outline: &Outline, bounds: Bounds) -> Outline {
    let hull = convex_hull(outline.corners());
    outline.turned(orientation::direction(&hull, bounds))
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
