//! What is kept, and what is not.

use std::time::{Duration, Instant};

use nix::sys::signal::Signal;
use serde_json::Value;
use unwrapd::jobs::{SteadyClock, Timestamp};

use super::watchable::{metrics, value};
use crate::cli::{assert_status, unwrapd};
use crate::harness::clock::Clock;
use crate::harness::process::{Process, Role};
use crate::meshes;
use crate::server::{SOON, Server, assert_problem};

/// A folder of files whose job nobody knows.
const UNKNOWN: &str = "019a0000-0000-7000-8000-000000000000";

async fn get(server: &Server, job: &Value) -> reqwest::Response {
    let path = job["links"]["self"].as_str().expect("a link");
    server.get(path).send().await.expect("an answer")
}

#[tokio::test]
async fn a_restart_keeps_jobs_and_the_files_without_one() {
    let mut server = Server::start();
    let job = server.submit(meshes::small(), "").await;
    server.ended(&job).await;
    server.kill();
    // As a crash between files and record leaves them; what is no id is not ours.
    let blobs = server.data().join("blobs");
    for name in [&format!("{UNKNOWN}/input"), "lost+found"] {
        std::fs::create_dir_all(blobs.join(name)).expect("a folder");
    }
    std::fs::write(blobs.join(format!("{UNKNOWN}/input/0")), "v").expect("a file");

    server.restart();
    let mut left = server.owners_of_files();
    left.sort();
    let id = job["id"].as_str().expect("an id");
    assert_eq!(left, [UNKNOWN, id, "lost+found"]);
    assert_eq!(get(&server, &job).await.status(), 200);
    let held = metrics(&server).await;
    assert_eq!(
        value(&held, "unwrapd_quarantined_bytes"),
        Some(1.0),
        "{held}"
    );

    // They go when their time is over and the clock has been normal for a while.
    server.signal(Signal::SIGTERM);
    server.stopped();
    server.restart_with(&[
        ("UNWRAPD_QUARANTINE_DAYS", "0"),
        ("UNWRAPD_RETAIN_DAYS", "0"),
    ]);
    assert!(!server.owners_of_files().contains(&UNKNOWN.to_owned()));
}

/// A database that was restored from an old backup does not know most files.
#[tokio::test]
async fn too_many_files_without_a_job_stay() {
    let mut server = Server::start();
    server.kill();
    let unknown = |n: u32| {
        server
            .data()
            .join(format!("blobs/019a0000-0000-7000-8000-{n:012}/input"))
    };
    for n in 0..21 {
        std::fs::create_dir_all(unknown(n)).expect("a folder");
        std::fs::write(unknown(n).join("0"), "v").expect("a file");
    }
    server.restart_with(&[
        ("UNWRAPD_QUARANTINE_DAYS", "0"),
        ("UNWRAPD_RETAIN_DAYS", "0"),
    ]);
    // It has looked at them before it answers, and the alert comes at once.
    assert_eq!(server.owners_of_files().len(), 21);
    let stopped = metrics(&server).await;
    assert_eq!(
        value(&stopped, "unwrapd_quarantine_stopped"),
        Some(1.0),
        "{stopped}"
    );
    let data = server.data().to_string_lossy().into_owned();
    let check = unwrapd(&["check", "--purge", "--data", &data]);
    assert_status(&check, 0);
    assert_eq!(server.owners_of_files().len(), 0);
}

/// A repetition finds its job whatever the clock says meanwhile.
#[tokio::test]
async fn a_jump_of_the_clock_forgets_no_idempotency_key() {
    let clock = Clock::ahead(0);
    let data = tempfile::tempdir().expect("a folder");
    let server = Server::on(data, &clock.settings());
    let submitted = async || {
        let request = server.post("/v1/jobs").header("idempotency-key", "one");
        let request = request.header("content-type", "model/gltf-binary");
        let answer = request.body(meshes::small()).send().await;
        let job: Value = answer.expect("an answer").json().await.expect("a job");
        job["id"].as_str().expect("an id").to_owned()
    };
    let first = submitted().await;
    clock.set(2 * 86_400);
    assert_eq!(submitted().await, first);
}

/// Until the clock can be trusted, what it says has expired stays.
#[tokio::test]
async fn a_jump_of_the_clock_starts_the_wait_anew() {
    let clock = Clock::ahead(0);
    let data = tempfile::tempdir().expect("a folder");
    let path = data.path().join("log");
    let log = std::fs::File::create(&path).expect("a file");
    // Looks at the clock every second.
    let mut settings = clock.settings();
    settings.push(("UNWRAPD_RETAIN_DAYS".to_owned(), "0.000116".to_owned()));
    let program = crate::harness::program();
    let process = Process::of(&program, Role::Serve, data, &settings, Some(log));
    clock.set(40 * 86_400);
    let start = Instant::now();
    loop {
        let said = std::fs::read_to_string(&path).expect("a file");
        if said.contains("nothing expires before") && said.contains("the clock jumped") {
            break;
        }
        assert!(start.elapsed() < SOON, "{said}");
        tokio::time::sleep(Duration::from_millis(20)).await;
    }
    drop(process);
}

/// The clock of the store is compared with the one that cannot be set.
#[test]
fn a_clock_is_steady_for_as_long_as_both_advance_alike() {
    let clock = SteadyClock::default();
    let (time, at) = (Timestamp(1_000_000_000_000), tokio::time::Instant::now());
    let minutes = |n: u64| Duration::from_mins(n);
    let look = |wall_ms: i64, monotonic: u64| {
        clock.record(Timestamp(time.0 + wall_ms), at + minutes(monotonic))
    };
    assert_eq!(look(0, 0).steady, Duration::ZERO);
    let later = look(30 * 60_000, 30);
    assert_eq!((later.steady, later.jump_ms), (minutes(30), None));
    for days in [40, -40] {
        let jump = days * 86_400_000;
        let jumped = look(60 * 60_000 + jump, 60);
        assert_eq!(
            (jumped.steady, jumped.jump_ms.is_some()),
            (Duration::ZERO, true)
        );
        let after = look(90 * 60_000 + jump, 90);
        assert_eq!((after.steady, after.jump_ms), (minutes(30), None));
        look(30 * 60_000, 30);
    }
}

#[tokio::test]
async fn a_job_goes_with_its_files_when_its_time_is_over() {
    let mut server = Server::start();
    let job = server.submit(meshes::small(), "").await;
    assert!(job["expires_at"].is_null());
    let job = server.ended(&job).await;
    assert!(job["expires_at"].as_str() > job["finished_at"].as_str());
    server.signal(Signal::SIGTERM);
    server.stopped();

    server.restart_with(&[("UNWRAPD_RETAIN_DAYS", "0")]);
    let start = Instant::now();
    while !server.owners_of_files().is_empty() {
        assert!(start.elapsed() < SOON, "the files are still there");
        tokio::task::yield_now().await;
    }
    assert_problem(get(&server, &job).await, 410, "job_expired").await;
    let path = job["links"]["self"].as_str().expect("a link");
    for path in [format!("{path}/result"), format!("{path}/events")] {
        let answer = server.get(&path).send().await.expect("an answer");
        assert_problem(answer, 410, "job_expired").await;
    }
    let deleted = server.request("DELETE", path).send().await;
    assert_problem(deleted.expect("an answer"), 410, "job_expired").await;
}
