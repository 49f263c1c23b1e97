//! Processes that are killed or stopped, and nothing is lost or done twice with effect.

use std::time::{Duration, Instant};

use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;

use super::{Cluster, assert_whole, submitted};
use crate::meshes;
use crate::server::{SOON, Server, assert_problem};

/// Waits for something that happens soon.
pub async fn soon(what: &str, mut happened: impl FnMut() -> bool) {
    let start = Instant::now();
    while !happened() {
        assert!(start.elapsed() < SOON, "{what}");
        tokio::time::sleep(Duration::from_millis(20)).await;
    }
}

async fn finish(api: &Server, path: &str) {
    let finish = api.post(&format!("{path}/finish")).send().await;
    assert_eq!(finish.expect("an answer").status(), 202);
}

#[tokio::test]
async fn the_jobs_of_a_killed_worker_go_to_another() {
    let cluster = Cluster::start();
    let api = cluster.api();
    let mut worker = cluster.worker();
    let job = api.submit(meshes::hills(350), "cut=disk").await;
    let small = submitted(&api, 256..258).await;
    api.mapping(&job).await;
    worker.kill();
    soon("an orphan is left", || worker.children().is_empty()).await;

    let _other = cluster.worker();
    for job in &small {
        assert_whole(&api, job).await;
    }
    api.mapping(&job).await;
    finish(&api, job["links"]["self"].as_str().expect("a link")).await;
    assert_whole(&api, &job).await;
    let attempts = cluster.attempts();
    let of_killed = &attempts[job["id"].as_str().expect("an id")];
    assert_eq!(*of_killed, ("succeeded".to_owned(), 2, 1));
}

#[tokio::test]
async fn a_worker_that_wakes_up_late_changes_nothing() {
    let cluster = Cluster::start();
    let api = cluster.api();
    let stopped = cluster.worker();
    let job = api.submit(meshes::large(), "cut=disk").await;
    api.mapping(&job).await;
    stopped.signal(Signal::SIGSTOP);
    let id = job["id"].as_str().expect("an id").to_owned();
    soon("it is not swept", || cluster.attempts()[&id].2 == 1).await;
    let other = cluster.worker();
    soon("nobody takes it", || cluster.attempts()[&id].1 == 2).await;
    finish(&api, job["links"]["self"].as_str().expect("a link")).await;
    assert_whole(&api, &job).await;
    let (row, objects) = (
        cluster.postgres.psql("unwrapd", "SELECT * FROM job"),
        cluster.s3.objects(),
    );

    stopped.signal(Signal::SIGCONT);
    soon("its child goes on", || stopped.children().is_empty()).await;
    // It works again, and on what is its own.
    drop(other);
    let next = submitted(&api, 256..257).await;
    assert_whole(&api, &next[0]).await;
    let statement = format!("SELECT * FROM job WHERE id = '{id}'");
    assert_eq!(cluster.postgres.psql("unwrapd", &statement), row);
    let of_job = |key: &String| key.starts_with(&id);
    let left: Vec<String> = cluster.s3.objects().into_iter().filter(of_job).collect();
    assert_eq!(left, objects);
}

#[tokio::test]
async fn a_killed_database_is_waited_for() {
    // A busy machine has time to hand the job back.
    let mut cluster = Cluster::with_lease("6");
    let api = cluster.api();
    let worker = cluster.worker();
    let job = api.submit(meshes::large(), "cut=disk").await;
    api.mapping(&job).await;
    // It shall not be done before its lease is over.
    for child in worker.children() {
        kill(Pid::from_raw(child), Signal::SIGSTOP).expect("a child");
    }
    cluster.postgres.kill();
    let refused = api.post("/v1/jobs").body(meshes::small()).send().await;
    assert_problem(refused.expect("an answer"), 503, "store_unavailable").await;
    let ready = api.get("/readyz").send().await.expect("an answer");
    assert_problem(ready, 503, "not_ready").await;
    // A worker that cannot renew its lease ends its child.
    soon("its child goes on", || worker.children().is_empty()).await;

    cluster.postgres.restart();
    let path = job["links"]["self"].as_str().expect("a link");
    finish(&api, path).await;
    let next = submitted(&api, 256..257).await;
    assert_whole(&api, &next[0]).await;
    assert_whole(&api, &job).await;
    // It was not the worker that was away.
    let id = job["id"].as_str().expect("an id");
    assert_eq!(cluster.attempts()[id], ("succeeded".to_owned(), 2, 0));
    let ready = api.get("/readyz").send().await.expect("an answer");
    assert_eq!(ready.status(), 200);
}

#[tokio::test]
async fn a_database_that_stands_still_is_waited_for() {
    let cluster = Cluster::start();
    let api = cluster.api();
    let worker = cluster.worker();
    let job = api.submit(meshes::large(), "cut=disk").await;
    api.mapping(&job).await;
    worker.signal(Signal::SIGSTOP);
    cluster.postgres.signal(Signal::SIGSTOP);
    // Longer than a lease, and shorter than a statement waits.
    tokio::time::sleep(Duration::from_millis(3500)).await;
    cluster.postgres.signal(Signal::SIGCONT);
    // Whoever looked for silent workers meanwhile is answered first.
    let waiting = "SELECT count(*) FROM pg_stat_activity WHERE state = 'active' AND query_start < now() - interval '1 s'";
    soon("what waited is not answered", || {
        cluster.postgres.psql("unwrapd", waiting).trim() == "0"
    })
    .await;
    worker.signal(Signal::SIGCONT);
    finish(&api, job["links"]["self"].as_str().expect("a link")).await;
    assert_whole(&api, &job).await;
    let id = job["id"].as_str().expect("an id");
    assert_eq!(cluster.attempts()[id], ("succeeded".to_owned(), 2, 0));
}

#[tokio::test]
async fn a_killed_store_of_files_is_waited_for() {
    let mut cluster = Cluster::start();
    let api = cluster.api();
    let paused = async |method| {
        let answer = api.request(method, "/v1/pause").send().await;
        assert_eq!(answer.expect("an answer").status(), 200);
    };
    paused("PUT").await;
    let jobs = submitted(&api, 256..258).await;
    let worker = cluster.worker();
    soon("the worker does not start", || {
        worker.folder().join("scratch").exists()
    })
    .await;
    cluster.s3.kill();
    let refused = api.post("/v1/jobs").body(meshes::small()).send().await;
    assert_problem(refused.expect("an answer"), 503, "store_unavailable").await;
    let ready = api.get("/readyz").send().await.expect("an answer");
    assert_problem(ready, 503, "not_ready").await;
    paused("DELETE").await;
    let id = jobs[0]["id"].as_str().expect("an id").to_owned();
    soon("nobody takes it", || cluster.attempts()[&id].1 > 0).await;

    cluster.s3.restart();
    for job in &jobs {
        assert_whole(&api, job).await;
    }
    assert_eq!(cluster.attempts()[&id].2, 0);
}

#[tokio::test]
async fn a_worker_that_is_told_to_stop_hands_its_job_back() {
    let cluster = Cluster::start();
    let api = cluster.api();
    let mut worker = cluster.worker();
    let job = api.submit(meshes::hills(350), "cut=disk").await;
    api.mapping(&job).await;
    worker.signal(Signal::SIGTERM);
    worker.stopped();
    assert_eq!(worker.children(), Vec::<i32>::new());
    let id = job["id"].as_str().expect("an id");
    let (state, attempt, lost) = cluster.attempts()[id].clone();
    assert_eq!((attempt, lost), (1, 0));
    assert!(state == "queued" || state == "succeeded", "{state}");
}

/// Jobs are not to blame for the machines that they happen to run on.
#[tokio::test]
async fn workers_killed_every_few_seconds_lose_no_job() {
    let cluster = Cluster::start();
    let api = cluster.api();
    let mut workers = [cluster.worker(), cluster.worker(), cluster.worker()];
    let jobs = submitted(&api, 256..296).await;
    for kill in 0.. {
        let ended = || {
            let states = "SELECT count(*) FROM job WHERE state NOT IN ('queued', 'running')";
            cluster.postgres.psql("unwrapd", states).trim().to_owned()
        };
        if ended() == "40" {
            assert!(0 < kill, "nothing was killed");
            break;
        }
        workers[kill % 3].kill();
        workers[kill % 3].restart();
        tokio::time::sleep(Duration::from_secs(4)).await;
    }
    let _ = api.get("/healthz").send().await;
    for job in &jobs {
        assert_whole(&api, job).await;
    }
}

#[tokio::test]
async fn a_worker_stops_while_the_database_is_down() {
    let mut cluster = Cluster::start();
    let api = cluster.api();
    let mut worker = cluster.worker();
    let job = api.submit(meshes::hills(400), "cut=disk").await;
    api.mapping(&job).await;
    cluster.postgres.kill();
    worker.signal(Signal::SIGTERM);
    worker.stopped();
    assert_eq!(worker.children(), Vec::<i32>::new());
}
