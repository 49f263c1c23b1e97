//! What belongs to one owner does not exist for another: asked of every operation that the OpenAPI
//! document has, so that none is forgotten.

use reqwest::Response;
use serde_json::{Value, json};

use super::{closed, key};
use crate::meshes;
use crate::openapi::stored;
use crate::server::sessions::sheet;
use crate::server::{Server, form, json as read};

/// Whoever needs none of what others made: operations without an id in their path.
const WITHOUT_ID: [&str; 10] = [
    "/v1/decode",
    "/v1/jobs/retry",
    "/metrics",
    "/v1/drain",
    "/v1/jobs",
    "/v1/measure",
    "/v1/pause",
    "/v1/sessions",
    "/v1/sign-in",
    "/v1/unwrap",
];
/// An id that nothing has.
const UNKNOWN: &str = "01890a5d-ac96-774b-bcce-b302099a8057";

/// Methods and paths of the operations that ask for keys.
fn operations() -> Vec<(String, String)> {
    let document = stored();
    let paths = document["paths"].as_object().expect("paths");
    let all = paths.iter().flat_map(|(path, methods)| {
        let methods = methods.as_object().expect("methods").iter();
        let closed = methods.filter(|(_, it)| it["security"] != json!([]));
        closed.map(|(method, _)| (method.to_uppercase(), path.clone()))
    });
    all.collect()
}

/// A path with its places filled in.
fn filled(path: &str, id: &str) -> String {
    let filled = path
        .replace("{id}", id)
        .replace("{index}", "0")
        .replace("{name}", "any.bin");
    assert!(!filled.contains('{'), "what is in {path}?");
    filled
}

async fn ask(server: &Server, method: &str, path: &str, key: Option<&str>) -> Response {
    let query = if method == "PATCH" {
        "?metadata=%7B%7D"
    } else {
        ""
    };
    let mut request = server
        .request(method, &format!("{path}{query}"))
        .header("accept", "text/event-stream");
    if let Some(key) = key {
        request = request.bearer_auth(key);
    }
    request.send().await.expect("an answer")
}

/// All of an answer that a client sees, but for the time and the name of the request.
async fn seen(answer: Response) -> (u16, String, Vec<u8>) {
    let status = answer.status().as_u16();
    let mut headers = answer.headers().clone();
    headers.remove("date");
    headers.remove("x-request-id");
    let headers = format!("{headers:?}");
    let body = answer.bytes().await.expect("a body").to_vec();
    (status, headers, body)
}

/// A job of an owner that has succeeded.
async fn job(server: &Server, key: &str) -> Value {
    let request = server.post("/v1/jobs?filename=sheet.glb").bearer_auth(key);
    let request = request
        .header("prefer", "wait=60")
        .header("idempotency-key", "night-run");
    let job = read(
        request
            .body(meshes::small())
            .send()
            .await
            .expect("an answer"),
    )
    .await;
    assert_eq!(job["state"], "succeeded", "{job}");
    job
}

async fn session(server: &Server, key: &str) -> Value {
    let request = server.post("/v1/sessions").bearer_auth(key);
    let form = form("deform", "{}", ("sheet.off", sheet(3).1));
    let session = request.multipart(form).send().await.expect("an answer");
    assert_eq!(session.status(), 201);
    read(session).await
}

fn id(of: &Value) -> &str {
    of["id"].as_str().expect("an id")
}

#[tokio::test]
async fn no_operation_is_open_by_mistake() {
    let server = closed();
    let open = [
        "/healthz",
        "/readyz",
        "/openapi.json",
        "/",
        "/docs",
        "/assets/page.js",
    ];
    for path in open {
        assert_eq!(ask(&server, "GET", path, None).await.status(), 200);
    }
    let operations = operations();
    assert!(operations.len() >= 26, "{operations:?}");
    for (method, path) in operations {
        let answer = ask(&server, &method, &filled(&path, UNKNOWN), None).await;
        assert_eq!(answer.status(), 401, "{method} {path}");
        assert!(answer.headers().contains_key("www-authenticate"));
        assert_eq!(read(answer).await["code"], "key_required");
    }
}

#[tokio::test]
async fn what_is_anothers_is_as_if_it_were_not() {
    let server = closed();
    let [alice, bob] = ["alice", "bob"].map(|owner| key(&server, owner, &[]));
    let (job, session) = (job(&server, &alice).await, session(&server, &alice).await);
    for (method, path) in operations() {
        if !path.contains("{id}") {
            assert!(WITHOUT_ID.contains(&path.as_str()), "whose is {path}?");
            continue;
        }
        let mine = if path.starts_with("/v1/sessions") {
            id(&session)
        } else {
            id(&job)
        };
        let [anothers, nobodys] = [mine, UNKNOWN].map(|id| filled(&path, id));
        let anothers = seen(ask(&server, &method, &anothers, Some(&bob)).await).await;
        let nobodys = seen(ask(&server, &method, &nobodys, Some(&bob)).await).await;
        assert_eq!(anothers, nobodys, "{method} {path}");
        assert_eq!(anothers.0, 404, "{method} {path}");
    }
    // Nothing of it has happened, and their owner finds them.
    for (method, path) in operations() {
        let is_looking = method == "GET" && path.contains("{id}");
        if is_looking && !path.contains("{name}") {
            let id = if path.starts_with("/v1/sessions") {
                id(&session)
            } else {
                id(&job)
            };
            let answer = ask(&server, &method, &filled(&path, id), Some(&alice)).await;
            assert_ne!(answer.status(), 404, "{method} {path}");
            // No cache gives it to others, or to whoever signed out.
            let kept = answer.headers()["cache-control"].to_str().expect("text");
            assert!(kept.contains("no-cache"), "{method} {path}: {kept}");
        }
    }
}

#[tokio::test]
async fn lists_sessions_and_results_are_each_owners_own() {
    let server = closed();
    let [alice, bob] = ["alice", "bob"].map(|owner| key(&server, owner, &[]));
    let admin = key(&server, "root", &["--scope", "admin"]);
    let (made, opened) = (job(&server, &alice).await, session(&server, &alice).await);
    let list = async |path: &str, name: &str, key: &str| {
        let list = read(ask(&server, "GET", path, Some(key)).await).await;
        let list = list[name].as_array().expect("a list").clone();
        list.iter().map(|it| id(it).to_owned()).collect::<Vec<_>>()
    };
    for (path, name, one) in [
        ("/v1/jobs", "jobs", &made),
        ("/v1/sessions", "sessions", &opened),
    ] {
        assert_eq!(list(path, name, &alice).await, [id(one)]);
        assert_eq!(list(path, name, &admin).await, [id(one)]);
        assert!(list(path, name, &bob).await.is_empty());
    }
    // Neither a session nor a job is made of another's job.
    for path in ["/v1/sessions?kind=edit_uv&job=", "/v1/jobs?job="] {
        let of = |id: &str| format!("{path}{id}");
        let anothers = seen(ask(&server, "POST", &of(id(&made)), Some(&bob)).await).await;
        let nobodys = seen(ask(&server, "POST", &of(UNKNOWN), Some(&bob)).await).await;
        assert_eq!(anothers, nobodys);
        assert_eq!(anothers.0, 404);
    }

    // Nor does an equal upload under the same key show that there was one before.
    assert_eq!(made["cached"], false);
    let own = job(&server, &bob).await;
    assert_eq!(
        (&own["cached"], &own["owner"]),
        (&false.into(), &"bob".into())
    );
    assert_ne!(own["id"], made["id"]);
    let again = job(&server, &bob).await;
    assert_eq!(again["id"], own["id"]);
    let call = server.post("/v1/jobs?filename=sheet.glb").bearer_auth(&bob);
    let call = call.body(meshes::small()).send().await.expect("an answer");
    assert_eq!(read(call).await["cached"], true);

    // Who sees everything may end it.
    let path = made["links"]["self"].as_str().expect("a link");
    assert_eq!(
        ask(&server, "DELETE", path, Some(&admin)).await.status(),
        204
    );
    assert_eq!(ask(&server, "GET", path, Some(&alice)).await.status(), 404);
}

#[tokio::test]
async fn one_owner_does_not_take_all_sessions() {
    leaves_a_session(("UNWRAPD_OWNER_SESSIONS", "1")).await;
}

#[tokio::test]
async fn one_owner_has_half_of_the_sessions_by_default() {
    leaves_a_session(("UNWRAPD_SESSIONS", "2")).await;
}

/// An owner who may have one session gets no second one, and another owner does.
async fn leaves_a_session(setting: (&str, &str)) {
    let server = Server::with(&[("UNWRAPD_REQUIRE_KEYS", "1"), setting]);
    let [alice, bob] = ["alice", "bob"].map(|owner| key(&server, owner, &[]));
    let opened = session(&server, &alice).await;
    let form = form("deform", "{}", ("sheet.off", sheet(3).1));
    let second = server.post("/v1/sessions").bearer_auth(&alice);
    let second = second.multipart(form).send().await.expect("an answer");
    crate::server::assert_problem(second, 503, "sessions_taken").await;
    session(&server, &bob).await;
    let path = opened["links"]["self"].as_str().expect("a link");
    assert_eq!(
        ask(&server, "DELETE", path, Some(&alice)).await.status(),
        204
    );
    while ask(&server, "GET", path, Some(&alice)).await.status() != 404 {
        tokio::task::yield_now().await;
    }
    // Its place is free when its process is gone.
    let again = async || {
        let request = server.post("/v1/sessions").bearer_auth(&alice);
        let form = crate::server::form("deform", "{}", ("sheet.off", sheet(3).1));
        let answer = request.multipart(form).send().await.expect("an answer");
        answer.status() == 201
    };
    while !again().await {
        tokio::task::yield_now().await;
    }
}
