//! The planes in which a surface is its own mirror image to the last vertex.

use super::cloud::points_over;
use super::plane::MirrorPlane;
use super::search::{
    EXACT, FITTING, IN_PLANE, ROUNDS, corners_of, every, fitted, promising, vertices,
};
use unwrapd_maps::mesh::Surface;
use unwrapd_method::numerics::point_tree::PointTree;
use unwrapd_method::numerics::vec3::{distance, dot};

/// Points of the cloud that candidates are judged by: they are fitted to vertices, and that decides.
const CLOUD: usize = 2_000;

/// Planes at most.
const MOST: usize = 4;

/// The cosine of the angle between normals above which two planes through one center are the same.
const SAME: f64 = 0.9999;

/// Planes in which every vertex has a mirror image, each once, the likeliest first.
///
/// The candidates are those of [`mirror_plane`](super::search::mirror_plane). O(n log n).
pub fn exact_mirror_planes(surface: &Surface) -> Vec<MirrorPlane> {
    let cloud = points_over(surface, CLOUD);
    let Some([low, high]) = corners_of(&cloud) else {
        return Vec::new();
    };
    let diagonal = distance(low, high);
    let cloud = PointTree::new(cloud);
    let vertices = vertices(surface);
    let sample = every(vertices.points(), FITTING);
    let is_mirrored = |plane: &MirrorPlane, p: [f64; 3]| {
        let image = plane.mirrored(p);
        vertices
            .nearest(image, EXACT * diagonal, |_| true)
            .is_some()
    };
    let mut planes: Vec<MirrorPlane> = Vec::new();
    for candidate in promising(&cloud, diagonal) {
        if planes.len() == MOST || is_among(&candidate, &planes) {
            continue;
        }
        let plane = fitted(candidate, &sample, &vertices, ROUNDS);
        let is_exact = sample.iter().all(|&p| is_mirrored(&plane, p))
            && vertices.points().iter().all(|&p| is_mirrored(&plane, p));
        if is_exact && !is_among(&plane, &planes) && mirrors_some(&plane, &cloud, diagonal) {
            planes.push(plane);
        }
    }
    planes
}

fn is_among(plane: &MirrorPlane, others: &[MirrorPlane]) -> bool {
    let is_same = |other: &MirrorPlane| dot(plane.normal, other.normal).abs() > SAME;
    others.iter().any(is_same)
}

/// Whether most of the surface does not lie in the plane.
fn mirrors_some(plane: &MirrorPlane, cloud: &PointTree, diagonal: f64) -> bool {
    let is_off = |p: &&[f64; 3]| plane.height(**p).abs() > IN_PLANE * diagonal;
    2 * cloud.points().iter().filter(is_off).count() > cloud.points().len()
}
