//! Joints that are the mirror images of others.

use super::joints::Joint;
use crate::charts::symmetry::plane::MirrorPlane;
use unwrapd_method::numerics::point_tree::PointTree;
use unwrapd_method::numerics::vec3::distance;

/// How far the mirror image of a joint may lie from another, and what their lengths may differ by, as a
/// part of its length.
const NEAR: f64 = 0.02;

/// For each joint the other that is its mirror image in a plane. O(n log n).
pub fn images(joints: &[Joint], plane: &MirrorPlane) -> Vec<Option<usize>> {
    let middle = |joint: &Joint| {
        let [a, b] = joint.ends;
        [0, 1, 2].map(|k| f64::midpoint(a[k], b[k]))
    };
    let length = |joint: &Joint| distance(joint.ends[0], joint.ends[1]);
    let middles = PointTree::new(joints.iter().map(middle).collect());
    let image = |joint: &Joint| {
        let reach = NEAR * length(joint);
        let is_as_long = |i: u32| (length(&joints[i as usize]) - length(joint)).abs() < reach;
        let place = plane.mirrored(middle(joint));
        let (i, _) = middles.nearest(place, reach, is_as_long)?;
        Some(i as usize)
    };
    let images: Vec<Option<usize>> = joints.iter().map(image).collect();
    let is_mutual = |(i, image): (usize, &Option<usize>)| {
        image.filter(|&image| image != i && images[image] == Some(i))
    };
    images.iter().enumerate().map(is_mutual).collect()
}
