//! Sparse Cholesky: against dense, against faer's, on any pattern, with any number of threads.

use faer::linalg::solvers::Solve;
use faer::sparse::{SparseColMat, Triplet};
use faer::{Mat, Side};
use proptest::prelude::*;
use rayon::ThreadPoolBuilder;
use unwrapd_method::numerics::cholesky::{Cholesky, NotPositiveDefinite, SymmetricPattern};
use unwrapd_method::numerics::linear_solver::{LinearSolver, MOST_BYTES};

/// The lower triangle of a matrix of full `block`×`block` blocks, for vertices and pairs of them.
fn pattern(n_vertices: usize, block: usize, mut pairs: Vec<(usize, usize)>) -> SymmetricPattern {
    pairs.sort_unstable();
    pairs.dedup();
    let mut pattern = SymmetricPattern {
        n: block * n_vertices,
        col_ptr: vec![0],
        row_idx: Vec::new(),
    };
    for column in 0..block * n_vertices {
        let v = column / block;
        let from = pairs.partition_point(|&(small, _)| small < v);
        let larger = pairs[from..].iter().take_while(|&&(small, _)| small == v);
        let below = larger.flat_map(|&(_, large)| block * large..block * (large + 1));
        pattern
            .row_idx
            .extend((column..block * (v + 1)).chain(below));
        pattern.col_ptr.push(pattern.row_idx.len());
    }
    pattern
}

/// Vertices on a grid in space, each coupled to the next in the three directions.
fn grid([x, y, z]: [usize; 3], block: usize) -> SymmetricPattern {
    let index = |i, j, k| i + x * (j + y * k);
    let mut pairs = Vec::new();
    for (k, j, i) in (0..z).flat_map(|k| (0..y).flat_map(move |j| (0..x).map(move |i| (k, j, i)))) {
        pairs.extend((i + 1 < x).then(|| (index(i, j, k), index(i + 1, j, k))));
        pairs.extend((j + 1 < y).then(|| (index(i, j, k), index(i, j + 1, k))));
        pairs.extend((k + 1 < z).then(|| (index(i, j, k), index(i, j, k + 1))));
    }
    pattern(x * y * z, block, pairs)
}

/// Entries between −1 and 1, and on the diagonal `diagonal` more.
fn values(pattern: &SymmetricPattern, diagonal: f64) -> Vec<f64> {
    entries(pattern)
        .enumerate()
        .map(|(k, (row, column))| {
            let wave = (k as f64 * 1.7).sin();
            if row == column { diagonal + wave } else { wave }
        })
        .collect()
}

/// Row and column of every stored entry.
fn entries(pattern: &SymmetricPattern) -> impl Iterator<Item = (usize, usize)> {
    let columns =
        (0..pattern.n).flat_map(|j| (pattern.col_ptr[j]..pattern.col_ptr[j + 1]).map(move |_| j));
    pattern.row_idx.iter().copied().zip(columns)
}

fn right_sides(n: usize, n_rhs: usize) -> Vec<f64> {
    (0..n * n_rhs).map(|i| (i as f64).cos()).collect()
}

/// The greatest entry of Ax − b.
fn residual(pattern: &SymmetricPattern, values: &[f64], x: &[f64], b: &[f64]) -> f64 {
    let mut rest = b.to_vec();
    for ((i, j), value) in entries(pattern).zip(values) {
        rest[i] -= value * x[j];
        if i != j {
            rest[j] -= value * x[i];
        }
    }
    rest.into_iter().map(f64::abs).fold(0.0, f64::max)
}

#[test]
fn small_grids_agree_with_dense() {
    for side in [1, 2, 5, 17] {
        let pattern = grid([side, side, 1], 1);
        let n = pattern.n;
        let mut cholesky = Cholesky::analyze(&pattern, 1);
        for diagonal in [6.0, 50.0] {
            let values = values(&pattern, diagonal);
            let b = right_sides(n, 3);
            let mut x = b.clone();
            cholesky.factor(&values).unwrap();
            cholesky.solve(&mut x, 3);
            let mut dense = Mat::zeros(n, n);
            for ((i, j), &value) in entries(&pattern).zip(&values) {
                dense[(i, j)] = value;
            }
            let b = Mat::from_fn(n, 3, |i, j| b[j * n + i]);
            let expected = dense.llt(Side::Lower).unwrap().solve(b);
            for (i, x) in x.iter().enumerate() {
                assert!((x - expected[(i % n, i / n)]).abs() < 1e-12);
            }
        }
    }
}

/// Fronts of hundreds of rows: every kernel is used.
#[test]
fn solids_agree_with_another_sparse_cholesky() {
    for (sides, block) in [([9, 9, 9], 3), ([40, 30, 2], 2), ([14, 14, 14], 1)] {
        let pattern = grid(sides, block);
        let values = values(&pattern, 25.0);
        let b = right_sides(pattern.n, 1);
        let mut x = b.clone();
        let mut cholesky = Cholesky::analyze(&pattern, block);
        cholesky.factor(&values).unwrap();
        cholesky.solve(&mut x, 1);
        let triplets: Vec<_> = (entries(&pattern).zip(&values))
            .map(|((i, j), &value)| Triplet::new(i, j, value))
            .collect();
        let matrix =
            SparseColMat::<usize, f64>::try_new_from_triplets(pattern.n, pattern.n, &triplets)
                .unwrap();
        let expected =
            matrix
                .sp_cholesky(Side::Lower)
                .unwrap()
                .solve(Mat::from_fn(pattern.n, 1, |i, _| b[i]));
        for (i, x) in x.iter().enumerate() {
            assert!((x - expected[(i, 0)]).abs() < 1e-12);
        }
    }
}

#[test]
fn beyond_the_memory_allowed_conjugate_gradients_take_over() {
    let pattern = grid([9, 9, 9], 3);
    let solved = |most_bytes, diagonal| {
        let values = values(&pattern, diagonal);
        let mut solver = LinearSolver::within(&pattern, 3, most_bytes);
        let mut x = right_sides(pattern.n, 1);
        let outcome =
            (solver.prepare(&values)).and_then(|()| solver.solve(&pattern, &values, &mut x));
        (
            matches!(solver, LinearSolver::Direct(_)),
            outcome.map(|()| x),
        )
    };
    let (is_direct, exact) = solved(MOST_BYTES, 12.0);
    assert!(is_direct);
    let (is_direct, near) = solved(0, 12.0);
    assert!(!is_direct);
    let (exact, near) = (exact.expect("definite"), near.expect("definite"));
    for (near, exact) in near.iter().zip(&exact) {
        assert!((near - exact).abs() < 1e-3 * exact.abs().max(0.1));
    }
    for most_bytes in [0, MOST_BYTES] {
        assert_eq!(solved(most_bytes, -12.0).1, Err(NotPositiveDefinite));
        assert_eq!(solved(most_bytes, 2.0).1, Err(NotPositiveDefinite));
    }
}

#[test]
fn threads_do_not_change_a_bit() {
    let pattern = grid([13, 13, 13], 3);
    let values = values(&pattern, 25.0);
    let solution = |n_threads| {
        let pool = ThreadPoolBuilder::new()
            .num_threads(n_threads)
            .build()
            .unwrap();
        pool.install(|| {
            let mut cholesky = Cholesky::analyze(&pattern, 3);
            let mut x = right_sides(pattern.n, 1);
            cholesky.factor(&values).unwrap();
            cholesky.solve(&mut x, 1);
            x
        })
    };
    let alone = solution(1);
    assert!(residual(&pattern, &values, &alone, &right_sides(pattern.n, 1)) < 1e-12);
    for n_threads in [2, 3] {
        assert!(solution(n_threads) == alone, "{n_threads} threads");
    }
}

#[test]
fn indefinite_and_nan_are_outcomes_and_the_next_matrix_works() {
    let pattern = grid([9, 9, 1], 1);
    let mut cholesky = Cholesky::analyze(&pattern, 1);
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
fn a_matrix_without_rows_has_a_factor() {
    let pattern = pattern(0, 2, Vec::new());
    let mut cholesky = Cholesky::analyze(&pattern, 2);
    assert_eq!(cholesky.factor(&[]), Ok(()));
    cholesky.solve(&mut [], 1);
}

proptest! {
    /// Also patterns that fall apart, stars and cliques.
    #[test]
    fn any_pattern_is_solved(
        block in 1_usize..=3,
        n_vertices in 1_usize..40,
        pairs in prop::collection::vec((0_usize..40, 0_usize..40), 0..150),
    ) {
        let pairs = pairs.into_iter()
            .map(|(a, b)| (a.min(b), a.max(b)))
            .filter(|&(small, large)| small < large && large < n_vertices)
            .collect();
        let pattern = pattern(n_vertices, block, pairs);
        // More than a row's other entries together.
        let values = values(&pattern, (block * n_vertices) as f64 + 2.0);
        let b = right_sides(pattern.n, 2);
        let mut x = b.clone();
        let mut cholesky = Cholesky::analyze(&pattern, block);
        prop_assert_eq!(cholesky.factor(&values), Ok(()));
        cholesky.solve(&mut x, 2);
        let n = pattern.n;
        for k in 0..2 {
            prop_assert!(residual(&pattern, &values, &x[k * n..][..n], &b[k * n..][..n]) < 1e-12);
        }
    }
}
