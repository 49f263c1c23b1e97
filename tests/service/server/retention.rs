//! What is kept, and what is not.

use std::time::Instant;

use nix::sys::signal::Signal;
use serde_json::Value;

use crate::meshes;
use crate::server::{SOON, Server, assert_problem};

async fn get(server: &Server, job: &Value) -> reqwest::Response {
    let path = job["links"]["self"].as_str().expect("a link");
    server.get(path).send().await.expect("an answer")
}

#[tokio::test]
async fn a_restart_keeps_jobs_and_removes_files_without_one() {
    let mut server = Server::start();
    let job = server.submit(meshes::small(), "").await;
    server.ended(&job).await;
    server.kill();
    // As a crash between files and record leaves them; what is no id is not ours.
    let blobs = server.data().join("blobs");
    for name in ["019a0000-0000-7000-8000-000000000000/input", "lost+found"] {
        std::fs::create_dir_all(blobs.join(name)).expect("a folder");
    }
    std::fs::write(
        blobs.join("019a0000-0000-7000-8000-000000000000/input/0"),
        "v",
    )
    .expect("a file");

    server.restart();
    let mut left = server.owners_of_files();
    left.sort();
    assert_eq!(left, [job["id"].as_str().expect("an id"), "lost+found"]);
    assert_eq!(get(&server, &job).await.status(), 200);
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
