//! The faces of a surface or of a chart, and how they meet.

use crate::charts::regions::facets::crossings;
use std::borrow::Cow;
use unwrapd_maps::cut::Sheet;
use unwrapd_maps::mesh::{Surface, next};
use unwrapd_method::numerics::bounds::bounds_of;
use unwrapd_method::numerics::vec3::{area_vector, distance, norm};

/// A face has a normal if each of its heights is at least this part of the farthest coordinate:
/// rounding to `f32` tilts a lower one by half a degree or more.
const LEAST_HEIGHT: f64 = 1e-5;

/// The faces of a surface or of a chart, and how they meet.
pub struct Faces<'a> {
    /// For each halfedge the one across; none also where a piece that is not orientable changes
    /// sides.
    pub across: Cow<'a, [u32]>,
    /// The places of the corners of each face.
    pub corners: Vec<[[f64; 3]; 3]>,
    pub areas: Vec<f64>,
    /// Unit normals, consistent within a piece; none of faces too thin to have one.
    pub normals: Vec<Option<[f64; 3]>>,
}

impl<'a> Faces<'a> {
    /// Of a surface. O(n).
    pub fn of_surface(surface: &'a Surface) -> Self {
        let turned = &surface.adjacency().turned;
        let n_faces = surface.triangles.len();
        let corners = (0..n_faces).map(|face| surface.corners(face)).collect();
        let mut faces = Self::new(crossings(surface).into(), corners);
        for (normal, _) in (faces.normals.iter_mut().zip(turned)).filter(|(_, turned)| **turned) {
            *normal = normal.map(|normal| normal.map(|x| -x));
        }
        faces
    }

    /// Of a chart's sheet. O(n).
    pub fn of_sheet(sheet: &'a Sheet) -> Self {
        let place = |v: u32| sheet.positions[v as usize];
        let (faces, _) = sheet.vertex.as_chunks::<3>();
        Self::new(
            sheet.twin.as_slice().into(),
            faces.iter().map(|face| face.map(place)).collect(),
        )
    }

    fn new(across: Cow<'a, [u32]>, corners: Vec<[[f64; 3]; 3]>) -> Self {
        let coordinates = corners.as_flattened().as_flattened().iter();
        let least = LEAST_HEIGHT * coordinates.fold(0.0, |most: f64, x| most.max(x.abs()));
        let doubled: Vec<[f64; 3]> = (corners.iter())
            .map(|&[a, b, c]| area_vector(a, b, c))
            .collect();
        let normal = |(&[a, b, c], &doubled): (&[[f64; 3]; 3], &[f64; 3])| {
            let length = norm(doubled);
            let longest = distance(a, b).max(distance(b, c)).max(distance(c, a));
            (length > least * longest).then(|| doubled.map(|x| x / length))
        };
        Self {
            across,
            areas: doubled.iter().map(|&of| norm(of) / 2.0).collect(),
            normals: corners.iter().zip(&doubled).map(normal).collect(),
            corners,
        }
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.areas.len()
    }

    /// The length of a halfedge.
    pub fn length(&self, h: u32) -> f64 {
        let [a, b] = [h, next(h)].map(|h| self.corners[h as usize / 3][h as usize % 3]);
        distance(a, b)
    }

    /// The diagonal of the box around all.
    pub fn diagonal(&self) -> f64 {
        let [low, high] = bounds_of(self.corners.as_flattened());
        if low[0] <= high[0] {
            distance(low, high)
        } else {
            0.0
        }
    }
}
