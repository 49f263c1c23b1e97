//! Pages of other sites, and names of other hosts.

use reqwest::RequestBuilder;
use tokio_tungstenite::connect_async;
use tokio_tungstenite::tungstenite::Error;
use tokio_tungstenite::tungstenite::client::IntoClientRequest;

use crate::meshes;
use crate::server::{Server, assert_problem};

const FRIEND: &str = "https://friend.example";
const FOE: &str = "https://foe.example";

fn upload(server: &Server, headers: &[(&str, &str)]) -> RequestBuilder {
    let request = server.post("/v1/jobs").body(meshes::small());
    let add = |request: RequestBuilder, &(name, value): &(&str, &str)| request.header(name, value);
    headers.iter().fold(request, add)
}

/// The status with which a WebSocket of a page is answered.
async fn socket_status(server: &Server, url: &str, origin: &str) -> u16 {
    let mut request = server.socket_url(url).into_client_request().expect("a URL");
    let origin = origin.parse().expect("a header");
    request.headers_mut().insert("origin", origin);
    match connect_async(request).await {
        Ok((_, answer)) => answer.status().as_u16(),
        Err(Error::Http(answer)) => answer.status().as_u16(),
        Err(error) => panic!("{error}"),
    }
}

#[tokio::test]
async fn pages_of_other_origins_are_refused() {
    let server = Server::start();
    let own = server.url("");
    for headers in [
        &[("origin", FOE)][..],
        &[("origin", FOE), ("sec-fetch-site", "cross-site")],
        &[("sec-fetch-site", "same-site")],
        &[("origin", "null")],
    ] {
        let answer = upload(&server, headers).send().await.expect("an answer");
        assert_problem(answer, 403, "foreign_origin").await;
    }
    let page = [("origin", own.as_str()), ("sec-fetch-site", "same-origin")];
    for headers in [&page[..1], &page, &[]] {
        let answer = upload(&server, headers).send().await.expect("an answer");
        assert_eq!(answer.status(), 202);
        assert!(!answer.headers().contains_key("access-control-allow-origin"));
    }
    let job = server.submit(meshes::small(), "resolution=512").await;
    let events = job["links"]["events"].as_str().expect("a link");
    assert_eq!(socket_status(&server, events, FOE).await, 403);
    assert_eq!(socket_status(&server, events, &own).await, 101);
}

#[tokio::test]
async fn pages_that_are_allowed_may_ask_and_read() {
    let server = Server::with(&[("UNWRAPD_ALLOW_ORIGIN", FRIEND)]);
    let asked = server
        .request("OPTIONS", "/v1/jobs")
        .header("origin", FRIEND)
        .header("access-control-request-method", "POST")
        .header("access-control-request-headers", "idempotency-key")
        .send();
    let asked = asked.await.expect("an answer");
    assert_eq!(asked.headers()["access-control-allow-origin"], FRIEND);
    assert_eq!(asked.headers()["access-control-allow-methods"], "POST");
    let headers = [("origin", FRIEND), ("sec-fetch-site", "cross-site")];
    let answer = upload(&server, &headers).send().await.expect("an answer");
    assert_eq!(answer.status(), 202);
    assert_eq!(answer.headers()["access-control-allow-origin"], FRIEND);
    let job: serde_json::Value = answer.json().await.expect("the job");
    let events = job["links"]["events"].as_str().expect("a link");
    assert_eq!(socket_status(&server, events, FRIEND).await, 101);
    let foe = upload(&server, &[("origin", FOE)]).send().await;
    assert_problem(foe.expect("an answer"), 403, "foreign_origin").await;
}

#[tokio::test]
async fn names_that_are_not_the_services_are_refused() {
    let ask = async |server: &Server, host: &str| {
        let answer = server.get("/healthz").header("host", host).send().await;
        answer.expect("an answer")
    };
    let server = Server::start();
    for host in [
        "foe.example",
        "localhost.foe.example:8080",
        "127.0.0.1.foe.example",
    ] {
        assert_problem(ask(&server, host).await, 421, "unknown_host").await;
    }
    for host in ["localhost:1234", "127.0.0.1", "[::1]:8080"] {
        assert_eq!(ask(&server, host).await.status(), 200);
    }
    let server = Server::with(&[("UNWRAPD_ALLOW_HOST", "mesh.example,other.example")]);
    assert_eq!(ask(&server, "Mesh.Example:443").await.status(), 200);
    assert_problem(ask(&server, "foe.example").await, 421, "unknown_host").await;
}

#[tokio::test]
async fn links_begin_with_the_path_of_a_proxy() {
    let server = Server::with(&[("UNWRAPD_BASE_PATH", "/tools/unwrapd/")]);
    let answer = upload(&server, &[]).send().await.expect("an answer");
    let location = answer.headers()["location"]
        .to_str()
        .expect("text")
        .to_owned();
    let job: serde_json::Value = answer.json().await.expect("the job");
    assert!(
        location.starts_with("/tools/unwrapd/v1/jobs/"),
        "{location}"
    );
    assert_eq!(job["links"]["self"], location);
    for link in ["events", "self"] {
        let link = job["links"][link].as_str().expect("a link");
        assert!(link.starts_with(&location), "{link}");
    }
    let input = job["links"]["inputs"][0]["href"].as_str().expect("a link");
    assert!(input.starts_with(&location), "{input}");
}
