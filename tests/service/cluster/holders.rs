//! Who holds a job, for how long, and how often.

use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;

use super::faults::soon;
use super::{Cluster, assert_whole, submitted};
use crate::harness::machines::LEASE;
use crate::meshes;

#[tokio::test]
async fn a_job_longer_than_its_lease_stays_with_its_worker() {
    let cluster = Cluster::start();
    let api = cluster.api();
    let workers = [cluster.worker(), cluster.worker()];
    let job = api.submit(meshes::large(), "cut=disk").await;
    api.mapping(&job).await;
    // It takes three leases, however fast the machine is.
    let children = || {
        workers
            .iter()
            .flat_map(crate::harness::process::Process::children)
    };
    let signal = |signal| {
        for child in children() {
            kill(Pid::from_raw(child), signal).expect("a child");
        }
    };
    signal(Signal::SIGSTOP);
    let id = job["id"].as_str().expect("an id").to_owned();
    let lease_ms: u64 = LEASE.parse::<u64>().expect("seconds") * 1000;
    let held = format!("SELECT lease - started > 4 * {lease_ms} FROM job WHERE id = '{id}'");
    soon("its lease is not renewed", || {
        cluster.postgres.psql("unwrapd", &held) == "t\n"
    })
    .await;
    signal(Signal::SIGCONT);
    let path = job["links"]["self"].as_str().expect("a link");
    let finish = api.post(&format!("{path}/finish")).send().await;
    assert_eq!(finish.expect("an answer").status(), 202);
    assert_whole(&api, &job).await;
    assert_eq!(cluster.attempts()[&id], ("succeeded".to_owned(), 1, 0));
}

#[tokio::test]
async fn a_job_outlives_three_workers_and_is_computed_alone() {
    let cluster = Cluster::start();
    let api = cluster.api();
    let job = api.submit(meshes::large(), "cut=disk").await;
    let id = job["id"].as_str().expect("an id").to_owned();
    for attempt in 1..=3 {
        let mut worker = cluster.worker();
        soon("nobody takes it", || {
            cluster.attempts()[&id].1 == attempt && !worker.children().is_empty()
        })
        .await;
        worker.kill();
        soon("nobody misses it", || cluster.attempts()[&id].2 == attempt).await;
    }
    let _worker = cluster.worker();
    // A connection that was silent for long may be about to close.
    let _ = api.get("/healthz").send().await;
    let next = submitted(&api, 256..257).await;
    api.mapping(&job).await;
    let path = job["links"]["self"].as_str().expect("a link");
    let finish = api.post(&format!("{path}/finish")).send().await;
    assert_eq!(finish.expect("an answer").status(), 202);
    assert_whole(&api, &job).await;
    assert_whole(&api, &next[0]).await;
    let charged = format!("SELECT lost, interrupted FROM job WHERE id = '{id}'");
    assert_eq!(cluster.postgres.psql("unwrapd", &charged), "0|3\n");
}
