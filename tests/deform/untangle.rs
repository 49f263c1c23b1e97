//! Supplied starts with inversions: untangled with little moved, or refused.

use unwrapd_deform::{Body, Handle, Model, Problem};
use unwrapd_method::solver::{Control, Iterate, Settings};

use crate::bodies::{block, sheet};

const SIDE: u32 = 20;

fn problem(body: Body) -> Problem {
    let to = body.rest[..body.dim()].to_vec();
    let handle = Handle::Vertex {
        vertex: 0,
        to,
        weight: None,
    };
    Problem::new(body, &[handle], &Model::default()).expect("a problem")
}

fn n_inverted(problem: &Problem) -> usize {
    let determinants = problem.body.determinants_at(&problem.start);
    determinants.iter().filter(|&&d| d <= 0.0).count()
}

/// Numbers between −1 and 1.
fn noise(i: usize) -> f64 {
    2.0 * (43_758.545 * (12.9898 * (i + 1) as f64).sin()).rem_euclid(1.0) - 1.0
}

#[test]
fn a_tangled_start_is_untangled_where_it_is() {
    let mut problem = problem(Body::from(&sheet(SIDE)));
    // All but the corners of a 5 × 5 patch far from the boundary are thrown about.
    for j in 8..12 {
        for i in 8..12 {
            let v = (j * (SIDE + 1) + i) as usize;
            problem.start[2 * v] += 2.5 * noise(2 * v);
            problem.start[2 * v + 1] += 2.5 * noise(2 * v + 1);
        }
    }
    let before = problem.start.clone();
    let n_before = n_inverted(&problem);
    assert!(n_before > 5, "{n_before}");
    problem.untangle_start().expect("a start near by");
    assert_eq!((n_inverted(&problem), problem.untangled), (0, n_before));
    let moved = (problem.start.chunks(2).zip(before.chunks(2)))
        .filter(|(now, before)| now != before)
        .count();
    assert!(moved <= 121, "{moved} of 441 vertices moved");
    let solution = problem
        .solve(&Settings::follow(), &|_: &Iterate| Control::Continue)
        .expect("a problem of the plane");
    assert_eq!(solution.quality.inverted, 0);
}

#[test]
fn a_whole_sheet_and_a_block_thrown_about_are_untangled() {
    for body in [Body::from(&sheet(SIDE)), Body::from(&block(4))] {
        let mut problem = problem(body);
        for (i, x) in problem.start.iter_mut().enumerate() {
            *x += 0.9 * noise(i);
        }
        let n_before = n_inverted(&problem);
        assert!(n_before > 50, "{n_before}");
        problem.untangle_start().expect("a start");
        assert_eq!((n_inverted(&problem), problem.untangled), (0, n_before));
    }
}

#[test]
fn a_valid_start_stays_bit_by_bit() {
    let mut problem = problem(Body::from(&block(4)));
    for (i, x) in problem.start.iter_mut().enumerate() {
        *x += 0.05 * noise(i);
    }
    let before = problem.start.clone();
    problem.untangle_start().expect("a valid start");
    assert_eq!((problem.start, problem.untangled), (before, 0));
}

#[test]
fn what_is_no_start_is_refused() {
    let mut problem = problem(Body::from(&sheet(SIDE)));
    problem.start[100] = f64::NAN;
    let error = problem.untangle_start().expect_err("no position");
    assert_eq!(error.code(), "infeasible_start");
}

mod shared {
    use crate::places;

    /// The file counts vertices from 0, which the format does not: read as the format has it half of its elements are inverted.
    #[test]
    #[ignore = "needs ../shared"]
    fn a_file_that_counts_from_zero_is_refused() {
        let path = places::shared("data/tet/gargoyle_inverted.mesh");
        let text = std::fs::read_to_string(path).expect("a file");
        let error = unwrapd_files::io::medit::read(text.as_bytes()).expect_err("counted from 0");
        assert_eq!(error.code(), "index_out_of_range");
        // The same counted from 1, as the format has it.
        let numbers = |line: &str| -> Option<Vec<i64>> {
            line.split_whitespace()
                .map(|word| word.parse().ok())
                .collect()
        };
        let line = |line: &str| match numbers(line).as_deref() {
            Some([corners @ .., mark]) if corners.len() == 4 => {
                let corners: Vec<String> = corners.iter().map(|v| (v + 1).to_string()).collect();
                format!("{} {mark}\n", corners.join(" "))
            }
            _ => format!("{line}\n"),
        };
        let counted: String = text.lines().map(line).collect();
        let elements = unwrapd_files::io::medit::read(counted.as_bytes()).expect("a mesh");
        let mesh = elements.into_tet_mesh().expect("a sound mesh");
        assert_eq!(mesh.reoriented(), 0);
    }
}
