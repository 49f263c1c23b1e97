//! Computations that end badly, one at a time; the service goes on.

use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;
use serde_json::Value;

use crate::meshes;
use crate::server::Server;

async fn assert_failed(server: &Server, job: &Value, code: &str) {
    let job = server.ended(job).await;
    assert_eq!(
        (&job["state"], &job["error"]["code"]),
        (&"failed".into(), &code.into()),
        "{job}"
    );
    let next = server.submit(meshes::hills(1), "").await;
    let ready = server.get("/readyz").send().await.expect("an answer");
    assert_eq!(ready.status(), 200);
    server.ended(&next).await;
}

#[tokio::test]
async fn a_child_killed_from_outside_is_a_lost_worker() {
    let server = Server::start();
    for (signal, code) in [
        (Signal::SIGKILL, "worker_lost"),
        (Signal::SIGABRT, "crashed"),
    ] {
        let job = server.submit(meshes::large(), "cut=disk").await;
        server.mapping(&job).await;
        for child in server.children() {
            kill(Pid::from_raw(child), signal).expect("a child of ours");
        }
        assert_failed(&server, &job, code).await;
    }
}

#[tokio::test]
async fn a_mesh_that_needs_too_much_memory_fails_alone() {
    let server = Server::with(&[("UNWRAPD_JOB_MEMORY_MIB", "64")]);
    let job = server.submit(meshes::large(), "cut=disk").await;
    assert_failed(&server, &job, "out_of_memory").await;
}

#[tokio::test]
async fn a_mesh_that_takes_too_long_ends_with_the_map_it_has() {
    let server = Server::with(&[("UNWRAPD_JOB_SECONDS", "0.05")]);
    let job = server.submit(meshes::large(), "cut=disk").await;
    let job = server.ended(&job).await;
    assert_eq!(job["state"], "succeeded", "{job}");
    let warnings = job["warnings"].as_array().expect("a list");
    let is_told = |warning: &serde_json::Value| warning["code"] == "ended_early";
    assert!(warnings.iter().any(is_told), "{job}");
}

#[tokio::test]
async fn a_mesh_without_a_map_fails_some_time_after_the_limit() {
    let server = Server::with(&[("UNWRAPD_JOB_SECONDS", "1")]);
    let job = server.submit(meshes::large(), "cut=disk").await;
    let mut children = server.children();
    while children.is_empty() {
        tokio::task::yield_now().await;
        children = server.children();
    }
    for child in children {
        kill(Pid::from_raw(child), Signal::SIGSTOP).expect("a child of ours");
    }
    assert_failed(&server, &job, "timed_out").await;
}

#[tokio::test]
async fn a_mesh_with_too_many_triangles_is_refused() {
    let server = Server::with(&[("UNWRAPD_MAX_TRIANGLES", "100")]);
    let job = server.submit(meshes::small(), "").await;
    assert_failed(&server, &job, "limit_exceeded").await;
}
