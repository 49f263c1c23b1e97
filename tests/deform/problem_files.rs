//! Problem files: what they may say, and that the function which they define is what is minimized.

use serde_json::json;
use unwrapd_deform::{Problem, ProblemFile};
use unwrapd_files::io::{ElementFormat, Elements};
use unwrapd_method::solver::{Control, Iterate, Objective, Settings};

use crate::bodies::sheet;

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
            r#""handles": [{"vertex": 0, "to": [0, 0]}], "targets": [[0, 0]]"#.to_owned(),
            "malformed_problem",
        ),
        (
            r#""handles": [{"vertex": 7, "to": [0, 0]}]"#.to_owned(),
            "unknown_handle",
        ),
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
    let by_formula = |text| problem(&with(good).replace("arap", text));
    assert!(by_formula("log(s1)^2 + log(s2)^2").is_ok());
    assert_eq!(by_formula("s1 - s2").expect_err("less"), "invalid_formula");
}

#[test]
fn handles_of_both_forms_are_the_same() {
    let pairs = problem(&with(r#""handles": [0, 2], "targets": [[0, 0], [2, 1]]"#));
    let handles = r#""handles": [{"vertex": 0, "to": [0, 0]}, {"vertex": 2, "to": [2, 1]}]"#;
    let handles = problem(&with(handles)).expect("a problem");
    let pairs = pairs.expect("a problem");
    assert_eq!(handles.stations.len(), 1);
    assert_eq!(handles.stations[0].vertices, pairs.stations[0].vertices);
    assert_eq!(handles.stations[0].targets, pairs.stations[0].targets);
}

#[test]
fn solutions_are_minimizers_of_the_function_of_the_file() {
    let sheet = sheet(10);
    let mesh = Elements {
        vertices: sheet.vertices().iter().map(|&[x, y]| [x, y, 0.0]).collect(),
        triangles: sheet.triangles().to_vec(),
        tets: Vec::new(),
    };
    // The left side stays, the middle of the right one is pulled past the top.
    let handles = [0, 11, 22, 33, 44, 55, 66, 77, 88, 99, 110, 65];
    let stay = (0..11).map(|y| [0.0, f64::from(y)]);
    let targets: Vec<[f64; 2]> = stay.chain([[6.0, 13.0]]).collect();
    for energy in [
        "dirichlet",
        "laplacian",
        "uniform_laplacian",
        "green",
        "arap",
    ] {
        let problem = json!({
            "mesh": "m.off", "energy": energy, "barrier": "spline", "handles": handles, "targets": targets,
        });
        let file = ProblemFile::parse(problem.to_string().as_bytes()).expect("a problem");
        let problem = file.with(mesh.clone(), None).expect("a sound problem");
        assert_minimized(&problem, energy);
    }
}

/// What is scaled inside the solver does not move the minimizer: where it ends, the function of the file, taken as it is, has a
/// Newton decrement that is nothing beside its value.
fn assert_minimized(problem: &Problem, name: &str) {
    let solution = problem
        .solve(&Settings::follow(), &|_: &Iterate| Control::Continue)
        .expect("a planar problem");
    assert_eq!(
        (solution.quality.inverted, solution.quality.residual),
        (0, 0.0),
        "{name}"
    );
    let terms = problem
        .body
        .terms(&problem.energy, problem.barrier, None)
        .expect("planar");
    let mut objective = Objective::of_terms(problem.body.n_vertices(), terms);
    objective.fix(&problem.stations[0].vertices);
    objective.linearize(&solution.x, 0.0);
    let mut direction = vec![0.0; solution.x.len()];
    let decrement = objective
        .newton_direction(&mut direction)
        .expect("projected");
    let value = solution.quality.energy + solution.quality.barrier;
    assert!(
        (objective.value(&solution.x) - value).abs() < 1e-12 * value,
        "{name}"
    );
    assert!(
        decrement < 1e-5 * value,
        "{name}: {decrement:e} of {value:e}"
    );
}

mod shared {
    use super::{ElementFormat, Problem, ProblemFile, assert_minimized};
    use crate::places;

    fn read(name: &str) -> Problem {
        let folder = places::shared("reference/problems");
        let json = std::fs::read(folder.join(format!("{name}.json"))).expect("a problem");
        let file = ProblemFile::parse(&json).expect("a problem");
        let format = ElementFormat::of_name(&file.mesh).expect("a known format");
        let bytes = std::fs::read(folder.join(&file.mesh)).expect("a mesh");
        let mesh = format.read(&bytes).expect("a mesh");
        file.with(mesh, None).expect("a sound problem")
    }

    #[test]
    #[ignore = "needs ../shared"]
    fn solutions_are_minimizers_of_the_function_of_the_file() {
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
            assert_minimized(&read(name), name);
        }
    }
}
