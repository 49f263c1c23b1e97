//! A disk that is full, and then is not.

use std::fs;
use std::path::Path;
use std::process::Command;
use std::time::Instant;

use serde_json::Value;
use tempfile::TempDir;

use crate::harness::disk::Disk;
use crate::meshes;
use crate::server::{SOON, Server, assert_problem, json, owned};

fn path(job: &Value) -> &str {
    job["links"]["self"].as_str().expect("a link")
}

fn is_healthy(server: &Server) -> bool {
    let health = Command::new(env!("CARGO_BIN_EXE_unwrapd"))
        .args(["health", "--data"])
        .arg(server.data())
        .output();
    health.expect("it runs").status.success()
}

/// What is refused, what still works.
async fn refuses_and_deletes(server: &Server, ended: &Value) {
    let ready = server.get("/readyz").send().await.expect("an answer");
    let problem = assert_problem(ready, 503, "not_ready").await;
    assert!(problem["detail"].as_str().expect("text").contains("MiB"));
    assert!(!is_healthy(server));
    for path in ["/v1/jobs", "/v1/unwrap"] {
        let refused = server.post(path).body(meshes::small()).send().await;
        assert_problem(refused.expect("an answer"), 507, "storage_full").await;
    }
    let alive = server.get("/healthz").send().await.expect("an answer");
    assert_eq!(alive.status(), 200);
    let read = server.get(&format!("{}/result", path(ended))).send().await;
    assert_eq!(read.expect("an answer").status(), 200);
    let deleted = server.request("DELETE", path(ended)).send().await;
    assert_eq!(deleted.expect("an answer").status(), 204);
    let files = server.owners_of_files();
    assert!(!files.contains(&ended["id"].as_str().expect("an id").to_owned()));
}

#[tokio::test]
async fn a_full_disk_is_told_and_everything_goes_on_when_there_is_space() {
    let Some(disk) = Disk::mount(48) else { return };
    let data = TempDir::new_in(disk.folder()).expect("a folder");
    let settings = [("UNWRAPD_MIN_FREE_MIB", "2"), ("UNWRAPD_WORKERS", "1")];
    let server = Server::on(data, &owned(&settings));
    let ended = server.submit(meshes::small(), "").await;
    let ended = server.ended(&ended).await;
    let running = server.submit(meshes::large(), "cut=disk").await;
    let waiting = server.submit(meshes::small(), "resolution=500").await;
    let cancelled = server.submit(meshes::small(), "resolution=501").await;
    server.mapping(&running).await;
    disk.fill();
    refuses_and_deletes(&server, &ended).await;
    disk.fill();
    let wished = server.request("DELETE", path(&cancelled)).send().await;
    assert_eq!(json(wished.expect("an answer")).await["state"], "cancelled");
    disk.fill();
    let finish = format!("{}/finish", path(&running));
    let finish = server.post(&finish).send().await.expect("an answer");
    assert_eq!(finish.status(), 202);
    // It has nowhere to put its result.
    let start = Instant::now();
    while json(server.get(path(&running)).send().await.expect("an answer")).await["state"]
        != "queued"
    {
        assert!(start.elapsed() < SOON, "it still runs");
        tokio::task::yield_now().await;
    }

    disk.free();
    let ready = server.get("/readyz").send().await.expect("an answer");
    assert_eq!(ready.status(), 200);
    let new = server.submit(meshes::small(), "resolution=502").await;
    for job in [&running, &waiting, &new] {
        let job = server.ended(job).await;
        assert_eq!(job["state"], "succeeded", "{job}");
    }
    assert!(is_healthy(&server));
}

#[tokio::test]
async fn a_quota_refuses_what_exceeds_it_until_something_is_deleted() {
    let server = Server::with(&[("UNWRAPD_QUOTA_MIB", "1")]);
    let job = server.submit(meshes::hills(60), "").await;
    let job = server.ended(&job).await;
    let metrics = server.get("/metrics").send().await.expect("an answer");
    let metrics = metrics.text().await.expect("text");
    assert!(
        metrics.contains("unwrapd_quota_bytes 1048576\n"),
        "{metrics}"
    );
    let stored = bytes_of_jobs(&server);
    assert!(metrics.contains(&format!("unwrapd_stored_bytes {stored}\n")));
    let large = server.post("/v1/jobs").body(meshes::hills(250)).send();
    assert_problem(large.await.expect("an answer"), 507, "storage_full").await;
    let deleted = server.request("DELETE", path(&job)).send().await;
    assert_eq!(deleted.expect("an answer").status(), 204);
    assert_eq!(bytes_of_jobs(&server), 0);
    server.submit(meshes::small(), "").await;
}

/// Bytes in the folders of jobs; the identity of the store lies beside them.
fn bytes_of_jobs(server: &Server) -> u64 {
    let entries = fs::read_dir(server.data().join("blobs")).expect("a folder");
    let folders = entries.flatten().map(|entry| entry.path());
    let folders = folders.filter(|path| path.is_dir());
    folders.map(|folder| bytes_below(&folder)).sum()
}

fn bytes_below(folder: &Path) -> u64 {
    let entries = fs::read_dir(folder).expect("a folder").flatten();
    let bytes = entries.map(|entry| match entry.metadata().expect("metadata") {
        metadata if metadata.is_dir() => bytes_below(&entry.path()),
        metadata => metadata.len(),
    });
    bytes.sum()
}
