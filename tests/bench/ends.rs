//! How long unwrapping is silent, and how soon it ends when it is asked to.
//!
//! `cargo bench --bench ends -- [FILE …]`; without arguments ten large meshes of `../shared/data`.
//! Each is unwrapped with the defaults, once whole, and once for each of some moments at which it is
//! asked to finish early: the start and four moments of the whole run. Tells the longest time in
//! which the reported share did not move, and between which reports; the seconds of the smallest
//! valid result, which is the run that is asked at its start; and the delay of the others.

use std::sync::Mutex;
use std::time::{Duration, Instant};

use unwrapd::document::Upload;
use unwrapd::pipeline::{Observer, Options, Progress, unwrap_document};
use unwrapd::solver::Control;

const DATA: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/data");

const FILES: [&str; 10] = [
    "closed/beetle.obj",
    "closed/boot.obj",
    "closed/human_neutral.obj",
    "closed/koala.obj",
    "closed/pizza.obj",
    "closed/rangemap_121k.ply",
    "closed/stanford_bunny_69k.obj",
    "disk/bimba_89k.obj",
    "disk/bimba_357k_midpoint.ply",
    "noisy/voxels.ply",
];

/// Moments at which the work is asked to end, as shares of the whole run.
const MOMENTS: [f64; 4] = [0.2, 0.4, 0.6, 0.8];

fn main() {
    let arguments = std::env::args().skip(1);
    let mut files: Vec<String> = arguments.filter(|a| !a.starts_with('-')).collect();
    if files.is_empty() {
        files = FILES.iter().map(|file| format!("{DATA}/{file}")).collect();
    }
    println!(
        "{:28} {:>8} {:>7} {:>8}  {:>7}  delays",
        "file", "seconds", "silent", "", "least"
    );
    let (mut worst_gap, mut worst_delay) = (0.0_f64, 0.0_f64);
    for file in files {
        let Ok(bytes) = std::fs::read(&file) else {
            println!("{file}: not read");
            continue;
        };
        let name = file.rsplit('/').next().unwrap_or(&file).to_owned();
        let upload = Upload::single(name.clone(), bytes);
        let whole = Watched::new(None);
        let seconds = whole.run(&upload);
        let (gap, place) = whole.longest_gap();
        let least = Watched::new(Some(0.0)).run(&upload);
        let delays = MOMENTS.map(|share| {
            let asked = share * seconds;
            Watched::new(Some(asked)).run(&upload) - asked
        });
        let latest = delays.into_iter().fold(0.0, f64::max);
        worst_gap = worst_gap.max(gap);
        worst_delay = worst_delay.max(latest - least);
        println!("{name:28} {seconds:8.2} {gap:7.2}  {place:50} {least:7.2}  {delays:.2?}");
    }
    println!(
        "longest silence {worst_gap:.2} s; longest delay beyond the smallest result {worst_delay:.2} s"
    );
}

/// Writes down when the share moved, and asks for an early end from some second on.
struct Watched {
    begin: Instant,
    asked: Option<f64>,
    moved: Mutex<Vec<(f64, Progress)>>,
}

impl Watched {
    fn new(asked: Option<f64>) -> Self {
        Self {
            begin: Instant::now(),
            asked,
            moved: Mutex::default(),
        }
    }

    /// Seconds that it took.
    fn run(&self, upload: &Upload) -> f64 {
        match unwrap_document(upload, &Options::default(), self) {
            Ok(outcome) if !outcome.report.certified => println!("{}: not certified", upload.name),
            Ok(_) => {}
            Err(error) => println!("{}: {error}", upload.name),
        }
        self.begin.elapsed().as_secs_f64()
    }

    /// The longest time without a report of a higher share, and where it was.
    fn longest_gap(&self) -> (f64, String) {
        let moved = self.moved.lock().expect("no reporter panics");
        let (mut gap, mut place) = (0.0, String::new());
        let mut before = (0.0, "begin".to_owned());
        let words = |p: &Progress| format!("{:?} {:.3} #{}", p.stage, p.fraction, p.iteration);
        for (at, progress) in moved.iter() {
            if at - before.0 > gap {
                gap = at - before.0;
                place = format!("{} > {}", before.1, words(progress));
            }
            before = (*at, words(progress));
        }
        let rest = self.begin.elapsed().as_secs_f64() - before.0;
        if rest > gap {
            return (rest, format!("{} > end", before.1));
        }
        (gap, place)
    }
}

impl Observer for Watched {
    fn progress(&self, progress: &Progress) -> Control {
        let now = self.begin.elapsed().as_secs_f64();
        let mut moved = self.moved.lock().expect("no reporter panics");
        if moved
            .last()
            .is_none_or(|(_, last)| last.fraction < progress.fraction)
        {
            moved.push((now, progress.clone()));
        }
        match self.asked {
            Some(asked) if asked <= now => Control::Finish,
            _ => Control::Continue,
        }
    }

    fn elapsed(&self) -> Duration {
        self.begin.elapsed()
    }
}
