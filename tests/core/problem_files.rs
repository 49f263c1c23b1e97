//! Problem files: what they may say, and that the function which they define is what is minimized.

use std::path::{Path, PathBuf};

use unwrapd::deform::{Problem, ProblemFile};
use unwrapd::mesh::io::ElementFormat;
use unwrapd::solver::{Control, Iterate, Objective, Settings};

const TRIANGLE: &str = "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";

fn problem(json: &str) -> Result<Problem, String> {
    let mesh = ElementFormat::Off
        .read(TRIANGLE.as_bytes())
        .expect("a mesh");
    let file = ProblemFile::parse(json.as_bytes()).map_err(|error| error.code().to_owned())?;
    file.with(mesh, None)
        .map_err(|error| error.code().to_owned())
}

fn with(rest: &str) -> String {
    format!(r#"{{"mesh": "m.off", "energy": "arap", "barrier": "spline", {rest}}}"#)
}

#[test]
fn bad_problems_have_names() {
    let good = r#""handles": [0, 2], "targets": [[0, 0], [2, 1]]"#;
    assert!(problem(&with(good)).is_ok());
    for (rest, code) in [
        (r#""handles": [0, 2]"#.to_owned(), "malformed_problem"),
        (
            r#""handles": [0, 7], "targets": [[0, 0], [2, 1]]"#.to_owned(),
            "unknown_handle",
        ),
        (
            r#""handles": [0, 2], "targets": [[0, 0]]"#.to_owned(),
            "unpaired_handles",
        ),
        (
            r#""handles": [0, 2], "targets": [[0, 0], [1]]"#.to_owned(),
            "bad_target",
        ),
        (
            r#""handles": [0, 0], "targets": [[0, 0], [1, 1]]"#.to_owned(),
            "contradictory_handles",
        ),
        (format!(r#"{good}, "beta": 0"#), "bad_parameter"),
        (format!(r#"{good}, "eps": 2"#), "bad_parameter"),
        (
            format!(r#"{good}, "rest": "elsewhere""#),
            "malformed_problem",
        ),
    ] {
        assert_eq!(problem(&with(&rest)).expect_err(code), code, "{rest}");
    }
    assert_eq!(problem("{").expect_err("no JSON"), "malformed_problem");
}

/// The reference problems, or nothing where they are not.
fn reference() -> Option<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/reference");
    if folder.is_dir() {
        return Some(folder);
    }
    eprintln!("skipped: ../shared/reference is absent");
    None
}

fn read(folder: &Path, name: &str) -> Problem {
    let json = std::fs::read(folder.join(format!("problems/{name}.json"))).expect("a problem");
    let file = ProblemFile::parse(&json).expect("a problem");
    let format = ElementFormat::of_name(&file.mesh).expect("a known format");
    let bytes = std::fs::read(folder.join("problems").join(&file.mesh)).expect("a mesh");
    let mesh = format.read(&bytes).expect("a mesh");
    file.with(mesh, None).expect("a sound problem")
}

/// What is scaled inside the solver does not move the minimizer: where it ends, the function of the file, taken as it is, has a
/// Newton decrement that is nothing beside its value.
#[test]
fn solutions_are_minimizers_of_the_function_of_the_file() {
    let Some(folder) = reference() else { return };
    for name in [
        "grid608_dirichlet_spline",
        "grid608_laplacian_spline",
        "grid608_uniform_laplacian_spline",
        "grid608_green_spline",
        "grid608_arap_spline",
        "woody-lo_pt_bend_arap_spline",
        "woody-lo_pt_squeeze_green_spline",
        "woody-hi_pt_bend_arap_spline",
    ] {
        let problem = read(&folder, name);
        let solution = problem
            .solve(&Settings::follow(), &|_: &Iterate| Control::Continue)
            .expect("a planar problem");
        assert_eq!(
            (solution.worth.inverted, solution.worth.residual),
            (0, 0.0),
            "{name}"
        );
        let terms = problem
            .energy
            .terms(&problem.body, problem.barrier, None)
            .expect("planar");
        let mut objective = Objective::of_terms(problem.body.n_vertices(), terms);
        objective.fix(&problem.stations[0].vertices);
        objective.linearize(&solution.x, 0.0);
        let mut direction = vec![0.0; solution.x.len()];
        let decrement = objective
            .newton_direction(&mut direction)
            .expect("projected");
        let value = solution.worth.energy + solution.worth.barrier;
        assert!(
            (objective.value(&solution.x) - value).abs() < 1e-12 * value,
            "{name}"
        );
        assert!(
            decrement < 1e-5 * value,
            "{name}: {decrement:e} of {value:e}"
        );
    }
}
