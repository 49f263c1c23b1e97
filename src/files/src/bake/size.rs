//! How dense textures are.

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
    let areas =
        Areas::of(all.filter_map(|(sampled, face)| Some((&sampled.as_ref()?.corners, face))));
    let [least, most] = SIDES;
    ((areas.length() - SLACK).ceil().clamp(least, most) as u32).next_power_of_two()
}

/// Twice the areas of faces.
pub(super) struct Areas {
    /// In what they show.
    pub sources: f64,
    /// In the texture that is made.
    pub targets: f64,
}

impl Areas {
    /// Of faces by their corners in both. Those without an area in the new texture are left out.
    pub fn of<'a>(faces: impl Iterator<Item = (&'a Corners, &'a Corners)>) -> Self {
        let mut areas = Self {
            sources: 0.0,
            targets: 0.0,
        };
        for (source, target) in faces {
            let target = doubled_area(target);
            if target > 0.0 {
                areas.sources += doubled_area(source);
                areas.targets += target;
            }
        }
        areas
    }

    /// How long a unit of the new texture is in the old one, at the mean; 0 where nothing is shown.
    pub fn length(&self) -> f64 {
        if self.targets > 0.0 {
            (self.sources / self.targets).sqrt()
        } else {
            0.0
        }
    }
}

fn doubled_area([a, b, c]: &Corners) -> f64 {
    ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])).abs()
}
