//! The life of a job.

use std::time::Instant;

use reqwest::multipart::{Form, Part};
use serde_json::json as object;

use crate::meshes;
use crate::server::{Server, assert_problem, json};

#[tokio::test]
async fn a_glb_becomes_a_glb_a_report_and_pictures() {
    let server = Server::start();
    let job = server
        .submit(meshes::small(), "resolution=512&filename=sheet.glb")
        .await;
    assert_eq!(job["kind"], "unwrap");
    assert_eq!(job["options"]["resolution"], 512);
    let job = server.ended(&job).await;
    assert_eq!(
        (&job["state"], &job["stage"]),
        (&"succeeded".into(), &object!(null))
    );

    let files = job["links"]["files"].as_array().expect("links");
    let hrefs: Vec<&str> = files
        .iter()
        .filter_map(|file| file["href"].as_str())
        .collect();
    let base = job["links"]["self"].as_str().expect("a link");
    let expected = [
        "result",
        "layout.png",
        "heatmap.png",
        "thumbnail.png",
        "uvs.bin",
        "report",
    ];
    assert_eq!(hrefs, expected.map(|name| format!("{base}/{name}")));

    let result = server.get(hrefs[0]).send().await.expect("an answer");
    assert_eq!(result.headers()["content-type"], "model/gltf-binary");
    let disposition = result.headers()["content-disposition"]
        .to_str()
        .expect("text")
        .to_owned();
    assert!(
        disposition.contains("sheet") && disposition.contains(".glb"),
        "{disposition}"
    );
    let glb = result.bytes().await.expect("bytes");
    assert!(glb.starts_with(b"glTF") && glb.windows(10).any(|w| w == b"TEXCOORD_0"));
    for picture in &hrefs[1..4] {
        let bytes = server
            .get(picture)
            .send()
            .await
            .expect("an answer")
            .bytes()
            .await;
        assert!(bytes.expect("bytes").starts_with(b"\x89PNG"));
    }
    let report = json(server.get(hrefs[5]).send().await.expect("an answer")).await;
    assert_eq!(report["certified"], true, "{report}");
    // What was asked for, and beside it what the service allows.
    assert_eq!(report["options"]["time_budget"], object!(null));
    assert_eq!(report["limits"]["seconds"], 600.0);

    let again = Part::bytes(glb.to_vec()).file_name("again.glb");
    let form = Form::new().part("mesh", again).text("kind", "measure");
    let measured = server
        .post("/v1/jobs")
        .multipart(form)
        .send()
        .await
        .expect("an answer");
    let measured = server.ended(&json(measured).await).await;
    assert_eq!(measured["state"], "succeeded", "{measured}");
    let path = format!(
        "{}/report",
        measured["links"]["self"].as_str().expect("a link")
    );
    let measured = json(server.get(&path).send().await.expect("an answer")).await;
    assert_eq!(
        measured["groups"][0]["measures"],
        report["groups"][0]["measures"]
    );
}

#[tokio::test]
async fn a_form_brings_the_files_that_a_gltf_references() {
    let server = Server::start();
    let positions: Vec<u8> = [0.0_f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]
        .into_iter()
        .flat_map(f32::to_le_bytes)
        .collect();
    let gltf = object!({
        "asset": { "version": "2.0" },
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 } }] }],
        "accessors": [{ "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0] }],
        "bufferViews": [{ "buffer": 0, "byteLength": 36 }],
        "buffers": [{ "byteLength": 36, "uri": "data/a%20b.bin" }],
    });
    let form = || {
        let mesh = Part::text(gltf.to_string()).file_name("scene.gltf");
        Form::new()
            .part("mesh", mesh)
            .text("options", r#"{"format":"gltf"}"#)
    };
    let buffer = Part::bytes(positions).file_name("data/a b.bin");
    let whole = form().part("resource", buffer);
    let job = server
        .post("/v1/jobs")
        .multipart(whole)
        .send()
        .await
        .expect("an answer");
    let job = server.ended(&json(job).await).await;
    assert_eq!(job["state"], "succeeded", "{job}");
    let files = job["links"]["files"].as_array().expect("links");
    let bin = files.iter().find(|file| file["name"] == "scene.bin");
    let href = bin.expect("a buffer")["href"].as_str().expect("a link");
    assert_eq!(
        server.get(href).send().await.expect("an answer").status(),
        200
    );

    let alone = server
        .post("/v1/jobs")
        .multipart(form())
        .send()
        .await
        .expect("an answer");
    let job = server.ended(&json(alone).await).await;
    assert_eq!(
        (&job["state"], &job["error"]["code"]),
        (&"failed".into(), &"missing_resource".into())
    );
}

#[tokio::test]
async fn a_cancelled_job_stops_and_leaves_nothing() {
    let server = Server::start();
    let job = server.submit(meshes::large(), "cut=disk").await;
    server.mapping(&job).await;
    assert_eq!(server.children().len(), 1);
    let path = job["links"]["self"].as_str().expect("a link");
    let start = Instant::now();
    let answer = server
        .request("DELETE", path)
        .send()
        .await
        .expect("an answer");
    assert_eq!(answer.status(), 202);
    assert_eq!(server.ended(&job).await["state"], "cancelled");
    // How long it took is for the reader: a busy machine is no fault.
    println!("cancelled after {:?}", start.elapsed());
    assert_eq!(server.children(), Vec::<i32>::new());
    assert_eq!(server.owners_of_files(), Vec::<String>::new());

    let result = server
        .get(&format!("{path}/result"))
        .send()
        .await
        .expect("an answer");
    assert_problem(result, 409, "no_result").await;
    let gone = server
        .request("DELETE", path)
        .send()
        .await
        .expect("an answer");
    assert_eq!(gone.status(), 204);
    assert_problem(
        server.get(path).send().await.expect("an answer"),
        404,
        "job_not_found",
    )
    .await;
}

#[tokio::test]
async fn a_job_that_finishes_early_has_a_certified_map() {
    let server = Server::start();
    let job = server.submit(meshes::large(), "cut=disk").await;
    server.mapping(&job).await;
    let path = job["links"]["self"].as_str().expect("a link");
    let early = server
        .get(&format!("{path}/result"))
        .send()
        .await
        .expect("an answer");
    assert_problem(early, 409, "not_finished").await;
    let finish = format!("{path}/finish");
    assert_eq!(
        server
            .post(&finish)
            .send()
            .await
            .expect("an answer")
            .status(),
        202
    );
    let job = server.ended(&job).await;
    assert_eq!(job["state"], "succeeded", "{job}");
    let report = json(
        server
            .get(&format!("{path}/report"))
            .send()
            .await
            .expect("an answer"),
    )
    .await;
    assert_eq!(report["certified"], true);
    assert_problem(
        server.post(&finish).send().await.expect("an answer"),
        409,
        "already_finished",
    )
    .await;
}

#[tokio::test]
async fn the_list_has_pages() {
    let server = Server::start();
    let mut made = Vec::new();
    for _ in 0..3 {
        made.push(server.submit(meshes::small(), "").await["id"].clone());
    }
    made.reverse();
    let first = json(
        server
            .get("/v1/jobs?limit=2")
            .send()
            .await
            .expect("an answer"),
    )
    .await;
    let ids = |page: &serde_json::Value| -> Vec<serde_json::Value> {
        page["jobs"]
            .as_array()
            .expect("jobs")
            .iter()
            .map(|job| job["id"].clone())
            .collect()
    };
    assert_eq!(ids(&first), made[..2]);
    let path = format!(
        "/v1/jobs?limit=2&cursor={}",
        first["next"].as_str().expect("a cursor")
    );
    let second = json(server.get(&path).send().await.expect("an answer")).await;
    assert_eq!(ids(&second), made[2..]);
    assert!(second["next"].is_null());
}
