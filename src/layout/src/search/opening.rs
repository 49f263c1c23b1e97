//! Ways to cut a set of faces open, by the predicted price.

use super::cut_mesh::CutMesh;
use super::effort::Effort;
use super::metric::Metric;
use super::prediction::{Grounded, Prediction, is_saddle};
use super::sets::union;
use std::collections::BTreeSet;
use unwrapd_maps::cut::Neighbors;
use unwrapd_method::numerics::ties::tied;
use unwrapd_method::numerics::vec3::distance;

/// Number of starts along the inner loop of a ring from which a slit to the other loop is tried.
const STARTS: usize = 4;
/// Number of ways to open some faces that are mapped before they are given up. With 2, 3 or 8 the sum of the costs of 30 machine parts
/// and game assets is higher by .43, .44 and .20 (`cost` in the reports of `unwrap`), and the time the same.
pub const MAPPED: usize = 4;
/// Excess by which two maps of the same faces may differ, since the solver ends when little is left to gain: ten times the difference
/// of two poses of 170 faces. Not tuned.
const ACCURACY: f64 = 1.0 / 8192.0;
/// Least gain of a slit or move, as a share of the root of the area, so that rounding makes none. Not tuned.
pub const GAIN: f64 = 1e-4;

/// A way to cut some faces open to a disk, with its predicted price.
#[derive(Clone, Debug)]
pub struct Opening {
    /// Edges in ascending order.
    pub slits: Vec<u32>,
    /// Length of the slits.
    pub length: f64,
    /// Predicted excess.
    pub excess: f64,
}

impl Opening {
    /// Returns the predicted price at a price of the excess.
    pub fn price(&self, lambda: f64) -> f64 {
        price(self.length, self.excess, lambda)
    }
}

/// Returns the price of slits and excess at a price of the excess. The excess is rounded to its accuracy, so that equal parts cost the
/// same.
pub fn price(length: f64, excess: f64, lambda: f64) -> f64 {
    length + lambda * (excess / ACCURACY).round() * ACCURACY
}

/// Openings of some faces that follow from starting slits, each predicted only once it may be the cheapest.
pub struct Ways {
    /// Starting slits with their length, the shortest last.
    starts: Vec<(f64, Vec<u32>)>,
    /// Predicted openings, the cheapest last.
    openings: Vec<Opening>,
}

impl Ways {
    /// Orders the starting slits; no opening is shorter than the slits it starts from.
    pub fn new(metric: &Metric, starts: impl IntoIterator<Item = Vec<u32>>) -> Self {
        let starts: BTreeSet<Vec<u32>> = starts.into_iter().collect();
        let mut starts: Vec<(f64, Vec<u32>)> = (starts.into_iter())
            .map(|slits| (metric.length_of(&slits), slits))
            .collect();
        starts.sort_by(|a, b| b.0.total_cmp(&a.0).then_with(|| b.1.cmp(&a.1)));
        Self {
            starts,
            openings: Vec::new(),
        }
    }

    /// Returns the cheapest opening that is left, if its price is below `most`.
    pub fn cheapest(
        &mut self,
        metric: &Metric,
        faces: &[u32],
        lambda: f64,
        most: f64,
        effort: &mut Effort,
    ) -> Option<&Opening> {
        let bar = |openings: &[Opening]| openings.last().map_or(most, |it| it.price(lambda));
        while let Some((_, slits)) =
            (self.starts).pop_if(|(length, _)| *length < bar(&self.openings))
        {
            let opening = opened_further(metric, faces, slits, lambda, most, effort);
            if let Some(opening) = opening.filter(|opening| opening.price(lambda) < most)
                && self.openings.iter().all(|it| it.slits != opening.slits)
            {
                self.openings.push(opening);
                self.openings.sort_by(|a, b| {
                    let by_price = b.price(lambda).total_cmp(&a.price(lambda));
                    by_price.then_with(|| b.slits.cmp(&a.slits))
                });
            }
        }
        self.openings.last()
    }

    /// Takes the opening that [`cheapest`](Self::cheapest) returned last.
    pub fn take(&mut self) -> Option<Opening> {
        self.openings.pop()
    }
}

/// Adds slits while they pay; returns `None` if the faces cannot be laid flat so.
fn opened_further(
    metric: &Metric,
    faces: &[u32],
    mut slits: Vec<u32>,
    lambda: f64,
    most_length: f64,
    effort: &mut Effort,
) -> Option<Opening> {
    let mut mesh = CutMesh::new(metric, faces, &slits);
    if mesh.loops.is_empty() {
        let first = first_slit(&mesh)?;
        slits = union(&slits, &mesh.edges(&first));
        mesh = CutMesh::new(metric, faces, &slits);
    }
    effort.predicted_faces += faces.len();
    let mut prediction = Prediction::new(&mesh)?;
    let neighbors = Neighbors::new(&mesh.sheet);
    loop {
        let length = metric.length_of(&slits);
        if length > most_length || effort.is_spent() {
            return None;
        }
        let mut best: Option<(Vec<u32>, Grounded)> = None;
        let mut cost = price(0.0, prediction.excess(), lambda);
        for path in paths(&mesh, &neighbors, &prediction) {
            let edges = mesh.edges(&path);
            let added = metric.length_of(&edges);
            if added >= cost {
                continue;
            }
            effort.predicted_faces += faces.len();
            let trial = prediction.grounded(&relieved(&mesh, &path));
            let slit = price(added, trial.excess, lambda);
            if slit < cost - GAIN {
                cost = slit;
                best = Some((edges, trial));
            }
        }
        let Some((edges, grounded)) = best else {
            return Some(Opening {
                length,
                excess: prediction.excess(),
                slits,
            });
        };
        slits = union(&slits, &edges);
        prediction.accept(grounded);
    }
}

/// Returns the vertices of a path that a slit along it relieves: not a saddle at its end.
fn relieved(mesh: &CutMesh, path: &[u32]) -> Vec<u32> {
    let mut vertices: Vec<u32> = path.iter().flat_map(|&h| mesh.sheet.ends(h)).collect();
    vertices.sort_unstable();
    (vertices.chunk_by(|a, b| a == b))
        .filter(|of| of.len() > 1 || !is_saddle(mesh, of[0] as usize))
        .map(|of| of[0])
        .collect()
}

/// Returns a path on a closed surface from the vertex of largest defect to the one farthest from it.
pub fn first_slit(mesh: &CutMesh) -> Option<Vec<u32>> {
    let defect = |v: usize| tied((2.0 * std::f64::consts::PI - mesh.angle[v]).abs());
    let position = |v: usize| mesh.sheet.positions[v];
    let n = mesh.welded.len();
    let from = (0..n).max_by(|&a, &b| defect(a).total_cmp(&defect(b)).then(b.cmp(&a)))?;
    let reach = |v: usize| tied(distance(position(v), position(from)));
    let to = (0..n).max_by(|&a, &b| reach(a).total_cmp(&reach(b)).then(b.cmp(&a)))?;
    let neighbors = Neighbors::new(&mesh.sheet);
    mesh.path(&neighbors, [from as u32], |v| v as usize == to)
}

/// Returns the paths along which a slit would relieve the predicted distortion most, as halfedges: from the hole that fails
/// most to close to the outer boundary, and from there to the vertex whose scale differs most.
pub fn paths(mesh: &CutMesh, neighbors: &Neighbors, prediction: &Prediction) -> Vec<Vec<u32>> {
    let mut found = Vec::new();
    if let Some(hole) = prediction.charged_hole() {
        let mut add = |from: &[u32]| {
            let from = from.iter().copied();
            found.extend(mesh.path(neighbors, from, |v| prediction.is_grounded(v)));
        };
        add(hole);
        if mesh.loops.len() == 2 {
            hole.chunks(hole.len().div_ceil(STARTS)).for_each(&mut add);
        }
    }
    if let Some(peak) = prediction.peak() {
        let grounded = (0..mesh.welded.len() as u32).filter(|&v| prediction.is_grounded(v));
        found.extend(mesh.path(neighbors, grounded, |v| v == peak));
    }
    found.retain(|path| !path.is_empty());
    found.sort_unstable();
    found.dedup();
    found
}
