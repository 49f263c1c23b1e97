//! Slight folds pushed apart.

use super::Chart;
use super::contact::Contacts;
use super::fold::{overlaps, overlaps_after};
use super::part::twins;
use super::surroundings::{NONE, Surroundings};
use crate::barrier::{Barrier, MapEnergy, epsilon, map_energy};
use crate::embed::{self, RestShapes, rest_shapes};
use crate::energy::{Positional, RestShape, Term};
use crate::mesh::{CUT, UnionFind, VertexFaces};
use crate::numerics::vec2::doubled_area;
use crate::solver::{Objective, Settings, Watch, minimize};
use std::collections::{BTreeMap, BTreeSet};

/// A push helps that leaves no more than this share of the pairs; so many may not.
const HELPS: f64 = 0.9;
const IN_VAIN: usize = 3;

/// Folds at most that are pushed apart: a chart with more is torn anyway.
const MOST_FOLDS: usize = 24;

/// How deep a vertex may lie in other faces to be pushed out, as a share of the square root of the chart's area.
const DEEPEST: f64 = 0.03;

/// What a vertex is pushed with, in the unit of the energy per area of a mean triangle.
const STRENGTH: f64 = 10.0;

/// Steps of the solver for one push.
const STEPS: usize = 12;

/// A map without flips that overlaps itself where these pairs of faces do, with the folds pushed apart that are slight; and which
/// pairs of faces still overlap.
///
/// Most folds are slivers along slits, where a surface bends like a saddle and the sides of a slit would pass each other. They need
/// little room, and a seam around each would make a chart of it. The energy with soft constraints is minimized in the surroundings
/// of a fold; pushes follow each other until none of its pairs is left, or it is left as it was.
pub fn pushed_apart(
    chart: &Chart,
    uv: &[[f64; 2]],
    pairs: Vec<[u32; 2]>,
    options: &embed::Options,
    watch: &dyn Watch,
) -> (Vec<[f64; 2]>, Vec<[u32; 2]>) {
    if pairs.is_empty() {
        return (uv.to_vec(), pairs);
    }
    let twin = twins(&chart.disk);
    let folds = folds(&twin, &pairs);
    if folds.len() > MOST_FOLDS {
        return (uv.to_vec(), pairs);
    }
    let rest = rest_shapes(&chart.positions, &chart.disk.triangles);
    let mut pushing = Pushing {
        of_vertex: VertexFaces::new(chart.disk.n_vertices, &chart.disk.triangles),
        settled: Contacts::new(chart, &twin),
        deepest: DEEPEST * (chart.disk.triangles.len() as f64).sqrt(),
        uv: uv.iter().map(|p| p.map(|x| x / rest.scale)).collect(),
        rest: &rest,
        pairs: pairs.clone(),
        chart,
        options,
        watch,
    };
    for fold in folds {
        pushing.push_apart(fold);
    }
    if pushing.settled.is_empty() {
        return (uv.to_vec(), pairs);
    }
    // In the mesh's unit again, decided again: coordinates are rounded.
    let in_unit = |p: &[f64; 2]| p.map(|x| x * rest.scale);
    let pushed: Vec<[f64; 2]> = pushing.uv.iter().map(in_unit).collect();
    if embed::is_positive(&chart.disk.triangles, &pushed) {
        let left = overlaps(&chart.disk, &pushed);
        (pushed, left)
    } else {
        (uv.to_vec(), pairs)
    }
}

/// The pairs in groups, the smallest first: faces that overlap or are neighbors are in one fold.
fn folds(twin: &[u32], pairs: &[[u32; 2]]) -> Vec<Vec<[u32; 2]>> {
    let mut sets = UnionFind::new(twin.len() / 3);
    let mut is_overlapped = vec![false; twin.len() / 3];
    for &[f, g] in pairs {
        sets.unite(f, g);
        (is_overlapped[f as usize], is_overlapped[g as usize]) = (true, true);
    }
    for (h, &t) in (0u32..).zip(twin).filter(|(_, t)| **t != CUT) {
        if is_overlapped[h as usize / 3] && is_overlapped[t as usize / 3] {
            sets.unite(h / 3, t / 3);
        }
    }
    let mut folds: BTreeMap<u32, Vec<[u32; 2]>> = BTreeMap::new();
    for &pair in pairs {
        folds.entry(sets.find(pair[0])).or_default().push(pair);
    }
    let mut folds: Vec<_> = folds.into_values().collect();
    folds.sort_by_key(Vec::len);
    folds
}

/// The pairs that are not among these.
fn difference(pairs: &[[u32; 2]], these: &[[u32; 2]]) -> BTreeSet<[u32; 2]> {
    let these: BTreeSet<&[u32; 2]> = these.iter().collect();
    let others = pairs.iter().filter(|pair| !these.contains(pair));
    others.copied().collect()
}

/// A map whose folds are pushed apart one after the other.
struct Pushing<'a> {
    chart: &'a Chart,
    of_vertex: VertexFaces,
    rest: &'a RestShapes,
    /// In the unit of the rest shapes.
    uv: Vec<[f64; 2]>,
    /// The faces that overlap.
    pairs: Vec<[u32; 2]>,
    /// Of the folds that are gone.
    settled: Contacts<'a>,
    deepest: f64,
    options: &'a embed::Options,
    watch: &'a dyn Watch,
}

impl Pushing<'_> {
    /// Pushes until none of the pairs of a fold is left, and no new one is there; or changes nothing.
    fn push_apart(&mut self, mut fold: Vec<[u32; 2]>) {
        let mut others: Option<BTreeSet<[u32; 2]>> = None;
        let before = self.uv.clone();
        let mut contacts = self.settled.none();
        let mut pairs = self.pairs.clone();
        let (mut least, mut in_vain) = (fold.len(), 0);
        while !fold.is_empty() && in_vain < IN_VAIN {
            let is_slight = contacts.renew(&self.uv, &fold, self.deepest);
            if !is_slight || contacts.is_empty() {
                break;
            }
            let others = others.get_or_insert_with(|| difference(&self.pairs, &fold));
            let moved = self.push(&contacts);
            if moved.is_empty() {
                break;
            }
            pairs = overlaps_after(&self.chart.disk, &self.uv, &pairs, &moved);
            fold = (pairs.iter().copied())
                .filter(|pair| !others.contains(pair))
                .collect();
            in_vain += usize::from(fold.len() as f64 > HELPS * least as f64);
            least = least.min(fold.len());
        }
        if fold.is_empty() {
            self.settled.extend(&contacts);
            self.pairs = pairs;
        } else {
            self.uv = before;
        }
    }

    /// Minimizes energy and constraints; returns the faces that have moved.
    fn push(&mut self, contacts: &Contacts) -> Vec<u32> {
        let around = Surroundings::new(self.chart, &self.of_vertex, contacts);
        let term = self.term(&around);
        let mut constraints = Positional {
            dim: 2,
            rows: Vec::new(),
            targets: Vec::new(),
            alpha: STRENGTH,
        };
        for contacts in [contacts, &self.settled] {
            for (row, target) in contacts.constraints(&self.uv) {
                let local = row.map(|(v, weight)| (around.local[v as usize], weight));
                if local.iter().all(|&(v, _)| v != NONE) {
                    constraints.rows.push(local.to_vec());
                    constraints.targets.extend(target);
                }
            }
        }
        let n = around.vertices.len();
        let mut objective = Objective::constrained(n, vec![term], constraints);
        objective.fix(&around.held);
        let settings = Settings {
            max_iterations: STEPS,
            ..self.options.solver
        };
        let mut x = around.gathered(&self.uv).into_flattened();
        let summary = minimize(&mut objective, &mut x, &settings, self.watch);
        let places: &[[f64; 2]] = x.as_chunks().0;
        if summary.iterations == 0 || !embed::is_positive(&around.triangles, places) {
            return Vec::new();
        }
        for (&v, &p) in around.vertices.iter().zip(places) {
            self.uv[v as usize] = p;
        }
        around.faces
    }

    /// The energy of the surroundings of a fold.
    fn term(&self, around: &Surroundings) -> Box<dyn Term> {
        let rest = around.faces.iter().map(|&f| self.rest.shapes[f as usize]);
        let rest: Vec<RestShape> = rest.collect();
        let uv = around.gathered(&self.uv);
        let area = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|v| uv[v as usize]);
            0.5 * doubled_area(a, b, c)
        };
        let smallest = around.triangles.iter().map(area);
        let smallest_rest = rest.iter().map(|shape| shape.size);
        let energy = MapEnergy {
            energy: self.options.energy,
            barrier: Barrier {
                kind: self.options.barrier,
                beta: self.options.beta,
                s: self.options.s,
                epsilon: epsilon(
                    smallest_rest.fold(f64::INFINITY, f64::min),
                    smallest.fold(f64::INFINITY, f64::min),
                ),
            },
        };
        map_energy(&around.triangles, &rest, &energy)
    }
}
