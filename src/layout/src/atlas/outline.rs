//! Outline of a chart: its boundary edges including those of holes, its area, and the angle at which it is packed.
use rayon::prelude::*;
use std::sync::Arc;

use super::copies::Moments;
use super::page::{Texture, page_side};
use super::problem::{AtlasError, ChartMap, Rotation};
use unwrapd_maps::plane::Straightness;
use unwrapd_method::numerics::hull::{convex_hull, smallest_page};
use unwrapd_method::numerics::vec2::doubled_area;

/// Outline of a chart, turned to the angle at which it is packed.
#[derive(Clone, Debug)]
pub(super) struct Outline {
    /// Directed edges around the area, which lies to their left, in the plane of the map.
    boundary: Arc<[[[f64; 2]; 2]]>,
    pub n_triangles: usize,
    /// Square root of the area in mesh units; 0 for a chart without area, which authored UVs may have.
    pub size: f64,
    /// Sides of the bounding rectangle of the turned outline, in mesh units.
    pub extent: [f64; 2],
    /// Axes of the outline in the plane of the map.
    pub straightness: Straightness,
    /// Moments in the plane of the map.
    pub moments: Moments,
    /// Rotations that the options permit.
    permitted: Rotation,
    /// `true` if enough copies of the chart lie at the same angle. They are then turned alike.
    pub has_copies: bool,
    /// Unit vector in the plane of the map that becomes the horizontal axis.
    axis: [f64; 2],
    /// Subtracted after turning: the lower left corner of the bounding rectangle, unless set by `with_corner`.
    low: [f64; 2],
}

impl Outline {
    /// Creates the outline of a map with the given area, not turned.
    pub(super) fn new(map: &ChartMap, area: f64) -> Self {
        let at = |v: u32| map.uv[v as usize];
        let boundary: Arc<[_]> = boundary(map).into_iter().map(|e| e.map(at)).collect();
        let outline = Self {
            straightness: Straightness::of(&boundary),
            moments: Moments::new(&boundary),
            permitted: Rotation::Any,
            has_copies: false,
            boundary,
            n_triangles: map.triangles.len(),
            size: area.max(0.0).sqrt(),
            extent: [0.0; 2],
            axis: [1.0, 0.0],
            low: [0.0; 2],
        };
        outline.turned([1.0, 0.0])
    }

    /// Returns the outline turned so that `axis`, a unit vector in the plane of the map, becomes horizontal.
    pub(super) fn turned(&self, axis: [f64; 2]) -> Self {
        let mut turned = Self {
            axis,
            low: [0.0; 2],
            extent: [0.0; 2],
            ..self.clone()
        };
        let mut high = [f64::NEG_INFINITY; 2];
        let mut low = [f64::INFINITY; 2];
        for p in self.corners().map(|p| turned.place(p)) {
            for k in 0..2 {
                low[k] = low[k].min(p[k]);
                high[k] = high[k].max(p[k]);
            }
        }
        if low[0] <= high[0] {
            turned.low = low;
            turned.extent = [high[0] - low[0], high[1] - low[1]];
        }
        turned
    }

    /// Returns the outline with `corner` as its origin instead of the lower left corner of the bounding rectangle. `corner` is
    /// given in turned coordinates and lies to the left of the rectangle and below it.
    pub(super) fn with_corner(&self, corner: [f64; 2]) -> Self {
        let extent = |k: usize| self.low[k] + self.extent[k] - corner[k];
        Self {
            extent: [0, 1].map(extent),
            low: corner,
            ..self.clone()
        }
    }

    /// Returns the outline with its origin moved, in placed coordinates.
    pub(super) fn with_origin(&self, origin: [f64; 2]) -> Self {
        self.with_corner([0, 1].map(|k| self.low[k] + origin[k]))
    }

    /// Limits the rotations, which are relative to the map.
    pub(super) fn limited_to(self, permitted: Rotation) -> Self {
        Self { permitted, ..self }
    }

    /// Returns the rotations to try: only quarter turns for an upright chart if any angle is permitted.
    pub(super) fn rotation(&self) -> Rotation {
        match (self.permitted, self.straightness) {
            (Rotation::Any, Straightness::Upright(_)) => Rotation::Quarter,
            (permitted, _) => permitted,
        }
    }

    /// Returns the outline turned upright if it leans and any angle is permitted; `None` otherwise.
    pub(super) fn straightened(&self) -> Option<Self> {
        match self.straightness {
            Straightness::Leaning(axis) if self.permitted == Rotation::Any => {
                Some(self.turned(axis).with(Straightness::Upright(axis)))
            }
            _ => None,
        }
    }

    /// Returns the outline turned upright; `None` if it leans or is round.
    pub(super) fn upright(&self) -> Option<Self> {
        match self.straightness {
            Straightness::Upright(axis) => Some(self.turned(axis)),
            Straightness::Leaning(_) | Straightness::Round => None,
        }
    }

    /// Returns a straight outline turned upright if it is then no longer than `side`. A longer one counts as leaning from then on,
    /// and the layouts decide on its angle. Returns other outlines unchanged.
    pub(super) fn upright_within(&self, side: f64) -> Self {
        match (self.upright(), self.straightness) {
            (Some(upright), _) if upright.extent[0].max(upright.extent[1]) <= side => upright,
            (Some(_), Straightness::Upright(axis)) => self.with(Straightness::Leaning(axis)),
            _ => self.clone(),
        }
    }

    /// Returns the outline turned like `first`, whose copy it is at `angle` in the plane of the map.
    pub(super) fn turned_like(&self, first: &Self, angle: f64) -> Self {
        let (sin, cos) = angle.sin_cos();
        let turned = |[c, s]: [f64; 2]| [c * cos - s * sin, c * sin + s * cos];
        let straightness = match first.straightness {
            Straightness::Upright(axis) => Straightness::Upright(turned(axis)),
            Straightness::Leaning(axis) => Straightness::Leaning(turned(axis)),
            Straightness::Round => Straightness::Round,
        };
        self.turned(turned(first.axis)).with(straightness)
    }

    /// Returns the angle of the outline on the page, in radians. Copies that lie alike have the same one.
    pub(super) fn lean(&self) -> f64 {
        self.moments.angle - self.axis[1].atan2(self.axis[0])
    }

    /// Returns the outline with `straightness` in place of its own.
    fn with(&self, straightness: Straightness) -> Self {
        Self {
            straightness,
            ..self.clone()
        }
    }

    /// Returns the angle, in radians, by which another rotation of this outline is turned further counter-clockwise.
    pub(super) fn angle_to(&self, other: &Self) -> f64 {
        let ([a, b], [c, d]) = (self.axis, other.axis);
        (b * c - a * d).atan2(a * c + b * d)
    }

    /// Returns the outline turned counter-clockwise by an angle in radians.
    pub(super) fn rotated(&self, angle: f64) -> Self {
        let ([c, s], (sin, cos)) = (self.axis, angle.sin_cos());
        self.turned([c * cos + s * sin, s * cos - c * sin])
    }

    /// Returns the outline turned counter-clockwise by quarters, exactly.
    pub(super) fn quarter_turned(&self, turns: u32) -> Self {
        let turned = |[c, s]: [f64; 2], _| [s, -c];
        self.turned((0..turns).fold(self.axis, turned))
    }

    /// Turns and shifts a point of the map. The lower left corner of the bounding rectangle becomes the origin.
    pub(super) fn place(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let [c, s] = self.axis;
        [c * x + s * y - self.low[0], c * y - s * x - self.low[1]]
    }

    /// Returns the point of the map at the center of the bounding rectangle.
    pub(super) fn middle(&self) -> [f64; 2] {
        let [c, s] = self.axis;
        let [x, y] = [0, 1].map(|k| self.low[k] + self.extent[k] / 2.0);
        [c * x - s * y, s * x + c * y]
    }

    /// Returns the corners of the outline, in the plane of the map.
    pub(super) fn corners(&self) -> impl Iterator<Item = [f64; 2]> {
        self.boundary.iter().map(|edge| edge[0])
    }

    /// Returns the directed edges, turned and shifted.
    pub(super) fn edges(&self) -> impl ExactSizeIterator<Item = [[f64; 2]; 2]> {
        self.boundary.iter().map(|edge| edge.map(|p| self.place(p)))
    }

    /// Returns the longer side of the smallest page around the outline in any of these rotations, without borders, in mesh units.
    pub(super) fn least_page(&self, rotation: Rotation, texture: Texture) -> f64 {
        let [width, height] = self.extent;
        let halvings = texture.resolution.halvings();
        match rotation {
            Rotation::Any => {
                let aspect = 1.0 / texture.share();
                let page = smallest_page(&convex_hull(self.corners()), aspect);
                (page.area * aspect).sqrt()
            }
            Rotation::Quarter => {
                page_side([width, height], halvings).min(page_side([height, width], halvings))
            }
            Rotation::None => page_side(self.extent, halvings),
        }
    }

    /// Returns the length of the boundary, in mesh units.
    pub(super) fn perimeter(&self) -> f64 {
        let length = |[p, q]: &[[f64; 2]; 2]| (p[0] - q[0]).hypot(p[1] - q[1]);
        self.boundary.iter().map(length).sum()
    }
}

/// Checks the charts and computes their outlines.
pub(super) fn outlines(charts: &[ChartMap]) -> Result<Vec<Outline>, AtlasError> {
    let areas: Vec<f64> = charts
        .par_iter()
        .map(check)
        .collect::<Vec<_>>()
        .into_iter()
        .enumerate()
        .map(|(chart, checked)| checked.map_err(|fault| fault(chart)))
        .collect::<Result<_, _>>()?;
    let outlined = charts.par_iter().zip(&areas);
    Ok(outlined
        .map(|(map, &area)| Outline::new(map, area))
        .collect())
}

/// Returns the area of a chart, or a function from its index to the error.
fn check(map: &ChartMap) -> Result<f64, fn(usize) -> AtlasError> {
    if map.uv.iter().flatten().any(|x| !x.is_finite()) {
        return Err(|chart| AtlasError::NonFinite { chart });
    }
    if map
        .triangles
        .iter()
        .flatten()
        .any(|&v| v as usize >= map.uv.len())
    {
        return Err(|chart| AtlasError::IndexOutOfRange { chart });
    }
    let area = area(map);
    if !area.is_finite() {
        return Err(|chart| AtlasError::NonFinite { chart });
    }
    Ok(area)
}

/// Returns the sum of the signed areas of the triangles.
fn area(map: &ChartMap) -> f64 {
    let doubled = map.triangles.iter().map(|t| doubled_area_of(map, t));
    doubled.sum::<f64>() / 2.0
}

fn doubled_area_of(map: &ChartMap, triangle: &[u32; 3]) -> f64 {
    let [a, b, c] = triangle.map(|v| map.uv[v as usize]);
    doubled_area(a, b, c)
}

/// Returns the directed edges of all triangles, except those that cancel because they run in opposite directions. Their order
/// depends only on the triangles.
///
/// Flipped triangles, which maps without a barrier may have, are turned over first, so that they count as area, too. The edges that
/// they share with their neighbors then run in the same direction and are kept twice. Edges of triangles without area are also
/// kept: they enclose nothing, but the chart extends that far. Otherwise, all edges of a closed surface whose UVs lie on a line
/// would cancel.
pub(super) fn boundary(map: &ChartMap) -> Vec<[u32; 2]> {
    let edges_of = |[a, b, c]: [u32; 3]| [[a, b], [b, c], [c, a]];
    let mut boundary = Vec::new();
    // Edges as their smaller and larger end, and whether they run from the smaller to the larger.
    let mut edges: Vec<(u32, u32, bool)> = Vec::with_capacity(3 * map.triangles.len());
    for &triangle @ [a, b, c] in map.triangles {
        let doubled_area = doubled_area_of(map, &triangle);
        if doubled_area == 0.0 {
            boundary.extend(edges_of(triangle));
            continue;
        }
        let counter_clockwise = if doubled_area < 0.0 {
            [a, c, b]
        } else {
            triangle
        };
        let of_triangle = edges_of(counter_clockwise);
        edges.extend(of_triangle.map(|[p, q]| (p.min(q), p.max(q), p < q)));
    }
    edges.sort_unstable();
    for same in edges.chunk_by(|x, y| (x.0, x.1) == (y.0, y.1)) {
        let (low, high, _) = same[0];
        let forward = same.iter().filter(|edge| edge.2).count();
        let back = same.len() - forward;
        boundary.extend((back..forward).map(|_| [low, high]));
        boundary.extend((forward..back).map(|_| [high, low]));
    }
    boundary
}
