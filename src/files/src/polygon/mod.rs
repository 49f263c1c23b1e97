//! Triangles inside polygons.
//!
//! A polygon of n corners becomes n − 2 triangles between its corners, with its winding. A quad is split by the
//! diagonal that lies inside and folds less; larger polygons get the constrained Delaunay triangulation (`spade`) of
//! their projection onto the plane of their Newell normal, the mean plane of a polygon that is not flat. No vertex is
//! added, and corners in the middle of a straight side are corners of triangles of positive area like all others. A
//! polygon may touch itself, for example if it leads to a hole and back along a bridge: triangles belong to corners,
//! not to positions.
//!
//! A polygon that crosses itself in that projection or has no area has no inside: it becomes the fan of its first
//! corner, which is reported ([`Filling::Fan`]). Nothing here looks beyond one polygon.
mod delaunay;
mod plane;
mod quad;

/// Method by which a polygon became triangles.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Filling {
    /// Triangles that cover its inside once.
    Inside,
    /// The fan of its first corner: it crosses itself or has no area.
    Fan,
}

/// Appends the triangles of a polygon, as indices of its corners; fewer than three corners have no triangles.
///
/// The smallest index of a triangle comes first, and triangles are sorted: a fan keeps its order, and equal corners
/// give equal triangles. A corner at the position of the one before it gets a triangle without area.
pub fn triangulate(corners: &[[f64; 3]], triangles: &mut Vec<[u32; 3]>) -> Filling {
    let n = corners.len();
    if n < 4 {
        triangles.extend((n == 3).then_some([0, 1, 2]));
        return Filling::Inside;
    }
    let start = triangles.len();
    if fill(corners, triangles).is_some() {
        let filled = &mut triangles[start..];
        for triangle in filled.iter_mut() {
            *triangle = smallest_first(*triangle);
        }
        filled.sort_unstable();
        return Filling::Inside;
    }
    triangles.truncate(start);
    triangles.extend((2..n as u32).map(|k| [0, k - 1, k]));
    Filling::Fan
}

/// Rotates a triangle so that it begins at its smallest corner.
pub fn smallest_first([a, b, c]: [u32; 3]) -> [u32; 3] {
    match a.min(b).min(c) {
        first if first == a => [a, b, c],
        first if first == b => [b, c, a],
        _ => [c, a, b],
    }
}

/// Appends the triangles of the inside, in any order; `None` if there is no inside.
fn fill(corners: &[[f64; 3]], triangles: &mut Vec<[u32; 3]>) -> Option<()> {
    let n = corners.len();
    let repeats = |k: usize| corners[k] == corners[(k + n - 1) % n];
    if !(0..n).any(repeats) {
        return fill_distinct(corners, triangles);
    }
    let kept: Vec<u32> = (0..n).filter(|&k| !repeats(k)).map(|k| k as u32).collect();
    let distinct: Vec<[f64; 3]> = kept.iter().map(|&k| corners[k as usize]).collect();
    let start = triangles.len();
    fill_distinct(&distinct, triangles)?;
    for triangle in &mut triangles[start..] {
        *triangle = triangle.map(|k| kept[k as usize]);
    }
    // Ears without area: after each kept corner those that repeat it, up to the next kept one.
    for (&corner, &next) in kept.iter().zip(kept.iter().cycle().skip(1)) {
        let mut repeated = (corner + 1) % n as u32;
        while repeated != next {
            let following = (repeated + 1) % n as u32;
            triangles.push([corner, repeated, following]);
            repeated = following;
        }
    }
    Some(())
}

/// Like [`fill`], for a polygon without sides of length zero.
fn fill_distinct(corners: &[[f64; 3]], triangles: &mut Vec<[u32; 3]>) -> Option<()> {
    match corners {
        [a, b, c, d] => triangles.extend(quad::fill([*a, *b, *c, *d])?),
        [_, _, _, ..] => delaunay::fill(&plane::flattened(corners)?, triangles)?,
        _ => return None,
    }
    Some(())
}
