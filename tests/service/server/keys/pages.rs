//! Browsers: a cookie instead of a header, and streams.

use futures_util::StreamExt;
use reqwest::{RequestBuilder, Response};
use serde_json::Value;
use tokio_tungstenite::tungstenite::client::IntoClientRequest;
use tokio_tungstenite::tungstenite::http::Request;

use super::{closed, id, key, keys};
use crate::harness::live::{Heard, Live};
use crate::meshes;
use crate::server::progress::Socket;
use crate::server::sessions::sheet;
use crate::server::{Server, assert_problem, form, json};

/// Signs a page in from an origin; what the cookie is set to.
async fn signed_in(server: &Server, key: &str, origin: &str) -> String {
    let request = server.post("/v1/sign-in").bearer_auth(key);
    let answer = request.header("origin", origin).send().await;
    let answer = answer.expect("an answer");
    assert_eq!(answer.status(), 204);
    let cookie = answer.headers()["set-cookie"].to_str().expect("text");
    cookie.to_owned()
}

/// The name and value of a cookie.
fn pair(cookie: &str) -> &str {
    cookie.split(';').next().unwrap_or_default()
}

async fn with(request: RequestBuilder, cookie: &str) -> Response {
    let request = request.header("cookie", format!("other=1; {cookie}; more=2"));
    request.send().await.expect("an answer")
}

/// A request for a WebSocket with a header.
fn socket(server: &Server, path: &str, (name, value): (&'static str, &str)) -> Request<()> {
    let request = server.socket_url(path).into_client_request();
    let mut request = request.expect("a URL");
    let value = value.parse().expect("a header");
    request.headers_mut().insert(name, value);
    request
}

#[tokio::test]
async fn a_page_signs_in_and_out() {
    let server = closed();
    let own = server.url("");
    let alice = key(&server, "alice", &[]);
    let cookie = signed_in(&server, &alice, &own).await;
    for attribute in ["HttpOnly", "SameSite=Strict", "Max-Age=43200"] {
        assert!(cookie.contains(attribute), "{cookie}");
    }
    // It is sent to everything below /v1, whatever is in front of that, and is not the key.
    assert!(!cookie.contains("Path") && !cookie.contains("Secure"));
    assert!(!cookie.contains(&alice) && !cookie.contains(id(&alice)));
    let cookie = pair(&cookie);

    let who = json(with(server.get("/v1/sign-in"), cookie).await).await;
    assert_eq!(
        (&who["owner"], &who["signed_in"]),
        (&"alice".into(), &true.into())
    );
    assert_eq!(who["scopes"], serde_json::json!(["read", "write"]));
    let upload = server.post("/v1/jobs").header("origin", &own);
    let job = json(with(upload.body(meshes::small()), cookie).await).await;
    assert_eq!(job["owner"], "alice");
    // Other sites cannot use it, even where a browser would send it.
    let foreign = server
        .post("/v1/jobs")
        .header("origin", "https://foe.example");
    let foreign = with(foreign.body(meshes::small()), cookie).await;
    assert_problem(foreign, 403, "foreign_origin").await;
    // Whoever lists keys sees that the key was used, and no others.
    let listed = keys(&server, &["list", "--json"]).stdout;
    let listed: Value = serde_json::from_slice(&listed).expect("JSON");
    assert_eq!(listed.as_array().map(Vec::len), Some(1));

    let out = server
        .request("DELETE", "/v1/sign-in")
        .header("origin", &own);
    let out = with(out, cookie).await;
    assert_eq!(out.status(), 204);
    let emptied = out.headers()["set-cookie"].to_str().expect("text");
    assert!(emptied.starts_with("unwrapd-key=;") && emptied.contains("Max-Age=0"));
    let refused = with(server.get("/v1/jobs"), cookie).await;
    assert_problem(refused, 401, "key_refused").await;
    // The key is as good as before; without a page there is nothing to sign out.
    let kept = server.request("DELETE", "/v1/sign-in").bearer_auth(&alice);
    assert_eq!(kept.send().await.expect("an answer").status(), 204);
    let kept = server.get("/v1/jobs").bearer_auth(&alice).send().await;
    assert_eq!(kept.expect("an answer").status(), 200);
}

#[tokio::test]
async fn over_tls_the_cookie_is_for_tls_only() {
    let server = Server::with(&[
        ("UNWRAPD_REQUIRE_KEYS", "true"),
        ("UNWRAPD_ALLOW_ORIGIN", "https://mesh.example"),
    ]);
    let alice = key(&server, "alice", &["--scope", "read"]);
    let cookie = signed_in(&server, &alice, "https://mesh.example").await;
    assert!(cookie.contains("; Secure"), "{cookie}");
}

#[tokio::test]
async fn without_keys_there_is_nothing_to_sign_in_to() {
    let server = Server::start();
    let answer = server.post("/v1/sign-in").send().await.expect("an answer");
    assert_problem(answer, 409, "no_keys").await;
    let who = json(server.get("/v1/sign-in").send().await.expect("an answer")).await;
    assert_eq!(
        (&who["owner"], &who["signed_in"]),
        (&Value::Null, &false.into())
    );
}

/// A job of a key that goes on until it is cancelled.
async fn endless(server: &Server, key: &str) -> Value {
    let request = server.post("/v1/jobs?cut=disk").bearer_auth(key);
    let job = request
        .body(meshes::large())
        .send()
        .await
        .expect("an answer");
    json(job).await
}

#[tokio::test]
async fn events_and_frames_end_with_the_key() {
    let server = closed();
    let (bob, alice) = (key(&server, "bob", &[]), key(&server, "alice", &[]));
    let cookie = signed_in(&server, &alice, &server.url("")).await;
    let cookie = pair(&cookie);
    let bearer = format!("Bearer {alice}");
    let job = endless(&server, &alice).await;
    let events = job["links"]["events"].as_str().expect("a link");
    let mut sockets = Vec::new();
    for header in [("authorization", bearer.as_str()), ("cookie", cookie)] {
        let mut events = Socket::connect(socket(&server, events, header)).await;
        events.next().await.expect("an event");
        sockets.push(events);
    }
    let request = server.get(events).header("accept", "text/event-stream");
    let answer = with(request, cookie).await;
    assert_eq!(answer.status(), 200);
    let mut stream = answer.bytes_stream();
    stream.next().await.expect("an event").expect("bytes");
    let form = form("deform", "{}", ("sheet.off", sheet(3).1));
    let session = server.post("/v1/sessions").bearer_auth(&alice);
    let session = session.multipart(form).send().await.expect("an answer");
    let session = json(session).await;
    let live = session["links"]["live"].as_str().expect("a link");
    let mut live = Live::connect(socket(&server, live, ("cookie", cookie))).await;

    // What another asks of them ends nothing: the end below is that of the key.
    let request = server.get(events).header("accept", "text/event-stream");
    let another = request.bearer_auth(&bob).send().await.expect("an answer");
    assert_problem(another, 404, "job_not_found").await;
    for method in ["DELETE", "GET"] {
        let path = job["links"]["self"].as_str().expect("a link");
        let another = server.request(method, path).bearer_auth(&bob).send().await;
        assert_problem(another.expect("an answer"), 404, "job_not_found").await;
    }

    keys(&server, &["revoke", id(&alice)]);
    for events in &mut sockets {
        while events.next().await.is_some() {}
        assert_eq!(events.closed, Some(1008));
    }
    while stream.next().await.is_some() {}
    loop {
        if let Heard::Closed(code, reason) = live.hear().await {
            assert_eq!((code, reason.as_str()), (1008, "key_refused"));
            break;
        }
    }
    let refused = with(server.get(events), cookie).await;
    assert_problem(refused, 401, "key_refused").await;
}
