//! Inputs and results as one ZIP.

use std::io::{Cursor, Read, Write};
use std::sync::Arc;

use reqwest::Response;
use reqwest::multipart::{Form, Part};
use serde_json::{Value, json as object};
use unwrapd::http::Crowds;
use zip::write::SimpleFileOptions;
use zip::{ZipArchive, ZipWriter};

use crate::meshes;
use crate::server::{Server, assert_problem, json};

fn zipped(files: &[(&str, &[u8])]) -> Vec<u8> {
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, content) in files {
        let options = SimpleFileOptions::default();
        archive.start_file(*name, options).expect("a file");
        archive.write_all(content).expect("memory");
    }
    archive.finish().expect("an archive").into_inner()
}

/// A triangle whose positions are in a file beside it.
fn triangle() -> (String, Vec<u8>) {
    let positions = [0.0_f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    let gltf = object!({
        "asset": { "version": "2.0" },
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 } }] }],
        "accessors": [{ "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
            "min": [0, 0, 0], "max": [1, 1, 0] }],
        "bufferViews": [{ "buffer": 0, "byteLength": 36 }],
        "buffers": [{ "byteLength": 36, "uri": "data/a%20b.bin" }],
    });
    let bytes = positions.into_iter().flat_map(f32::to_le_bytes).collect();
    (gltf.to_string(), bytes)
}

async fn posted(server: &Server, archive: Vec<u8>) -> Response {
    let request = server.post("/v1/jobs?format=gltf");
    let request = request.header("content-type", "application/zip");
    request.body(archive).send().await.expect("an answer")
}

fn names(files: &Value) -> Vec<&str> {
    let files = files.as_array().expect("files").iter();
    files.filter_map(|file| file["name"].as_str()).collect()
}

#[tokio::test]
async fn an_archive_brings_an_input_and_takes_all_results() {
    let server = Server::start();
    let (gltf, bytes) = triangle();
    let archive = zipped(&[
        ("__MACOSX/model/._scene.gltf", b"x"),
        ("all/model/data/a b.bin", &bytes),
        ("all/model/scene.gltf", gltf.as_bytes()),
    ]);
    let job = server
        .ended(&json(posted(&server, archive).await).await)
        .await;
    assert_eq!(job["state"], "succeeded", "{job}");
    let inputs = names(&job["links"]["inputs"]);
    assert_eq!(inputs, ["scene.gltf", "data/a b.bin"]);
    let base = job["links"]["self"].as_str().expect("a link");
    let answer = server.get(&format!("{base}/files.zip")).send().await;
    let answer = answer.expect("an answer");
    assert_eq!(answer.headers()["content-type"], "application/zip");
    let all = answer.bytes().await.expect("all bytes");
    let mut archive = ZipArchive::new(Cursor::new(all)).expect("an archive");
    let files = job["links"]["files"].as_array().expect("files");
    assert_eq!(archive.len(), files.len());
    for file in files {
        let name = file["name"].as_str().expect("a name");
        let mut packed = Vec::new();
        let mut entry = archive.by_name(name).expect(name);
        entry.read_to_end(&mut packed).expect("bytes");
        let alone = server
            .get(file["href"].as_str().expect("a link"))
            .send()
            .await;
        let alone = alone.expect("an answer").bytes().await.expect("bytes");
        assert_eq!(packed, alone, "{name}");
    }
    // The same files in a form are the same job.
    let again = zipped(&[("scene.gltf", gltf.as_bytes()), ("data/a b.bin", &bytes)]);
    assert_eq!(json(posted(&server, again).await).await["cached"], true);
    assert_eq!(scratch(&server), 0);
}

fn scratch(server: &Server) -> usize {
    let folder = std::fs::read_dir(server.data().join("scratch"));
    folder.expect("a folder").count()
}

#[tokio::test]
async fn an_archive_of_nothing_usable_is_refused() {
    let server = Server::start();
    let obj = meshes::TRIANGLE.as_bytes();
    let mut damaged = zipped(&[("a.obj", obj)]);
    let middle = damaged.len() / 2;
    damaged[middle..].fill(0);
    for (archive, status, code) in [
        (zipped(&[]), 400, "missing_mesh"),
        (zipped(&[("read.me", b"hello")]), 400, "missing_mesh"),
        (
            zipped(&[("a.obj", obj), ("b.obj", obj)]),
            422,
            "invalid_archive",
        ),
        (zipped(&[("../../a.obj", obj)]), 422, "invalid_archive"),
        (damaged, 422, "invalid_archive"),
    ] {
        assert_problem(posted(&server, archive).await, status, code).await;
    }
    let job = server.submit(meshes::large(), "").await;
    let path = format!(
        "{}/files.zip",
        job["links"]["self"].as_str().expect("a link")
    );
    let early = server.get(&path).send().await.expect("an answer");
    assert_problem(early, 409, "not_finished").await;
    assert_eq!(server.owners_of_files().len(), 1);
}

#[tokio::test]
async fn what_an_archive_grows_to_is_counted() {
    let server = Server::with(&[("UNWRAPD_MAX_UPLOAD_MIB", "1")]);
    let content = vec![b'#'; 4 << 20];
    let honest = zipped(&[("a.obj", &content)]);
    assert!(honest.len() < 1 << 16);
    // It says that there are 100 bytes, in both places.
    let mut lying = honest.clone();
    let size = (content.len() as u32).to_le_bytes();
    let places: Vec<usize> = (0..lying.len() - 4)
        .filter(|&at| lying[at..at + 4] == size)
        .collect();
    assert_eq!(places.len(), 2);
    for at in places {
        lying[at..at + 4].copy_from_slice(&100_u32.to_le_bytes());
    }
    assert_problem(posted(&server, honest).await, 413, "upload_too_large").await;
    assert_problem(posted(&server, lying).await, 422, "invalid_archive").await;
    assert_eq!((scratch(&server), server.owners_of_files().len()), (0, 0));
}

#[tokio::test]
async fn an_owner_receives_only_so_many_archives_at_a_time() {
    let server = Server::start();
    let (gltf, bytes) = triangle();
    // More than the buffers of a connection take: who does not read it keeps the archive.
    let note = "x".repeat(16 << 20);
    let gltf = gltf.replacen('{', &format!("{{\"extras\":\"{note}\","), 1);
    let archive = zipped(&[("a.gltf", gltf.as_bytes()), ("data/a b.bin", &bytes)]);
    let job = json(posted(&server, archive).await).await;
    let job = server.ended(&job).await;
    let path = format!("/v1/jobs/{}/files.zip", job["id"].as_str().expect("an id"));
    let asked = || async { server.get(&path).send().await.expect("an answer") };
    let mut unread = Vec::new();
    for _ in 0..16 {
        unread.push(asked().await);
    }
    assert!(unread.iter().all(|answer| answer.status() == 200));
    let refused = asked().await;
    assert!(refused.headers().contains_key("retry-after"));
    assert_problem(refused, 429, "rate_limited").await;
    drop(unread);
    while asked().await.status() != 200 {
        tokio::task::yield_now().await;
    }
}

/// Keys that are always rejected must not fill the memory of the service.
#[test]
fn a_limit_of_zero_leaves_nothing_of_a_rejected_key() {
    let crowds = Arc::new(Crowds::default());
    assert!(Crowds::enter(&crowds, "a", Some(0)).is_none());
    assert!(crowds.is_empty());
    let seat = Crowds::enter(&crowds, "a", Some(1));
    assert!(seat.is_some() && Crowds::enter(&crowds, "a", Some(1)).is_none());
    drop(seat);
    assert!(crowds.is_empty());
}

/// What an input does not refer to is not kept: zeros pack well.
#[tokio::test]
async fn what_nothing_refers_to_is_dropped() {
    let server = Server::start();
    let (gltf, bytes) = triangle();
    let zeros = vec![0; 8 << 20];
    let obj = format!("mtllib m.mtl\n{}", meshes::TRIANGLE);
    let off = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    let material = "newmtl m\nmap_Kd t/p.png\n";
    for (files, kept) in [
        (
            vec![
                ("scene.gltf", gltf.as_bytes()),
                ("data/a b.bin", &bytes[..]),
                ("z.bin", &zeros),
            ],
            vec!["scene.gltf", "data/a b.bin"],
        ),
        (
            vec![
                ("a/z.bin", &zeros[..]),
                ("a/t/p.png", b"p"),
                ("a/m.mtl", material.as_bytes()),
                ("a/a.obj", obj.as_bytes()),
            ],
            vec!["a.obj", "t/p.png", "m.mtl"],
        ),
        (
            vec![("a.off", off.as_bytes()), ("z.bin", &zeros)],
            vec!["a.off"],
        ),
    ] {
        let request = server.post("/v1/jobs");
        let request = request.header("content-type", "application/zip");
        let answer = request
            .body(zipped(&files))
            .send()
            .await
            .expect("an answer");
        assert_eq!(names(&json(answer).await["links"]["inputs"]), kept);
        let mut form = Form::new();
        for (name, content) in files {
            let name = name.strip_prefix("a/").unwrap_or(name);
            let role = if name == kept[0] { "mesh" } else { "resource" };
            let part = Part::bytes(content.to_vec()).file_name(name.to_owned());
            form = form.part(role, part);
        }
        let answer = server.post("/v1/jobs").multipart(form).send().await;
        let job = json(answer.expect("an answer")).await;
        assert_eq!(names(&job["links"]["inputs"]), kept);
    }
}
