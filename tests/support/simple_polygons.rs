//! Random simple polygons with exact coordinates, in the plane and in space.

use unwrapd_method::numerics::predicates::orient2d_sign;
use unwrapd_method::numerics::random::Random;

/// A counter-clockwise polygon of points with small integer coordinates.
pub struct SimplePolygon {
    pub plane: Vec<[f64; 2]>,
    /// The same, turned, enlarged and moved without any rounding.
    pub space: Vec<[f32; 3]>,
    /// Lengths in space are so many times those in the plane.
    pub scale: f64,
}

/// Half the side of the square that they lie in.
const SIZE: i64 = 512;

/// A polygon of so many corners, about every sixth in the middle of a straight side.
///
/// Grown from a triangle: a side is replaced by two that lead over a new corner, outward or inward or all the way round, wherever
/// these touch no other side.
pub fn simple_polygon(n_corners: usize, random: &mut Random) -> SimplePolygon {
    let mut corners = loop {
        let [a, b, c] = [0; 3].map(|_| anywhere(random));
        if turn(a, b, c) > 0 {
            break vec![a, b, c];
        }
    };
    while corners.len() < n_corners {
        let k = random.below(corners.len());
        let corner = new_corner(corners[k], corners[(k + 1) % corners.len()], random);
        if corner.is_some_and(|corner| fits(&corners, k, corner)) {
            corners.insert(k + 1, corner.expect("just tested"));
        }
    }
    let plane: Vec<[f64; 2]> = corners.iter().map(|p| p.map(|x| x as f64)).collect();
    if doubled_area(&plane) < 0.0 {
        corners.reverse();
    }
    in_space(&corners, random)
}

type Point = [i64; 2];

fn anywhere(random: &mut Random) -> Point {
    [0; 2].map(|_| random.below(2 * SIZE as usize + 1) as i64 - SIZE)
}

/// The middle of a side, if there is one and chance has it, else a point near it.
fn new_corner(a: Point, b: Point, random: &mut Random) -> Option<Point> {
    let middle = [0, 1].map(|axis| a[axis] + b[axis]);
    if random.below(6) == 0 {
        return middle
            .iter()
            .all(|x| x % 2 == 0)
            .then_some(middle.map(|x| x / 2));
    }
    let reach = (a[0] - b[0]).abs().max((a[1] - b[1]).abs()).max(4);
    let corner = middle.map(|x| x / 2 + random.below(2 * reach as usize + 1) as i64 - reach);
    corner.iter().all(|x| x.abs() <= SIZE).then_some(corner)
}

/// Whether the polygon stays simple with `corner` after the one at `k`.
fn fits(corners: &[Point], k: usize, corner: Point) -> bool {
    let n = corners.len();
    let side = |j: usize| [corners[j % n], corners[(j + 1) % n]];
    let [a, b] = side(k);
    if corner == a || corner == b {
        return false;
    }
    (0..n).filter(|&j| j != k).all(|j| {
        let [p, q] = side(j);
        let meets = |from: Point, shared: bool| {
            if shared {
                // At the common end they may meet, beyond it not.
                let other = if p == from { q } else { p };
                is_on(other, from, corner) || is_on(corner, p, q)
            } else {
                touch(from, corner, p, q)
            }
        };
        !meets(a, p == a || q == a) && !meets(b, p == b || q == b)
    })
}

fn turn(a: Point, b: Point, c: Point) -> i8 {
    orient2d_sign(
        a.map(|x| x as f64),
        b.map(|x| x as f64),
        c.map(|x| x as f64),
    )
}

/// Whether a point lies on a segment.
fn is_on(p: Point, a: Point, b: Point) -> bool {
    let between = |axis: usize| (a[axis].min(b[axis])..=a[axis].max(b[axis])).contains(&p[axis]);
    turn(a, b, p) == 0 && between(0) && between(1)
}

/// Whether two segments have a point in common.
fn touch(a: Point, b: Point, p: Point, q: Point) -> bool {
    let cross = turn(a, b, p) * turn(a, b, q) < 0 && turn(p, q, a) * turn(p, q, b) < 0;
    cross || is_on(p, a, b) || is_on(q, a, b) || is_on(a, p, q) || is_on(b, p, q)
}

/// The polygon with axes of the rotation of an integer quaternion times its norm: everything stays an integer.
fn in_space(corners: &[Point], random: &mut Random) -> SimplePolygon {
    let [a, b, c, d] = loop {
        let quaternion = [0; 4].map(|_| random.below(7) as i64 - 3);
        if quaternion != [0; 4] {
            break quaternion;
        }
    };
    let right = [
        a * a + b * b - c * c - d * d,
        2 * (b * c + a * d),
        2 * (b * d - a * c),
    ];
    let up = [
        2 * (b * c - a * d),
        a * a - b * b + c * c - d * d,
        2 * (c * d + a * b),
    ];
    let origin = [0; 3].map(|_| anywhere(random)[0] * 64);
    let place = |&[x, y]: &Point| {
        [0, 1, 2].map(|axis| (origin[axis] + x * right[axis] + y * up[axis]) as f32)
    };
    SimplePolygon {
        plane: corners.iter().map(|p| p.map(|x| x as f64)).collect(),
        space: corners.iter().map(place).collect(),
        scale: (a * a + b * b + c * c + d * d) as f64,
    }
}

/// Twice the area of a polygon, positive if it turns counter-clockwise; exact for small integers.
pub fn doubled_area(corners: &[[f64; 2]]) -> f64 {
    let following = corners.iter().cycle().skip(1);
    corners
        .iter()
        .zip(following)
        .map(|(p, q)| p[0] * q[1] - p[1] * q[0])
        .sum()
}
