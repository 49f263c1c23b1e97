//! Regions of a surface whose normals lie within a cone.

use super::cone::{Cone, Normals};
use super::facets::{consistent_normals, crossings, facets};
use super::merge::{Limits, Regions};
use super::smooth::smooth_borders;
use unwrapd_maps::mesh::{CUT, Surface, UnionFind, next, origin};
use unwrapd_method::numerics::vec3::distance;

/// All but 1 % of a region's area lies within 70° of its mean normal: its projection along that normal is injective but
/// for noise, with room for what the border smoothing moves. A spherical cap of 70° loses 0.33 of its area in projection,
/// two faces of a cube lose 0.29; three lose 0.42 and would have to be torn at their corner.
const CONE: Cone = Cone {
    cos: 0.342,
    stray: 0.01,
    spread: 0.35,
};

/// Regions smaller than [`CRUMB`] may go to a neighbor whose cone becomes wider than [`CONE`].
const CRUMB_CONE: Cone = Cone {
    cos: 0.174,
    stray: 0.01,
    spread: 0.4,
};

/// The share of the whole area below which a region is a crumb.
const CRUMB: f64 = 0.003;

/// Labels connected regions, numbered by their first triangles, and how many there are.
pub fn regions(surface: &Surface) -> (Vec<u32>, usize) {
    let normals = consistent_normals(surface);
    let across = crossings(surface);
    let length = |h: u32| {
        let [a, b] =
            [h, next(h)].map(|h| surface.positions[origin(&surface.triangles, h) as usize]);
        distance(a, b)
    };
    let (facet, n_facets) = facets(&normals, &across);
    let mut distributions = vec![Normals::default(); n_facets];
    for (&f, &normal) in facet.iter().zip(&normals) {
        distributions[f as usize].add(normal);
    }
    let area: f64 = distributions.iter().map(|d| d.area).sum();
    let borders = (0u32..).zip(&across).filter_map(|(h, &t)| {
        let (a, b) = (facet[h as usize / 3], *facet.get(t as usize / 3)?);
        (h < t && a != b).then(|| (a, b, length(h)))
    });
    let mut merged = Regions::new(distributions, borders);
    merged.merge(&Limits {
        cone: CONE,
        smaller_area: f64::INFINITY,
    });
    merged.merge(&Limits {
        cone: CRUMB_CONE,
        smaller_area: CRUMB * area,
    });
    let label = merged.labels();
    let mut region: Vec<u32> = facet.iter().map(|&f| label[f as usize]).collect();
    smooth_borders(&mut region, &normals, &across, length);
    connected(&region, &across)
}

/// The connected parts of labeled triangles.
fn connected(region: &[u32], across: &[u32]) -> (Vec<u32>, usize) {
    let mut parts = UnionFind::new(region.len());
    for (h, &t) in across.iter().enumerate().filter(|(_, t)| **t != CUT) {
        if region[h / 3] == region[t as usize / 3] {
            parts.unite(h as u32 / 3, t / 3);
        }
    }
    parts.labels()
}
