//! Charts of authored UVs by their faults.

use super::stacks::StackedCharts;
use super::topology::UvTopology;
use serde::Serialize;
use std::collections::HashSet;
use std::fmt;

/// Counts of charts by what they are. A chart with several faults counts for the first of these: without area, folded,
/// overlapping, tiled, outside.
#[derive(Clone, PartialEq, Eq, Debug, Default, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct Islands {
    /// Charts without a fault.
    pub sound: usize,
    /// Charts without a face of UV area.
    pub without_area: usize,
    /// Charts with a face that is flipped, has no UV area or cannot be judged, and charts that are not orientable.
    pub folded: usize,
    /// Charts that overlap themselves or another chart, except in accepted stacks; 0 when that was not tested.
    pub overlapping: usize,
    /// Charts longer than a tile, which repeat a texture.
    pub tiled: usize,
    /// Other charts that are not inside the unit square.
    pub outside: usize,
    /// Charts with a fault.
    pub faulty: Vec<FaultyIsland>,
}

/// Describes the counts in words.
impl fmt::Display for Islands {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} sound", self.sound)?;
        let faults = [
            (self.without_area, "without area"),
            (self.folded, "folded"),
            (self.overlapping, "overlapping"),
            (self.tiled, "tiled"),
            (self.outside, "outside the square"),
        ];
        for (n, what) in faults {
            if n > 0 {
                write!(f, ", {n} {what}")?;
            }
        }
        Ok(())
    }
}

/// A chart with a fault.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct FaultyIsland {
    /// Its number, in the order of the first faces of charts.
    pub chart: u32,
    /// Its first face.
    pub face: u32,
    /// Its first fault.
    pub fault: IslandFault,
}

/// Fault of a chart.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
#[serde(rename_all = "snake_case")]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub enum IslandFault {
    /// No face has UV area.
    WithoutArea,
    /// A face is flipped, has no UV area or cannot be judged, or the chart is not orientable.
    Folded,
    /// It overlaps itself or another chart.
    Overlapping,
    /// It is longer than a tile.
    Tiled,
    /// It is not inside the unit square.
    Outside,
}

/// Facts about the faces of a chart.
#[derive(Clone)]
struct ChartFacts {
    /// The first face; `None` for a chart of exempt faces alone.
    first: Option<u32>,
    has_area: bool,
    is_folded: bool,
    low: [f64; 2],
    high: [f64; 2],
}

/// Sorts the charts by their faults; `overlapping` holds charts that overlap, one of each stack. Charts of exempt faces
/// alone are left out.
pub(super) fn judge_islands(
    topology: &UvTopology,
    stacked: &StackedCharts,
    overlapping: &HashSet<u32>,
) -> Islands {
    let mut islands = Islands::default();
    for (chart, facts) in (0..).zip(chart_facts(topology)) {
        let Some(face) = facts.first else {
            continue;
        };
        let overlaps = overlapping.contains(&stacked.first[chart as usize]);
        let (count, fault) = match facts.fault(overlaps) {
            None => {
                islands.sound += 1;
                continue;
            }
            Some(fault) => {
                let count = match fault {
                    IslandFault::WithoutArea => &mut islands.without_area,
                    IslandFault::Folded => &mut islands.folded,
                    IslandFault::Overlapping => &mut islands.overlapping,
                    IslandFault::Tiled => &mut islands.tiled,
                    IslandFault::Outside => &mut islands.outside,
                };
                (count, fault)
            }
        };
        *count += 1;
        islands.faulty.push(FaultyIsland { chart, face, fault });
    }
    islands
}

fn chart_facts(topology: &UvTopology) -> Vec<ChartFacts> {
    let is_judged = |f: usize| topology.is_judged(f);
    let positive = topology.chart_orientations(is_judged);
    let new = |nonorientable: &bool| ChartFacts {
        first: None,
        has_area: false,
        is_folded: *nonorientable,
        low: [f64::INFINITY; 2],
        high: [f64::NEG_INFINITY; 2],
    };
    let mut charts: Vec<ChartFacts> = topology.charts.nonorientable.iter().map(new).collect();
    for (face, corners) in topology.uvs.iter().enumerate() {
        let chart = topology.charts.of_face[face] as usize;
        let facts = &mut charts[chart];
        let sign = topology.orientation_in_chart(face);
        if topology.repeats_position(face) && !topology.unusable[face] {
            facts.is_folded |= sign != 0 && sign != positive[chart];
            continue;
        }
        facts.first.get_or_insert(face as u32);
        facts.has_area |= sign != 0;
        facts.is_folded |= sign == 0 || sign != positive[chart] || topology.unusable[face];
        for uv in corners {
            for axis in 0..2 {
                facts.low[axis] = facts.low[axis].min(uv[axis]);
                facts.high[axis] = facts.high[axis].max(uv[axis]);
            }
        }
    }
    charts
}

impl ChartFacts {
    fn fault(&self, overlaps: bool) -> Option<IslandFault> {
        let is_any = |is: &dyn Fn(usize) -> bool| (0..2).any(is);
        if !self.has_area {
            Some(IslandFault::WithoutArea)
        } else if self.is_folded {
            Some(IslandFault::Folded)
        } else if overlaps {
            Some(IslandFault::Overlapping)
        } else if is_any(&|axis| self.high[axis] - self.low[axis] > 1.0) {
            Some(IslandFault::Tiled)
        } else if is_any(&|axis| self.low[axis] < 0.0 || self.high[axis] > 1.0) {
            Some(IslandFault::Outside)
        } else {
            None
        }
    }
}
