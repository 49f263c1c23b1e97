//! Ways to cut a set of faces open, by the predicted price.

use super::cut_mesh::CutMesh;
use super::effort::SearchEffort;
use super::metric::Metric;
use super::prediction::{Grounded, Prediction, is_saddle};
use super::sets::union;
use std::collections::{BTreeSet, HashMap};
use std::sync::Arc;
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
        plans: &mut Plans,
        faces: &Arc<[u32]>,
        lambda: f64,
        most: f64,
        effort: &mut SearchEffort,
    ) -> Option<&Opening> {
        let bar = |openings: &[Opening]| openings.last().map_or(most, |it| it.price(lambda));
        while let Some((_, slits)) =
            (self.starts).pop_if(|(length, _)| *length < bar(&self.openings))
        {
            let faces = faces.clone();
            let opening = plans.opening(&Start { faces, slits }, lambda, most, effort);
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

/// Plans of slits by their starts, `None` where the faces cannot be laid flat. Prices of the excess fall, and at a lower price fewer slits of
/// a plan pay, so each is made once.
pub struct Plans<'a> {
    metric: &'a Metric<'a>,
    known: HashMap<Start, Option<SlitPlan>>,
}

/// Faces to open, and the slits that are there.
#[derive(Clone, PartialEq, Eq, Hash)]
struct Start {
    faces: Arc<[u32]>,
    slits: Vec<u32>,
}

/// Slits to add one by one, each the one that relieves most for its length.
struct SlitPlan {
    /// Price of the excess at which no further slit pays.
    lambda: f64,
    /// Starting slits, which open the faces to a disk.
    start: Opening,
    slits: Vec<Slit>,
}

/// A slit of a plan.
pub struct Slit {
    /// Edges in ascending order.
    pub edges: Vec<u32>,
    /// Length of the edges.
    pub length: f64,
    /// Predicted excess that it relieves for its length.
    pub rate: f64,
    /// Predicted excess with it.
    pub excess: f64,
}

impl<'a> Plans<'a> {
    pub fn new(metric: &'a Metric<'a>) -> Self {
        Self {
            metric,
            known: HashMap::new(),
        }
    }

    /// Returns the opening that follows from a start at some price of the excess; `None` if the faces cannot be laid flat so, or if it is
    /// longer than `most`.
    fn opening(
        &mut self,
        start: &Start,
        lambda: f64,
        most: f64,
        effort: &mut SearchEffort,
    ) -> Option<Opening> {
        let is_known = match self.known.get(start) {
            Some(Some(plan)) => lambda <= plan.lambda,
            Some(None) => true,
            None => false,
        };
        if !is_known {
            if effort.is_spent() {
                return None;
            }
            let plan = planned(self.metric, start, lambda, most, effort);
            if effort.is_spent() {
                return None;
            }
            self.known.insert(start.clone(), plan);
        }
        self.known[start].as_ref()?.opening(lambda, most)
    }
}

impl SlitPlan {
    /// Returns the cheapest opening with the first slits of the plan.
    fn opening(&self, lambda: f64, most: f64) -> Option<Opening> {
        let (mut length, mut best) = (self.start.length, (self.start.price(lambda), 0));
        for (place, slit) in self.slits.iter().enumerate() {
            length += slit.length;
            let price = price(length, slit.excess, lambda);
            if price < best.0 - GAIN {
                best = (price, place + 1);
            }
        }
        let mut opening = self.start.clone();
        for slit in &self.slits[..best.1] {
            opening.slits = union(&opening.slits, &slit.edges);
            opening.length += slit.length;
            opening.excess = slit.excess;
        }
        (opening.length <= most).then_some(opening)
    }
}

/// Plans slits while they pay at some price of the excess. Returns `None` if the faces cannot be laid flat.
///
/// The plan may end where the opening is longer than `most`: a longer one is not wanted at this price, and at a lower one less is.
fn planned(
    metric: &Metric,
    start: &Start,
    lambda: f64,
    most: f64,
    effort: &mut SearchEffort,
) -> Option<SlitPlan> {
    let (faces, mut slits) = (&start.faces, start.slits.clone());
    let mut mesh = CutMesh::new(metric, faces.clone(), &slits);
    if mesh.loops.is_empty() {
        let first = first_slit(&mesh)?;
        slits = union(&slits, &mesh.edges(&first));
        mesh = CutMesh::new(metric, faces.clone(), &slits);
    }
    let mesh = Arc::new(mesh);
    effort.predicted_faces += faces.len();
    let mut prediction = Prediction::new(&mesh)?;
    let neighbors = Neighbors::new(&mesh.sheet);
    let mut length = metric.length_of(&slits);
    let mut plan = SlitPlan {
        lambda,
        start: Opening {
            length,
            excess: prediction.excess(),
            slits,
        },
        slits: Vec::new(),
    };
    while length <= most && !effort.is_spent() {
        let before = price(0.0, prediction.excess(), lambda);
        let mut paths = paths(&mesh, &neighbors, &prediction);
        paths.retain(|path| metric.length_of(&mesh.edges(path)) < before);
        let relieved = |path: &[u32]| relieved(&mesh, path);
        let pays = |slit: &Slit| price(slit.length, slit.excess, lambda) < before - GAIN;
        let mut slits = slits_along(paths, &mesh, &mut prediction, relieved, effort);
        slits.retain(|(slit, _)| pays(slit));
        let Some((slit, grounded)) = best(slits) else {
            break;
        };
        prediction.accept(grounded);
        length += slit.length;
        plan.slits.push(slit);
    }
    Some(plan)
}

/// Predicts a slit along each of some paths, given as halfedges; `relieved` returns the vertices that it relieves.
pub fn slits_along(
    paths: Vec<Vec<u32>>,
    mesh: &CutMesh,
    prediction: &mut Prediction,
    relieved: impl Fn(&[u32]) -> Vec<u32>,
    effort: &mut SearchEffort,
) -> Vec<(Slit, Grounded)> {
    let before = prediction.excess();
    let mut slits = Vec::with_capacity(paths.len());
    for path in paths {
        effort.predicted_faces += mesh.faces.len();
        let grounded = prediction.grounded(&relieved(&path));
        let edges = mesh.edges(&path);
        let (length, excess) = (mesh.metric.length_of(&edges), grounded.excess);
        let slit = Slit {
            rate: tied((before - excess).max(0.0) / length),
            edges,
            length,
            excess,
        };
        slits.push((slit, grounded));
    }
    slits
}

/// Returns the slit that relieves most for its length, the first of equals.
pub fn best(slits: Vec<(Slit, Grounded)>) -> Option<(Slit, Grounded)> {
    let better = |best: (Slit, Grounded), other: (Slit, Grounded)| {
        if other.0.rate > best.0.rate {
            other
        } else {
            best
        }
    };
    slits.into_iter().reduce(better)
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
            found.extend(mesh.path(neighbors, from, |v| prediction.is_outside(v)));
        };
        add(hole);
        if mesh.loops.len() == 2 {
            hole.chunks(hole.len().div_ceil(STARTS)).for_each(&mut add);
        }
    }
    if let Some(peak) = prediction.peak() {
        let outside = (0..mesh.welded.len() as u32).filter(|&v| prediction.is_outside(v));
        found.extend(mesh.path(neighbors, outside, |v| v == peak));
    }
    found.retain(|path| !path.is_empty());
    found.sort_unstable();
    found.dedup();
    found
}
