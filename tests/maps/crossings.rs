//! Triangles that pass through each other, against rational arithmetic.

use unwrapd_maps::certificate::crossings;

/// Cross and dot products of integers.
fn normal(t: &[[i64; 3]; 3]) -> [i64; 3] {
    let [u, v] = [1, 2].map(|k| [0, 1, 2].map(|x| t[k][x] - t[0][x]));
    [
        u[1] * v[2] - u[2] * v[1],
        u[2] * v[0] - u[0] * v[2],
        u[0] * v[1] - u[1] * v[0],
    ]
}

fn dot(a: [i64; 3], b: [i64; 3]) -> i64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The interval of the line of two planes inside `t`, as fractions of a coordinate along `axis`.
fn interval(t: &[[i64; 3]; 3], n: [i64; 3], origin: [i64; 3], axis: usize) -> Vec<(i64, i64)> {
    let height = t.map(|p| dot(n, [0, 1, 2].map(|x| p[x] - origin[x])));
    let mut ends = Vec::new();
    for (i, j) in [(0, 1), (1, 2), (2, 0)] {
        let (h, g) = (height[i], height[j]);
        if (h < 0) != (g < 0) || h == 0 || g == 0 {
            let denominator = h - g;
            if denominator != 0 {
                let numerator = h * t[j][axis] - g * t[i][axis];
                ends.push((numerator * denominator.signum(), denominator.abs()));
            }
        }
    }
    ends.sort_by(|a, b| (a.0 * b.1).cmp(&(b.0 * a.1)));
    ends
}

/// The same question answered in rational numbers, for triangles that are not coplanar.
fn cross_rational(a: &[[i64; 3]; 3], b: &[[i64; 3]; 3]) -> Option<bool> {
    let (na, nb) = (normal(a), normal(b));
    let line = normal(&[[0; 3], na, nb]);
    let axis = (0..3).find(|&x| line[x] != 0)?;
    let straddles = |t: &[[i64; 3]; 3], n, o: [i64; 3]| {
        let h = t.map(|p| dot(n, [0, 1, 2].map(|x| p[x] - o[x])));
        h.iter().any(|&x| x > 0) && h.iter().any(|&x| x < 0)
    };
    if !straddles(a, nb, b[0]) || !straddles(b, na, a[0]) {
        return Some(false);
    }
    let (ia, ib) = (interval(a, nb, b[0], axis), interval(b, na, a[0], axis));
    let less = |x: &(i64, i64), y: &(i64, i64)| x.0 * y.1 < y.0 * x.1;
    let ends = |i: &[(i64, i64)]| Some((*i.first()?, *i.last()?));
    let ((a0, a1), (b0, b1)) = (ends(&ia)?, ends(&ib)?);
    Some(less(&a0, &b1) && less(&b0, &a1))
}

#[test]
fn crossing_agrees_with_rational_numbers() {
    let mut state = 1_u64;
    let mut random = |n: i64| {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as i64 % n
    };
    let mut counts = [0; 2];
    for round in 0..200_000 {
        // Few coordinates, so that edges meet and corners are shared often.
        let n = if round % 2 == 0 { 4 } else { 50 };
        let mut triangle = || [(); 3].map(|()| [(); 3].map(|()| random(n)));
        let (a, b) = (triangle(), triangle());
        let Some(expected) = cross_rational(&a, &b) else {
            continue;
        };
        let [p, q] = [a, b].map(|t| t.map(|p| p.map(|x| x as f64)));
        for corners in [[p, q], [q, p]] {
            let found = crossings(corners.as_flattened(), &[[0, 1, 2], [3, 4, 5]]);
            assert_eq!(found.pairs, u64::from(expected), "{a:?} {b:?}");
        }
        counts[usize::from(expected)] += 1;
    }
    assert!(counts[0] > 10_000 && counts[1] > 10_000, "{counts:?}");
}

#[test]
fn crossing_triangles_are_counted_but_not_those_that_touch() {
    let positions = [
        [0.0, 0.0, 0.0],
        [4.0, 0.0, 0.0],
        [0.0, 4.0, 0.0],
        // Passes through the first.
        [1.0, 1.0, -1.0],
        [1.0, 1.0, 1.0],
        [5.0, 5.0, 0.0],
        // Stands on it.
        [0.5, 1.0, 0.0],
        [0.5, 2.0, 1.0],
        [0.5, 0.5, 1.0],
        // Lies in its plane, with a common corner.
        [3.0, 0.1, 0.0],
        [0.1, 3.0, 0.0],
    ];
    let pairs = |triangles: &[[u32; 3]]| crossings(&positions, triangles).pairs;
    assert_eq!(pairs(&[[0, 1, 2], [3, 4, 5]]), 1);
    assert_eq!(pairs(&[[0, 1, 2], [6, 7, 8]]), 0);
    assert_eq!(
        pairs(&[[0, 1, 2], [0, 3, 4]]),
        1,
        "a common vertex, but they cross elsewhere"
    );
    assert_eq!(pairs(&[[0, 1, 2], [0, 1, 4]]), 0, "a common edge");
    assert_eq!(pairs(&[[0, 1, 2], [0, 9, 10]]), 1, "coplanar");
    assert_eq!(pairs(&[[0, 1, 2], [3, 4, 4]]), 0, "no area");
    assert_eq!(pairs(&[[0, 1, 2], [3, 4, 99]]), 0, "not there");
    let found = crossings(&positions, &[[6, 7, 8], [0, 1, 2], [3, 4, 5]]);
    assert_eq!((found.named.len(), found.truncated), (1, false));
    assert!(found.named[0] == [1, 2] || found.named[0] == [2, 1]);
}
