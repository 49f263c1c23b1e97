//! What is said of faults: what is wrong, and what it is called.

use reqwest::Response;
use serde_json::{Value, json as object};

use crate::meshes;
use crate::server::{Server, assert_problem, ended, form, json};

fn detail(problem: &Value) -> String {
    problem["detail"].as_str().expect("a detail").to_owned()
}

async fn posted(server: &Server, query: &str) -> Response {
    let request = server.post(&format!("/v1/jobs?{query}"));
    let answer = request.body(meshes::small()).send().await;
    answer.expect("an answer")
}

#[tokio::test]
async fn the_option_that_is_wrong_is_named() {
    let server = Server::start();
    for (query, name, why) in [
        ("padding=abc", "`padding`", "invalid type: string \"abc\""),
        ("cut=zigzag", "`cut`", "unknown variant `zigzag`, expected"),
        ("paddings=2", "`paddings`", "unknown option"),
    ] {
        let answer = posted(&server, query).await;
        let said = detail(&assert_problem(answer, 400, "invalid_options").await);
        assert!(said.contains(name) && said.contains(why), "{said}");
    }
}

#[tokio::test]
async fn the_column_of_a_formula_that_is_wrong_is_named() {
    let server = Server::start();
    for (energy, column) in [
        ("steam", Some(1)),
        ("(s1-1)^2 %2B (s2-1)^", Some(19)),
        ("(s1-2)^2 %2B (s2-2)^2", None),
    ] {
        let answer = posted(&server, &format!("kind=deform&energy={energy}")).await;
        let problem = assert_problem(answer, 422, "invalid_formula").await;
        assert_eq!(problem.get("column").and_then(Value::as_u64), column);
    }
}

#[tokio::test]
async fn a_call_that_never_began_took_no_time() {
    let server = Server::with(&[("UNWRAPD_SYNCHRONOUS_SECONDS", "0.2")]);
    let paused = server.request("PUT", "/v1/pause").send().await;
    assert_eq!(paused.expect("an answer").status(), 200);
    let call = server.post("/v1/unwrap").body(meshes::small()).send().await;
    let said = detail(&assert_problem(call.expect("an answer"), 504, "timed_out").await);
    assert!(said.contains("not begun, behind other jobs"), "{said}");
}

#[tokio::test]
async fn a_deformation_without_handles_says_so() {
    let server = Server::start();
    for options in [object!({}), object!({ "cage": 8 })] {
        let form = form(
            "deform",
            &options.to_string(),
            ("hills.glb", meshes::small()),
        );
        let job = ended(&server, form).await;
        assert_eq!(job["error"]["code"], "no_handle", "{job}");
    }
}

#[tokio::test]
async fn a_cancelled_job_has_been_cancelled() {
    let server = Server::start();
    let job = server.submit(meshes::large(), "").await;
    let path = job["links"]["self"].as_str().expect("a link");
    server
        .request("DELETE", path)
        .send()
        .await
        .expect("an answer");
    server.ended(&job).await;
    let id = job["id"].as_str().expect("an id");
    let session = server.post(&format!("/v1/sessions?job={id}")).send().await;
    let said = detail(&assert_problem(session.expect("an answer"), 409, "no_result").await);
    assert_eq!(said, "the job has been cancelled");
}

#[tokio::test]
async fn a_file_that_is_gone_is_the_reason() {
    let server = Server::start();
    let pause = async |method| server.request(method, "/v1/pause").send().await;
    pause("PUT").await.expect("an answer");
    let job = server.submit(meshes::small(), "").await;
    let id = job["id"].as_str().expect("an id");
    let input = server.data().join("blobs").join(id).join("input/0");
    std::fs::remove_file(input).expect("a file");
    pause("DELETE").await.expect("an answer");
    let job = server.ended(&job).await;
    let said = detail(&job["error"]);
    assert!(said.contains("missing"), "{said}");
    // Where it was is nothing for clients.
    assert!(!said.contains("blobs"), "{said}");
}

#[test]
fn a_folder_that_cannot_be_used_is_named() {
    for taken in ["blobs", "scratch"] {
        let data = tempfile::tempdir().expect("a folder");
        let path = data.path().join(taken);
        std::fs::write(&path, "no folder").expect("a file");
        let output = std::process::Command::new(env!("CARGO_BIN_EXE_unwrapd"))
            .args(["serve", "--listen", "127.0.0.1:0", "--data"])
            .arg(data.path())
            .output()
            .expect("the binary runs");
        assert_eq!(output.status.code(), Some(1));
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(said.contains(&*path.display().to_string()), "{said}");
    }
}

#[tokio::test]
async fn a_list_names_the_parameter_that_is_wrong() {
    let server = Server::start();
    let list = server.get("/v1/jobs?state=resting").send().await;
    let problem = json(list.expect("an answer")).await;
    let said = detail(&problem);
    assert!(
        said.contains("state") && said.contains("unknown variant"),
        "{said}"
    );
}
