//! In which order charts are placed, and how each is turned.
use super::Turns;
use super::orientation::{self, Bounds};
use super::outline::Outline;
use crate::numerics::hull::convex_hull;

/// What a layout is made from.
#[derive(Clone, Debug)]
pub(super) struct Plan {
    /// The charts, each turned to an angle.
    pub outlines: Vec<Outline>,
    /// For each chart the quarter turns beyond that: one, or what the layout finds best.
    pub turns: Vec<QuarterTurns>,
    /// Indices of the charts that have triangles, in the order in which they are placed.
    pub order: Vec<usize>,
    /// For each chart how far to the right and up it lies at least, as shares of the side; empty where nothing is known.
    pub corners: Vec<[f64; 2]>,
}

/// The quarter turns that a chart may be placed with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum QuarterTurns {
    Any,
    Only(u32),
}

impl Plan {
    /// The largest first, each in the smallest rectangle.
    pub(super) fn largest_first(outlines: &[Outline], turns: Turns) -> Self {
        let total: f64 = outlines.iter().map(|o| o.size * o.size).sum();
        let turned = outlines.iter().map(|outline| {
            // A chart that is most of the atlas decides its side; others fit better as rectangles.
            let bounds = if turns == Turns::Quarters {
                Bounds::Given
            } else if 2.0 * outline.size * outline.size > total {
                Bounds::Square
            } else {
                Bounds::Rectangle
            };
            let hull = convex_hull(outline.corners());
            outline.turned(orientation::direction(&hull, bounds))
        });
        let outlines: Vec<Outline> = turned.collect();
        let mut order: Vec<usize> = (0..outlines.len())
            .filter(|&i| outlines[i].n_triangles > 0)
            .collect();
        let half_perimeter = |i: usize| outlines[i].extent[0] + outlines[i].extent[1];
        order.sort_by(|&i, &j| half_perimeter(j).total_cmp(&half_perimeter(i)));
        Self {
            turns: vec![QuarterTurns::Any; outlines.len()],
            corners: Vec::new(),
            outlines,
            order,
        }
    }

    /// Sum of the charts' areas, in mesh units.
    pub(super) fn area(&self) -> f64 {
        self.outlines.iter().map(|o| o.size * o.size).sum()
    }
}
