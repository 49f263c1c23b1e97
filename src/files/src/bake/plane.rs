//! Sources of a texture for a new UV map: old textures, places of faces in them, and tangent frames.

use super::coverage::{Areas, Barycentric, doubled_area};
use super::{Corners, Texture};
use crate::document::Encoding;
use crate::picture::Picture;
use std::collections::HashMap;

/// Texture of a face and, for each of its corners, the place in it, in texels.
#[derive(Clone, Copy)]
pub struct Sampled {
    /// Index of the texture.
    pub texture: u32,
    /// Places of the corners.
    pub corners: Corners,
}

/// Red, green, blue and alpha of the three corners of a face.
pub type CornerColors = [[f32; 4]; 3];

/// Textures on the old map that are merged into one on the new map.
pub struct Plane<'a> {
    /// Encoding of the texels.
    pub encoding: Encoding,
    /// Old textures.
    pub textures: Vec<Texture<'a>>,
    /// Source of each face; `None` for faces without a texture.
    pub faces: Vec<Option<Sampled>>,
    /// Frames to which directions are relative; only for normal maps.
    pub frames: Option<Frames>,
    /// Linear colors of the corners of each face, which multiply the texels; `None` if all are white.
    pub colors: Option<Vec<CornerColors>>,
}

impl Plane<'_> {
    /// Returns whether a texture has 16 bits per channel.
    pub fn is_deep(&self) -> bool {
        let mut textures = self.textures.iter();
        textures.any(|texture| matches!(texture.picture, Picture::Sixteen(_)))
    }

    /// Returns a value multiplied by the color at a place of a face.
    pub(super) fn colored(&self, face: usize, weights: Barycentric, value: [f32; 4]) -> [f32; 4] {
        let Some(colors) = &self.colors else {
            return value;
        };
        let color = interpolated(weights, &colors[face]);
        [0, 1, 2, 3].map(|k| color[k] * value[k])
    }
}

// Choice of the texture size.

/// Most texels of all new textures of a document: eight of 8192 × 8192, 2 GiB.
pub const MOST_TEXELS: u64 = 1 << 29;
/// Smallest and largest side that are chosen automatically.
const SIDES: [f64; 2] = [16.0, 4096.0];
/// Texels by which a side may be too small without a visible loss.
const SIDE_SLACK: f64 = 1.0;
/// Texels for each face with vertex colors: two along each direction for each vertex, as there are half as many vertices
/// as faces.
const TEXELS_PER_FACE: f64 = 2.0;

/// Returns the side, a power of two from 16 to 4096, of a texture on which the faces of each old picture have as many
/// texels as on that, and faces of several colors enough to tell them apart. Faces of one color need none. `faces` are
/// corners in the unit square.
pub fn side_for(plane: &Plane, faces: &[Corners]) -> u32 {
    let mut of_pictures: HashMap<*const Picture, Vec<(&Corners, &Corners)>> = HashMap::new();
    for (sampled, face) in plane.faces.iter().zip(faces) {
        let Some(sampled) = sampled else {
            continue;
        };
        let texture = &plane.textures[sampled.texture as usize];
        if !texture.is_constant() {
            let of_picture = of_pictures.entry(std::ptr::from_ref(texture.picture));
            of_picture.or_default().push((&sampled.corners, face));
        }
    }
    let lengths = of_pictures.into_values();
    let lengths = lengths.map(|faces| Areas::of(faces.into_iter()).length());
    side_of_length(lengths.fold(colors_length(plane, faces), f64::max))
}

/// Returns the side of a texture that needs `length` texels along it: a power of two from 16 to 4096.
pub fn side_of_length(length: f64) -> u32 {
    let [least, most] = SIDES;
    ((length - SIDE_SLACK).ceil().clamp(least, most) as u32).next_power_of_two()
}

/// Returns the number of texels along a unit of length that vertex colors need.
fn colors_length(plane: &Plane, faces: &[Corners]) -> f64 {
    let several = |[a, b, c]: &CornerColors| a != b || b != c;
    let colors = plane.colors.iter().flatten();
    let colored = colors.zip(faces).filter(|(colors, _)| several(colors));
    let (n_faces, doubled) = colored.fold((0.0, 0.0), |(n, sum), (_, face)| {
        (n + 1.0, sum + doubled_area(face))
    });
    if doubled > 0.0 {
        (TEXELS_PER_FACE * n_faces / (0.5 * doubled)).sqrt()
    } else {
        0.0
    }
}

// Directions converted from one tangent frame to another.

/// Normals, and tangents with the sign of the bitangent, at the corners of faces.
pub struct Frames {
    /// Normals of the surface.
    pub normals: Vec<[[f32; 3]; 3]>,
    /// Tangents of the old map, to which directions are relative.
    pub from: Vec<[[f32; 4]; 3]>,
    /// Tangents of the new map.
    pub to: Vec<[[f32; 4]; 3]>,
}

impl Frames {
    /// Appends faces without directions.
    pub fn skip(&mut self, n_faces: usize) {
        let n = self.normals.len() + n_faces;
        self.normals.resize(n, [[0.0; 3]; 3]);
        self.from.resize(n, [[0.0; 4]; 3]);
        self.to.resize(n, [[0.0; 4]; 3]);
    }

    /// Converts a direction at a place of a face from the old frame to the new one, with unit length; returns it
    /// unchanged if a frame is degenerate.
    pub(super) fn carried(
        &self,
        face: usize,
        weights: Barycentric,
        direction: [f32; 3],
    ) -> [f32; 3] {
        let normal = unit(interpolated(weights, &self.normals[face]));
        let from = basis(normal, interpolated(weights, &self.from[face]));
        let to = basis(normal, interpolated(weights, &self.to[face]));
        let [x, y, z] = direction;
        let world = [0, 1, 2].map(|k| x * from[0][k] + y * from[1][k] + z * from[2][k]);
        // Cramer's rule, the columns of the matrix being the axes of the new frame.
        let volume = dot(to[0], cross(to[1], to[2]));
        let carried =
            [(1, 2), (2, 0), (0, 1)].map(|(a, b)| dot(world, cross(to[a], to[b])) / volume);
        let carried = unit(carried);
        if carried.iter().all(|x| x.is_finite()) {
            carried
        } else {
            direction
        }
    }
}

/// Returns tangent, bitangent and normal as glTF defines them.
fn basis(normal: [f32; 3], [x, y, z, sign]: [f32; 4]) -> [[f32; 3]; 3] {
    let tangent = unit([x, y, z]);
    let bitangent = unit(cross(normal, tangent)).map(|x| x * sign.signum());
    [tangent, bitangent, normal]
}

fn interpolated<const N: usize>(weights: Barycentric, corners: &[[f32; N]; 3]) -> [f32; N] {
    std::array::from_fn(|k| (0..3).map(|c| weights[c] as f32 * corners[c][k]).sum())
}

fn cross(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn unit(a: [f32; 3]) -> [f32; 3] {
    let length = dot(a, a).sqrt();
    a.map(|x| x / length)
}
