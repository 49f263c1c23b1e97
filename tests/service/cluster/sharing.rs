//! Services and workers that share everything, and nothing goes wrong.

use std::time::{Duration, Instant};

use nix::sys::signal::Signal;
use serde_json::Value;

use super::{Cluster, assert_whole, submitted};
use crate::meshes;
use crate::server::{assert_problem, json, progress::Socket};

/// How long any service may take to show what happened elsewhere.
const SHOWN: Duration = Duration::from_secs(1);
/// For a machine that does other things.
const SLACK: Duration = Duration::from_secs(4);

#[tokio::test]
async fn two_services_share_three_workers() {
    let cluster = Cluster::with_lease("60");
    let (one, other) = (cluster.api(), cluster.api());
    let mut workers = [cluster.worker(), cluster.worker(), cluster.worker()];
    let mut jobs = submitted(&one, 256..262).await;
    jobs.extend(submitted(&other, 262..268).await);
    for job in &jobs {
        assert_whole(&other, job).await;
    }
    let attempts = cluster.attempts();
    assert_eq!(attempts.len(), jobs.len());
    assert!(
        attempts
            .values()
            .all(|it| *it == ("succeeded".to_owned(), 1, 0))
    );
    for job in &jobs {
        let path = job["links"]["self"].as_str().expect("a link");
        let deleted = other.request("DELETE", path).send().await;
        assert_eq!(deleted.expect("an answer").status(), 204);
        let gone = one.get(path).send().await.expect("an answer");
        assert_problem(gone, 404, "job_not_found").await;
    }
    assert_eq!(cluster.s3.objects(), Vec::<String>::new());
    for worker in &mut workers {
        worker.signal(Signal::SIGTERM);
        worker.stopped();
    }
}

#[tokio::test]
async fn maps_under_way_stay_with_the_worker() {
    let cluster = Cluster::with_lease("60");
    let service = cluster.api();
    let _worker = cluster.worker();
    let job = service.submit(meshes::hills(150), "").await;
    let path = job["links"]["self"].as_str().expect("a link");
    let maps = service.get(&format!("{path}/maps")).send().await;
    assert_problem(maps.expect("an answer"), 409, "computed_elsewhere").await;
    assert_whole(&service, &job).await;
}

#[tokio::test]
async fn any_service_shows_cancels_and_finishes_any_job() {
    let cluster = Cluster::start();
    let (one, other) = (cluster.api(), cluster.api());
    let mut worker = cluster.worker();
    let job = one.submit(meshes::hills(800), "cut=disk").await;
    let path = job["links"]["self"].as_str().expect("a link").to_owned();
    let mut socket = Socket::connect(&other.socket_url(&format!("{path}/events"))).await;
    let mut last: Option<(Instant, Value)> = None;
    let mut worst = Duration::ZERO;
    loop {
        let event = socket.next().await.expect("an event");
        assert!(event["finished_at"].is_null());
        if let Some((when, before)) = &last {
            assert!(before["seq"].as_u64() < event["seq"].as_u64());
            if before["state"] == "running" {
                worst = worst.max(when.elapsed());
            }
        }
        if event["iteration"].as_u64() > Some(0) {
            break;
        }
        last = Some((Instant::now(), event));
    }
    println!("longest pause between two events: {worst:?}");
    assert!(worst < SHOWN + SLACK);
    let waiting = one.get(&format!("{path}?wait=1")).send().await;
    assert_eq!(json(waiting.expect("an answer")).await["state"], "running");

    let start = Instant::now();
    let cancelled = other.request("DELETE", &path).send().await;
    assert_eq!(cancelled.expect("an answer").status(), 202);
    while socket.next().await.is_some() {}
    assert_eq!(socket.closed, Some(1000));
    println!("cancelled elsewhere after {:?}", start.elapsed());
    assert!(start.elapsed() < SHOWN + SLACK);
    assert_eq!(one.ended(&job).await["state"], "cancelled");
    assert_eq!(worker.children(), Vec::<i32>::new());
    assert_eq!(cluster.s3.objects(), Vec::<String>::new());

    let job = other.submit(meshes::hills(800), "cut=disk").await;
    one.mapping(&job).await;
    let path = job["links"]["self"].as_str().expect("a link");
    let finish = one.post(&format!("{path}/finish")).send().await;
    assert_eq!(finish.expect("an answer").status(), 202);
    assert_whole(&other, &job).await;

    let guest = other.post("/v1/unwrap").body(meshes::small()).send().await;
    assert_eq!(guest.expect("an answer").status(), 200);
    worker.signal(Signal::SIGTERM);
    worker.stopped();
}

#[test]
fn a_worker_needs_what_it_shares() {
    let alone = std::process::Command::new(env!("CARGO_BIN_EXE_unwrapd"))
        .arg("worker")
        .output()
        .expect("it runs");
    let said = String::from_utf8_lossy(&alone.stderr).into_owned();
    assert!(said.contains("--database"), "{said}");
    assert_eq!(alone.status.code(), Some(1));
}
