//! Charts given back on both sides of a mirror plane, or on neither.

use super::border::Run;
use super::given_back::{Cost, Giving, MOST_PAIRS};
use super::laid::Laid;
use super::occupied::Ground;
use crate::charts::mapped::MappedChart;
use crate::charts::symmetry::counterpart::moment;
use crate::charts::symmetry::plane::MirrorPlane;
use crate::numerics::vec3::distance;

/// How far the mirror image of a border may lie from the border of the other chart, in mean lengths of its edges.
const ASTRAY: f64 = 1.5;

/// Charts as they were.
type Before = Vec<(u32, MappedChart, Cost)>;

impl Giving<'_> {
    /// Glues a chart to a neighbor, and the mirror image of the chart to the neighbor's; both or none.
    pub(super) fn join_alike(&mut self, number: u32, laid: Laid, run: &Run) -> bool {
        let Some(plane) = self.charts[&number].chart.mirror else {
            return self.join(number, laid, run);
        };
        let line = self.image_of_run(number, run, &plane);
        let image = match self.image_of(number, &plane) {
            Some(image) if image == number => {
                // One seam would be closed, and its mirror image would stay.
                let is_own_image = self.image_of(run.neighbor, &plane) == Some(run.neighbor);
                if !is_own_image || !self.is_crossing(number, run, &plane) {
                    return false;
                }
                None
            }
            Some(image) if image != run.neighbor => {
                if self.run_along(image, &line).is_none() {
                    return false;
                }
                Some(image)
            }
            _ => None,
        };
        let mut before = self.saved([number, run.neighbor]);
        if !self.join(number, laid, run) {
            return false;
        }
        let is_alike = image.is_none_or(|image| self.join_along(image, &line, &mut before));
        if !is_alike {
            self.restore(before);
        }
        is_alike
    }

    /// Glues a chart to a neighbor along a line, if it can be.
    fn join_along(&mut self, number: u32, line: &[[f64; 3]], before: &mut Before) -> bool {
        let Some(run) = self.run_along(number, line) else {
            return false;
        };
        let neighbor = &self.charts[&run.neighbor];
        let Some(laid) = Laid::new(&self.charts[&number], neighbor, &run) else {
            return false;
        };
        let is_new = |n: &u32| before.iter().all(|(of, ..)| of != n);
        let others: Vec<u32> = [number, run.neighbor].into_iter().filter(is_new).collect();
        if laid.n_overlaps(&Ground::new(neighbor), MOST_PAIRS) > MOST_PAIRS {
            return false;
        }
        before.extend(self.saved(others));
        self.join(number, laid, &run)
    }

    /// The part of the border of a chart that lies along a line.
    fn run_along(&self, number: u32, line: &[[f64; 3]]) -> Option<Run> {
        let mut runs = self.borders.runs(number, &self.charts).into_iter();
        let positions = &self.charts[&number].chart.positions;
        runs.find_map(|run| part_along(&run, line, positions))
    }

    /// Whether a run of a chart crosses the plane, or meets it.
    fn is_crossing(&self, number: u32, run: &Run, plane: &MirrorPlane) -> bool {
        let positions = &self.charts[&number].chart.positions;
        let height = |vertices: Option<&[u32; 2]>| {
            vertices.map_or(0.0, |[v, _]| plane.height(positions[*v as usize]))
        };
        height(run.vertices.first()) * height(run.vertices.last()) <= 0.0
    }

    /// The chart that is the mirror image of one, which may be itself.
    fn image_of(&self, number: u32, plane: &MirrorPlane) -> Option<u32> {
        let of = moment(&self.charts[&number].chart);
        if of.is_image_of(&of, plane) {
            return Some(number);
        }
        let is_image = |map: &MappedChart| moment(&map.chart).is_image_of(&of, plane);
        let mut others = self.charts.iter();
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
    let lengths = line.windows(2).map(|of| distance(of[0], of[1]));
    let reach = ASTRAY * lengths.sum::<f64>() / (line.len() as f64 - 1.0).max(1.0);
    let nearest = |point: [f64; 3]| {
        let away = |&i: &usize| distance(positions[run.vertices[i][0] as usize], point);
        let place = (0..run.vertices.len()).min_by(|a, b| away(a).total_cmp(&away(b)))?;
        (away(&place) <= reach).then_some(place)
    };
    let [a, b] = [nearest(*line.first()?)?, nearest(*line.last()?)?];
    let vertices = run.vertices[a.min(b)..=a.max(b)].to_vec();
    (vertices.len() > 1).then_some(Run { vertices, ..*run })
}
