//! The files that a job was made of.

use reqwest::multipart::Part;

use serde_json::Value;

use super::{Server, assert_problem, ended, form, json};
use crate::meshes;

/// A triangle whose material file is named.
const PLATE: &str = "mtllib plate.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

#[tokio::test]
async fn inputs_are_listed_and_answered() {
    let server = Server::start();
    let second = Part::bytes(b"# none".to_vec()).file_name("plate.mtl");
    let input = form("unwrap", "{}", ("plate.obj", PLATE.into())).part("resource", second);
    let job = ended(&server, input).await;
    let inputs = job["links"]["inputs"].as_array().expect("a list");
    assert_eq!(inputs.len(), 2);
    assert_eq!(inputs[0]["name"], "plate.obj");
    let path = inputs[0]["href"].as_str().expect("a path");
    let answer = server.get(path).send().await.expect("an answer");
    assert_eq!(answer.status(), 200);
    let tag = answer.headers()["etag"].clone();
    assert_eq!(answer.bytes().await.expect("bytes"), PLATE.as_bytes());
    let part = server.get(path).header("range", "bytes=0-2").send().await;
    let part = part.expect("an answer");
    assert_eq!(part.status(), 206);
    assert_eq!(part.bytes().await.expect("bytes"), &PLATE.as_bytes()[..3]);
    let same = server.get(path).header("if-none-match", tag).send().await;
    assert_eq!(same.expect("an answer").status(), 304);
    for missing in ["2", "x"] {
        let path = format!(
            "{}/input/{missing}",
            job["links"]["self"].as_str().expect("a link")
        );
        let answer = server.get(&path).send().await.expect("an answer");
        assert_eq!(answer.status(), 404);
        let problem: Value = answer.json().await.expect("JSON");
        assert_eq!(problem["code"], "no_such_file");
    }
}

/// The input of a job is computed again with other options, also after that job is deleted.
#[tokio::test]
async fn a_job_is_run_again_with_other_options() {
    let server = Server::start();
    let second = Part::bytes(b"# none".to_vec()).file_name("plate.mtl");
    let input = form("unwrap", "{}", ("plate.obj", PLATE.into())).part("resource", second);
    let first = ended(&server, input).await;
    let id = first["id"].as_str().expect("an id");
    let again = format!("/v1/jobs?job={id}&resolution=512&priority=3");
    let again = json(server.post(&again).send().await.expect("an answer")).await;
    let deleted = server.request("DELETE", &format!("/v1/jobs/{id}"));
    assert_eq!(deleted.send().await.expect("an answer").status(), 204);
    let again = server.ended(&again).await;
    assert_eq!(again["state"], "succeeded", "{again}");
    assert_eq!(again["options"]["resolution"], 512);
    assert_eq!(
        (&again["priority"], &again["cached"]),
        (&3.into(), &false.into())
    );
    let names = |job: &Value| -> Vec<Value> {
        let inputs = job["links"]["inputs"].as_array().expect("a list");
        inputs.iter().map(|file| file["name"].clone()).collect()
    };
    assert_eq!(names(&again), names(&first));
    // Of a job's result, too; and with the same options, its result is copied.
    let id = again["id"].as_str().expect("an id");
    let measured = server.post(&format!("/v1/jobs?job={id}&file=result&kind=measure"));
    let measured = json(measured.send().await.expect("an answer")).await;
    let measured = server.ended(&measured).await;
    assert_eq!(measured["state"], "succeeded", "{measured}");
    let same = server.post(&format!("/v1/jobs?job={id}&resolution=512"));
    let same = json(same.send().await.expect("an answer")).await;
    assert_eq!(same["cached"], true);
}

#[tokio::test]
async fn a_cancelled_job_has_no_files_to_run_again() {
    let server = Server::with(&[("UNWRAPD_WORKERS", "1")]);
    server.submit(meshes::large(), "cut=disk").await;
    let waiting = server.submit(meshes::small(), "").await;
    let id = waiting["id"].as_str().expect("an id");
    let cancelled = server.request("DELETE", &format!("/v1/jobs/{id}"));
    assert_eq!(cancelled.send().await.expect("an answer").status(), 202);
    let again = server.post(&format!("/v1/jobs?job={id}")).send().await;
    assert_problem(again.expect("an answer"), 409, "no_result").await;
}
