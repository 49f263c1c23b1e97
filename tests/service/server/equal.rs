//! Equal submissions: computed once, unless a client wants it otherwise.

use std::path::Path;
use std::time::Instant;

use serde_json::Value;

use super::{Server, json};
use crate::harness::program;
use crate::meshes;
use crate::server::{SOON, assert_problem};

fn path(job: &Value) -> &str {
    job["links"]["self"].as_str().expect("a link")
}

/// The files of a job, by what follows its path in their links.
async fn files(server: &Server, job: &Value) -> Vec<(String, Vec<u8>)> {
    let mut files = Vec::new();
    for file in job["links"]["files"].as_array().expect("links") {
        let href = file["href"].as_str().expect("a link");
        let answer = server.get(href).send().await.expect("an answer");
        assert_eq!(answer.status(), 200);
        let bytes = answer.bytes().await.expect("a whole file").to_vec();
        files.push((href.replace(path(job), ""), bytes));
    }
    files
}

#[tokio::test]
async fn an_equal_job_gets_a_copy_of_its_own() {
    let server = Server::start();
    let first = server.submit(meshes::small(), "filename=a.glb").await;
    let first = server.ended(&first).await;
    assert_eq!(
        (&first["cached"], &first["attempt"]),
        (&false.into(), &1.into())
    );
    let copy = server.submit(meshes::small(), "filename=a.glb").await;
    assert_eq!(
        (&copy["cached"], &copy["attempt"]),
        (&true.into(), &0.into())
    );
    assert_ne!(copy["id"], first["id"]);
    for field in ["state", "progress", "certified", "warnings", "options"] {
        assert_eq!(copy[field], first[field], "{field}");
    }
    let made = files(&server, &first).await;
    assert!(made.len() > 3);
    assert!(files(&server, &copy).await == made);

    let deleted = server.request("DELETE", path(&first)).send().await;
    assert_eq!(deleted.expect("an answer").status(), 204);
    assert!(files(&server, &copy).await == made);
    // The copy serves as well as the original.
    let next = server.submit(meshes::small(), "filename=a.glb").await;
    assert_eq!(next["cached"], true);
    assert!(files(&server, &next).await == made);
}

#[tokio::test]
async fn what_differs_or_is_to_be_new_is_computed() {
    let server = Server::start();
    let first = server.submit(meshes::small(), "").await;
    server.ended(&first).await;
    for query in ["resolution=512", "filename=other.glb", "kind=measure"] {
        let other = server.submit(meshes::small(), query).await;
        assert_eq!(other["cached"], false, "{query}");
        assert_eq!(server.ended(&other).await["attempt"], 1, "{query}");
    }
    let new = server
        .post("/v1/jobs")
        .header("cache-control", "max-age=0, No-Cache");
    let new = new.body(meshes::small()).send().await.expect("an answer");
    let new = json(new).await;
    assert_eq!(server.ended(&new).await["attempt"], 1);
}

#[tokio::test]
async fn what_was_cut_short_is_computed_again() {
    let server = Server::start();
    let first = server.submit(meshes::hills(250), "cut=disk").await;
    server.mapping(&first).await;
    let finish = server
        .post(&format!("{}/finish", path(&first)))
        .send()
        .await;
    assert_eq!(finish.expect("an answer").status(), 202);
    let first = server.ended(&first).await;
    assert_eq!(first["warnings"][0]["code"], "ended_early");
    let again = server.submit(meshes::hills(250), "cut=disk").await;
    assert_eq!(again["cached"], false);
}

#[tokio::test]
async fn a_copy_that_fails_is_computed() {
    let server = Server::start();
    let first = server.submit(meshes::small(), "").await;
    server.ended(&first).await;
    let id = first["id"].as_str().expect("an id");
    let folder = server.data().join("blobs").join(id).join("output-1");
    std::fs::remove_dir_all(folder).expect("its files");
    let next = server.submit(meshes::small(), "").await;
    assert_eq!(next["cached"], false);
    let next = server.ended(&next).await;
    assert_eq!(next["state"], "succeeded");
    assert!(!files(&server, &next).await.is_empty());
}

#[tokio::test]
async fn a_call_gets_the_result_of_an_equal_job() {
    let server = Server::start();
    let job = server.submit(meshes::small(), "").await;
    let job = server.ended(&job).await;
    let call = server.post("/v1/unwrap").body(meshes::small()).send().await;
    let call = call.expect("an answer");
    assert_eq!(call.headers()["unwrapd-certified"], "true");
    let bytes = call.bytes().await.expect("a mesh");
    let result = format!("{}/result", path(&job));
    let result = server.get(&result).send().await.expect("an answer");
    assert_eq!(result.bytes().await.expect("a mesh"), bytes);
}

/// Bytes that the server has read so far.
fn bytes_read(server: &Server) -> u64 {
    let counts = Path::new("/proc").join(server.process_id().to_string());
    let counts = std::fs::read_to_string(counts.join("io")).expect("counts");
    let mut lines = counts.lines();
    let read = lines.find_map(|line| line.strip_prefix("rchar: "));
    read.expect("a line").parse().expect("a number")
}

#[test]
fn the_program_is_read_before_the_first_job_comes() {
    let server = Server::start();
    let size = std::fs::metadata(program()).expect("a file").len();
    let start = Instant::now();
    while bytes_read(&server) < size {
        assert!(start.elapsed() < SOON, "{} bytes", bytes_read(&server));
        std::thread::yield_now();
    }
}

/// The inode of the first output: a copy is another name of the same file.
#[tokio::test]
async fn copies_take_no_space() {
    use std::os::unix::fs::MetadataExt;
    let server = Server::start();
    let first = server.submit(meshes::small(), "").await;
    server.ended(&first).await;
    let copy = server.submit(meshes::small(), "").await;
    let inode = |job: &Value, folder: &str| {
        let id = Path::new(job["id"].as_str().expect("an id")).join(folder);
        let file = server.data().join("blobs").join(id).join("0");
        std::fs::metadata(file).expect("a file").ino()
    };
    assert_eq!(inode(&copy, "output"), inode(&first, "output-1"));
}

#[tokio::test]
async fn a_higher_priority_goes_first() {
    let server = Server::with(&[("UNWRAPD_WORKERS", "0")]);
    for priority in ["101", "1.5", "high", ""] {
        let refused = server.post(&format!("/v1/jobs?priority={priority}"));
        let refused = refused.body(meshes::small()).send().await;
        assert_problem(refused.expect("an answer"), 400, "invalid_request").await;
    }
    let low = server.submit(meshes::small(), "priority=-1").await;
    let normal = server.submit(meshes::small(), "resolution=512").await;
    let high = server
        .submit(meshes::small(), "priority=100&resolution=256")
        .await;
    assert_eq!(
        (&low["priority"], &normal["priority"]),
        (&(-1).into(), &0.into())
    );
    let mut server = server;
    server.kill();
    server.restart_with(&[("UNWRAPD_WORKERS", "1")]);
    let mut starts = Vec::new();
    for job in [&high, &normal, &low] {
        let job = server.ended(job).await;
        starts.push(job["started_at"].as_str().expect("a time").to_owned());
    }
    assert!(starts.is_sorted(), "{starts:?}");
}
