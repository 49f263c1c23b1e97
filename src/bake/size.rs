//! How dense textures are.

use super::triangle::Triangle;
use super::{Corners, Plane};

/// Texels of one document's new textures together at most: eight of 8192 × 8192.
pub const MOST_TEXELS: u64 = 1 << 29;
/// Sides that are chosen unasked.
const SIDES: [f64; 2] = [16.0, 4096.0];
/// A texel less than the texture had costs nothing that is seen.
const SLACK: f64 = 1.0;

/// The side, a power of two from 16 to 4096, of a texture on which the faces have as many texels as they had in the old ones.
/// `faces`: corners in the unit square.
pub fn side_for(plane: &Plane, faces: &[Corners]) -> u32 {
    let all = plane.faces.iter().zip(faces);
    let side =
        texel_length(all.filter_map(|(sampled, face)| Some((&sampled.as_ref()?.corners, face))));
    let [least, most] = SIDES;
    ((side - SLACK).ceil().clamp(least, most) as u32).next_power_of_two()
}

/// How many units of the places of faces in a texture, at the mean, are a unit of their places in another; 0 without an area.
pub(super) fn texel_length<'a>(faces: impl Iterator<Item = (&'a Corners, &'a Corners)>) -> f64 {
    let (mut sources, mut targets) = (0.0, 0.0);
    for (source, target) in faces {
        if let Some(triangle) = Triangle::new(*target) {
            let [[a, b], [c, d]] = triangle.jacobian(source);
            sources += (a * d - b * c).abs() * triangle.doubled_area();
            targets += triangle.doubled_area();
        }
    }
    if targets > 0.0 {
        (sources / targets).sqrt()
    } else {
        0.0
    }
}
