//! Nobody waits for others longer than they must, and the queue waits when it is told to.

use serde_json::Value;

use super::{Server, json};
use crate::cli::{assert_status, unwrapd};
use crate::meshes;

async fn state(server: &Server, job: &Value, query: &str) -> String {
    let path = job["links"]["self"].as_str().expect("a link");
    let answer = server.get(&format!("{path}{query}")).send().await;
    let job = json(answer.expect("an answer")).await;
    job["state"].as_str().expect("a word").to_owned()
}

#[tokio::test]
async fn small_jobs_do_not_wait_for_large_ones() {
    let server = Server::with(&[("UNWRAPD_WORKERS", "1"), ("UNWRAPD_SMALL_KIB", "64")]);
    let large = server.submit(meshes::hills(500), "cut=disk").await;
    let second = server.submit(meshes::hills(251), "cut=disk").await;
    server.mapping(&large).await;
    let small = server.submit(meshes::small(), "").await;
    assert_eq!(server.ended(&small).await["state"], "succeeded");
    assert_eq!(state(&server, &large, "").await, "running");
    assert_eq!(state(&server, &second, "").await, "queued");
}

fn queue(server: &Server, arguments: &[&str]) -> String {
    let data = server.data().to_string_lossy().into_owned();
    let output = unwrapd(&[&["queue"], arguments, &["--data", &data]].concat());
    assert_status(&output, 0);
    String::from_utf8(output.stdout).expect("text")
}

#[tokio::test]
async fn a_paused_queue_starts_nothing_and_accepts_all() {
    let server = Server::start();
    let pause = async |method| {
        let answer = server.request(method, "/v1/pause").send().await;
        json(answer.expect("an answer")).await["paused"].clone()
    };
    assert_eq!(pause("GET").await, false);
    assert_eq!(pause("PUT").await, true);
    let job = server.submit(meshes::small(), "").await;
    assert_eq!(state(&server, &job, "?wait=1").await, "queued");
    let status: Value = serde_json::from_str(&queue(&server, &["status", "--json"])).expect("JSON");
    assert_eq!(
        (&status["paused"], &status["jobs"]["queued"]),
        (&true.into(), &1.into())
    );
    queue(&server, &["resume"]);
    assert_eq!(server.ended(&job).await["state"], "succeeded");
    assert_eq!(pause("GET").await, false);
    queue(&server, &["pause"]);
    assert_eq!(pause("GET").await, true);
    assert_eq!(pause("DELETE").await, false);
}
