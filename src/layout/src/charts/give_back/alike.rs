//! Charts given back on both sides of a mirror plane, or on neither.

use super::border::Run;
use super::cost::Cost;
use super::given_back::{Giving, MOST_PAIRS};
use super::laid::MovedChart;
use super::occupied::Ground;
use crate::charts::mapped::MappedChart;
use crate::charts::symmetry::counterpart::moment;
use crate::charts::symmetry::own_image::Moment;
use crate::charts::symmetry::plane::MirrorPlane;
use unwrapd_method::numerics::vec3::{distance, polyline_length};

/// How far the mirror image of a border may lie from the border of the other chart, in mean lengths of its edges.
const ASTRAY: f64 = 1.5;

/// Charts as they were.
type Before = Vec<(u32, MappedChart, Cost)>;

impl Giving<'_> {
    /// Glues a chart to a neighbor, and the mirror image of the chart to the neighbor's; both or none.
    pub(super) fn join_alike(&mut self, number: u32, laid: MovedChart, run: &Run) -> bool {
        let Some(plane) = self.charts[&number].chart.mirror else {
            return self.join(number, laid, run);
        };
        let of = moment(&self.charts[&number].chart);
        if of.is_image_of(&of, &plane) {
            let joint = of.and(&moment(&self.charts[&run.neighbor].chart));
            return joint.is_image_of(&joint, &plane) && self.join(number, laid, run);
        }
        let image = self.image_of(number, &of, &plane);
        let Some(image) = image.filter(|&image| image != run.neighbor) else {
            return self.join(number, laid, run);
        };
        let line = self.image_of_run(number, run, &plane);
        // Where the image has no place beside it, the chart need not be minimized in its own.
        let Some((other, other_run)) = self.laid_along(image, &line) else {
            return false;
        };
        if other_run.neighbor == run.neighbor
            && laid.n_overlaps(&Ground::new(&other.map), MOST_PAIRS) > MOST_PAIRS
        {
            return false;
        }
        let mut before = self.saved([number, run.neighbor]);
        if !self.join(number, laid, run) {
            return false;
        }
        let is_alike = self.join_along(image, &line, &mut before);
        if !is_alike {
            self.restore(before);
        }
        is_alike
    }

    /// A chart laid on a neighbor along a line, if it can be.
    fn laid_along(&self, number: u32, line: &[[f64; 3]]) -> Option<(MovedChart, Run)> {
        let chart = &self.charts[&number];
        let mut runs = self.borders.runs(number, &self.charts).into_iter();
        let run = runs.find_map(|run| part_along(&run, line, &chart.chart.positions))?;
        let laid = MovedChart::new(chart, &self.charts[&run.neighbor], &run)?;
        Some((laid, run))
    }

    /// Glues a chart to a neighbor along a line, if it can be.
    fn join_along(&mut self, number: u32, line: &[[f64; 3]], before: &mut Before) -> bool {
        let Some((laid, run)) = self.laid_along(number, line) else {
            return false;
        };
        let neighbor = &self.charts[&run.neighbor];
        let is_new = |n: &u32| before.iter().all(|(of, ..)| of != n);
        let others: Vec<u32> = [number, run.neighbor].into_iter().filter(is_new).collect();
        if laid.n_overlaps(&Ground::new(neighbor), MOST_PAIRS) > MOST_PAIRS {
            return false;
        }
        before.extend(self.saved(others));
        self.join(number, laid, &run)
    }

    fn image_of(&self, number: u32, of: &Moment, plane: &MirrorPlane) -> Option<u32> {
        let mut others = self.charts.iter().filter(|(n, _)| **n != number);
        let is_image = |map: &MappedChart| moment(&map.chart).is_image_of(of, plane);
        others.find(|(_, map)| is_image(map)).map(|(&n, _)| n)
    }

    fn image_of_run(&self, number: u32, run: &Run, plane: &MirrorPlane) -> Vec<[f64; 3]> {
        let positions = &self.charts[&number].chart.positions;
        let vertices = run.vertices.iter();
        vertices
            .map(|[v, _]| plane.mirrored(positions[*v as usize]))
            .collect()
    }

    fn saved(&self, numbers: impl IntoIterator<Item = u32>) -> Before {
        let saved = |n: u32| (n, self.charts[&n].clone(), self.costs[&n]);
        numbers.into_iter().map(saved).collect()
    }

    fn restore(&mut self, before: Before) {
        for (number, map, cost) in before {
            self.grounds.remove(&number);
            self.borders.place(number, &map.chart);
            self.charts.insert(number, map);
            self.costs.insert(number, cost);
        }
    }
}

/// The part of a run that lies along a line.
fn part_along(run: &Run, line: &[[f64; 3]], positions: &[[f64; 3]]) -> Option<Run> {
    let reach = ASTRAY * polyline_length(line) / (line.len() as f64 - 1.0).max(1.0);
    let nearest = |point: [f64; 3]| {
        let away = |&i: &usize| distance(positions[run.vertices[i][0] as usize], point);
        let place = (0..run.vertices.len()).min_by(|a, b| away(a).total_cmp(&away(b)))?;
        (away(&place) <= reach).then_some(place)
    };
    let [a, b] = [nearest(*line.first()?)?, nearest(*line.last()?)?];
    (a != b).then(|| run.part(a.min(b)..a.max(b)))
}
