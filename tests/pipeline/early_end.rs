//! Work that is asked to end early ends soon, with a valid result, and says so.

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

use unwrapd_files::document::Upload;
use unwrapd_maps::certificate::{Overlap, certify};
use unwrapd_method::solver::Control;
use unwrapd_pipeline::{
    Budget, Cutting, Observer, Options, Progress, Settings, Stage, Unobserved, Workers, unwrap,
    unwrap_document,
};

use crate::zoo::{self, Mesh};

const BOX: &[u8] = include_bytes!("../assets/Box.glb");

/// Asks for an end from some stage on, and counts the reports of each stage. Its clock advances by a
/// second with every report.
struct Ending {
    from: Option<Stage>,
    reports: Mutex<Vec<Stage>>,
    seconds: AtomicUsize,
}

impl Ending {
    fn from(stage: Option<Stage>) -> Self {
        Self {
            from: stage,
            reports: Mutex::default(),
            seconds: AtomicUsize::new(0),
        }
    }

    fn reports(&self, stage: Stage) -> usize {
        let reports = self.reports.lock().expect("no reporter panics");
        reports.iter().filter(|at| **at == stage).count()
    }
}

impl Observer for Ending {
    fn progress(&self, progress: &Progress) -> Control {
        self.seconds.fetch_add(1, Ordering::Relaxed);
        let mut reports = self.reports.lock().expect("no reporter panics");
        reports.push(progress.stage);
        match self.from {
            Some(from) if from <= progress.stage => Control::Finish,
            _ => Control::Continue,
        }
    }
    fn elapsed(&self) -> Duration {
        Duration::from_secs(self.seconds.load(Ordering::Relaxed) as u64)
    }
}

/// Unwraps a mesh under a bound that takes several rounds of maps, checks the result, and returns what was reported.
fn ended(mesh: &Mesh, from: Option<Stage>) -> Ending {
    let settings = Settings {
        cutting: Cutting {
            max_distortion: Some(4.02),
            ..Cutting::default()
        },
        workers: Workers { threads: Some(1) },
        ..Settings::default()
    };
    let ending = Ending::from(from);
    let unwrapped =
        unwrap(&mesh.positions, &mesh.triangles, &settings, &ending).expect("it unwraps");
    let positions: Vec<[f64; 3]> = mesh.positions.iter().map(|p| p.map(f64::from)).collect();
    let uvs = unwrapped.corner_uvs();
    let certificate = certify(&positions, &mesh.triangles, &uvs, &Overlap::Test.into());
    assert!(certificate.is_bijective(), "{from:?}: {certificate:?}");
    ending
}

#[test]
fn packing_ends_soon_after_it_is_asked_to() {
    let mesh = zoo::sphere(48, 31);
    let whole = ended(&mesh, None).reports(Stage::Pack);
    let early = ended(&mesh, Some(Stage::Pack)).reports(Stage::Pack);
    assert!(5 * early < whole, "{early} of {whole} reports");
}

#[test]
fn mapping_ends_soon_after_it_is_asked_to() {
    let mesh = zoo::sphere(48, 31);
    let whole = ended(&mesh, None).reports(Stage::Map);
    let early = ended(&mesh, Some(Stage::Map)).reports(Stage::Map);
    assert!(2 * early < whole, "{early} of {whole} reports");
}

/// The messages of the warning that the work ended early.
fn warnings(options: &Options, observer: &dyn Observer) -> Vec<String> {
    let upload = Upload::single("Box.glb", BOX.to_vec());
    let outcome = unwrap_document(&upload, options, observer).expect("it unwraps");
    assert!(outcome.report.certified);
    let warnings = outcome.report.warnings.into_iter();
    let early = warnings.filter(|warning| warning.code == "ended_early");
    early.map(|warning| warning.message).collect()
}

#[test]
fn the_report_tells_an_early_end_and_its_cause() {
    let defaults = Options::default();
    let limited = Options {
        budget: Budget {
            time_budget: Some(0.5),
        },
        ..Options::default()
    };
    assert!(warnings(&defaults, &Unobserved).is_empty());
    assert!(warnings(&defaults, &Ending::from(None)).is_empty());
    // Nothing can end early any more when the document is written.
    assert!(warnings(&defaults, &Ending::from(Some(Stage::Write))).is_empty());
    let asked = warnings(&defaults, &Ending::from(Some(Stage::Map)));
    assert!(
        asked.len() == 1 && asked[0].contains("on request"),
        "{asked:?}"
    );
    let late = warnings(&limited, &Ending::from(None));
    assert!(
        late.len() == 1 && late[0].contains("time limit of 0.5 s"),
        "{late:?}"
    );
}
