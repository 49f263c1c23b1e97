//! What a chart takes of the bound.

use crate::charts::bound::distortion::{excess_and_area, stretched_area};
use crate::charts::bound::quality::Bound;
use crate::charts::mapped::MappedChart;
use unwrapd_maps::embed::RestShapes;

/// The area of a chart's surface, and what its map takes of the bound.
#[derive(Clone, Copy, Default)]
pub struct Cost {
    pub area: f64,
    /// The excess of its energy, summed over the area.
    pub excess: f64,
    /// The area that is stretched more than it may be.
    pub stretched: f64,
}

impl Cost {
    pub fn of(map: &MappedChart, rest: &RestShapes, bound: &Bound) -> Self {
        let [excess, area] = excess_and_area(map, rest);
        let stretched = |most| stretched_area(map, rest, most);
        Self {
            area,
            excess,
            stretched: bound.stretch.map_or(0.0, stretched),
        }
    }
}
