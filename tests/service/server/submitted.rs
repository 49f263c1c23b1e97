//! `unwrapd submit`: a run whose work a real service does.

use std::fs;
use std::process::{Child, Stdio};

use serde_json::Value;

use super::{Server, json};
use crate::bulk::Folders;
use crate::cli::{assert_status, last_error, unwrapd};

/// All jobs of a service.
async fn jobs(server: &Server) -> Vec<Value> {
    let answer = server.get("/v1/jobs?limit=200").send().await;
    let page = json(answer.expect("an answer")).await;
    page["jobs"].as_array().expect("jobs").clone()
}

#[tokio::test]
async fn a_service_makes_the_same_files_once() {
    let server = Server::start();
    let url = server.url("");
    let folders = Folders::with(&["a.obj", "b/c.obj"]);
    folders.write("in/bad.obj", "v 0 0 0\n");
    let extras = ["--report", "--heatmap", "--format", "gltf"];
    assert_status(&folders.submit(&url, &extras), 4);
    let row = folders.summary("summary.csv")["bad.obj"].clone();
    assert_eq!(row["code"], "no_triangles");
    let outputs = [
        "a.bin",
        "a.gltf",
        "a.heatmap.png",
        "a.report.json",
        "b/c.bin",
        "b/c.gltf",
        "b/c.heatmap.png",
        "b/c.report.json",
    ];
    assert_eq!(folders.outputs(), outputs);
    assert_eq!(jobs(&server).await.len(), 3);

    let before = folders.written();
    assert_status(&folders.submit(&url, &extras), 4);
    assert_eq!(folders.written(), before);
    // The command does not distinguish who did the work: the version is the same.
    assert_status(&folders.batch(&extras), 4);
    assert_eq!(folders.written(), before);
    assert_eq!(jobs(&server).await.len(), 3);
    assert_status(
        &folders.submit(&url, &["--retry-failed", "--format", "gltf"]),
        4,
    );

    let there = |name: &str| fs::read(folders.path(name)).expect("an output");
    let served = ["out/a.bin", "out/b/c.gltf"].map(there);
    fs::remove_dir_all(folders.path("out")).expect("a folder");
    assert_status(&folders.batch(&extras), 4);
    assert!(served == ["out/a.bin", "out/b/c.gltf"].map(there));
}

#[tokio::test]
async fn a_failed_job_is_made_again_only_on_request() {
    let server = Server::start();
    let folders = Folders::with(&[]);
    folders.write("in/bad.obj", "v 0 0 0\n");
    for (arguments, count) in [
        (&[][..], 1),
        (&[][..], 1),
        (&["--retry-failed"], 2),
        (&["--retry-failed"], 3),
    ] {
        assert_status(&folders.submit(&server.url(""), arguments), 4);
        assert_eq!(jobs(&server).await.len(), count);
    }
}

#[tokio::test]
async fn a_copy_can_be_refused() {
    let server = Server::start();
    let folders = Folders::of(1);
    for (arguments, count, cached) in [
        (&[][..], 1, false),
        // Another submission of the same.
        (&["--report"], 2, true),
        (&["--report", "--no-cache"], 3, false),
        // The same submission.
        (&["--report", "--no-cache"], 3, false),
    ] {
        assert_status(&folders.submit(&server.url(""), arguments), 0);
        let jobs = jobs(&server).await;
        assert_eq!(jobs.len(), count, "{arguments:?}");
        assert_eq!(jobs[0]["cached"], cached, "{arguments:?}");
        fs::remove_dir_all(folders.path("out")).expect("a folder");
    }
}

#[tokio::test]
async fn a_killed_run_finds_its_jobs_again() {
    const COUNT: usize = 4;
    let server = Server::start();
    let folders = Folders::of(COUNT);
    let mut command = folders.submission(&server.url(""), &["--jobs", "3"]);
    let mut run: Child = command
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("the binary runs");
    // Three are submitted, one may be ended.
    while jobs(&server).await.len() < 3 {
        tokio::task::yield_now().await;
    }
    run.kill().expect("it runs");
    run.wait().expect("an end");
    assert_status(&folders.submit(&server.url(""), &[]), 0);
    assert_eq!(folders.outputs().len(), COUNT);
    let jobs = jobs(&server).await;
    assert_eq!(jobs.len(), COUNT, "none twice");
    assert!(jobs.iter().all(|job| job["attempt"] == 1));
}

#[test]
fn addresses_without_a_service_are_refused() {
    let folders = Folders::of(1);
    let closed = std::net::TcpListener::bind("127.0.0.1:0").expect("a port");
    let address = closed.local_addr().expect("an address");
    drop(closed);
    for (server, status, words) in [
        ("nowhere".to_owned(), 2, "is not the address of a service"),
        (
            "ftp://a".to_owned(),
            2,
            "does not begin with http:// or https://",
        ),
        (format!("http://{address}"), 1, "no service answers at"),
    ] {
        let run = folders.submit(&server, &[]);
        assert_status(&run, status);
        assert!(last_error(&run).contains(words), "{}", last_error(&run));
    }
    let (input, out) = (folders.text("in"), folders.text("out"));
    assert_status(&unwrapd(&["submit", &input, "-o", &out]), 2);
    assert!(!folders.path("out").exists());
}
