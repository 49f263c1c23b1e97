//! Choice of the texture size.

use super::{Corners, Plane};

/// Most texels of all new textures of a document: eight of 8192 × 8192, 2 GiB.
pub const MOST_TEXELS: u64 = 1 << 29;
/// Smallest and largest side that are chosen automatically.
const SIDES: [f64; 2] = [16.0, 4096.0];
/// Texels by which a side may be too small without a visible loss.
const SLACK: f64 = 1.0;

/// Returns the side, a power of two from 16 to 4096, of a texture on which the faces have the same number of texels as
/// in the old ones. `faces` are corners in the unit square.
pub fn side_for(plane: &Plane, faces: &[Corners]) -> u32 {
    let all = plane.faces.iter().zip(faces);
    let areas =
        Areas::of(all.filter_map(|(sampled, face)| Some((&sampled.as_ref()?.corners, face))));
    let [least, most] = SIDES;
    ((areas.length() - SLACK).ceil().clamp(least, most) as u32).next_power_of_two()
}

/// Sums of doubled areas of faces.
pub(super) struct Areas {
    /// Area in the source textures.
    pub sources: f64,
    /// Area in the new texture.
    pub targets: f64,
}

impl Areas {
    /// Sums the areas of faces, given by their corners in both. Faces without area in the new texture are left out.
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

    /// Returns the mean length, in the old texture, of a unit of the new one; 0 if there are no sources.
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
