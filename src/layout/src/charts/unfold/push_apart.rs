//! Pushes slight folds of a map apart.

use super::contact::Contacts;
use super::local_minimum::Local;
use super::overlaps::{overlaps, overlaps_after};
use crate::charts::Chart;
use std::collections::{BTreeMap, BTreeSet};
use unwrapd_maps::embed::{self, rest_shapes};
use unwrapd_maps::mesh::{CUT, UnionFind};
use unwrapd_method::solver::Watch;

/// A push helps if it leaves at most this share of the overlapping pairs; at the first that does not a fold is given up. Allowing two
/// or three such pushes changes seams and charts by more than 1 % on five of 29 meshes, in both directions, and takes up to 1.3 times
/// the time of the search (`cargo bench -p unwrapd-layout --bench search`).
const HELPS: f64 = 0.9;

/// The most folds to push apart: a chart with more is cut anyway.
const MOST_FOLDS: usize = 24;

/// How deep a vertex may lie in other faces to be pushed out, as a share of the square root of the chart's area.
const DEEPEST: f64 = 0.03;

/// Pushes the slight folds apart of a map without flips that overlaps itself at these pairs of faces.
/// Returns the map and the pairs that still overlap.
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
    let twin = chart.disk.twins();
    let folds = folds(&twin, &pairs);
    if folds.is_empty() || folds.len() > MOST_FOLDS {
        return (uv.to_vec(), pairs);
    }
    let rest = rest_shapes(&chart.positions, &chart.disk.triangles);
    let local = Local::new(chart, &rest, options, watch);
    let mut pushing = Pushing::new(local, &twin, uv, &pairs);
    for fold in folds {
        pushing.push_apart(fold);
    }
    match pushing.in_mesh_unit() {
        Some(pushed) if !pushing.settled.is_empty() => {
            let left = overlaps(&chart.disk, &pushed);
            (pushed, left)
        }
        _ => (uv.to_vec(), pairs),
    }
}

/// Pushes the slight folds of a map apart as [`pushed_apart`] does, but returns `None` as soon as one is left.
pub fn all_pushed_apart(
    chart: &Chart,
    uv: &[[f64; 2]],
    pairs: &[[u32; 2]],
    options: &embed::Options,
    watch: &dyn Watch,
) -> Option<Vec<[f64; 2]>> {
    if pairs.is_empty() {
        return Some(uv.to_vec());
    }
    let twin = chart.disk.twins();
    let folds = folds(&twin, pairs);
    if folds.len() > MOST_FOLDS {
        return None;
    }
    let rest = rest_shapes(&chart.positions, &chart.disk.triangles);
    let local = Local::new(chart, &rest, options, watch);
    let mut pushing = Pushing::new(local, &twin, uv, pairs);
    let is_apart = folds.into_iter().all(|fold| pushing.push_apart(fold));
    let pushed = is_apart.then(|| pushing.in_mesh_unit())??;
    overlaps(&chart.disk, &pushed).is_empty().then_some(pushed)
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
    local: Local<'a>,
    /// In the unit of the rest shapes.
    uv: Vec<[f64; 2]>,
    /// The faces that overlap.
    pairs: Vec<[u32; 2]>,
    /// Of the folds that are gone.
    settled: Contacts<'a>,
    deepest: f64,
}

impl<'a> Pushing<'a> {
    fn new(local: Local<'a>, twin: &'a [u32], uv: &[[f64; 2]], pairs: &[[u32; 2]]) -> Self {
        let chart = local.chart;
        Self {
            settled: Contacts::new(chart, twin),
            deepest: DEEPEST * (chart.disk.triangles.len() as f64).sqrt(),
            uv: local.in_unit(uv),
            pairs: pairs.to_vec(),
            local,
        }
    }

    /// Returns the map in the mesh's unit; `None` if rounding flips a triangle.
    fn in_mesh_unit(&self) -> Option<Vec<[f64; 2]>> {
        let pushed = self.local.in_mesh_unit(&self.uv);
        embed::is_positive(&self.local.chart.disk.triangles, &pushed).then_some(pushed)
    }

    /// Pushes the pairs of a fold apart without making new ones. Returns whether that succeeds; otherwise the map is unchanged.
    fn push_apart(&mut self, mut fold: Vec<[u32; 2]>) -> bool {
        let mut others: Option<BTreeSet<[u32; 2]>> = None;
        let before = self.uv.clone();
        let mut contacts = self.settled.none();
        let mut pairs = self.pairs.clone();
        let mut most = f64::INFINITY;
        while !fold.is_empty() && fold.len() as f64 <= most {
            most = HELPS * fold.len() as f64;
            let is_slight = contacts.renew(&self.uv, &fold, self.deepest);
            if !is_slight || contacts.is_empty() {
                break;
            }
            let others = others.get_or_insert_with(|| difference(&self.pairs, &fold));
            let moved = self.push(&contacts);
            if moved.is_empty() {
                break;
            }
            pairs = overlaps_after(&self.local.chart.disk, &self.uv, &pairs, &moved);
            fold = (pairs.iter().copied())
                .filter(|pair| !others.contains(pair))
                .collect();
        }
        let is_apart = fold.is_empty();
        if is_apart {
            self.settled.extend(&contacts);
            self.pairs = pairs;
        } else {
            self.uv = before;
        }
        is_apart
    }

    /// Minimizes energy and constraints; returns the faces that have moved.
    fn push(&mut self, contacts: &Contacts) -> Vec<u32> {
        let rows = [contacts, &self.settled].map(|contacts| contacts.constraints(&self.uv));
        let rows: Vec<_> = rows.into_iter().flatten().collect();
        self.local
            .minimize(&mut self.uv, contacts.vertices(), &rows)
    }
}
