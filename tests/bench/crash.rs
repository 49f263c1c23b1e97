//! Nine faults, and what they do to accepted jobs: nothing.
//!
//! `cargo bench --bench crash -- [--fault NAME]… [--jobs N] [--moments N] [--seed N]`; without
//! arguments all faults, 200 jobs and ten moments each. Two services and three workers share a
//! PostgreSQL and an S3 server. Clients submit different small meshes under keys, and go on asking
//! where no answer comes; at moments drawn from the seed something goes wrong and, after a while, is
//! mended. Then everything is judged by the clients' own list of what was accepted, by the history of
//! all rows, which a trigger writes down, and by the files. Each fault has one line: its jobs,
//! moments and seconds; jobs lost; jobs done twice with effect; children, folders and files that are
//! left; results that are not proven. The exit code is 1 unless all of these are 0.
//!
//! The program is that of the build, or what `UNWRAPD_PROGRAM` names. PostgreSQL and libfaketime
//! have to be installed, and small disks to be mounted, which takes root.

#[path = "../harness/mod.rs"]
#[expect(dead_code, reason = "some is for tests")]
mod harness;
#[path = "../service/meshes.rs"]
#[expect(dead_code, reason = "only hills are sent")]
mod meshes;

use std::process::ExitCode;
use std::time::Duration;

use harness::crash::Run;
use harness::fault::Fault;
use harness::s3;

/// A run takes a few minutes at most.
const PATIENCE: Duration = Duration::from_mins(10);

#[tokio::main]
async fn main() -> ExitCode {
    s3::serve_if_asked().await;
    let (mut faults, mut jobs, mut moments, mut seed) = (Vec::new(), 200, 10, fresh_seed());
    let mut arguments = std::env::args().skip(1).filter(|a| a != "--bench");
    while let Some(argument) = arguments.next() {
        let value = arguments.next().expect("a value");
        let number = || value.parse().expect("a number");
        match &*argument {
            "--fault" => faults.push(value.parse().expect("a fault")),
            "--jobs" => jobs = number(),
            "--moments" => moments = number(),
            "--seed" => seed = value.parse().expect("a number"),
            _ => panic!("there is no {argument}"),
        }
    }
    if faults.is_empty() {
        faults = Fault::all().collect();
    }
    println!("seed {seed}");
    println!(
        "{:14} {:>5} {:>8} {:>8} {:>5} {:>6} {:>8} {:>11}",
        "fault", "jobs", "moments", "seconds", "lost", "twice", "orphans", "unverified"
    );
    let mut is_clean = true;
    for fault in faults {
        let run = Run {
            fault,
            jobs,
            moments,
            seed,
            patience: PATIENCE,
        };
        is_clean &= told(&run).await;
    }
    ExitCode::from(u8::from(!is_clean))
}

fn fresh_seed() -> u64 {
    let now = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH);
    now.expect("after 1970").as_secs()
}

/// Runs, tells how it went, and returns whether all is 0. What the processes told is kept if not.
async fn told(run: &Run) -> bool {
    let logs = tempfile::tempdir().expect("a folder");
    let name = run.fault.name();
    let Some(judged) = run.judged(Some(logs.path())).await else {
        println!("{name:14} cannot be made here");
        return false;
    };
    let [lost, twice, orphans, unverified] = judged.judgment.counts();
    println!(
        "{name:14} {:5} {:8} {:8.1} {lost:5} {twice:6} {orphans:8} {unverified:11}",
        run.jobs,
        judged.happened,
        judged.took.as_secs_f64()
    );
    for (what, faults) in judged.judgment.all() {
        for fault in faults {
            println!("    {what}: {fault}");
        }
    }
    let is_clean = [lost, twice, orphans, unverified] == [0; 4];
    if !is_clean {
        println!("    logs: {}", logs.keep().display());
    }
    is_clean
}
