//! Charts laid side by side as rigid pieces.

use crate::charts::give_back::border::{Borders, Run};
use crate::charts::give_back::laid::Laid;
use crate::charts::give_back::occupied::Ground;
use crate::charts::mapped::MappedChart;
use crate::charts::observer::Observer;
use crate::mesh::Surface;
use crate::numerics::vec2::{cross, dot, sub};
use crate::plane::keep_apart;
use crate::solver::Control;
use std::collections::{BTreeMap, BTreeSet};

/// A border along which charts are joined has at least this share of the outline of the smaller: a
/// disc that hangs by one of a hundred edges makes no layout easier to read.
const LEAST_SHARE: f64 = 0.1;

/// How far the two sides of a border may differ, as a part of its length.
const SAME: f64 = 1e-5;

/// How far a border may turn at a vertex: the sine of the angle.
const STRAIGHT: f64 = 1e-3;

/// The least distance of an outline from itself, as a part of its extent: rounding would close what
/// is narrower.
const APART: f64 = 1e-6;

/// Charts with maps that keep lengths, joined along straight borders where none covers another.
///
/// The smallest comes first, and its longest border. Maps stay as they are but for their place.
///
/// Ends early when the observer wants the work to end.
pub fn joined(
    surface: &Surface,
    charts: Vec<MappedChart>,
    observer: &dyn Observer,
) -> Vec<MappedChart> {
    if charts.len() < 2 {
        return charts;
    }
    let charts: BTreeMap<u32, MappedChart> = (0..).zip(charts).collect();
    let mut joining = Joining {
        borders: Borders::new(surface, charts.iter().map(|(&n, map)| (n, &map.chart))),
        charts,
        grounds: BTreeMap::new(),
        observer,
    };
    while joining.pass() {}
    joining.charts.into_values().collect()
}

struct Joining<'a> {
    borders: Borders<'a>,
    charts: BTreeMap<u32, MappedChart>,
    /// The faces of charts next to which others were laid.
    grounds: BTreeMap<u32, Ground>,
    observer: &'a dyn Observer,
}

impl Joining<'_> {
    /// Tries to join each chart to a larger one, the smallest first; false if none was.
    fn pass(&mut self) -> bool {
        let size = |number: u32, map: &MappedChart| (map.area().to_bits(), number);
        let all = self.charts.iter();
        let mut queue: BTreeSet<(u64, u32)> = all.map(|(&n, map)| size(n, map)).collect();
        let n_before = queue.len();
        while self.observer.control() == Control::Continue
            && let Some((_, number)) = queue.pop_first()
        {
            if let Some(neighbor) = self.join(number) {
                queue.retain(|&(_, other)| other != neighbor);
                queue.insert(size(neighbor, &self.charts[&neighbor]));
            }
        }
        self.charts.len() < n_before
    }

    /// Joins a chart to a neighbor, which is returned.
    fn join(&mut self, number: u32) -> Option<u32> {
        let map = &self.charts[&number];
        self.observer.worked(map.chart.disk.triangles.len());
        let outline = outline(map);
        let mut runs: Vec<Run> = (self.borders.runs(number, &self.charts).iter())
            .flat_map(|run| straight_parts(run, &map.embedding.uv))
            .collect();
        let uv = &map.embedding.uv;
        runs.sort_by(|a, b| b.length(uv).total_cmp(&a.length(uv)));
        let runs: Vec<Run> = (runs.into_iter())
            .take_while(|run| run.length(uv) >= LEAST_SHARE * outline)
            .collect();
        runs.into_iter().find_map(|run| {
            let joint = self.laid_beside(number, &run)?;
            self.charts.remove(&number);
            self.grounds.remove(&number);
            self.grounds.remove(&run.neighbor);
            self.borders.place(run.neighbor, &joint.chart);
            self.charts.insert(run.neighbor, joint);
            Some(run.neighbor)
        })
    }

    /// A chart and its neighbor as one, if they fit and neither covers the other.
    fn laid_beside(&mut self, number: u32, run: &Run) -> Option<MappedChart> {
        let (map, neighbor) = (&self.charts[&number], &self.charts[&run.neighbor]);
        if !is_same(run, &map.embedding.uv, &neighbor.embedding.uv) {
            return None;
        }
        let laid = Laid::new(map, neighbor, run)?;
        let ground = self.grounds.entry(run.neighbor);
        let ground = ground.or_insert_with(|| Ground::new(neighbor));
        if laid.n_overlaps(ground, 0) > 0 {
            return None;
        }
        let joint = laid.glued(neighbor)?.facing_front();
        let outline = joint.chart.disk.boundary_in(&joint.embedding.uv);
        keep_apart(&outline, APART).then_some(joint)
    }
}

/// The length of a chart's outer boundary in its map.
fn outline(map: &MappedChart) -> f64 {
    let loops = map.chart.disk.boundary_in(&map.embedding.uv);
    let length = |polygon: &Vec<[f64; 2]>| {
        let edges = polygon.iter().zip(polygon.iter().cycle().skip(1));
        edges.map(|(&a, &b)| norm(sub(b, a))).sum::<f64>()
    };
    loops.iter().map(length).fold(0.0, f64::max)
}

/// The parts of a run that are straight in a map.
fn straight_parts(run: &Run, uv: &[[f64; 2]]) -> Vec<Run> {
    let at = |i: usize| uv[run.vertices[i][0] as usize];
    let turns = |i: usize| {
        let (before, after) = (sub(at(i), at(i - 1)), sub(at(i + 1), at(i)));
        let sine = cross(before, after).abs();
        sine > STRAIGHT * norm(before) * norm(after) || dot(before, after) < 0.0
    };
    let last = run.vertices.len() - 1;
    let mut ends: Vec<usize> = vec![0];
    ends.extend((1..last).filter(|&i| turns(i)));
    ends.push(last);
    let part = |ends: &[usize]| Run {
        vertices: run.vertices[ends[0]..=ends[1]].to_vec(),
        ..*run
    };
    ends.windows(2).map(part).collect()
}

/// Whether the two sides of a run have the same shape.
fn is_same(run: &Run, uv: &[[f64; 2]], of_neighbor: &[[f64; 2]]) -> bool {
    let first = run.vertices[0];
    let length = run.length(uv);
    run.vertices.iter().all(|&[v, w]| {
        let here = norm(sub(uv[v as usize], uv[first[0] as usize]));
        let there = norm(sub(of_neighbor[w as usize], of_neighbor[first[1] as usize]));
        (here - there).abs() <= SAME * length
    })
}

fn norm(v: [f64; 2]) -> f64 {
    v[0].hypot(v[1])
}
