//! A rolling update from one program to another under load: nothing is lost.
//!
//! `cargo bench --bench update -- [--older PROGRAM] [--workers-first] [--jobs N]
//! [--seed N]`. Two services and three
//! workers of the older program share a PostgreSQL and an S3 server. While clients submit jobs
//! under keys, each process is told to stop by SIGTERM and its place is taken by one of this build,
//! one process after the other; services and workers take turns, unless workers come first. Everything is judged as by the
//! bench `crash`. Without `--older` both programs are this one, and the database gets columns and a
//! version that it does not know. `tests/bench/update.sh COMMIT` builds the program of a commit and
//! updates from that.

#[path = "../harness/mod.rs"]
#[expect(dead_code, reason = "some is for tests")]
mod harness;
#[path = "../service/meshes.rs"]
#[expect(dead_code, reason = "only hills are sent")]
mod meshes;

use std::process::ExitCode;
use std::time::{Duration, Instant};

use harness::s3;
use harness::update::Update;

#[tokio::main]
async fn main() -> ExitCode {
    s3::serve_if_asked().await;
    let mut update = Update {
        older: None,
        workers_first: false,
        jobs: 120,
        seed: 1,
        patience: Duration::from_mins(10),
    };
    let mut arguments = std::env::args().skip(1).filter(|a| a != "--bench");
    while let Some(argument) = arguments.next() {
        if argument == "--workers-first" {
            update.workers_first = true;
            continue;
        }
        let value = arguments.next().expect("a value");
        match &*argument {
            "--older" => update.older = Some(value.into()),
            "--jobs" => update.jobs = value.parse().expect("a number"),
            "--seed" => update.seed = value.parse().expect("a number"),
            _ => panic!("there is no {argument}"),
        }
    }
    let logs = tempfile::tempdir().expect("a folder");
    let begin = Instant::now();
    let updated = update.judged(Some(logs.path())).await;
    println!("{update:?}: {:.1} s", begin.elapsed().as_secs_f64());
    println!(
        "{} processes replaced, {} with a job in work; {} workers had jobs; {} attempts lost; the longest stop {:?}",
        updated.replaced, updated.interrupted, updated.holders, updated.lost, updated.stop
    );
    for (what, faults) in updated.judgment.all() {
        println!("{what}: {}", faults.len());
        for fault in faults {
            println!("    {fault}");
        }
    }
    let is_clean = updated.judgment.counts() == [0; 4] && updated.replaced == 5;
    if !is_clean {
        println!("logs: {}", logs.keep().display());
    }
    ExitCode::from(u8::from(!is_clean))
}
