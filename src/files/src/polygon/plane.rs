//! The plane of a polygon.

use unwrapd_method::numerics::vec3::{cross, dot, norm, perpendicular, sub, unit};

/// Least area of a polygon, as a share of its squared extent: smaller areas are rounding errors of zero.
const LEAST_AREA: f64 = 1e-12;

/// Returns the corners relative to the first, in units of a power of two no smaller than the largest coordinate; `None`
/// if there is no such power.
pub(super) fn scaled<const N: usize>(corners: &[[f64; 3]; N]) -> Option<[[f64; 3]; N]> {
    let frame = PlaneFrame::of(corners)?;
    Some(corners.map(|p| frame.enter(p)))
}

/// Returns the corners in their mean plane, seen from the side from which they turn counter-clockwise; `None` if they
/// have no area. Exact if the plane is that of two axes.
pub(super) fn flattened(corners: &[[f64; 3]]) -> Option<Vec<[f64; 2]>> {
    let frame = PlaneFrame::of(corners)?;
    let corners: Vec<[f64; 3]> = corners.iter().map(|&p| frame.enter(p)).collect();
    let normal = newell_normal(&corners);
    if norm(normal) <= LEAST_AREA {
        return None;
    }
    let normal = unit(normal);
    let right = perpendicular(normal);
    let up = cross(normal, right);
    Some(
        corners
            .iter()
            .map(|&p| [dot(p, right), dot(p, up)])
            .collect(),
    )
}

/// Returns twice the sum of the areas under all edges, as a vector: normal to the plane in which the polygon has the
/// most area (Newell).
fn newell_normal(corners: &[[f64; 3]]) -> [f64; 3] {
    let mut normal = [0.0; 3];
    let following = corners.iter().cycle().skip(1);
    for (&p, &q) in corners.iter().zip(following) {
        let area = cross(p, q);
        for axis in 0..3 {
            normal[axis] += area[axis];
        }
    }
    normal
}

/// Position and scale of a polygon.
struct PlaneFrame {
    origin: [f64; 3],
    scale: f64,
}

impl PlaneFrame {
    fn of(corners: &[[f64; 3]]) -> Option<Self> {
        let &origin = corners.first()?;
        let extent = corners.iter().flat_map(|&p| sub(p, origin));
        let extent = extent.fold(0.0, |most: f64, x| most.max(x.abs()));
        let scale = (-extent.log2().ceil()).exp2();
        (scale > 0.0 && scale.is_finite()).then_some(Self { origin, scale })
    }

    fn enter(&self, p: [f64; 3]) -> [f64; 3] {
        sub(p, self.origin).map(|x| x * self.scale)
    }
}
