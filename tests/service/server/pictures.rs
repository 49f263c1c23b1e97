//! Pictures of results: drawn when they are first asked for, kept, and drawn again when they are damaged.

use std::path::PathBuf;

use futures_util::future::join_all;
use serde_json::Value;

use crate::cli::unwrapd;
use crate::meshes;
use crate::server::{Server, assert_problem};

const PICTURES: [&str; 3] = ["layout.png", "heatmap.png", "thumbnail.png"];

async fn unwrapped(server: &Server, query: &str) -> Value {
    let job = server.submit(meshes::small(), query).await;
    let job = server.ended(&job).await;
    assert_eq!(job["state"], "succeeded", "{job}");
    job
}

fn path(job: &Value, name: &str) -> String {
    format!("{}/{name}", job["links"]["self"].as_str().expect("a link"))
}

async fn picture(server: &Server, job: &Value, name: &str) -> Vec<u8> {
    let answer = server.get(&path(job, name)).send().await;
    let answer = answer.expect("an answer");
    assert_eq!(answer.status(), 200, "{name}");
    answer.bytes().await.expect("bytes").into()
}

/// The stored pictures of a job.
fn stored(server: &Server, job: &Value) -> Vec<PathBuf> {
    let id = job["id"].as_str().expect("an id");
    let folder = server.data().join("blobs").join(id).join("output-1");
    let files = std::fs::read_dir(folder).expect("a folder");
    let paths = files.map(|file| file.expect("an entry").path());
    paths
        .filter(|path| path.extension().is_some_and(|it| it == "png"))
        .collect()
}

/// The sizes of the pictures, as the job lists them.
async fn sizes(server: &Server, job: &Value) -> Vec<Option<u64>> {
    let job = server.get(&path(job, "")[..path(job, "").len() - 1]);
    let job: Value = (job.send().await.expect("an answer"))
        .json()
        .await
        .expect("JSON");
    let files = job["links"]["files"].as_array().expect("files").clone();
    let size = |name: &&str| {
        let file = files.iter().find(|file| file["name"] == **name);
        file.expect("it is listed")["bytes"].as_u64()
    };
    PICTURES.iter().map(size).collect()
}

/// Nobody pays for pictures that nobody looks at, and they are what the command draws.
#[tokio::test]
async fn pictures_are_drawn_when_they_are_asked_for() {
    let server = Server::start();
    let job = unwrapped(&server, "").await;
    assert_eq!(stored(&server, &job), [] as [PathBuf; 0]);
    assert_eq!(sizes(&server, &job).await, [None; 3]);

    let folder = tempfile::tempdir().expect("a folder");
    let file = |name: &str| folder.path().join(name).display().to_string();
    std::fs::write(file("in.glb"), meshes::small()).expect("a file");
    let made = unwrapd(&[
        "unwrap",
        &file("in.glb"),
        "-o",
        &file("out.glb"),
        "--layout",
        &file("layout.png"),
        "--heatmap",
        &file("heatmap.png"),
    ]);
    assert!(made.status.success());
    for name in ["layout.png", "heatmap.png"] {
        let expected = std::fs::read(file(name)).expect("a picture");
        assert!(picture(&server, &job, name).await == expected, "{name}");
    }
    assert_eq!(stored(&server, &job).len(), 2);
    let [layout, heatmap, thumbnail] = sizes(&server, &job).await[..] else {
        panic!("three pictures");
    };
    assert!(layout.is_some() && heatmap.is_some() && thumbnail.is_none());
}

/// The second time, the file is there: no child starts, even where none could.
#[tokio::test]
async fn a_picture_is_kept() {
    let mut server = Server::start();
    let job = unwrapped(&server, "").await;
    let mut drawn = Vec::new();
    for name in PICTURES {
        drawn.push(picture(&server, &job, name).await);
    }
    let inodes = |server: &Server| {
        let files = stored(server, &job).into_iter();
        let mut inodes: Vec<u64> = files
            .map(|file| std::os::unix::fs::MetadataExt::ino(&file.metadata().expect("a file")))
            .collect();
        inodes.sort_unstable();
        inodes
    };
    let before = inodes(&server);
    assert_eq!(before.len(), 3);
    server.kill();
    server.restart();
    for (name, drawn) in PICTURES.iter().zip(drawn) {
        assert!(picture(&server, &job, name).await == drawn, "{name}");
    }
    assert_eq!(inodes(&server), before, "drawn again");
    let folder = server.data().join("scratch");
    assert_eq!(std::fs::read_dir(folder).expect("a folder").count(), 0);
}

#[tokio::test]
async fn concurrent_requests_draw_once() {
    let server = Server::start();
    let job = unwrapped(&server, "").await;
    let asked = (0..16).map(|_| picture(&server, &job, "heatmap.png"));
    let mut scratch = 0;
    let watch = async {
        let folder = server.data().join("scratch");
        for _ in 0..50 {
            let folders = std::fs::read_dir(&folder).expect("a folder").count();
            scratch = scratch.max(folders);
            tokio::time::sleep(std::time::Duration::from_millis(5)).await;
        }
    };
    let (drawn, ()) = tokio::join!(join_all(asked), watch);
    assert!(drawn.iter().all(|png| *png == drawn[0]));
    assert!(scratch <= 1, "{scratch} children at once");
    assert_eq!(stored(&server, &job).len(), 1);
}

/// Whoever deletes a job while a picture of it is drawn leaves nothing.
#[tokio::test]
async fn a_job_that_goes_while_it_is_drawn_leaves_nothing() {
    let server = Server::start();
    for wait_ms in [0, 20, 40, 80, 160] {
        let job = unwrapped(&server, &format!("padding={}", 2 + wait_ms / 20)).await;
        let link = path(&job, "layout.png");
        let asked = server.get(&link).send();
        let deleted = async {
            tokio::time::sleep(std::time::Duration::from_millis(wait_ms)).await;
            let itself = job["links"]["self"].as_str().expect("a link");
            let answer = server.request("DELETE", itself).send().await;
            assert_eq!(answer.expect("an answer").status(), 204);
        };
        let (answer, ()) = tokio::join!(asked, deleted);
        let answer = answer.expect("an answer");
        if answer.status() != 200 {
            let code = answer.json::<Value>().await.expect("a problem")["code"].clone();
            assert!(code == "job_not_found" || code == "missing_file", "{code}");
        }
        let again = server.get(&link).send().await.expect("an answer");
        assert_problem(again, 404, "job_not_found").await;
        assert_eq!(server.owners_of_files(), [] as [String; 0], "{wait_ms} ms");
    }
}

#[tokio::test]
async fn a_damaged_picture_is_drawn_again() {
    let server = Server::start();
    let job = unwrapped(&server, "").await;
    let drawn = picture(&server, &job, "layout.png").await;
    let [file] = &stored(&server, &job)[..] else {
        panic!("one picture");
    };
    let mut damaged = drawn.clone();
    let middle = damaged.len() / 2;
    damaged[middle] ^= 1;
    std::fs::write(file, damaged).expect("a file");
    assert!(picture(&server, &job, "layout.png").await == drawn);
    assert!(std::fs::read(file).expect("a file") == drawn);
    std::fs::remove_file(file).expect("a file");
    assert!(picture(&server, &job, "layout.png").await == drawn);
    assert_eq!(stored(&server, &job).len(), 1);
}

/// A damaged result is not drawn.
#[tokio::test]
async fn nothing_is_drawn_of_a_damaged_result() {
    let server = Server::start();
    let job = unwrapped(&server, "").await;
    let id = job["id"].as_str().expect("an id");
    let result = server.data().join("blobs").join(id).join("output-1/0");
    let mut bytes = std::fs::read(&result).expect("a file");
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    std::fs::write(&result, bytes).expect("a file");
    let answer = server.get(&path(&job, "layout.png")).send().await;
    assert_problem(answer.expect("an answer"), 500, "damaged_file").await;
}

/// A process that computes no jobs draws: it is small work.
#[tokio::test]
async fn a_process_without_workers_draws() {
    let mut server = Server::start();
    let job = unwrapped(&server, "").await;
    server.kill();
    server.restart_with(&[("UNWRAPD_WORKERS", "0"), ("UNWRAPD_SMALL_KIB", "0")]);
    for name in PICTURES {
        assert!(picture(&server, &job, name).await.starts_with(b"\x89PNG"));
    }
}
