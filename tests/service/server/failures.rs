//! Computations that end badly, one at a time; the service goes on.

use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;
use serde_json::Value;

use crate::cli::unwrapd;
use crate::harness::memory::Memory;
use crate::meshes;
use crate::server::{Server, assert_problem, json};

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

/// Ends the computation under way, which may be about to start.
fn kill_child(server: &Server, signal: Signal) {
    loop {
        if let Some(&child) = server.children().first() {
            return kill(Pid::from_raw(child), signal).expect("a child of ours");
        }
        std::thread::yield_now();
    }
}

#[tokio::test]
async fn a_child_that_aborts_fails_its_job() {
    let server = Server::start();
    let job = server.submit(meshes::large(), "cut=disk").await;
    server.mapping(&job).await;
    kill_child(&server, Signal::SIGABRT);
    assert_failed(&server, &job, "crashed").await;
}

#[tokio::test]
async fn a_killed_child_is_tried_again_and_parked_after_three_times() {
    let server = Server::start();
    let job = server.submit(meshes::large(), "cut=disk").await;
    for attempt in 1..=3 {
        let mut running = server.mapping(&job).await;
        while running["seq"].as_u64() < Some(attempt * 1_000_000) {
            running = server.mapping(&job).await;
        }
        kill_child(&server, Signal::SIGKILL);
    }
    assert_failed(&server, &job, "worker_lost").await;
    let path = job["links"]["self"].as_str().expect("a link");
    let failed = server.get("/v1/jobs?state=failed").send().await;
    let failed = json(failed.expect("an answer")).await;
    assert_eq!(failed["jobs"][0]["error"]["code"], "worker_lost");

    let retry = async || server.post(&format!("{path}/retry")).send().await;
    let again = json(retry().await.expect("an answer")).await;
    assert_eq!(
        (&again["state"], &again["error"]),
        (&"queued".into(), &Value::Null)
    );
    let refused = retry().await.expect("an answer");
    assert_problem(refused, 409, "not_failed").await;
    server.mapping(&job).await;
    let finish = server.post(&format!("{path}/finish")).send().await;
    assert_eq!(finish.expect("an answer").status(), 202);
    assert_eq!(server.ended(&job).await["state"], "succeeded");
}

#[tokio::test]
async fn failed_jobs_are_tried_again_by_their_code() {
    let server = Server::with(&[("UNWRAPD_ATTEMPTS", "1")]);
    let flat = server.post("/v1/jobs?filename=flat.obj");
    let flat = flat.body("v 0 0 0\nv 1 0 0\nv 2 0 0\n").send().await;
    let flat = json(flat.expect("an answer")).await;
    assert_eq!(server.ended(&flat).await["state"], "failed");
    let job = server.submit(meshes::large(), "cut=disk").await;
    for by_command in [false, true] {
        server.mapping(&job).await;
        kill_child(&server, Signal::SIGKILL);
        assert_failed(&server, &job, "worker_lost").await;
        if by_command {
            let data = server.data().to_string_lossy().into_owned();
            let retry = ["queue", "retry", "--code", "worker_lost", "--data", &data];
            let output = unwrapd(&retry);
            assert_eq!(output.stdout, b"1 jobs queued again\n");
        } else {
            let retry = server.post("/v1/jobs/retry?code=worker_lost").send().await;
            let retry = retry.expect("an answer");
            assert_eq!(retry.status(), 202);
            let retried = json(retry).await;
            assert_eq!(
                (&retried["retried"], &retried["jobs"], &retried["next"]),
                (&1.into(), &serde_json::json!([job["id"]]), &Value::Null)
            );
        }
    }
    server.mapping(&job).await;
    let path = job["links"]["self"].as_str().expect("a link");
    let finish = server.post(&format!("{path}/finish")).send().await;
    assert_eq!(finish.expect("an answer").status(), 202);
    assert_eq!(server.ended(&job).await["state"], "succeeded");
    let wrong = server.post("/v1/jobs/retry?state=failed").send().await;
    assert_problem(wrong.expect("an answer"), 400, "invalid_request").await;
}

/// As when a machine is shut down, which tells every process to stop.
#[tokio::test]
async fn a_child_that_is_told_to_stop_is_no_fault_of_its_job() {
    let server = Server::with(&[("UNWRAPD_ATTEMPTS", "1")]);
    let job = server.submit(meshes::large(), "cut=disk").await;
    server.mapping(&job).await;
    kill_child(&server, Signal::SIGTERM);
    let mut running = server.mapping(&job).await;
    while running["seq"].as_u64() < Some(2_000_000) {
        running = server.mapping(&job).await;
    }
    let path = job["links"]["self"].as_str().expect("a link");
    let finish = server.post(&format!("{path}/finish")).send().await;
    assert_eq!(finish.expect("an answer").status(), 202);
    let ended = server.ended(&job).await;
    assert_eq!(
        (&ended["state"], &ended["attempt"]),
        (&"succeeded".into(), &2.into())
    );
}

#[tokio::test]
async fn a_mesh_that_needs_too_much_memory_fails_alone() {
    let server = Server::with(&[("UNWRAPD_JOB_MEMORY_MIB", "64")]);
    let job = server.submit(meshes::large(), "cut=disk").await;
    assert_failed(&server, &job, "out_of_memory").await;
}

/// The service needs less than the group has, and the mesh more; its own limit would let it have that.
#[tokio::test]
async fn a_child_that_the_system_ends_for_its_memory_says_so() {
    let Some(group) = Memory::limited_to(96 << 20) else {
        return;
    };
    let server = Server::start();
    group.take(server.process_id());
    let job = server.submit(meshes::large(), "cut=disk").await;
    assert_failed(&server, &job, "out_of_memory").await;
    let detail = server.ended(&job).await["error"]["detail"].clone();
    let detail = detail.as_str().expect("text");
    assert!(detail.starts_with("the system ended it"), "{detail}");
    drop((server, group));
}

#[tokio::test]
async fn a_mesh_that_takes_too_long_ends_with_the_map_it_has() {
    let server = Server::with(&[("UNWRAPD_JOB_SECONDS", "0.02")]);
    let job = server.submit(meshes::hills(100), "cut=disk").await;
    let job = server.ended(&job).await;
    assert_eq!(job["state"], "succeeded", "{job}");
    let warnings = job["warnings"].as_array().expect("a list");
    let is_told = |warning: &Value| warning["code"] == "ended_early";
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
