//! A chart on its way below a bound.

use super::distortion::excess_and_area;
use super::predicted_slits::Predicted;
use super::slits::Slits;
use crate::charts::Chart;
use crate::charts::mapped::{Folds, MappedChart, map_chart};
use crate::charts::observer::Observer;
use unwrapd_maps::embed;
use unwrapd_method::numerics::vec3::polyline_length;

/// Mapped excess over predicted, before a chart has been mapped: a map trades angles for areas and does better than the
/// conformal flattening it is predicted by. Measured on 14 meshes: 0.1 to 0.3.
const MAPPED_OVER_PREDICTED: f64 = 0.17;

/// The least and most that [`MAPPED_OVER_PREDICTED`] may become where a map says otherwise. One that got stuck far from its optimum
/// would ask for dozens of slits; the next round shows what is really missing.
const LEAST_AND_MOST_RATIO: [f64; 2] = [0.05, 0.5];

/// A chart on its way below the bound.
pub struct PendingChart {
    slits: Option<Predicted>,
    pub map: Option<MappedChart>,
    /// What the map costs, or is expected to cost with the slits that are planned; and the area it is spent on.
    pub excess: f64,
    pub area: f64,
    /// Mapped excess over predicted, as last seen here.
    ratio: f64,
}

impl PendingChart {
    /// A chart without slits.
    pub fn unmapped(chart: Chart) -> Self {
        let slits = Predicted::new(chart);
        Self {
            excess: MAPPED_OVER_PREDICTED * slits.excess,
            area: slits.area,
            slits: Some(slits),
            map: None,
            ratio: MAPPED_OVER_PREDICTED,
        }
    }

    /// A chart that is mapped.
    pub fn of(map: MappedChart) -> Self {
        let [excess, area] = excess_and_area(&map, &map.rest_shapes());
        Self {
            slits: None,
            map: Some(map),
            excess,
            area,
            ratio: MAPPED_OVER_PREDICTED,
        }
    }

    /// The maps of those that are mapped.
    pub fn maps(pieces: Vec<Self>) -> impl Iterator<Item = MappedChart> {
        pieces.into_iter().filter_map(|piece| piece.map)
    }

    /// Plans a slit, or several; false if there is nothing to slit.
    pub fn cut(&mut self, is_far: bool) -> bool {
        self.planned(|slits| slits.cut(is_far))
    }

    /// Plans slits along lines, see [`Predicted::cut_along`].
    pub fn cut_along(&mut self, lines: &[Vec<[f64; 3]>]) -> bool {
        self.planned(|slits| slits.cut_along(lines))
    }

    fn planned(&mut self, plan: impl FnOnce(&mut Predicted) -> bool) -> bool {
        let slits = match (&mut self.slits, &self.map) {
            (Some(slits), _) => slits,
            (none, Some(map)) => {
                let slits = Predicted::new(map.chart.clone());
                let [least, most] = LEAST_AND_MOST_RATIO;
                let measured = self.excess / slits.excess.max(f64::MIN_POSITIVE);
                self.ratio = measured.clamp(least, most);
                none.insert(slits)
            }
            (None, None) => return false,
        };
        let is_cut = plan(slits);
        if is_cut {
            self.excess = self.ratio * slits.excess;
        }
        is_cut
    }

    /// The mirror images of the slits that are planned, but for so many.
    pub fn images(&self, n_first: usize) -> Vec<Vec<[f64; 3]>> {
        self.slits()
            .map_or(Vec::new(), |slits| slits.images(n_first))
    }

    /// How many slits are planned.
    pub fn n_slits(&self) -> usize {
        self.slits().map_or(0, |slits| slits.lines.len())
    }

    /// The length of the slits that are planned.
    pub fn slits_length(&self) -> f64 {
        let lines = self.slits().into_iter().flat_map(|slits| &slits.lines);
        lines.map(|line| polyline_length(line)).sum()
    }

    /// The chart that is slit or mapped.
    pub fn chart(&self) -> Option<&Chart> {
        let mapped = self.map.as_ref().map(|map| &map.chart);
        self.slits().map(Slits::chart).or(mapped)
    }

    /// Mapped, unless it is and no slit is new.
    pub fn mapped(self, options: &embed::Options, observer: &dyn Observer) -> Vec<Self> {
        match self.slits {
            Some(Predicted { slits, .. }) if self.map.is_none() || slits.is_cut() => {
                let mapped = |map| Self {
                    ratio: self.ratio,
                    ..Self::of(map)
                };
                let charts = slits.opened().into_iter();
                let pieces: Vec<Self> = charts
                    .flat_map(|chart| map_chart(chart, options, Folds::Cut, observer))
                    .map(mapped)
                    .collect();
                let n = pieces.len() as isize;
                observer.charted(n, n - 1);
                pieces
            }
            _ => vec![Self {
                slits: None,
                ..self
            }],
        }
    }

    /// Whether it is mapped, but slits are new.
    pub fn is_mapped_again(&self) -> bool {
        self.map.is_some() && self.slits().is_some_and(Slits::is_cut)
    }

    /// The slits that are planned.
    pub fn slits(&self) -> Option<&Slits> {
        self.slits.as_ref().map(|predicted| &predicted.slits)
    }

    /// Its triangles.
    pub fn n_faces(&self) -> usize {
        self.chart().map_or(0, |chart| chart.disk.triangles.len())
    }
}
