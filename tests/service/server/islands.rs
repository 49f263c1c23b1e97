//! Live sessions in which islands make room for those that are held.

use std::f64::consts::TAU;
use std::fmt::Write as _;

use serde_json::{Value, json};
use unwrapd::plane::are_disjoint;

use super::applications::form;
use super::sessions::{baked, opened};
use super::{Server, assert_problem, json as read};
use crate::cli::{assert_status, unwrapd};
use crate::harness::live::{Frame, Live};

/// A page of `n` by `n` squares that nearly touch, as an OBJ file; they lie apart in space.
fn squares(n: usize) -> Vec<u8> {
    let step = 1.0 / n as f64;
    let mut text = String::new();
    for k in 0..n * n {
        let [u, v] = [k % n, k / n].map(|i| step * (i as f64 + 0.1));
        for [x, y] in [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]] {
            writeln!(text, "v {} {y} 0", x + 2.0 * k as f64).expect("memory");
            let [u, v] = [u + 0.8 * step * x, v + 0.8 * step * y];
            writeln!(text, "vt {u} {v}").expect("memory");
        }
        let c = |corner: usize| 4 * k + corner;
        writeln!(text, "f {0}/{0} {1}/{1} {2}/{2}", c(1), c(2), c(3)).expect("memory");
        writeln!(text, "f {0}/{0} {1}/{1} {2}/{2}", c(1), c(3), c(4)).expect("memory");
    }
    text.into_bytes()
}

fn upload(n: usize) -> reqwest::multipart::Form {
    form("repack", "{}", ("squares.obj", squares(n)))
}

/// The vertices of a frame.
fn points(frame: &Frame) -> Vec<[f64; 2]> {
    frame.positions.as_chunks().0.to_vec()
}

/// No two islands of a frame overlap, and all lie on the page.
fn assert_apart(live: &Live, frame: &Frame) {
    let triangles = live.mesh.triangles.iter();
    let triangles = triangles.map(|t| [t[0], t[1], t[2]]);
    // Islands of the OBJ file are counter-clockwise, and v points down in the result.
    let uvs: Vec<[f64; 2]> = points(frame).iter().map(|&[u, v]| [u, 1.0 - v]).collect();
    assert!(
        are_disjoint(&uvs, &triangles.collect::<Vec<_>>()),
        "an overlap"
    );
    let is_inside = |x: &f64| (-1e-6..=1.0 + 1e-6).contains(x);
    assert!(uvs.as_flattened().iter().all(is_inside), "off the page");
}

/// The middle of the square of a face.
fn middle(live: &Live, frame: &Frame, face: usize) -> [f64; 2] {
    let uvs = points(frame);
    let corners = live.mesh.triangles[face].iter();
    let corners: Vec<[f64; 2]> = corners.map(|&v| uvs[v as usize]).collect();
    // The first face of a square has its diagonal between its first and its third corner.
    [0, 1].map(|k| f64::midpoint(corners[0][k], corners[2][k]))
}

async fn hold(live: &mut Live, name: u32, handle: Value) -> u32 {
    live.say(json!({ "add": { "name": name, "handle": handle } }))
        .await
}

#[tokio::test]
async fn islands_make_room_and_are_baked_where_they_lie() {
    let server = Server::start();
    let (session, mut live) = opened(&server, upload(5)).await;
    assert_eq!(session["kind"], "repack", "{session}");
    hold(&mut live, 7, json!({ "face": 0 })).await;
    for step in 0..20 {
        let angle = TAU * f64::from(step) / 20.0;
        let to = [0.5 + 0.3 * angle.cos(), 0.5 + 0.3 * angle.sin()];
        let n = live.say(json!({ "move": { "name": 7, "to": to } })).await;
        let frame = live.frame_with(n).await;
        assert_apart(&live, &frame);
        let held = middle(&live, &frame, 0);
        let far = (held[0] - to[0]).hypot(held[1] - to[1]);
        assert!(far < 1e-6, "{held:?} is not {to:?}");
    }
    // It is turned where it lies, let go, and another one is held.
    let n = hold(&mut live, 7, json!({ "face": 0, "turn": 30 })).await;
    let turned = live.settled(n).await;
    assert_apart(&live, &turned);
    let n = live.say(json!({ "remove": { "name": 7 } })).await;
    let released = live.settled(n).await;
    assert_eq!(released.positions, turned.positions);
    let n = hold(&mut live, 8, json!({ "face": 10, "move": [0.2, 0.0] })).await;
    let frame = live.settled(n).await;
    assert_eq!(frame.stage, 1, "settled");
    assert_apart(&live, &frame);

    // The job has the islands where the last frame had them.
    let job = baked(&server, &session).await;
    assert_eq!(
        (&job["kind"], &job["certified"]),
        (&json!("repack"), &json!(true))
    );
    let count = |list: &Value| list.as_array().map(Vec::len);
    let counts = [&job["options"]["islands"], &job["links"]["inputs"]].map(count);
    assert_eq!(counts, [Some(25), Some(1)], "no start file");
    let result = job["links"]["files"][0]["href"].as_str().expect("a link");
    let result = server.get(result).send().await.expect("an answer");
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("baked.glb");
    std::fs::write(&file, result.bytes().await.expect("bytes")).expect("a file");
    let verify = [
        "verify",
        &file.to_string_lossy(),
        "--bijective",
        "--padding",
        "2",
    ];
    assert_status(&unwrapd(&verify), 0);
    let (_, again) = opened(&server, repacked_from(&file)).await;
    let shown = corners(&live, &frame.positions);
    let written = corners(&again, &again.mesh.rest);
    assert_eq!(shown.len(), written.len());
    let far = shown
        .iter()
        .zip(&written)
        .map(|([u, v], [x, y])| (u - x).hypot(v - y));
    assert!(far.fold(0.0, f64::max) < 1e-6);
}

fn repacked_from(file: &std::path::Path) -> reqwest::multipart::Form {
    let bytes = std::fs::read(file).expect("a file");
    form("repack", "{}", ("baked.glb", bytes))
}

fn corners(live: &Live, positions: &[f64]) -> Vec<[f64; 2]> {
    let vertices = live.mesh.triangles.iter().flatten();
    vertices
        .map(|&v| [0, 1].map(|k| positions[2 * v as usize + k]))
        .collect()
}

#[tokio::test]
async fn faulty_handles_of_islands_are_answered() {
    let server = Server::start();
    let (session, mut live) = opened(&server, upload(3)).await;
    let answer = server.post(session["links"]["bake"].as_str().expect("a link"));
    assert_problem(answer.send().await.expect("an answer"), 422, "no_handle").await;
    let wishes = [
        (
            json!({ "add": { "name": 1, "handle": { "face": 18 } } }),
            "unknown_face",
        ),
        (
            json!({ "add": { "name": 1, "handle": { "vertex": 0 } } }),
            "malformed_handles",
        ),
        (
            json!({ "add": { "name": 1, "handle": { "face": 0, "turn": 1e6 } } }),
            "bad_target",
        ),
        (
            json!({ "add": { "name": 1, "handle": { "face": 0, "scale": 100 } } }),
            "island_off_page",
        ),
        (
            json!({ "move": { "name": 1, "to": [0.5, 0.5] } }),
            "unknown_handle",
        ),
        (json!({ "settings": {} }), "bad_parameter"),
        (json!({ "undo": {} }), "nothing_to_undo"),
    ];
    for (wish, code) in wishes {
        let n = live.say(wish.clone()).await;
        assert_eq!(live.reply_to(n).await["error"]["code"], code, "{wish}");
    }
    hold(&mut live, 1, json!({ "face": 0 })).await;
    let n = hold(&mut live, 2, json!({ "face": 1 })).await;
    let reply = live.reply_to(n).await;
    assert_eq!(reply["error"]["code"], "island_named_twice", "{reply}");
    // Off the page it cannot stay, and comes back.
    let n = live
        .say(json!({ "move": { "name": 1, "to": [1.0, 0.5] } }))
        .await;
    assert_eq!(live.settled(n).await.stage, 2);
    let n = live
        .say(json!({ "move": { "name": 1, "to": [0.5, 0.5] } }))
        .await;
    let frame = live.settled(n).await;
    assert_eq!(frame.stage, 1);
    assert_apart(&live, &frame);
}

#[tokio::test]
async fn sessions_of_too_many_islands_are_refused() {
    let server = Server::start();
    let sent = server.post("/v1/sessions").multipart(upload(11)).send();
    assert_problem(sent.await.expect("an answer"), 422, "too_many_islands").await;
    let options = r#"{"texels_per_unit": 10}"#;
    let form = form("repack", options, ("squares.obj", squares(2)));
    let answer = server.post("/v1/sessions").multipart(form).send().await;
    let answer = answer.expect("an answer");
    let status = answer.status();
    let problem = read(answer).await;
    assert_eq!(
        (status.as_u16(), &problem["code"]),
        (400, &json!("invalid_options"))
    );
}
