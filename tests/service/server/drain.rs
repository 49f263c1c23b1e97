//! A process that takes in no more jobs, and ends what it has.

use std::time::{Duration, Instant};

use super::{SOON, Server, assert_problem, json};
use crate::meshes;

async fn drain(server: &Server, method: &str) -> serde_json::Value {
    let answer = server.request(method, "/v1/drain").send().await;
    json(answer.expect("an answer")).await
}

#[tokio::test]
async fn a_drained_service_ends_what_runs_and_starts_nothing() {
    let server = Server::with(&[("UNWRAPD_WORKERS", "1")]);
    let running = server.submit(meshes::hills(350), "cut=disk").await;
    let waiting = server.submit(meshes::small(), "").await;
    server.mapping(&running).await;
    let state = drain(&server, "PUT").await;
    assert_eq!(state, serde_json::json!({ "draining": true, "running": 1 }));
    for path in ["/v1/jobs", "/v1/unwrap"] {
        let refused = server.post(path).body(meshes::small()).send().await;
        assert_problem(refused.expect("an answer"), 503, "draining").await;
    }
    let ready = server.get("/readyz").send().await.expect("an answer");
    assert_problem(ready, 503, "draining").await;
    let path = running["links"]["self"].as_str().expect("a link");
    let finish = server.post(&format!("{path}/finish")).send().await;
    assert_eq!(finish.expect("an answer").status(), 202);
    assert_eq!(server.ended(&running).await["state"], "succeeded");
    while drain(&server, "GET").await["running"] != 0 {}
    let path = waiting["links"]["self"].as_str().expect("a link");
    let still = server.get(&format!("{path}?wait=2")).send().await;
    assert_eq!(json(still.expect("an answer")).await["state"], "queued");

    assert_eq!(drain(&server, "DELETE").await["draining"], false);
    assert_eq!(server.ended(&waiting).await["state"], "succeeded");
    let ready = server.get("/readyz").send().await.expect("an answer");
    assert_eq!(ready.status(), 200);
}

#[tokio::test]
async fn a_drained_service_removes_nothing() {
    // Two seconds.
    let server = Server::with(&[("UNWRAPD_RETAIN_DAYS", "0.000023")]);
    let job = server.submit(meshes::hills(350), "cut=disk").await;
    server.mapping(&job).await;
    drain(&server, "PUT").await;
    let path = job["links"]["self"].as_str().expect("a link");
    let finish = server.post(&format!("{path}/finish")).send().await;
    assert_eq!(finish.expect("an answer").status(), 202);
    assert_eq!(server.ended(&job).await["state"], "succeeded");
    // Its time is over, and that of two searches, which are a second apart.
    tokio::time::sleep(Duration::from_secs(4)).await;
    let kept = server.get(path).send().await.expect("an answer");
    assert_eq!(kept.status(), 200);

    drain(&server, "DELETE").await;
    let start = Instant::now();
    while server.get(path).send().await.expect("an answer").status() == 200 {
        assert!(start.elapsed() < SOON, "it is still there");
    }
    let gone = server.get(path).send().await.expect("an answer");
    assert_problem(gone, 410, "job_expired").await;
}

#[tokio::test]
async fn a_command_drains_the_service_on_a_folder() {
    let server = Server::with(&[("UNWRAPD_WORKERS", "1")]);
    let drain = |arguments: &[&str]| {
        let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_unwrapd"));
        command
            .arg("drain")
            .args(arguments)
            .arg("--data")
            .arg(server.data());
        command.output().expect("the binary runs")
    };
    let running = server.submit(meshes::hills(120), "").await;
    server.mapping(&running).await;
    let drained = drain(&["--wait"]);
    let said = String::from_utf8_lossy(&drained.stdout);
    assert_eq!(
        (drained.status.code(), &*said),
        (Some(0), "draining\t0 running\n")
    );
    assert_eq!(server.ended(&running).await["state"], "succeeded");
    let refused = server.post("/v1/jobs").body(meshes::small()).send().await;
    assert_problem(refused.expect("an answer"), 503, "draining").await;
    let undone = drain(&["--undo"]);
    assert_eq!(undone.status.code(), Some(0));
    let job = server.submit(meshes::small(), "").await;
    assert_eq!(server.ended(&job).await["state"], "succeeded");
    // Where nobody listens.
    let folder = tempfile::tempdir().expect("a folder");
    let nowhere = std::process::Command::new(env!("CARGO_BIN_EXE_unwrapd"))
        .args(["drain", "--data"])
        .arg(folder.path())
        .output()
        .expect("the binary runs");
    assert_eq!(nowhere.status.code(), Some(1));
}
