//! What is accepted is not lost.

use std::time::Instant;

use crate::meshes;
use crate::server::{SOON, Server, json};

#[tokio::test]
async fn a_killed_server_leaves_no_child_and_its_job_completes_once() {
    let mut server = Server::start();
    let running = server.submit(meshes::large(), "cut=disk").await;
    server.mapping(&running).await;
    let mut waiting = Vec::new();
    for _ in 0..2 {
        waiting.push(server.submit(meshes::small(), "").await);
    }
    assert!(!server.children().is_empty());
    server.kill();
    let start = Instant::now();
    while !server.children().is_empty() {
        assert!(start.elapsed() < SOON, "an orphan is left");
        tokio::task::yield_now().await;
    }

    // What an attempt stores before it is lost is of no use.
    let id = running["id"].as_str().expect("an id");
    let files = server.data().join("blobs").join(id);
    std::fs::create_dir(files.join("output-1")).expect("a folder");
    std::fs::write(files.join("output-1/0"), "a result").expect("a file");

    server.restart();
    let ended = server.ended(&running).await;
    assert_eq!(
        (&ended["state"], &ended["attempt"]),
        (&"succeeded".into(), &2.into()),
        "{ended}"
    );
    assert!(!files.join("output-1").exists());
    for job in &waiting {
        assert_eq!(server.ended(job).await["state"], "succeeded");
    }
    let all = json(server.get("/v1/jobs").send().await.expect("an answer")).await;
    assert_eq!(all["jobs"].as_array().map(Vec::len), Some(3));
    assert_eq!(server.children(), Vec::<i32>::new());
}

#[tokio::test]
async fn a_job_is_not_to_blame_for_a_server_that_is_lost_three_times() {
    let mut server = Server::start();
    let job = server.submit(meshes::large(), "cut=disk").await;
    for _ in 0..3 {
        server.mapping(&job).await;
        server.kill();
        server.restart();
    }
    server.mapping(&job).await;
    let path = job["links"]["self"].as_str().expect("a link");
    let finish = server.post(&format!("{path}/finish")).send().await;
    assert_eq!(finish.expect("an answer").status(), 202);
    let ended = server.ended(&job).await;
    assert_eq!(
        (&ended["state"], &ended["attempt"]),
        (&"succeeded".into(), &4.into()),
        "{ended}"
    );
}

#[tokio::test]
async fn two_servers_do_not_share_a_folder() {
    let server = Server::start();
    let second = std::process::Command::new(env!("CARGO_BIN_EXE_unwrapd"))
        .args(["serve", "--listen", "127.0.0.1:0", "--data"])
        .arg(server.data())
        .output()
        .expect("it runs");
    assert_eq!(second.status.code(), Some(1));
    let said = String::from_utf8_lossy(&second.stderr).into_owned();
    assert!(said.contains("another server uses"), "{said}");
}
