//! Several pages, textures that are not square, densities on the command line.

use crate::cli::{assert_status, asset, unwrapd};
use serde_json::Value;

#[test]
fn pages_are_written_and_verify() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    let (input, report) = (asset("spot.ply"), path("r.json"));
    let input = input.to_string_lossy();
    for output in [path("spot.glb"), path("spot.obj")] {
        let layout = path("l.png");
        let texture = ["--pages", "3", "--resolution", "1024x512"];
        let files = [
            "unwrap", &input, "-o", &output, "--report", &report, "--layout", &layout,
        ];
        assert_status(&unwrapd(&[&files[..], &texture].concat()), 0);
        let claims = ["--bijective", "--padding", "2", "--resolution", "1024x512"];
        let verify = ["verify", &output];
        for (pages, status) in [("3", 0), ("2", 4)] {
            let pages = ["--pages", pages];
            assert_status(&unwrapd(&[&verify[..], &claims, &pages].concat()), status);
        }
        let report: Value = serde_json::from_slice(&std::fs::read(&report).expect("a report"))
            .expect("a JSON report");
        assert_eq!(report["options"]["resolution"], "1024x512");
        assert_eq!(report["proven"]["pages"]["kept"], true);
        let pages = report["groups"][0]["measures"]["pages"]
            .as_array()
            .expect("pages");
        let numbers: Vec<_> = pages.iter().map(|page| &page["udim"]).collect();
        assert_eq!(numbers, [1001, 1002, 1003]);
        assert!(
            pages.iter().all(|page| page["fill"].as_f64() > Some(0.25)),
            "{pages:?}"
        );
    }
}

/// Texels per unit, as a report has them.
fn density(report: &str) -> f64 {
    let text = std::fs::read(report).expect("a report");
    let report: Value = serde_json::from_slice(&text).expect("a JSON report");
    let density = report["groups"][0]["texels_per_unit"].as_f64();
    density.expect("a number")
}

/// Charts never become smaller with more pages.
#[test]
fn more_pages_are_denser() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    let (input, output, report) = (asset("cat_head.obj"), path("cat.glb"), path("r.json"));
    let input = input.to_string_lossy();
    let densities = ["1", "4", "7", "10"].map(|pages| {
        let unwrap = ["unwrap", &input, "-o", &output, "--report", &report];
        assert_status(&unwrapd(&[&unwrap[..], &["--pages", pages]].concat()), 0);
        density(&report)
    });
    assert!(densities.is_sorted(), "{densities:?}");
    assert!(densities[2] > 1.5 * densities[0], "{densities:?}");
}

#[test]
fn a_density_is_kept_or_refused_with_what_would_do() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    let (input, output, report) = (asset("spot.ply"), path("spot.glb"), path("r.json"));
    let input = input.to_string_lossy();
    let unwrap = ["unwrap", &input, "-o", &output, "--report", &report];
    let with = |options: &[&str]| unwrapd(&[&unwrap[..], options].concat());
    assert_status(&with(&["--texels-per-unit", "150"]), 0);
    let density = density(&report);
    assert!((density - 150.0).abs() < 0.01, "{density}");

    let refused = with(&["--texels-per-unit", "700"]);
    assert_status(&refused, 3);
    let error = String::from_utf8_lossy(&refused.stderr).into_owned();
    let line = error.lines().last().expect("a line");
    assert!(line.contains("texture_too_small"), "{line}");
    let resolution = line.split("resolution ").nth(1).expect("a resolution");
    let resolution = resolution.split([' ', ',']).next().expect("a number");
    let enough = ["--texels-per-unit", "700", "--resolution", resolution];
    assert_status(&with(&enough), 0);

    let beyond = with(&["--texels-per-unit", "1e9", "--pages", "3"]);
    assert_status(&beyond, 3);
}

#[test]
fn textures_that_cannot_be_are_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let output = folder.path().join("a.glb").to_string_lossy().into_owned();
    let input = asset("cat_head.obj").to_string_lossy().into_owned();
    for options in [
        &["--resolution", "1000x300"][..],
        &["--resolution", "1024x32"],
        &["--resolution", "wide"],
        &["--pages", "0"],
        &["--pages", "11"],
        &["--texels-per-unit", "0"],
        &["--texels-per-unit", "nan"],
        &["--pages", "2", "--rebake"],
        &["--resolution", "512x256", "--rebake"],
        &["--pages", "2", "--quantization-safe", "12"],
    ] {
        let unwrap = ["unwrap", &input, "-o", &output];
        assert_status(&unwrapd(&[&unwrap[..], options].concat()), 2);
    }
}
