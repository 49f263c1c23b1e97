//! The mirror plane of a surface.

use super::cloud::points_over;
use super::plane::MirrorPlane;
use unwrapd_maps::mesh::{Surface, UsedVertices};
use unwrapd_method::numerics::bounds::bounds_of;
use unwrapd_method::numerics::point_tree::PointTree;
use unwrapd_method::numerics::symmetric::eigen;
use unwrapd_method::numerics::vec3::{cross, distance, dot, norm, sub};

/// Points of the cloud, and those of them that are mirrored to judge a candidate, to fit it and to accept it.
const CLOUD: usize = 20_000;
const JUDGING: usize = 150;
const FITTING: usize = 400;
const ACCEPTING: usize = 1_000;

/// Times that a plane is fitted to new pairs at most, and the change of its normal, and of its place as a share of the diagonal, below
/// which it is settled.
const ROUNDS: usize = 10;
const SETTLED: f64 = 1e-4;

/// Factor of a known distance within which a nearest point is searched for. It exceeds 1 by more than rounding.
const BEYOND: f64 = 1.0 + 1e-9;

/// Vertices that are mirrored to fit a plane to the vertices.
const VERTICES: usize = 1_000;

/// Directions that are tried around an axis about which the surface has equal moments.
const AROUND: usize = 12;

/// Moments are equal if they differ by less than this share.
const EQUAL_MOMENTS: f64 = 0.1;

/// A candidate is followed up if this share of its points comes to lie within that part of the diagonal of the surface
/// on the average.
const SHARE_JUDGED: f64 = 0.8;
const PROMISING: f64 = 0.04;

/// Candidates that are followed up at most.
const FOLLOWED: usize = 3;

/// A surface is symmetric if this share of its area is mirrored to within that part of the diagonal of itself.
const ACCEPTED: f64 = 0.95;
const NEAR: f64 = 0.01;

/// A vertex has a mirror image if there is a vertex within this part of the diagonal.
const EXACT: f64 = 1e-4;

/// A plane in which half of the surface lies mirrors nothing.
const IN_PLANE: f64 = 0.0025;

/// The plane in which a surface is its own mirror image, exactly or nearly; the best if there are several.
///
/// The normal of such a plane is a principal axis of the area. Those axes, the coordinate axes and, where two moments are
/// equal, directions around the third are candidates; each is fitted to nearest pairs of points and mirror images again and again,
/// at last to pairs of vertices. O(n log n).
///
/// From: Zabrodsky, Peleg, Avnir 1995, Symmetry as a Continuous Feature; the fit is that of Besl and McKay 1992 for a reflection.
pub fn mirror_plane(surface: &Surface) -> Option<MirrorPlane> {
    let cloud = points_over(surface, CLOUD);
    let [low, high] = corners_of(&cloud)?;
    let diagonal = distance(low, high);
    let cloud = PointTree::new(cloud);
    let [fitting, accepting] = [FITTING, ACCEPTING].map(|n| every(cloud.points(), n));
    let candidates = promising(&cloud, diagonal).into_iter();
    let fitted = candidates.filter_map(|plane| {
        let plane = fitted(plane, &fitting, &cloud, diagonal);
        let distances = distances(&plane, &accepting, &cloud);
        let is_accepted = is_accepted(&plane, &accepting, &distances, diagonal);
        let mismatch = mismatch(distances.into_iter(), f64::INFINITY)?;
        is_accepted.then_some((mismatch, plane))
    });
    let (_, plane) = fitted.min_by(|a, b| a.0.total_cmp(&b.0))?;
    Some(sharpened(plane, surface, diagonal))
}

/// The plane fitted to the vertices if more of them have a mirror image then.
fn sharpened(plane: MirrorPlane, surface: &Surface, diagonal: f64) -> MirrorPlane {
    let vertices = vertices(surface);
    let sample = every(vertices.points(), VERTICES);
    let n_mirrored = |plane: &MirrorPlane| {
        let is_mirrored = |p: &&[f64; 3]| {
            let image = plane.mirrored(**p);
            vertices
                .nearest(image, EXACT * diagonal, |_| true)
                .is_some()
        };
        sample.iter().filter(is_mirrored).count()
    };
    let sharper = fitted(plane, &sample, &vertices, diagonal);
    if n_mirrored(&sharper) > n_mirrored(&plane) {
        sharper
    } else {
        plane
    }
}

/// The vertices of faces.
fn vertices(surface: &Surface) -> PointTree {
    let corners = surface.triangles.as_flattened().iter().copied();
    let used = UsedVertices::new(corners).into_vec().into_iter();
    PointTree::new(used.map(|v| surface.positions[v as usize]).collect())
}

/// Returns the [likeliest](FOLLOWED) planes through the center of the points in which the cloud may be its own mirror image, the
/// likeliest first.
fn promising(cloud: &PointTree, diagonal: f64) -> Vec<MirrorPlane> {
    let judging = every(cloud.points(), JUDGING);
    let mut best: Vec<(f64, MirrorPlane)> = Vec::with_capacity(FOLLOWED + 1);
    for plane in candidates(cloud.points()) {
        let limit = (best.get(FOLLOWED - 1)).map_or(PROMISING * diagonal, |(worst, _)| *worst);
        let distances = judging.iter().map(|&p| image_in(&plane, p, cloud).1);
        if let Some(mismatch) = mismatch(distances, limit) {
            let place = best.partition_point(|(other, _)| *other <= mismatch);
            best.insert(place, (mismatch, plane));
            best.truncate(FOLLOWED);
        }
    }
    best.into_iter().map(|(_, plane)| plane).collect()
}

/// Planes through the center of the points.
fn candidates(points: &[[f64; 3]]) -> Vec<MirrorPlane> {
    let n = points.len() as f64;
    let mut center = [0.0; 3];
    for p in points {
        center = [0, 1, 2].map(|k| center[k] + p[k] / n);
    }
    let mut moments = [[0.0; 3]; 3];
    for p in points {
        let d = sub(*p, center);
        for (row, x) in moments.iter_mut().zip(d) {
            *row = [0, 1, 2].map(|k| row[k] + x * d[k]);
        }
    }
    let (of_axis, axes) = eigen(&moments);
    let mut normals = vec![[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    normals.extend(axes);
    for k in 0..3 {
        let (a, b) = (of_axis[(k + 1) % 3], of_axis[(k + 2) % 3]);
        if (a - b).abs() < EQUAL_MOMENTS * a.max(b) {
            let first = axes[(k + 1) % 3];
            let second = cross(axes[k], first);
            normals.extend((0..AROUND).map(|i| {
                let (sin, cos) = (std::f64::consts::PI * i as f64 / AROUND as f64).sin_cos();
                [0, 1, 2].map(|k| cos * first[k] + sin * second[k])
            }));
        }
    }
    normals
        .into_iter()
        .map(|normal| MirrorPlane::through(center, normal))
        .collect()
}

/// The distances of the mirror images of points from a cloud.
fn distances(plane: &MirrorPlane, points: &[[f64; 3]], cloud: &PointTree) -> Vec<f64> {
    let points = points.iter();
    points.map(|&p| image_in(plane, p, cloud).1).collect()
}

/// Returns the mean of the distances without the farthest ones; `None` if it is not below a limit. Takes no more distances once
/// that is certain.
fn mismatch(distances: impl ExactSizeIterator<Item = f64>, limit: f64) -> Option<f64> {
    let n_kept = ((SHARE_JUDGED * distances.len() as f64) as usize).max(1);
    let n_left_out = distances.len().saturating_sub(n_kept);
    let mut sum = 0.0;
    // The farthest distances so far, in ascending order. Those that are no longer among them count.
    let mut farthest = Vec::with_capacity(n_left_out + 1);
    for distance in distances {
        let place = farthest.partition_point(|other| *other < distance);
        farthest.insert(place, distance);
        if farthest.len() > n_left_out {
            sum += farthest.remove(0);
            if sum >= limit * n_kept as f64 {
                return None;
            }
        }
    }
    (sum < limit * n_kept as f64).then(|| sum / n_kept as f64)
}

/// The point of a cloud nearest to the mirror image of a point, and how far they are apart.
fn image_in(plane: &MirrorPlane, p: [f64; 3], cloud: &PointTree) -> ([f64; 3], f64) {
    let nearest = cloud.nearest(plane.mirrored(p), f64::INFINITY, |_| true);
    let (v, distance) = nearest.unwrap_or((0, f64::INFINITY));
    (cloud.points()[v as usize], distance)
}

/// Returns whether the mirror images of enough points lie near the surface, and enough of the points lie off the plane. The distances are
/// those of the mirror images from the surface.
fn is_accepted(plane: &MirrorPlane, points: &[[f64; 3]], distances: &[f64], diagonal: f64) -> bool {
    let n_near = distances.iter().filter(|&&it| it < NEAR * diagonal).count();
    let is_off = |p: &&[f64; 3]| plane.height(**p).abs() > IN_PLANE * diagonal;
    let n_off = points.iter().filter(is_off).count();
    n_near as f64 >= ACCEPTED * points.len() as f64 && 2 * n_off > points.len()
}

/// The plane that fits the pairs of points and nearest mirror images best, found again and again.
///
/// ```text
/// Σ |y − mirrored(x)|² is least for the plane through c = mean (x + y) / 2
/// whose normal is the eigenvector of Σ (x − c)(y − c)ᵀ + (y − c)(x − c)ᵀ for the least eigenvalue
/// ```
fn fitted(
    mut plane: MirrorPlane,
    points: &[[f64; 3]],
    cloud: &PointTree,
    diagonal: f64,
) -> MirrorPlane {
    // The image found in the last round is near the next one, so its distance bounds the search.
    let mut images: Vec<Option<[f64; 3]>> = vec![None; points.len()];
    for _ in 0..ROUNDS {
        let mut pairs: Vec<([f64; 3], [f64; 3], f64)> = (points.iter().zip(&mut images))
            .map(|(&p, last)| {
                let mirrored = plane.mirrored(p);
                let reach = last.map_or(f64::INFINITY, |image| BEYOND * distance(mirrored, image));
                let nearest = cloud.nearest(mirrored, reach, |_| true);
                let image = nearest.map(|(v, _)| cloud.points()[v as usize]).or(*last);
                *last = image;
                let image = image.unwrap_or(mirrored);
                (p, image, distance(mirrored, image))
            })
            .collect();
        // Of what has no mirror image the worst tenth is left out.
        pairs.sort_by(|a, b| a.2.total_cmp(&b.2));
        pairs.truncate((pairs.len() * 9).div_ceil(10));
        let Some(next) = best_plane(&pairs, plane.normal) else {
            break;
        };
        let is_settled = norm(sub(next.normal, plane.normal)) < SETTLED
            && (next.offset - plane.offset).abs() < SETTLED * diagonal;
        plane = next;
        if is_settled {
            break;
        }
    }
    plane
}

fn best_plane(pairs: &[([f64; 3], [f64; 3], f64)], normal: [f64; 3]) -> Option<MirrorPlane> {
    let n = pairs.len() as f64;
    let mut center = [0.0; 3];
    for (x, y, _) in pairs {
        center = [0, 1, 2].map(|k| center[k] + (x[k] + y[k]) / (2.0 * n));
    }
    let mut moments = [[0.0; 3]; 3];
    for (x, y, _) in pairs {
        let (x, y) = (sub(*x, center), sub(*y, center));
        for (k, row) in moments.iter_mut().enumerate() {
            *row = [0, 1, 2].map(|l| row[l] + x[k] * y[l] + y[k] * x[l]);
        }
    }
    let (values, vectors) = eigen(&moments);
    let least = (0..3).min_by(|&a, &b| values[a].total_cmp(&values[b]))?;
    let sign = dot(vectors[least], normal).signum();
    let best = MirrorPlane::through(center, vectors[least].map(|x| sign * x));
    best.offset.is_finite().then_some(best)
}

/// About so many of the points, evenly.
fn every(points: &[[f64; 3]], n: usize) -> Vec<[f64; 3]> {
    points
        .iter()
        .copied()
        .step_by(points.len().div_ceil(n).max(1))
        .collect()
}

fn corners_of(points: &[[f64; 3]]) -> Option<[[f64; 3]; 2]> {
    (!points.is_empty()).then(|| bounds_of(points))
}
