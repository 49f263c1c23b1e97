//! Rough surfaces, as depth sensors and generators make them, and what they are samples of.
//!
//! No map with few seams keeps the distances on a surface of noise: every vertex is a small cone. What it is a sample of
//! unfolds well. So charts are cut on the smoothed surface, whose distortion is bounded, and the true one is mapped.

use std::f64::consts::TAU;

use super::facets::faces::Faces;
use super::facets::planar::Facets;
use super::mapped::MappedChart;
use super::observer::Observer;
use unwrapd_maps::embed;
use unwrapd_maps::mesh::Surface;
use unwrapd_method::numerics::vec3::{cross, dot, norm, sub};

/// The mean angle defect, in radians, from which on the vertices of a component may be noise.
const ROUGH: f64 = 0.2;
/// The share of its canceling curvature that smoothing leaves to noise at most; of a shape it leaves a third and more.
const LEFT: f64 = 1.0 / 6.0;

/// The share of the area of a component in planes of more than one face from which on it consists of planes. Not tuned.
const OF_PLANES: f64 = 0.6;

/// The surface with its rough components smoothed; none if it has no rough one.
///
/// A component is rough if much of the curvature at its inner vertices cancels, as that of bumps and dents does, and vanishes when it
/// is [smoothed](Surface::smoothed). Those that consist of planes are not, however many corners they have. O(n log n).
pub fn smoothed_where_rough(surface: &Surface) -> Option<Surface> {
    let is_on_border = surface.is_on_border();
    let before = curvatures_of(surface, &is_on_border);
    if !before.iter().any(Curvature::is_large) {
        return None;
    }
    let mut smooth = surface.clone();
    smooth.positions = surface.smoothed(&is_on_border);
    let after = curvatures_of(&smooth, &is_on_border);
    let mut is_rough: Vec<bool> = (before.iter().zip(&after))
        .map(|(before, after)| before.is_large() && after.canceling() < LEFT * before.canceling())
        .collect();
    let component = &surface.adjacency().component;
    if is_rough.contains(&true) {
        for (is_rough, share) in is_rough.iter_mut().zip(shares_of_planes(surface)) {
            *is_rough &= share < OF_PLANES;
        }
    }
    let mut is_kept = vec![true; surface.positions.len()];
    for (triangle, &c) in surface.triangles.iter().zip(component) {
        for v in triangle {
            is_kept[*v as usize] &= !is_rough[c as usize];
        }
    }
    for (v, _) in is_kept.iter().enumerate().filter(|(_, kept)| **kept) {
        smooth.positions[v] = surface.positions[v];
    }
    is_rough.contains(&true).then_some(smooth)
}

/// Returns the share of the area of each component that lies in planes of more than one face.
fn shares_of_planes(surface: &Surface) -> Vec<f64> {
    let faces = Faces::of_surface(surface);
    let facets = Facets::new(&faces);
    let adjacency = surface.adjacency();
    let mut areas = vec![[0.0; 2]; adjacency.n_components];
    for (face, &area) in faces.areas.iter().enumerate() {
        let is_in_plane = facets.n_faces[facets.of_face[face] as usize] > 1;
        let [all, in_planes] = &mut areas[adjacency.component[face] as usize];
        *all += area;
        *in_planes += if is_in_plane { area } else { 0.0 };
    }
    let shares = areas.iter().map(|[all, in_planes]| in_planes / all);
    shares.collect()
}

/// The curvature of a component: sums of the angle defects 2π − Σ angles of its inner vertices, in radians.
#[derive(Clone, Copy, Default)]
struct Curvature {
    sum: f64,
    absolute: f64,
    n_vertices: usize,
}

impl Curvature {
    /// Returns the part of the curvature that cancels: none on a cone or a convex surface.
    fn canceling(&self) -> f64 {
        self.absolute - self.sum.abs()
    }

    fn is_large(&self) -> bool {
        self.canceling() > ROUGH * self.n_vertices as f64
    }
}

/// Returns the curvature of each component; a vertex that two share counts in one of them.
fn curvatures_of(surface: &Surface, is_on_border: &[bool]) -> Vec<Curvature> {
    let component = &surface.adjacency().component;
    let mut angles = vec![0.0; surface.positions.len()];
    let mut component_of = vec![None; surface.positions.len()];
    for (t, triangle) in surface.triangles.iter().enumerate() {
        let corners = surface.corners(t);
        for (k, &v) in triangle.iter().enumerate() {
            let [a, b] = [1, 2].map(|j| sub(corners[(k + j) % 3], corners[k]));
            angles[v as usize] += norm(cross(a, b)).atan2(dot(a, b));
            component_of[v as usize] = Some(component[t]);
        }
    }
    let n_components = component.iter().max().map_or(0, |&c| c as usize + 1);
    let mut curvatures = vec![Curvature::default(); n_components];
    for ((angle, of), is_on_border) in angles.iter().zip(component_of).zip(is_on_border) {
        if let (Some(of), false) = (of, is_on_border) {
            let curvature: &mut Curvature = &mut curvatures[of as usize];
            curvature.sum += TAU - angle;
            curvature.absolute += (TAU - angle).abs();
            curvature.n_vertices += 1;
        }
    }
    curvatures
}

impl MappedChart {
    /// A chart of the smoothed surface as one of the surface itself, mapped from where it lies.
    pub(crate) fn on(
        mut self,
        surface: &Surface,
        options: &embed::Options,
        observer: &dyn Observer,
    ) -> Self {
        let chart = &mut self.chart;
        let mut is_moved = false;
        for (triangle, corners) in chart.disk.triangles.iter().zip(&chart.corners) {
            for (&v, &corner) in triangle.iter().zip(corners) {
                let own = surface.corners(corner as usize / 3)[corner as usize % 3];
                is_moved |= chart.positions[v as usize] != own;
                chart.positions[v as usize] = own;
            }
        }
        if !is_moved {
            return self;
        }
        self.relaxed(Vec::new(), &|_| options.clone(), observer).0
    }
}
