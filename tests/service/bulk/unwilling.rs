//! `unwrapd submit` and a service that is busy, fails, or means ill.

use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use axum::Router;
use axum::extract::{Path, State};
use axum::http::{HeaderMap, StatusCode};
use axum::response::{IntoResponse, Response};
use axum::routing::{get, post};
use serde_json::{Value, json};

use super::Folders;
use crate::cli::assert_status;

/// What the service was asked, and what its job made.
#[derive(Clone)]
struct Script {
    /// Time and key of each submission.
    submissions: Arc<Mutex<Vec<(Instant, String)>>>,
    /// Times at which the result was asked for.
    fetches: Arc<Mutex<usize>>,
    /// Roles of the files of the job.
    roles: &'static [&'static str],
}

impl Script {
    fn of(roles: &'static [&'static str]) -> Self {
        Self {
            submissions: Arc::default(),
            fetches: Arc::default(),
            roles,
        }
    }

    /// Serves on a free port.
    async fn serve(&self) -> String {
        let router = Router::new()
            .route(
                "/openapi.json",
                get(|| async { body(&json!({"info": {"version": "9"}})) }),
            )
            .route("/v1/jobs", post(submit))
            .route("/v1/jobs/{id}/{*role}", get(file))
            .with_state(self.clone());
        let listener = tokio::net::TcpListener::bind("127.0.0.1:0").await;
        let listener = listener.expect("a port");
        let address = listener.local_addr().expect("an address");
        tokio::spawn(axum::serve(listener, router).into_future());
        format!("http://{address}")
    }
}

fn body(value: &Value) -> Response {
    value.to_string().into_response()
}

/// The first is told to wait, the second that something is out of order.
async fn submit(State(script): State<Script>, headers: HeaderMap) -> Response {
    let key = headers["idempotency-key"]
        .to_str()
        .expect("text")
        .to_owned();
    let number = {
        let mut submissions = script.submissions.lock().expect("no panic");
        submissions.push((Instant::now(), key));
        submissions.len()
    };
    match number {
        1 => {
            let problem = json!({"code": "queue_full", "detail": "try again later"});
            let answer = (StatusCode::TOO_MANY_REQUESTS, problem.to_string());
            ([("retry-after", "1")], answer).into_response()
        }
        2 => StatusCode::BAD_GATEWAY.into_response(),
        _ => {
            let href = |role: &&str| json!({"href": format!("/v1/jobs/7/{role}"), "name": "x", "bytes": 3});
            let files: Vec<Value> = script.roles.iter().map(href).collect();
            body(&json!({
                "id": "7", "state": "succeeded",
                "links": {"self": "/v1/jobs/7", "events": "/v1/jobs/7/events", "files": files}
            }))
        }
    }
}

async fn file(State(script): State<Script>, Path((_, role)): Path<(String, String)>) -> Response {
    if role == "report" {
        let measures =
            json!({"faces": 1, "charts": 1, "sym_dirichlet_mean": 4.0, "stretch_p99": 1});
        let groups = [json!({"measures": measures})];
        return body(&json!({"certified": true, "warnings": [], "groups": groups}));
    }
    let mut fetches = script.fetches.lock().expect("no panic");
    *fetches += 1;
    if *fetches == 1 {
        return StatusCode::SERVICE_UNAVAILABLE.into_response();
    }
    "abc".into_response()
}

/// The exit status of a run.
async fn run(folders: Folders, url: String) -> (Folders, std::process::Output) {
    let run = tokio::task::spawn_blocking(move || {
        let output = folders.submit(&url, &[]);
        (folders, output)
    });
    run.await.expect("an end")
}

#[tokio::test]
async fn a_busy_service_is_waited_for_as_long_as_it_asks() {
    let script = Script::of(&["result", "report", "layout.png"]);
    let (folders, output) = run(Folders::of(1), script.serve().await).await;
    assert_status(&output, 0);
    assert_eq!(folders.outputs(), ["000.glb"]);
    let content = std::fs::read(folders.path("out/000.glb")).expect("an output");
    assert_eq!(content, b"abc");
    let submissions = script.submissions.lock().expect("no panic");
    let [first, second, third] = submissions.as_slice() else {
        panic!("{submissions:?}");
    };
    assert!(Duration::from_secs(1) <= second.0 - first.0, "told to wait");
    assert!(first.1 == second.1 && second.1 == third.1, "one submission");
    assert_eq!(
        *script.fetches.lock().expect("no panic"),
        2,
        "nobody asked for pictures"
    );
}

#[tokio::test]
async fn names_from_a_service_do_not_lead_out_of_the_folder() {
    let script = Script::of(&["result", "files/../../../stolen", "report"]);
    let (folders, output) = run(Folders::of(1), script.serve().await).await;
    assert_status(&output, 4);
    assert_eq!(
        folders.summary("summary.csv")["000.obj"]["code"],
        "output_unwritable"
    );
    assert!(folders.outputs().is_empty());
    assert!(!folders.path("stolen").exists() && !folders.path("../stolen").exists());
}
