//! Requests that are refused, and those that are repeated.

use reqwest::RequestBuilder;
use reqwest::multipart::{Form, Part};

use crate::meshes;
use crate::server::{Server, assert_problem, json};

/// What curl says of a body if it is not told otherwise.
const CURL: &str = "application/x-www-form-urlencoded";

fn raw(
    server: &Server,
    query: &str,
    content_type: &str,
    body: impl Into<reqwest::Body>,
) -> RequestBuilder {
    server
        .post(&format!("/v1/jobs?{query}"))
        .header("content-type", content_type)
        .body(body)
}

/// A body that is packed is not read as a mesh; the answer says what is read.
#[tokio::test]
async fn a_content_coding_is_refused() {
    let server = Server::start();
    let packed = || raw(&server, "", "model/gltf-binary", meshes::small());
    let answer = packed().header("content-encoding", "gzip").send().await;
    let answer = answer.expect("an answer");
    assert_eq!(answer.headers()["accept-encoding"], "identity");
    assert_problem(answer, 415, "unsupported_media_type").await;
    let plain = packed().header("content-encoding", "identity").send().await;
    assert_eq!(plain.expect("an answer").status(), 202);
}

#[tokio::test]
async fn what_is_not_a_mesh_is_refused_before_202() {
    let server = Server::start();
    let bytes = "application/octet-stream";
    let cases: [(&str, &str, Vec<u8>, u16, &str); 13] = [
        ("", bytes, b"hello, world".to_vec(), 422, "unknown_format"),
        ("", CURL, b"name=value".to_vec(), 422, "unknown_format"),
        ("", bytes, Vec::new(), 422, "unknown_format"),
        (
            "",
            bytes,
            b"\x89PNG\r\n\x1a\n".to_vec(),
            422,
            "unknown_format",
        ),
        (
            "",
            "model/gltf-binary",
            b"glTF\x01\0\0\0".to_vec(),
            422,
            "invalid_gltf",
        ),
        (
            "",
            "model/gltf-binary",
            meshes::small()[..40].to_vec(),
            422,
            "invalid_gltf",
        ),
        (
            "",
            "model/gltf+json",
            br#"{"asset": "#.to_vec(),
            422,
            "invalid_gltf",
        ),
        (
            "",
            "image/gif",
            meshes::small(),
            415,
            "unsupported_media_type",
        ),
        ("kind=fold", bytes, meshes::small(), 400, "invalid_request"),
        ("kind=warp", bytes, meshes::small(), 422, "unknown_format"),
        ("kind=solve", bytes, meshes::small(), 422, "unknown_format"),
        (
            "kind=warp&grid=[",
            "image/png",
            b"\x89PNG\r\n\x1a\n".to_vec(),
            400,
            "invalid_options",
        ),
        (
            "cut=disk&cut=auto",
            bytes,
            meshes::small(),
            400,
            "invalid_request",
        ),
    ];
    for (query, content_type, body, status, code) in cases {
        let answer = raw(&server, query, content_type, body)
            .send()
            .await
            .expect("an answer");
        assert_problem(answer, status, code).await;
    }
    let jobs = json(server.get("/v1/jobs").send().await.expect("an answer")).await;
    assert_eq!(jobs["jobs"], serde_json::json!([]));
}

/// `curl --data-binary @mesh.glb` names a type that has nothing to do with the file.
#[tokio::test]
async fn a_mesh_is_known_by_its_content_where_curl_is_not_told_its_type() {
    let server = Server::start();
    for mesh in [meshes::small(), meshes::TRIANGLE.into()] {
        let answer = raw(&server, "", CURL, mesh).send().await;
        let answer = answer.expect("an answer");
        assert_eq!(answer.status(), 202);
        let job = server.ended(&json(answer).await).await;
        assert_eq!(job["state"], "succeeded", "{job}");
    }
}

#[tokio::test]
async fn options_that_make_no_sense_are_refused_before_202() {
    let server = Server::start();
    let bytes = "application/octet-stream";
    for query in [
        "color=red",
        "energy=warp",
        "resolution=0",
        "max_distortion=3.9",
        "cut=fast&max_stretch=2",
        "kind=measure&energy=arap",
    ] {
        let answer = raw(&server, query, bytes, meshes::small());
        let answer = answer.send().await.expect("an answer");
        assert_problem(answer, 400, "invalid_options").await;
    }
}

#[tokio::test]
async fn what_would_be_lost_is_refused() {
    let server = Server::start();
    let form = || Form::new().part("mesh", Part::text(meshes::TRIANGLE).file_name("a.obj"));
    let file = || Part::text("1").file_name("a.mtl");
    let long = format!("filename={}.obj", "x".repeat(60_000));
    let cases = [
        ("", form().part("foo", file()), "unexpected part"),
        ("", form().part("resource", Part::text("1")), "file name"),
        (
            "",
            form().part("resource", file()).part("resource", file()),
            "twice",
        ),
        (
            "",
            form().text("options", "{}").text("options", "{}"),
            "options",
        ),
        (
            "",
            form().text("kind", "measure").text("kind", "unwrap"),
            "kind",
        ),
        ("kind=measure", form().text("kind", "unwrap"), "kind"),
        (
            "cut=disk",
            form().text("options", r#"{"cut": "auto"}"#),
            "cut is given twice",
        ),
        (&long, form(), "255 bytes"),
    ];
    for (query, form, detail) in cases {
        let request = server.post(&format!("/v1/jobs?{query}")).multipart(form);
        let answer = request.send().await.expect("an answer");
        let problem = assert_problem(answer, 400, "invalid_request").await;
        assert!(
            problem["detail"].as_str().expect("text").contains(detail),
            "{problem}"
        );
    }
}

#[tokio::test]
async fn malformed_forms_are_refused() {
    let server = Server::start();
    let mesh = || Part::text(meshes::TRIANGLE).file_name("a.obj");
    let cases = [
        (Form::new().text("options", "{}"), "missing_mesh"),
        (
            Form::new().part("mesh", mesh()).part("mesh", mesh()),
            "invalid_request",
        ),
        (
            Form::new().part("mesh", mesh()).text("options", "[]"),
            "invalid_options",
        ),
        (
            Form::new()
                .part("mesh", mesh())
                .text("options", r#"{"cut": 3}"#),
            "invalid_options",
        ),
        (
            Form::new().part("mesh", mesh()).text("stray", "text"),
            "invalid_request",
        ),
    ];
    for (form, code) in cases {
        let answer = server
            .post("/v1/jobs")
            .multipart(form)
            .send()
            .await
            .expect("an answer");
        assert_problem(answer, 400, code).await;
    }
    let cut_off = raw(
        &server,
        "",
        "multipart/form-data; boundary=x",
        "--x\r\nContent-Disp",
    );
    assert_problem(
        cut_off.send().await.expect("an answer"),
        400,
        "invalid_request",
    )
    .await;
    let no_boundary = raw(&server, "", "multipart/form-data", "--x");
    assert_problem(
        no_boundary.send().await.expect("an answer"),
        400,
        "invalid_request",
    )
    .await;
}

#[tokio::test]
async fn uploads_and_queue_have_limits() {
    let server = Server::with(&[
        ("UNWRAPD_MAX_UPLOAD_MIB", "1"),
        ("UNWRAPD_QUEUE_DEPTH", "0"),
    ]);
    let answer = raw(&server, "", "model/gltf-binary", meshes::hills(300))
        .send()
        .await;
    let problem = assert_problem(answer.expect("an answer"), 413, "upload_too_large").await;
    assert_eq!(problem["limit"], 1 << 20);
    let answer = raw(&server, "", "model/gltf-binary", meshes::small())
        .send()
        .await
        .expect("an answer");
    // No job has ended yet: the queue has no pace.
    assert_eq!(answer.headers()["retry-after"], "60");
    assert_problem(answer, 503, "queue_full").await;
}

#[tokio::test]
async fn paths_and_methods_that_do_not_exist_are_problems() {
    let server = Server::start();
    let nothing = server.get("/v2").send().await.expect("an answer");
    assert_problem(nothing, 404, "not_found").await;
    let method = server
        .request("PUT", "/v1/jobs")
        .send()
        .await
        .expect("an answer");
    assert!(
        method.headers()["allow"]
            .to_str()
            .expect("text")
            .contains("POST")
    );
    assert_problem(method, 405, "method_not_allowed").await;
    for id in ["x", "00000000-0000-7000-8000-000000000000"] {
        let job = server
            .get(&format!("/v1/jobs/{id}"))
            .send()
            .await
            .expect("an answer");
        assert_problem(job, 404, "job_not_found").await;
    }
    let query = server
        .get("/v1/jobs?limit=many")
        .send()
        .await
        .expect("an answer");
    assert_problem(query, 400, "invalid_request").await;
}

#[tokio::test]
async fn a_key_makes_repetitions_harmless() {
    let server = Server::start();
    let send = async |query: &str, mesh: Vec<u8>| {
        let request = raw(&server, query, "model/gltf-binary", mesh);
        request
            .header("idempotency-key", "one")
            .send()
            .await
            .expect("an answer")
    };
    let first = json(send("padding=3", meshes::small()).await).await;
    let second = send("padding=3", meshes::small()).await;
    assert_eq!(second.status(), 202);
    assert_eq!(json(second).await["id"], first["id"]);
    assert_problem(
        send("padding=4", meshes::small()).await,
        422,
        "idempotency_key_reused",
    )
    .await;
    assert_problem(
        send("padding=3", meshes::hills(3)).await,
        422,
        "idempotency_key_reused",
    )
    .await;
    for said in ["metadata={\"n\":1}", "accept=certified"] {
        let other = send(&format!("padding=3&{said}"), meshes::small()).await;
        assert_problem(other, 422, "idempotency_key_reused").await;
    }
    let jobs = json(server.get("/v1/jobs").send().await.expect("an answer")).await;
    assert_eq!(jobs["jobs"].as_array().map(Vec::len), Some(1));
}

#[tokio::test]
async fn a_preferred_wait_is_answered_with_the_end() {
    let server = Server::start();
    let request = raw(&server, "", "model/obj", meshes::TRIANGLE).header("prefer", "wait=60");
    let answer = request.send().await.expect("an answer");
    assert_eq!(answer.status(), 200);
    assert_eq!(answer.headers()["preference-applied"], "wait=60");
    assert!(answer.headers().contains_key("location"));
    assert_eq!(json(answer).await["state"], "succeeded");
}

#[tokio::test]
async fn pages_are_an_option_of_a_call() {
    let server = Server::start();
    let path = "/v1/unwrap?filename=sheet.glb&pages=2&resolution=512x256";
    let answer = server.post(path).body(meshes::small()).send().await;
    let glb = answer.expect("an answer").bytes().await.expect("bytes");
    let path = "/v1/measure?pages=2&resolution=512x256";
    let report = server.post(path).body(glb).send().await.expect("an answer");
    let report = json(report).await;
    assert_eq!(report["proven"]["pages"]["kept"], true, "{report}");
    let send = async |query: &str| {
        let path = format!("/v1/unwrap?filename=sheet.glb&{query}");
        server
            .post(&path)
            .body(meshes::small())
            .send()
            .await
            .expect("an answer")
    };
    let too_small = send("texels_per_unit=1e6").await;
    assert_problem(too_small, 422, "texture_too_small").await;
    for query in ["resolution=512x300", "resolution=512x", "pages=11"] {
        assert_problem(send(query).await, 400, "invalid_options").await;
    }
}

#[tokio::test]
async fn the_stored_document_is_handed_out() {
    let server = Server::start();
    let served = json(server.get("/openapi.json").send().await.expect("an answer")).await;
    assert_eq!(served, crate::openapi::stored());
    let request = server.get("/openapi.json");
    let compressed = request.header("Accept-Encoding", "gzip").send().await;
    let compressed = compressed.expect("an answer");
    assert_eq!(compressed.headers()["content-encoding"], "gzip");
    let tag = compressed.headers()["etag"].clone();
    let length = compressed.bytes().await.expect("a body").len();
    assert!(length < 100_000, "{length}");
    let again = server
        .get("/openapi.json")
        .header("Accept-Encoding", "gzip");
    let again = again.header("If-None-Match", tag).send().await;
    assert_eq!(again.expect("an answer").status(), 304);
}
