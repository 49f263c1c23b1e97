//! The benches in Python still run: the smallest case of each table.

use std::path::{Path, PathBuf};
use std::process::Command;

const ROOT: &str = env!("CARGO_MANIFEST_DIR");

/// What a script prints; `None`, with a printed reason, where the reference problems or its Python are absent.
fn printed(script: &str, arguments: &[&str]) -> Option<String> {
    let shared = Path::new(ROOT).join("../shared");
    if !shared.join("reference/index.json").exists() {
        println!("skipped: no reference problems");
        return None;
    }
    let own = Path::new(ROOT).join("tests/.venv/bin/python");
    let python = if own.exists() {
        own
    } else {
        PathBuf::from("python3")
    };
    let numpy = Command::new(&python).args(["-c", "import numpy"]).output();
    if !numpy.is_ok_and(|output| output.status.success()) {
        println!("skipped: no Python with numpy");
        return None;
    }
    let output = Command::new(&python)
        .arg(Path::new(ROOT).join("tests/bench").join(script))
        .arg("--reference")
        .arg(shared.join("reference"))
        .args(["--unwrapd", env!("CARGO_BIN_EXE_unwrapd")])
        .args(arguments)
        .output()
        .expect("a Python");
    let error = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{error}");
    Some(String::from_utf8_lossy(&output.stdout).into_owned())
}

#[test]
fn the_papers_tables_are_drawn() {
    let Some(text) = printed("paper", &["--quick", "--ipopt-seconds", "0"]) else {
        return;
    };
    for title in [
        "Table 1",
        "Timings of the figures",
        "Figure 18",
        "Figure 20",
    ] {
        let table = text.split("\n## ").find(|part| part.starts_with(title));
        let Some(table) = table else {
            assert!(
                text.contains(&format!("skipped: {title}")),
                "{title}: {text}"
            );
            continue;
        };
        // Title, header, line, and then results, none of which is inverted but without a barrier.
        let rows: Vec<_> = table
            .lines()
            .filter(|line| line.starts_with("| "))
            .collect();
        assert!(rows.len() > 1, "{table}");
    }
}

#[test]
fn bijective_maps_are_judged() {
    let Some(text) = printed("bijective.py", &["woody-lo_pt_swapAL_arap_spline"]) else {
        return;
    };
    // Crossings, status and distance to the targets with `bijective`.
    assert!(text.contains(" | 0 | converged | 0 | "), "{text}");
}

#[test]
fn reference_problems_are_judged() {
    let checker = Path::new(ROOT).join("../shared/tools/lim_check.py");
    let arguments = [
        "--checker",
        &checker.to_string_lossy(),
        "grid608_green_spline",
        "bar_c_bend_green_spline",
    ];
    let Some(text) = printed("reference.py", &arguments) else {
        return;
    };
    assert!(
        text.contains(
            "2 problems; inverted: none; energy more than 1 % above: none; targets missed: none"
        ),
        "{text}"
    );
}
