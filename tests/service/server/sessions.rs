//! Live sessions: frames are those of the library, valid whatever is pulled, and are baked to jobs.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use reqwest::multipart::Form;
use serde_json::{Value, json};
use unwrapd::deform::{Body, Handle, HandleId, Model, Session};
use unwrapd::mesh::PlanarMesh;

use super::applications::{asset, form, two_materials};
use super::{Server, assert_problem, json as read};
use crate::cli::unwrapd;
use crate::harness::live::{Frame, Heard, Live};
use crate::meshes::{self, bar};

/// A sheet of `n` by `n` squares.
pub fn sheet(n: u32) -> (PlanarMesh, Vec<u8>) {
    let index = |i: u32, j: u32| i * (n + 1) + j;
    let vertices = (0..=n).flat_map(|i| (0..=n).map(move |j| [f64::from(i), f64::from(j)]));
    let vertices: Vec<[f64; 2]> = vertices.collect();
    let squares = (0..n).flat_map(|i| (0..n).map(move |j| (i, j)));
    let triangles = squares.flat_map(|(i, j)| {
        let [a, b] = [index(i, j), index(i + 1, j)];
        [[a, b, b + 1], [a, b + 1, a + 1]]
    });
    let triangles: Vec<[u32; 3]> = triangles.collect();
    let mut text = format!("OFF\n{} {} 0\n", vertices.len(), triangles.len());
    for [x, y] in &vertices {
        writeln!(text, "{x} {y} 0").expect("memory");
    }
    for [a, b, c] in &triangles {
        writeln!(text, "3 {a} {b} {c}").expect("memory");
    }
    let mesh = PlanarMesh::new(vertices, triangles).expect("a sheet");
    (mesh, text.into_bytes())
}

/// Opens a session and connects to it.
pub async fn opened(server: &Server, form: Form) -> (Value, Live) {
    let answer = server.post("/v1/sessions").multipart(form).send().await;
    let answer = answer.expect("an answer");
    let status = answer.status();
    let session = read(answer).await;
    assert_eq!(status, 201, "{session}");
    let live = connected(server, &session).await;
    (session, live)
}

/// Connects to a session.
pub async fn connected(server: &Server, session: &Value) -> Live {
    let live = session["links"]["live"].as_str().expect("a link");
    Live::connect(&server.socket_url(live)).await
}

/// Bakes a session and waits for the job.
pub async fn baked(server: &Server, session: &Value) -> Value {
    let path = session["links"]["bake"].as_str().expect("a link");
    let job = read(server.post(path).send().await.expect("an answer")).await;
    let job = server.ended(&job).await;
    assert_eq!(job["state"], "succeeded", "{job}");
    job
}

async fn file(server: &Server, job: &Value, name: &str) -> Vec<u8> {
    let path = format!("{}/{name}", job["links"]["self"].as_str().expect("a link"));
    let answer = server.get(&path).send().await.expect("an answer");
    answer.bytes().await.expect("bytes").to_vec()
}

/// What is done to a session, and the same in the library.
enum Done {
    Held(u32, Handle),
    Moved(u32, Vec<f64>),
    Remembered,
    Undone,
    Exchanged(Model),
}

fn wish(done: &Done) -> Value {
    match done {
        Done::Held(name, handle) => json!({ "add": { "name": name, "handle": handle } }),
        Done::Moved(name, to) => json!({ "move": { "name": name, "to": to } }),
        Done::Remembered => json!({ "remember": {} }),
        Done::Undone => json!({ "undo": {} }),
        Done::Exchanged(model) => json!({ "settings": model }),
    }
}

/// Two ends are held, one is dragged, energy and barrier change, and the drag is undone.
fn script() -> Vec<Done> {
    let disc = |center: [f64; 2]| Handle::Disc {
        center: center.to_vec(),
        radius: 1.5,
        to: center.to_vec(),
        turn: 0.0,
        axis: None,
        weight: None,
    };
    let mut script = vec![
        Done::Held(7, disc([0.0, 5.0])),
        Done::Held(3, disc([10.0, 5.0])),
        Done::Remembered,
    ];
    for frame in 1..30 {
        let angle = 0.2 * f64::from(frame);
        script.push(Done::Moved(3, vec![10.0 - angle, 5.0 + 4.0 * angle.sin()]));
    }
    script.push(Done::Exchanged(Model {
        barrier_strength: Some(0.1),
        ..Model::default()
    }));
    script.push(Done::Moved(3, vec![6.0, 3.0]));
    script.push(Done::Undone);
    script
}

#[tokio::test]
async fn frames_are_those_of_the_library() {
    let server = Server::start();
    let (mesh, off) = sheet(10);
    let (_, mut live) = opened(&server, form("deform", "{}", ("sheet.off", off))).await;
    let script = script();
    let mut frames: Vec<Frame> = Vec::new();
    let mut steps = vec![None; script.len()];
    let mut last = 0;
    for (index, done) in script.iter().enumerate() {
        last = live.say(wish(done)).await;
        assert_eq!(last as usize, index + 1);
        // Now and then the solver goes on alone.
        while index % 5 == 0 && frames.last().is_none_or(|frame| frame.message < last) {
            hear(&mut live, &mut frames, &mut steps).await;
        }
    }
    while frames
        .last()
        .is_none_or(|f| f.message < last || f.is_moving())
    {
        hear(&mut live, &mut frames, &mut steps).await;
    }
    assert!(frames.len() > 10);

    let mut session = Session::new(Body::from(&mesh), &Model::default()).expect("a session");
    let mut names: Vec<(u32, HandleId)> = Vec::new();
    let (mut step, mut next, mut n) = (0, 0, 0);
    for frame in &frames {
        while step < frame.step {
            while next < script.len() && steps[next].as_ref().is_some_and(|(at, _)| *at == step) {
                let (_, is_superseded) = steps[next].expect("a reply");
                n = next as u32 + 1;
                if !is_superseded {
                    take(&mut session, &mut names, &script[next]);
                }
                next += 1;
            }
            session.step();
            step += 1;
        }
        let positions = session.positions();
        let bytes: Vec<u8> = match frame.width {
            4 => (positions.iter())
                .flat_map(|&x| (x as f32).to_le_bytes())
                .collect(),
            _ => positions.iter().flat_map(|x| x.to_le_bytes()).collect(),
        };
        assert_eq!((frame.message, &frame.bytes), (n, &bytes), "step {step}");
        if step > 0 {
            let energy = session.summary().energy_last;
            assert_eq!(frame.energy.to_bits(), energy.to_bits());
        }
        live.judge(frame);
    }
    assert_eq!((next, session.stage() as u8), (script.len(), 1));
}

/// Of each message the iterations before it, and whether a later one took its place.
type Steps = [Option<(u32, bool)>];

async fn hear(live: &mut Live, frames: &mut Vec<Frame>, steps: &mut Steps) {
    match live.hear().await {
        Heard::Frame(frame) => frames.push(frame),
        Heard::Reply(reply) => {
            assert!(reply["error"].is_null(), "{reply}");
            let number = |name: &str| reply[name].as_u64().expect("a number") as u32;
            let is_superseded = reply["superseded"] == true;
            steps[number("n") as usize - 1] = Some((number("step"), is_superseded));
        }
        Heard::Closed(code, reason) => panic!("closed: {code} {reason}"),
    }
}

fn take(session: &mut Session, names: &mut Vec<(u32, HandleId)>, done: &Done) {
    match done {
        Done::Held(name, handle) => {
            let id = session.add(handle.clone()).expect("a handle");
            names.push((*name, id));
        }
        Done::Moved(name, to) => {
            let (_, id) = names
                .iter()
                .find(|(given, _)| given == name)
                .expect("a name");
            session.move_handle(*id, to).expect("a target");
        }
        Done::Remembered => session.remember(),
        Done::Undone => assert!(session.undo()),
        Done::Exchanged(model) => session.remodel(model).expect("a model"),
    }
}

/// What is pulled: a job's kind, options and file, a handle that stays, one that is dragged, and where to.
struct Case {
    kind: &'static str,
    options: &'static str,
    file: (&'static str, Vec<u8>),
    handles: [Value; 2],
    target: Value,
}

const DRAWING: &str = r#"<svg xmlns="http://www.w3.org/2000/svg" width="100" height="60"><rect width="100" height="60"/></svg>"#;

fn cases() -> [Case; 7] {
    [
        Case {
            kind: "deform",
            options: "{}",
            file: ("bar.tet", bar(6).into_bytes()),
            handles: [
                json!({ "center": [0, 0.5, 0.5], "radius": 0.8, "to": [0, 0.5, 0.5] }),
                json!({ "center": [6, 0.5, 0.5], "radius": 0.8, "to": [6, 0.5, 0.5] }),
            ],
            target: json!([2, 4, 1.5]),
        },
        Case {
            kind: "deform",
            options: r#"{"cage": 6}"#,
            file: ("spot.ply", asset("spot.ply")),
            handles: [
                json!({ "center": [0, -0.7, 0], "radius": 0.2, "to": [0, -0.7, 0] }),
                json!({ "center": [0, 0.9, 0.3], "radius": 0.3, "to": [0, 0.9, 0.3] }),
            ],
            target: json!([0.5, 0.2, 0.4]),
        },
        Case {
            kind: "warp",
            options: r#"{"fix_border": true, "grid": 20}"#,
            file: ("spot.png", asset("pictures/spot.png")),
            handles: [
                json!({ "at": [300, 300], "to": [300, 300] }),
                json!({ "at": [900, 400], "to": [900, 400] }),
            ],
            target: json!([350, 250]),
        },
        Case {
            kind: "deform",
            options: r#"{"triangles": 400}"#,
            file: ("drawing.svg", DRAWING.into()),
            handles: [
                json!({ "center": [0, 30], "radius": 10, "to": [0, 30] }),
                json!({ "at": [90, 30], "to": [90, 30] }),
            ],
            target: json!([20, 80]),
        },
        Case {
            kind: "deform",
            options: "{}",
            file: ("two.obj", two_materials()),
            handles: [
                json!({ "select": "material=Left" }),
                json!({ "select": "color=ff0000", "to": [8, 1], "turn": 20 }),
            ],
            target: json!([8.5, 2.5]),
        },
        Case {
            kind: "deform",
            options: r#"{"triangles": 400}"#,
            file: ("drawing.svg", DRAWING.into()),
            handles: [
                json!({ "outline": [[0, 0], [20, 0], [20, 20], [10, 20], [10, 60], [0, 60]], "to": [10, 30] }),
                json!({ "line": [[50, 10], [50, 50]], "to": [[50, 10], [55, 30], [50, 50]] }),
            ],
            target: json!([60, 40]),
        },
        Case {
            kind: "warp",
            options: r#"{"fix_border": true, "grid": 20}"#,
            file: ("spot.png", asset("pictures/spot.png")),
            handles: [
                json!({ "line": [[200, 500], [500, 500]], "to": [[200, 500], [500, 450]] }),
                json!({ "at": [900, 400], "to": [900, 400], "weight": 5 }),
            ],
            target: json!([850, 350]),
        },
    ]
}

/// Whatever can be pulled: each is dragged hard, every frame is judged by its bytes, and the session becomes a job that ends
/// where the session ended.
#[tokio::test]
async fn whatever_is_pulled_stays_valid_and_is_baked() {
    let server = Server::start();
    for case in cases() {
        let name = case.file.0;
        let upload = form(case.kind, case.options, case.file);
        let (session, mut live) = opened(&server, upload).await;
        let [held, dragged] = case.handles;
        live.say(json!({ "add": { "name": 0, "handle": held } }))
            .await;
        live.say(json!({ "add": { "name": 1, "handle": dragged } }))
            .await;
        let pulled = json!({ "name": 1, "to": case.target });
        let n = live.say(json!({ "move": pulled })).await;
        let frame = live.settled(n).await;
        assert_ne!(frame.positions, live.mesh.rest, "{name}");
        assert_eq!(live.mesh.skin.is_empty(), name != "spot.ply");
        let job = baked(&server, &session).await;
        assert_eq!(job["options"]["handles"].as_array().map(Vec::len), Some(2));
        let report = file(&server, &job, "report").await;
        let report: Value = serde_json::from_slice(&report).expect("JSON");
        assert_eq!(report["unreached"], json!([]), "{name}: {report}");
        if case.kind == "warp" {
            assert_eq!(job["certified"], true, "{report}");
            assert_eq!(live.mesh.picture[0], 1304, "columns");
        } else {
            assert_eq!(report["inverted"], 0, "{name}: {report}");
            let energy = |when: &str| report[when].as_f64().expect("a number");
            let change = energy("energy_first") / energy("energy_last") - 1.0;
            assert!(change.abs() < 1e-6, "{name}: {report}");
        }
    }
}

/// UVs of the result of a job are pulled by anchors; the certificate of the job is about what the session showed.
#[tokio::test]
async fn uvs_of_a_job_are_pulled() {
    let server = Server::start();
    let job = server.submit(meshes::small(), "").await;
    let id = server.ended(&job).await["id"]
        .as_str()
        .expect("an id")
        .to_owned();
    let path = format!("/v1/sessions?job={id}");
    let session = read(server.post(&path).send().await.expect("an answer")).await;
    assert_eq!(session["kind"], "edit_uv", "{session}");
    let live = session["links"]["live"].as_str().expect("a link");
    let mut live = Live::connect(&server.socket_url(live)).await;
    assert_eq!(live.mesh.elements, live.mesh.triangles);
    let (first, last) = ends_of_a_chart(&live);
    let to = [0, 1].map(|k| 0.7 * last[k] + 0.3 * first[k]);
    live.say(json!({ "add": { "name": 0, "handle": { "at": first, "to": first } } }))
        .await;
    live.say(json!({ "add": { "name": 1, "handle": { "at": last, "to": last } } }))
        .await;
    let n = live.say(json!({ "move": { "name": 1, "to": to } })).await;
    let frame = live.settled(n).await;
    assert_ne!(frame.positions, live.mesh.rest);
    let job = baked(&server, &session).await;
    assert_eq!(
        (&job["state"], &job["kind"]),
        (&"succeeded".into(), &"edit_uv".into()),
        "{job}"
    );
    // What is said of the file is what the command says of it.
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("baked.glb");
    let result = job["links"]["files"][0]["href"].as_str().expect("a link");
    let result = server.get(result).send().await.expect("an answer");
    std::fs::write(&file, result.bytes().await.expect("bytes")).expect("a file");
    let verify = unwrapd(&["verify", &file.to_string_lossy(), "--bijective"]);
    assert_eq!(job["certified"], verify.status.success(), "{job}");
    let path = format!("/v1/sessions?job={}", job["id"].as_str().expect("an id"));
    let session = read(server.post(&path).send().await.expect("an answer")).await;
    let again = session["links"]["live"].as_str().expect("a link");
    let again = Live::connect(&server.socket_url(again)).await;
    let corners = |live: &Live, places: &[f64]| -> Vec<f64> {
        let vertices = live.mesh.elements.iter().flatten();
        vertices
            .flat_map(|&v| places[2 * v as usize..][..2].to_vec())
            .collect()
    };
    let shown = corners(&live, &frame.positions);
    let written = corners(&again, &again.mesh.rest);
    let far = shown.iter().zip(&written).map(|(a, b)| (a - b).abs());
    assert_eq!(shown.len(), written.len());
    assert!(far.fold(0.0, f64::max) < 1e-5);
}

/// The middles of the first face and of the last one in its chart.
fn ends_of_a_chart(live: &Live) -> ([f64; 2], [f64; 2]) {
    let faces = &live.mesh.elements;
    let mut chart: BTreeSet<u32> = faces[0].iter().copied().collect();
    let touches = |chart: &BTreeSet<u32>, face: &&Vec<u32>| face.iter().any(|v| chart.contains(v));
    loop {
        let size = chart.len();
        for face in faces {
            if touches(&chart, &face) {
                chart.extend(face);
            }
        }
        if chart.len() == size {
            break;
        }
    }
    let middle = |face: &Vec<u32>| {
        let coordinate = |k: usize| {
            face.iter()
                .map(|&v| live.mesh.rest[2 * v as usize + k])
                .sum::<f64>()
                / 3.0
        };
        [coordinate(0), coordinate(1)]
    };
    let last = faces
        .iter()
        .rfind(|face| touches(&chart, face))
        .expect("the first");
    (middle(&faces[0]), middle(last))
}

#[tokio::test]
async fn what_is_wrong_is_answered_and_changes_nothing() {
    let server = Server::start();
    let (_, off) = sheet(4);
    let (session, mut live) = opened(&server, form("deform", "{}", ("sheet.off", off))).await;
    let vertex = json!({ "vertex": 0, "to": [0, 0] });
    let n = live
        .say(json!({ "add": { "name": 4, "handle": vertex } }))
        .await;
    assert!(live.reply_to(n).await["error"].is_null());
    let wishes = [
        (
            json!({ "move": { "name": 5, "to": [1, 1] } }),
            "unknown_handle",
        ),
        (json!({ "move": { "name": 4, "to": [1] } }), "bad_target"),
        (
            json!({ "add": { "name": 5, "handle": { "vertex": 99, "to": [0, 0] } } }),
            "unknown_handle",
        ),
        (
            json!({ "add": { "name": 5, "handle": { "vertex": 0, "to": [1, 0] } } }),
            "contradictory_handles",
        ),
        (
            json!({ "add": { "name": 5, "handle": { "bone": 1 } } }),
            "malformed_handles",
        ),
        (
            json!({ "settings": { "barrier": "none" } }),
            "bad_parameter",
        ),
        (
            json!({ "settings": { "barrier_strength": -1 } }),
            "bad_parameter",
        ),
        (json!({ "undo": {} }), "nothing_to_undo"),
        (json!({ "redo": {} }), "nothing_to_redo"),
        (json!({ "dance": {} }), "invalid_message"),
    ];
    for (wish, code) in wishes {
        let n = live.say(wish).await;
        let reply = live.reply_to(n).await;
        assert_eq!(reply["error"]["code"], code, "{reply}");
    }
    let n = live.say(json!({ "list": {} })).await;
    let handles = live.reply_to(n).await["handles"].clone();
    assert_eq!(
        handles,
        json!([{ "name": 4, "handle": { "vertex": 0, "to": [0.0, 0.0] } }])
    );
    let n = live.say(json!({ "reset": {} })).await;
    assert_eq!(live.reply_to(n).await["handles"], json!([]));
    let bake = session["links"]["bake"].as_str().expect("a link");
    let answer = server.post(bake).send().await.expect("an answer");
    assert_problem(answer, 422, "no_handle").await;

    let broken = form("deform", "{}", ("sheet.off", b"OFF\nnothing".to_vec()));
    let answer = server.post("/v1/sessions").multipart(broken).send().await;
    assert_problem(answer.expect("an answer"), 422, "invalid_mesh").await;
    let other = form("unwrap", "{}", ("hills.glb", meshes::small()));
    let answer = server.post("/v1/sessions").multipart(other).send().await;
    assert_problem(answer.expect("an answer"), 400, "invalid_options").await;
    for path in ["/v1/sessions/nothing", "/v1/sessions/nothing/live"] {
        let answer = server.get(path).send().await.expect("an answer");
        assert_problem(answer, 404, "session_not_found").await;
    }
}
