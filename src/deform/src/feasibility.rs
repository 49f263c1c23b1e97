//! Targets that no map without inversions reaches, recognized before the first iteration.
//!
//! An element that is held by all its corners is what their targets make of it. And where the whole boundary of a part
//! is held, its targets decide much about the map: without inversions the map covers every point as often as the
//! boundary winds around it, its signed size is what the boundary encloses, and in the plane the boundary turns at
//! least as often as the Euler characteristic says (Gauss–Bonnet; a vertex around which the map winds more than once
//! adds turns).
//!
//! These conditions are necessary, not sufficient: targets that meet them may still be out of reach. They bind only
//! where the energy or the barrier forbids inversions.

use super::body::{Body, BodyElements};
use super::problem::{Problem, parts};
use super::problem_error::ProblemError;
use std::collections::HashMap;
use std::f64::consts::{PI, TAU};
use unwrapd_maps::mesh::{Edges, UsedVertices, boundary_edges, boundary_triangles, same_direction};
use unwrapd_method::numerics::predicates::{orient2d_sign, orient3d_sign};
use unwrapd_method::numerics::vec2::{cross, dot, sub};
use unwrapd_method::numerics::vec3;
use unwrapd_method::solver::Handles;

impl Problem {
    /// Checks that the last targets do not contradict every map without inversions.
    ///
    /// # Errors
    /// For an element that the targets of its held corners invert or flatten, and for a held boundary that encloses no
    /// positive size or, in the plane, turns too little.
    pub(super) fn check_targets(&self) -> Result<(), ProblemError> {
        let Some(targets) = self.binding_targets() else {
            return Ok(());
        };
        let n_vertices = self.body.n_vertices();
        match &self.body.elements {
            BodyElements::Triangles { corners, .. } => {
                let held = HeldPlaces::<2>::new(targets, n_vertices);
                check_elements(corners, |element| held.flattens_triangle(element))?;
                for part in held_borders(&self.body, corners, &held) {
                    check_size(signed_area(&part.faces, &held))?;
                    part.check_turning(&held)?;
                }
            }
            BodyElements::Tetrahedra { corners, .. } => {
                let held = HeldPlaces::<3>::new(targets, n_vertices);
                check_elements(corners, |element| held.flattens_tetrahedron(element))?;
                for part in held_parts(&self.body, boundary_triangles(corners), &held) {
                    check_size(signed_volume(&part.faces, &held))?;
                }
            }
        }
        Ok(())
    }

    /// Returns the held vertices inside parts with a held boundary that cannot come to their last targets: outside the
    /// boundary, or more of them at one place than the boundary winds around it.
    pub(super) fn uncovered(&self) -> Vec<u32> {
        let Some(targets) = self.binding_targets() else {
            return Vec::new();
        };
        let n_vertices = self.body.n_vertices();
        match &self.body.elements {
            BodyElements::Triangles { corners, .. } => {
                let held = HeldPlaces::<2>::new(targets, n_vertices);
                let parts = held_borders(&self.body, corners, &held);
                let of = |part: &HeldPart<2>| {
                    held.uncovered(&part.inner, |p| winding(&part.faces, &held, p))
                };
                parts.iter().flat_map(of).collect()
            }
            BodyElements::Tetrahedra { corners, .. } => {
                let held = HeldPlaces::<3>::new(targets, n_vertices);
                let parts = held_parts(&self.body, boundary_triangles(corners), &held);
                let of = |part: &HeldPart<3>| {
                    held.uncovered(&part.inner, |p| winding_in_space(&part.faces, &held, p))
                };
                parts.iter().flat_map(of).collect()
            }
        }
    }

    /// Returns the last targets if they bind: without anything that forbids inversions a map may fold to reach them.
    fn binding_targets(&self) -> Option<&Handles> {
        self.stations.last().filter(|_| self.forbids_inversion())
    }
}

// Targets of held vertices.

/// The targets of the held vertices, by vertex.
struct HeldPlaces<const D: usize> {
    places: Vec<Option<[f64; D]>>,
}

impl<const D: usize> HeldPlaces<D> {
    fn new(handles: &Handles, n_vertices: usize) -> Self {
        let mut places = vec![None; n_vertices];
        for (&v, target) in handles.vertices.iter().zip(handles.targets.as_chunks().0) {
            places[v as usize] = Some(*target);
        }
        Self { places }
    }

    fn of(&self, vertex: u32) -> Option<[f64; D]> {
        self.places[vertex as usize]
    }

    /// Returns the places of vertices that are all held.
    fn all<const N: usize>(&self, vertices: &[u32; N]) -> [[f64; D]; N] {
        vertices.map(|v| self.of(v).unwrap_or([f64::NAN; D]))
    }

    /// Returns the places of the held ones among these vertices.
    fn some(&self, vertices: &[u32]) -> Vec<[f64; D]> {
        vertices.iter().filter_map(|&v| self.of(v)).collect()
    }

    /// Returns these held vertices without those that their places may hold: as many as `winding` says, or all if that
    /// is unknown.
    fn uncovered(&self, vertices: &[u32], winding: impl Fn([f64; D]) -> Option<i64>) -> Vec<u32> {
        let mut at_place: HashMap<[u64; D], Vec<u32>> = HashMap::new();
        for &v in vertices {
            // −0 and 0 are one place.
            let [place] = self.all(&[v]);
            at_place
                .entry(place.map(|x| (x + 0.0).to_bits()))
                .or_default()
                .push(v);
        }
        let mut beyond: Vec<u32> = Vec::new();
        for held in at_place.into_values() {
            let [place] = self.all(&[held[0]]);
            if let Some(winding) = winding(place) {
                beyond.extend(held.iter().skip(winding.max(0) as usize));
            }
        }
        beyond.sort_unstable();
        beyond
    }
}

impl HeldPlaces<2> {
    /// Returns whether the held corners of a triangle leave it no positive area.
    fn flattens_triangle(&self, triangle: &[u32; 3]) -> bool {
        match self.some(triangle)[..] {
            [a, b] => a == b,
            [a, b, c] => orient2d_sign(a, b, c) <= 0,
            _ => false,
        }
    }
}

impl HeldPlaces<3> {
    /// Returns whether the held corners of a tetrahedron leave it no positive volume.
    fn flattens_tetrahedron(&self, tetrahedron: &[u32; 4]) -> bool {
        match self.some(tetrahedron)[..] {
            [a, b] => a == b,
            [a, b, c] => are_collinear(a, b, c),
            [a, b, c, d] => orient3d_sign(a, b, c, d) <= 0,
            _ => false,
        }
    }
}

/// Returns whether three points of space lie exactly on one line: then so do their shadows on the coordinate planes.
fn are_collinear(a: [f64; 3], b: [f64; 3], c: [f64; 3]) -> bool {
    (0..3).all(|k| {
        let shadow = |p: [f64; 3]| [p[(k + 1) % 3], p[(k + 2) % 3]];
        orient2d_sign(shadow(a), shadow(b), shadow(c)) == 0
    })
}

/// Returns the first element without a positive size as an error.
fn check_elements<const N: usize>(
    elements: &[[u32; N]],
    is_flat: impl Fn(&[u32; N]) -> bool,
) -> Result<(), ProblemError> {
    match elements.iter().position(is_flat) {
        Some(element) => Err(ProblemError::HeldElement { element }),
        None => Ok(()),
    }
}

// Parts with a held boundary.

/// A connected part of a body whose boundary vertices are all held.
#[derive(Clone, Default)]
struct HeldPart<const D: usize> {
    /// Edges or triangles of the boundary, with the part on their left or inside.
    faces: Vec<[u32; D]>,
    /// Held vertices inside.
    inner: Vec<u32>,
    n_vertices: usize,
    n_elements: usize,
}

/// Returns the parts of a planar body whose boundary is held. The list is empty if the triangles form no oriented surface,
/// as those of a surface in space may not.
fn held_borders(body: &Body, triangles: &[[u32; 3]], held: &HeldPlaces<2>) -> Vec<HeldPart<2>> {
    let edges = Edges::new(body.n_vertices(), triangles);
    let is_surface = edges.iter().all(|halfedges| match *halfedges {
        [_] => true,
        [one, other] => !same_direction(triangles, one, other),
        _ => false,
    });
    if !is_surface {
        return Vec::new();
    }
    held_parts(body, boundary_edges(body.n_vertices(), triangles), held)
}

/// Returns the parts of a body with this boundary whose boundary vertices are all held.
fn held_parts<const D: usize>(
    body: &Body,
    boundary: Vec<[u32; D]>,
    held: &HeldPlaces<D>,
) -> Vec<HeldPart<D>> {
    let (part, n_parts) = parts(body);
    let mut all = vec![HeldPart::<D>::default(); n_parts];
    // Distribute the boundary and the elements.
    let mut is_outer = vec![false; body.n_vertices()];
    for face in boundary {
        for v in face {
            is_outer[v as usize] = true;
        }
        all[part[face[0] as usize] as usize].faces.push(face);
    }
    let corners = body.corners();
    for element in &corners {
        all[part[element[0] as usize] as usize].n_elements += 1;
    }
    // Distribute the vertices; those of no element do not count.
    for v in UsedVertices::new(corners.into_iter().flatten().copied()).into_vec() {
        let part = &mut all[part[v as usize] as usize];
        part.n_vertices += 1;
        if !is_outer[v as usize] && held.of(v).is_some() {
            part.inner.push(v);
        }
    }
    let is_held = |face: &[u32; D]| face.iter().all(|&v| held.of(v).is_some());
    all.retain(|part| !part.faces.is_empty() && part.faces.iter().all(is_held));
    all
}

/// Checks that a boundary encloses a signed size above its rounding error.
fn check_size([size, rounding]: [f64; 2]) -> Result<(), ProblemError> {
    if size > rounding {
        Ok(())
    } else {
        Err(ProblemError::BoundarySize { size })
    }
}

/// Returns the signed area within edges, and a bound of its rounding error.
fn signed_area(edges: &[[u32; 2]], held: &HeldPlaces<2>) -> [f64; 2] {
    let [origin] = held.all(&[edges[0][0]]);
    let terms = edges.iter().map(|edge| {
        let [a, b] = held.all(edge).map(|p| sub(p, origin));
        [0.5 * cross(a, b), (a[0] * b[1]).abs() + (a[1] * b[0]).abs()]
    });
    with_rounding(terms, edges.len())
}

/// Returns the signed volume within triangles, and a bound of its rounding error.
fn signed_volume(triangles: &[[u32; 3]], held: &HeldPlaces<3>) -> [f64; 2] {
    let [origin] = held.all(&[triangles[0][0]]);
    let terms = triangles.iter().map(|triangle| {
        let [a, b, c] = held.all(triangle).map(|p| vec3::sub(p, origin));
        let volume = vec3::dot(a, vec3::cross(b, c)) / 6.0;
        [volume, vec3::norm(a) * vec3::norm(b) * vec3::norm(c)]
    });
    with_rounding(terms, triangles.len())
}

/// Returns the sum of values and a bound of its rounding error, given the size of each value's terms.
fn with_rounding(terms: impl Iterator<Item = [f64; 2]>, n: usize) -> [f64; 2] {
    let [sum, sizes] = terms.fold([0.0; 2], |[sum, sizes], [value, size]| {
        [sum + value, sizes + size]
    });
    // Few roundings for each term, and one for each addition.
    [sum, (n as f64 + 10.0) * f64::EPSILON * sizes]
}

// Turns of the border.

impl HeldPart<2> {
    /// Checks the total turning of the border against the Euler characteristic. A border that passes a vertex twice is
    /// not judged.
    fn check_turning(&self, held: &HeldPlaces<2>) -> Result<(), ProblemError> {
        let next: HashMap<u32, u32> = self.faces.iter().map(|&[a, b]| (a, b)).collect();
        if next.len() < self.faces.len() {
            return Ok(());
        }
        let angle = |&[a, b]: &[u32; 2]| next.get(&b).map_or(0.0, |&c| turn(held.all(&[a, b, c])));
        let turns = (self.faces.iter().map(angle).sum::<f64>() / TAU).round() as i64;
        let needed = self.characteristic();
        if turns < needed {
            return Err(ProblemError::BoundaryTurning { turns, needed });
        }
        Ok(())
    }

    /// Returns the number of vertices minus that of edges plus that of triangles.
    fn characteristic(&self) -> i64 {
        // Triangles have three edges each, and count inner ones twice.
        let n_border = self.faces.len();
        let n_edges = n_border + (3 * self.n_elements - n_border) / 2;
        self.n_vertices as i64 - n_edges as i64 + self.n_elements as i64
    }
}

/// Returns the exterior angle of a line at its middle point, positive to the left, in [−π, π).
///
/// A line that goes exactly back turns by −π: there the part lies all around its end, for a triangle between both
/// edges would be empty.
fn turn([a, b, c]: [[f64; 2]; 3]) -> f64 {
    let (before, after) = (sub(b, a), sub(c, b));
    let along = dot(before, after);
    match orient2d_sign(a, b, c) {
        0 if along < 0.0 => -PI,
        0 => 0.0,
        sign => f64::from(sign) * cross(before, after).abs().atan2(along),
    }
}

// Winding numbers of the boundary around a point.

/// Returns how often closed lines wind around a point counter-clockwise; `None` if it lies on one of them. Exact.
fn winding(edges: &[[u32; 2]], held: &HeldPlaces<2>, p: [f64; 2]) -> Option<i64> {
    let mut winding = 0;
    for edge in edges {
        let [a, b] = held.all(edge);
        // An edge that meets the horizontal line through the point passes it on one side or the other.
        let (is_above, ends_above) = (a[1] > p[1], b[1] > p[1]);
        let is_within = |k: usize| a[k].min(b[k]) <= p[k] && p[k] <= a[k].max(b[k]);
        if !is_within(1) {
            continue;
        }
        let side = orient2d_sign(a, b, p);
        if side == 0 && is_within(0) {
            return None;
        }
        winding += match (is_above, ends_above) {
            (false, true) if side > 0 => 1,
            (true, false) if side < 0 => -1,
            _ => 0,
        };
    }
    Some(winding)
}

/// Largest distance of a sum of solid angles, over 4π, from a whole number at a point off the surface: rounding is far
/// smaller, and on the surface the sum is about a half.
const UNSURE: f64 = 0.1;

/// Returns how often a closed surface winds around a point; `None` if it lies on the surface, or too near to tell.
///
/// From: van Oosterom and Strackee 1983, The Solid Angle of a Plane Triangle.
fn winding_in_space(triangles: &[[u32; 3]], held: &HeldPlaces<3>, p: [f64; 3]) -> Option<i64> {
    let solid_angle = |triangle: &[u32; 3]| {
        let [a, b, c] = held.all(triangle).map(|corner| vec3::sub(corner, p));
        let [x, y, z] = [a, b, c].map(vec3::norm);
        let (ab, bc, ca) = (vec3::dot(a, b), vec3::dot(b, c), vec3::dot(c, a));
        2.0 * vec3::dot(a, vec3::cross(b, c)).atan2(x * y * z + ab * z + bc * x + ca * y)
    };
    let winding = triangles.iter().map(solid_angle).sum::<f64>() / (2.0 * TAU);
    ((winding - winding.round()).abs() < UNSURE).then_some(winding.round() as i64)
}
