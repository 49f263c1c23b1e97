//! Progress moves with the work: in many steps, none of them large, and never back.

use std::sync::Mutex;
use std::time::Duration;

use unwrapd_layout::charts::{Cut, MapUnderway, Symmetry};
use unwrapd_method::solver::Control;
use unwrapd_pipeline::{Cutting, Observer, Progress, Settings, Stage, Unobserved, Workers, unwrap};

use crate::places;
use crate::zoo::{self, Mesh};

/// Writes down every report; its clock stands still.
#[derive(Default)]
struct Recorder(Mutex<Vec<Progress>>);

impl Observer for Recorder {
    fn map(&self, _: usize, map: &MapUnderway) {
        // Where overlaps are pushed apart, a part of the chart is solved for, which is no map of the chart.
        assert_eq!(map.x.len(), 2 * map.chart.disk.n_vertices);
    }
    fn progress(&self, progress: &Progress) -> Control {
        let mut reports = self.0.lock().expect("no reporter panics");
        reports.push(progress.clone());
        Control::Continue
    }
    fn elapsed(&self) -> Duration {
        Duration::ZERO
    }
}

fn reports(mesh: &Mesh, cut: Cut) -> Vec<Progress> {
    let settings = Settings {
        cutting: Cutting {
            cut,
            ..Cutting::default()
        },
        // Reports of several threads may pass each other on their way.
        workers: Workers { threads: Some(1) },
        ..Settings::default()
    };
    let recorder = Recorder::default();
    let seen = unwrap(&mesh.positions, &mesh.triangles, &settings, &recorder).expect("it unwraps");
    let unseen = unwrap(&mesh.positions, &mesh.triangles, &settings, &Unobserved);
    assert_eq!(seen.grid, unseen.expect("it unwraps").grid);
    recorder.0.into_inner().expect("no reporter panics")
}

/// Steps of the fraction, each with the stage in which it was made.
fn steps(reports: &[Progress]) -> Vec<(Stage, f64)> {
    let pairs = reports.windows(2);
    let steps = pairs.map(|pair| (pair[1].stage, pair[1].fraction - pair[0].fraction));
    steps.filter(|(_, step)| *step != 0.0).collect()
}

#[test]
fn progress_has_many_small_steps() {
    for (name, mesh, cut, least, most) in [
        ("sphere", zoo::sphere(48, 31), Cut::Auto, 40, 0.15),
        ("torus", zoo::torus(48, 32), Cut::Auto, 40, 0.15),
        ("sphere", zoo::sphere(48, 31), Cut::Fast, 40, 0.15),
        // One chart: its map takes a few steps, and there are few layouts to search.
        ("torus", zoo::torus(48, 32), Cut::Disk, 5, 0.6),
    ] {
        let reports = reports(&mesh, cut);
        let steps = steps(&reports);
        let largest = steps.iter().map(|(_, step)| *step).fold(0.0, f64::max);
        let of = |stage| steps.iter().filter(|step| step.0 == stage).count();
        let what = format!(
            "{name} {cut:?}: {} steps, {} mapping, {} packing, the largest {largest}",
            steps.len(),
            of(Stage::Map),
            of(Stage::Pack)
        );
        assert!(steps.iter().all(|(_, step)| *step > 0.0), "{what}");
        assert!(steps.len() >= least && largest <= most, "{what}");
        assert!(reports.iter().all(|report| report.fraction <= 1.0));
    }
}

#[test]
fn what_takes_longer_has_more_of_the_whole() {
    let share = |mesh: &Mesh| {
        let steps = steps(&reports(mesh, Cut::Auto));
        let of = |stage| -> f64 {
            let steps = steps.iter().filter(|(at, _)| *at == stage);
            steps.map(|(_, step)| step).sum()
        };
        of(Stage::Map) / of(Stage::Pack)
    };
    // A search for a full layout reads as many words for ten thousand faces as for a thousand more.
    let (small, large) = (share(&zoo::sphere(16, 10)), share(&zoo::sphere(120, 80)));
    assert!(small < large, "{small} {large}");
}

#[test]
fn charts_are_counted_while_they_are_mapped() {
    for mesh in [zoo::sphere(48, 31), zoo::torus(48, 32)] {
        let reports = reports(&mesh, Cut::Auto);
        let mapping = || reports.iter().filter(|report| report.stage == Stage::Map);
        assert!(mapping().any(|report| 0 < report.charts));
        assert!(mapping().all(|report| report.chart <= report.charts));
        let packing = reports.iter().find(|report| report.stage == Stage::Pack);
        let packing = packing.expect("charts are packed");
        assert!(0 < packing.chart && packing.chart == packing.charts);
    }
}

/// Spot overlaps itself on the way, and is pushed apart.
#[test]
fn maps_that_are_shown_are_whole() {
    let bytes = std::fs::read(places::asset("spot.ply")).expect("an asset");
    let mesh = unwrapd_files::io::ply::read(&bytes).expect("a mesh");
    for symmetry in [Symmetry::Auto, Symmetry::Off] {
        let settings = Settings {
            cutting: Cutting {
                symmetry,
                ..Cutting::default()
            },
            ..Settings::default()
        };
        let recorder = Recorder::default();
        unwrap(&mesh.positions, &mesh.triangles, &settings, &recorder).expect("it unwraps");
    }
}
