//! Components slit to cone singularities, one chart each.
//!
//! The angles around a vertex on a slit need not sum to 2π in the plane, so the map can have a cone there: distortion leaves through it.
//! The vertices are chosen where the predicted scale of the map differs most ([`charts_at_cones`]), or given ([`charts_through`]). The
//! maps may overlap themselves: charts are parted there when they are mapped, not here.

use super::cut_mesh::CutMesh;
use super::effort::SearchEffort;
use super::metric::Metric;
use super::net::chart;
use super::slitting::{Slitting, components, ways_to_open};
use crate::charts::Chart;
use rayon::prelude::*;
use unwrapd_maps::cut::{Branches, Neighbors, distances, open_to_disk};
use unwrapd_maps::mesh::Surface;
use unwrapd_method::numerics::ties::tied;

/// Opens each component to a disk, possibly with holes, by slits to `n_cones` cone singularities: one after the other, the vertex at
/// which the predicted scale of the map differs most, or a hole that does not lie flat, whichever relieves more for the length of its
/// slit. The slit that opens a closed component of genus 0 has two cones at its ends.
///
/// There are fewer cones where nothing is left to relieve. Returns `None` if a component cannot be opened.
///
/// The choice by the metric is that of Ben-Chen et al. 2008, *Conformal flattening by curvature prescription and metric scaling*. Test:
/// `search::more_cones_lower_the_distortion`.
pub fn charts_at_cones(surface: &Surface, n_cones: usize) -> Option<Vec<Chart>> {
    let metric = Metric::new(surface);
    let charts = components(&metric)
        .into_par_iter()
        .map(|faces| chart_at_cones(&metric, &faces, n_cones));
    charts.collect()
}

fn chart_at_cones(metric: &Metric, faces: &[u32], n_cones: usize) -> Option<Chart> {
    let is_sphere = CutMesh::new(metric, faces, &[]).is_sphere();
    let n_slits = n_cones.saturating_sub(if is_sphere { 2 } else { 0 });
    let mut best: Option<(f64, Vec<u32>)> = None;
    for opening in ways_to_open(metric, faces, None) {
        let Some(mut slitting) = Slitting::new(metric, faces, opening, None) else {
            continue;
        };
        let mut effort = SearchEffort::UNBOUNDED;
        while slitting.n_made < n_slits && slitting.plan_next(&mut effort).is_some() {
            slitting.make_next();
        }
        let excess = tied(slitting.predicted(slitting.n_made));
        if best.as_ref().is_none_or(|(least, _)| excess < *least) {
            best = Some((excess, slitting.slits()));
        }
    }
    chart(&CutMesh::new(metric, faces, &best?.1))
}

/// Opens each component to a disk, possibly with holes, by slits through given cone singularities, vertices of the surface.
///
/// The slits are a tree: from the boundary, or the cut graph that opens a surface with handles, or the first cone, each time along the
/// shortest path to the nearest cone that is left, at most twice as long as the shortest tree. A closed component of genus 0 with a
/// single cone is slit to the vertex farthest from it. Components without cones are only opened. Returns `None` if a component cannot
/// be opened.
///
/// From: Takahashi, Matsuyama 1980, *An approximate solution for the Steiner problem in graphs*. Test:
/// `search::slits_pass_through_given_cones`.
pub fn charts_through(surface: &Surface, cones: &[u32]) -> Option<Vec<Chart>> {
    let metric = Metric::new(surface);
    let mut is_cone = vec![false; surface.positions.len()];
    for &cone in cones {
        is_cone[cone as usize] = true;
    }
    let charts = components(&metric)
        .into_par_iter()
        .map(|faces| chart_through(&metric, &faces, &is_cone));
    charts.collect()
}

fn chart_through(metric: &Metric, faces: &[u32], is_cone: &[bool]) -> Option<Chart> {
    let mesh = CutMesh::new(metric, faces, &[]);
    let is_cone: Vec<bool> = (mesh.welded.iter()).map(|&v| is_cone[v as usize]).collect();
    let Some(first) = is_cone.iter().position(|&is_cone| is_cone) else {
        return chart_at_cones(metric, faces, 0);
    };
    let mut tree = SlitTree::new(&mesh);
    if mesh.is_sphere() {
        tree.reach(first as u32);
        while tree.grow(|v| is_cone[v as usize]) {}
        if tree.slits.is_empty() {
            let far = tree.farthest();
            tree.grow(|v| v == far);
        }
        if tree.slits.len() == 1 {
            // Two edges of a disk do not join the same two vertices.
            tree.grow(|_| true);
        }
    } else {
        for h in open_to_disk(&mesh.sheet, Branches::None) {
            tree.add(h);
        }
        while tree.grow(|v| is_cone[v as usize]) {}
    }
    chart(&CutMesh::new(metric, faces, &mesh.edges(&tree.slits)))
}

/// Slits of a component that are connected, with each other or through its boundary.
struct SlitTree<'a> {
    mesh: &'a CutMesh<'a>,
    neighbors: Neighbors,
    /// Vertices on slits or on the boundary.
    is_reached: Vec<bool>,
    /// Halfedges of the slits.
    slits: Vec<u32>,
}

impl<'a> SlitTree<'a> {
    fn new(mesh: &'a CutMesh<'a>) -> Self {
        Self {
            neighbors: Neighbors::new(&mesh.sheet),
            is_reached: mesh.is_inner.iter().map(|is_inner| !is_inner).collect(),
            slits: Vec::new(),
            mesh,
        }
    }

    fn reach(&mut self, vertex: u32) {
        self.is_reached[vertex as usize] = true;
    }

    /// Adds an edge, given as a halfedge.
    fn add(&mut self, h: u32) {
        self.slits.push(h);
        for v in self.mesh.sheet.ends(h) {
            self.reach(v);
        }
    }

    /// Slits along the shortest path to the nearest vertex that is wanted and not yet reached; returns whether there was one.
    fn grow(&mut self, is_wanted: impl Fn(u32) -> bool) -> bool {
        let is_goal = |v: u32| !self.is_reached[v as usize] && is_wanted(v);
        let path = self.mesh.path(&self.neighbors, self.reached(), is_goal);
        let path = path.unwrap_or_default();
        for &h in &path {
            self.add(h);
        }
        !path.is_empty()
    }

    fn farthest(&self) -> u32 {
        let sheet = &self.mesh.sheet;
        distances(sheet, &self.neighbors, self.reached(), |h| sheet.length(h))
            .farthest()
            .0
    }

    fn reached(&self) -> impl Iterator<Item = u32> {
        let reached = (0u32..).zip(&self.is_reached);
        reached.filter(|(_, is)| **is).map(|(v, _)| v)
    }
}
