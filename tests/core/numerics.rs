//! Sparse Cholesky against dense, exact orientation.

use faer::linalg::solvers::Solve;
use faer::{Mat, Side};
use unwrapd::numerics::cholesky::{Cholesky, NotPositiveDefinite, SymmetricPattern};
use unwrapd::numerics::predicates::orient2d_sign;
use unwrapd::numerics::vec2::doubled_area;

/// Lower triangle of the five-point stencil on a `side` × `side` grid.
fn grid_pattern(side: usize) -> SymmetricPattern {
    let n = side * side;
    let mut pattern = SymmetricPattern {
        n,
        col_ptr: vec![0],
        row_idx: Vec::new(),
    };
    for j in 0..n {
        pattern.row_idx.push(j);
        if j % side + 1 < side {
            pattern.row_idx.push(j + 1);
        }
        if j + side < n {
            pattern.row_idx.push(j + side);
        }
        pattern.col_ptr.push(pattern.row_idx.len());
    }
    pattern
}

/// Entries of a symmetric matrix on the pattern: `diagonal` plus something, off the diagonal between −1 and 1.
fn values(pattern: &SymmetricPattern, diagonal: f64) -> Vec<f64> {
    let mut values = Vec::new();
    for j in 0..pattern.n {
        for k in pattern.col_ptr[j]..pattern.col_ptr[j + 1] {
            let wave = (k as f64 * 1.7).sin();
            values.push(if pattern.row_idx[k] == j {
                diagonal + wave
            } else {
                wave
            });
        }
    }
    values
}

fn dense(pattern: &SymmetricPattern, values: &[f64]) -> Mat<f64> {
    let mut a = Mat::zeros(pattern.n, pattern.n);
    for j in 0..pattern.n {
        let column = pattern.col_ptr[j]..pattern.col_ptr[j + 1];
        for (&i, &value) in pattern.row_idx[column.clone()].iter().zip(&values[column]) {
            a[(i, j)] = value;
            a[(j, i)] = value;
        }
    }
    a
}

#[test]
fn sparse_cholesky_agrees_with_dense() {
    for side in [1, 2, 5, 17] {
        let pattern = grid_pattern(side);
        let n = pattern.n;
        let mut cholesky = Cholesky::analyze(&pattern);
        for diagonal in [6.0, 50.0] {
            let values = values(&pattern, diagonal);
            let b: Vec<f64> = (0..3 * n).map(|i| (i as f64).cos()).collect();
            let mut x = b.clone();
            cholesky.factor(&values).unwrap();
            cholesky.solve(&mut x, 3);
            let expected = dense(&pattern, &values)
                .llt(Side::Lower)
                .unwrap()
                .solve(Mat::from_fn(n, 3, |i, j| b[j * n + i]));
            for (i, x) in x.iter().enumerate() {
                assert!((x - expected[(i % n, i / n)]).abs() < 1e-12);
            }
        }
    }
}

#[test]
fn indefinite_and_nan_are_outcomes_and_the_next_matrix_works() {
    let pattern = grid_pattern(9);
    let mut cholesky = Cholesky::analyze(&pattern);
    assert_eq!(
        cholesky.factor(&values(&pattern, -3.0)),
        Err(NotPositiveDefinite)
    );
    let mut spoiled = values(&pattern, 6.0);
    spoiled[40] = f64::NAN;
    assert_eq!(cholesky.factor(&spoiled), Err(NotPositiveDefinite));
    assert_eq!(cholesky.factor(&values(&pattern, 6.0)), Ok(()));
}

#[test]
fn orientation_is_exact_where_rounding_is_not() {
    // Shewchuk's example: points within a few last places of the line y = x, where the rounded determinant errs.
    let (b, c) = ([12.0, 12.0], [24.0, 24.0]);
    let last_place = f64::EPSILON / 2.0;
    let mut rounded_wrong = 0;
    for i in 0..16_i32 {
        for j in 0..16_i32 {
            let a = [
                0.5 + f64::from(i) * last_place,
                0.5 + f64::from(j) * last_place,
            ];
            let expected = (j - i).signum();
            assert_eq!(i32::from(orient2d_sign(b, c, a)), expected);
            rounded_wrong += i32::from((doubled_area(a, b, c) > 0.0) != (expected > 0));
        }
    }
    assert!(rounded_wrong > 0, "the example no longer shows rounding");
    assert_eq!(orient2d_sign([f64::NAN, 0.0], b, [1.0, 2.0]), 0);
}
