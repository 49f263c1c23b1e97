//! Small meshes and textures in one call.

use unwrapd::picture::Image;

use crate::meshes;
use crate::places;
use crate::server::{Server, assert_problem, json};

#[tokio::test]
async fn one_call_unwraps_and_one_measures() {
    let server = Server::start();
    let request = server
        .post("/v1/unwrap?filename=sheet.glb")
        .body(meshes::small());
    let answer = request.send().await.expect("an answer");
    assert_eq!(
        (answer.status().as_u16(), &answer.headers()["content-type"]),
        (200, &"model/gltf-binary".parse().expect("text"))
    );
    let glb = answer.bytes().await.expect("bytes");
    let report = server
        .post("/v1/measure")
        .body(glb)
        .send()
        .await
        .expect("an answer");
    let report = json(report).await;
    assert_eq!(report["groups"][0]["certificate"]["flipped"], 0, "{report}");
    let jobs = json(server.get("/v1/jobs").send().await.expect("an answer")).await;
    assert_eq!(jobs["jobs"], serde_json::json!([]));
}

#[tokio::test]
async fn unusable_meshes_are_problems() {
    let server = Server::start();
    let send = async |path: &str, body: &'static str| {
        server
            .post(path)
            .header("content-type", "model/obj")
            .body(body)
            .send()
            .await
            .expect("an answer")
    };
    let points = send("/v1/unwrap", "v 0 0 0\nv 1 0 0\n").await;
    assert_problem(points, 422, "no_triangles").await;
    let no_uvs = send("/v1/measure", meshes::TRIANGLE).await;
    assert_problem(no_uvs, 422, "no_uvs").await;
    let two_files = send("/v1/unwrap?format=gltf", meshes::TRIANGLE).await;
    assert_problem(two_files, 400, "needs_job").await;
    let obj = send("/v1/unwrap?format=obj", meshes::TRIANGLE).await;
    let obj = obj.text().await.expect("text");
    assert!(obj.contains("\nvt "), "{obj}");
}

#[tokio::test]
async fn what_takes_longer_than_a_call_may_is_ended() {
    let server = Server::with(&[("UNWRAPD_SYNCHRONOUS_SECONDS", "0.05")]);
    let request = server.post("/v1/unwrap?cut=disk").body(meshes::large());
    assert_problem(request.send().await.expect("an answer"), 504, "timed_out").await;
    let job = server.submit(meshes::small(), "").await;
    assert_eq!(server.ended(&job).await["state"], "succeeded");
}

#[tokio::test]
async fn textures_become_pictures() {
    let server = Server::start();
    let decode = async |media_type: &str, body: Vec<u8>| {
        let request = server.post("/v1/decode").header("content-type", media_type);
        request.body(body).send().await.expect("an answer")
    };
    for name in ["ktx2/etc1s.ktx2", "ktx2/uastc.ktx2"] {
        let texture = std::fs::read(places::asset(name)).expect("an asset");
        let expected = unwrapd::picture::Picture::decode(&texture).expect("a picture");
        let answer = decode("image/ktx2", texture.clone()).await;
        assert_eq!(
            (answer.status().as_u16(), &answer.headers()["content-type"]),
            (200, &"image/png".parse().expect("text"))
        );
        let png = answer.bytes().await.expect("bytes");
        let picture = Image::decode(&png).expect("a picture");
        assert_eq!([picture.width, picture.height], expected.size());
        assert!(png == expected.png(), "{name}");
        // A file that is cut off is refused, and the service goes on.
        let cut_off = texture[..texture.len() / 2].to_vec();
        assert_problem(decode("image/ktx2", cut_off).await, 422, "invalid_image").await;
    }
    let text = decode("application/octet-stream", b"no picture".into()).await;
    assert_problem(text, 422, "unknown_format").await;
    let form = decode("text/html", b"no picture".into()).await;
    assert_problem(form, 415, "unsupported_media_type").await;
    let folders = std::fs::read_dir(server.data().join("scratch"));
    assert_eq!(folders.map_or(0, Iterator::count), 0, "nothing is kept");
}
