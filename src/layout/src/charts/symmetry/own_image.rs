//! Whether triangles are the mirror image of others, or of themselves.

use super::plane::MirrorPlane;
use unwrapd_method::numerics::vec3::{area_vector, distance, norm};

/// What the areas on both sides of the plane, or of a chart and its image, may differ by as a share.
const SAME_AREA: f64 = 0.1;

/// What centers may be apart, in square roots of the area.
const SAME_CENTER: f64 = 0.05;

/// Area and center of some triangles.
#[derive(Clone, Copy, Debug, Default)]
pub struct Moment {
    pub area: f64,
    weighted: [f64; 3],
}

impl Moment {
    /// Of some triangles.
    pub fn of(triangles: &[[u32; 3]], positions: &[[f64; 3]]) -> Self {
        let mut all = Self::default();
        for triangle in triangles {
            all.add(triangle.map(|v| positions[v as usize]));
        }
        all
    }

    fn add(&mut self, [a, b, c]: [[f64; 3]; 3]) {
        let area = norm(area_vector(a, b, c)) / 2.0;
        self.area += area;
        for k in 0..3 {
            self.weighted[k] += area * (a[k] + b[k] + c[k]) / 3.0;
        }
    }

    fn center(&self) -> [f64; 3] {
        self.weighted.map(|x| x / self.area.max(f64::MIN_POSITIVE))
    }

    /// Whether it is about the mirror image of another.
    pub fn is_image_of(&self, other: &Self, plane: &MirrorPlane) -> bool {
        let most = self.area.max(other.area);
        (self.area - other.area).abs() <= SAME_AREA * most
            && distance(self.center(), plane.mirrored(other.center())) <= SAME_CENTER * most.sqrt()
    }
}

/// Whether triangles are about their own mirror image: both sides of the plane have the same area and center.
pub fn are_own_image(triangles: &[[u32; 3]], positions: &[[f64; 3]], plane: &MirrorPlane) -> bool {
    let (mut front, mut behind) = (Moment::default(), Moment::default());
    for triangle in triangles {
        let corners = triangle.map(|v| positions[v as usize]);
        let height: f64 = corners.iter().map(|&p| plane.height(p)).sum();
        let side = if height > 0.0 {
            &mut front
        } else {
            &mut behind
        };
        side.add(corners);
    }
    front.is_image_of(&behind, plane)
}
