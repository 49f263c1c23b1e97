//! Who is let in.

use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

use serde_json::Value;

use super::{closed, id, key, keys};
use crate::cli::{assert_status, last_error, unwrapd};
use crate::harness::program;
use crate::meshes;
use crate::server::{SOON, Server, assert_problem, client, json};

/// The status of a look at the jobs.
async fn status(server: &Server, key: Option<&str>) -> u16 {
    let mut request = server.get("/v1/jobs");
    if let Some(key) = key {
        request = request.bearer_auth(key);
    }
    request.send().await.expect("an answer").status().as_u16()
}

/// Waits until a look at the jobs is answered in this way: what is known of keys is some seconds old.
async fn becomes(server: &Server, key: Option<&str>, wanted: u16) {
    let asked = async {
        while status(server, key).await != wanted {
            tokio::time::sleep(Duration::from_millis(50)).await;
        }
    };
    let seen = tokio::time::timeout(SOON, asked).await;
    seen.unwrap_or_else(|_| panic!("it does not become {wanted}"));
}

#[tokio::test]
async fn the_first_key_closes_the_service_for_good() {
    let server = Server::start();
    assert_eq!(status(&server, None).await, 200);
    assert_eq!(status(&server, Some("of another service")).await, 200);
    let early = server.submit(meshes::small(), "").await;
    assert_eq!(early["owner"], Value::Null);

    let alice = key(&server, "alice", &[]);
    becomes(&server, None, 401).await;
    let refused = server.get("/v1/jobs").send().await.expect("an answer");
    let challenge = refused.headers()["www-authenticate"].to_str();
    assert!(challenge.is_ok_and(|it| it.starts_with("Bearer ")));
    assert_problem(refused, 401, "key_required").await;
    assert_eq!(status(&server, Some(&alice)).await, 200);

    // What was made without a key is seen by who sees everything.
    let path = early["links"]["self"].as_str().expect("a link");
    let admin = key(&server, "root", &["--scope", "admin"]);
    for (key, wanted) in [(&alice, 404), (&admin, 200)] {
        let answer = server.get(path).bearer_auth(key).send().await;
        assert_eq!(answer.expect("an answer").status(), wanted);
    }
    // Two keys at once: one replaces the other.
    let next = key(&server, "alice", &["--name", "for the next year"]);
    keys(&server, &["revoke", id(&alice)]);
    becomes(&server, Some(&alice), 401).await;
    assert_eq!(status(&server, Some(&next)).await, 200);
    for key in [&next, &admin] {
        keys(&server, &["revoke", id(key)]);
        becomes(&server, Some(key), 401).await;
    }
    assert_eq!(status(&server, None).await, 401);
}

#[tokio::test]
async fn keys_that_are_none_are_refused() {
    let server = closed();
    assert_eq!(status(&server, None).await, 401);
    let alice = key(&server, "alice", &[]);
    let flipped = match alice.strip_suffix('0') {
        Some(most) => format!("{most}1"),
        None => format!("{}0", &alice[..alice.len() - 1]),
    };
    let unknown = alice.replace(id(&alice), "0123456789abcdef");
    for bad in [
        flipped.as_str(),
        &unknown,
        &alice[..alice.len() - 1],
        id(&alice),
        "uw__",
        "x",
    ] {
        let answer = server.get("/v1/jobs").bearer_auth(bad).send().await;
        let problem = assert_problem(answer.expect("an answer"), 401, "key_refused").await;
        assert!(!problem.to_string().contains(bad) || bad == "x");
    }
    // Only a scheme that is ours is read, and it in any case.
    for (scheme, wanted) in [("bearer", 200), ("BEARER", 200), ("Basic", 401)] {
        let header = format!("{scheme} {alice}");
        let request = server.get("/v1/jobs").header("authorization", header);
        assert_eq!(request.send().await.expect("an answer").status(), wanted);
    }
}

/// Who is still sending when the answer comes reads it all the same.
#[tokio::test]
async fn a_large_upload_without_a_key_is_answered() {
    let server = closed();
    let upload = server.post("/v1/jobs").body(vec![0; 16 << 20]).send().await;
    assert_problem(upload.expect("an answer"), 401, "key_required").await;
}

#[tokio::test]
async fn a_key_ends_at_its_time() {
    let server = closed();
    let short = key(&server, "alice", &["--expires", "3s"]);
    assert_eq!(status(&server, Some(&short)).await, 200);
    becomes(&server, Some(&short), 401).await;
    let listed = keys(&server, &["list", "--json"]).stdout;
    let listed: Value = serde_json::from_slice(&listed).expect("JSON");
    assert_eq!(listed[0]["state"], "expired");
    assert!(listed[0]["used"].is_string());
}

#[tokio::test]
async fn scopes_say_what_a_key_may_do() {
    let server = closed();
    let ask = async |method: &str, path: &str, key: &str| {
        let request = server.request(method, path).bearer_auth(key);
        let request = request.body(if method == "GET" {
            Vec::new()
        } else {
            meshes::small()
        });
        request.send().await.expect("an answer")
    };
    let of = |scopes: &str| key(&server, "alice", &["--scope", scopes]);
    let [reader, writer, watcher, admin] = ["read", "write", "read,admin", "admin"].map(of);
    let made = json(ask("POST", "/v1/jobs", &writer).await).await;
    assert_eq!(made["owner"], "alice");
    let path = made["links"]["self"].as_str().expect("a link");
    for (method, path, allowed) in [
        ("GET", "/v1/jobs", [&reader, &watcher, &admin].as_slice()),
        ("GET", path, &[&reader, &watcher, &admin]),
        ("POST", "/v1/measure", &[&writer, &admin]),
        ("GET", "/v1/sessions", &[&reader, &watcher, &admin]),
        ("GET", "/metrics", &[&watcher, &admin]),
        ("PUT", "/v1/pause", &[&admin]),
        ("GET", "/v1/drain", &[&watcher, &admin]),
        ("DELETE", "/v1/drain", &[&admin]),
        ("GET", "/v1/sign-in", &[&reader, &writer, &watcher, &admin]),
    ] {
        for key in [&reader, &writer, &watcher, &admin] {
            let answer = ask(method, path, key).await;
            if allowed.contains(&key) {
                assert!(answer.status() != 403, "{method} {path}: {answer:?}");
            } else {
                assert_problem(answer, 403, "missing_scope").await;
            }
        }
    }
}

/// Serves on all interfaces for a moment: how a call without a key is answered, and the log.
async fn exposed(data: &Path, more: &[&str]) -> (u16, String) {
    let mut command = serve(data);
    let pipes = command.args(more).stdout(Stdio::piped());
    let mut server = pipes.stderr(Stdio::piped()).spawn().expect("it starts");
    let mut stdout = BufReader::new(server.stdout.take().expect("piped"));
    let mut line = String::new();
    stdout.read_line(&mut line).expect("its address");
    let (_, port) = line.trim().rsplit_once(':').expect("its address");
    let url = format!("http://127.0.0.1:{port}/v1/jobs");
    let answer = client().get(url).send().await.expect("an answer");
    server.kill().expect("it is ours");
    let output = server.wait_with_output().expect("it is ours");
    let log = String::from_utf8_lossy(&output.stderr).into_owned();
    (answer.status().as_u16(), log)
}

fn serve(data: &Path) -> Command {
    let mut command = Command::new(program());
    command.args(["serve", "--listen", "0.0.0.0:0", "--data"]);
    command.arg(data);
    command
}

#[tokio::test]
async fn what_others_reach_needs_keys_or_a_word() {
    let folder = tempfile::tempdir().expect("a folder");
    let refused = serve(folder.path()).output().expect("it runs");
    assert_eq!(refused.status.code(), Some(1));
    let said = last_error(&refused);
    assert!(said.contains("--allow-anonymous") && said.contains("keys create"));

    let (status, log) = exposed(folder.path(), &["--allow-anonymous"]).await;
    assert_eq!(status, 200);
    assert!(log.contains("NO API KEYS"), "{log}");
    let (status, log) = exposed(folder.path(), &["--require-keys"]).await;
    assert_eq!(status, 401);
    assert!(log.contains("keys create"), "{log}");

    let data = folder.path().to_string_lossy().into_owned();
    assert_status(
        &unwrapd(&["keys", "create", "--owner", "alice", "--data", &data]),
        0,
    );
    for more in [&[][..], &["--allow-anonymous"]] {
        let (status, log) = exposed(folder.path(), more).await;
        assert_eq!(status, 401);
        assert!(!log.contains("NO API KEYS"), "{log}");
    }
}

#[test]
fn keys_that_cannot_be_made_or_revoked_are_usage_errors_or_named() {
    let folder = tempfile::tempdir().expect("a folder");
    let data = folder.path().to_string_lossy().into_owned();
    for arguments in [
        &["create"][..],
        &["create", "--owner", "a b"],
        &["create", "--owner", "alice", "--scope", "all"],
        &["create", "--owner", "alice", "--expires", "soon"],
        &["create", "--owner", "alice", "--expires", "0s"],
        &["create", "--owner", "alice", "--name", "a\nb"],
        &["revoke", "no-id"],
    ] {
        let output = unwrapd(&[&["keys"], arguments, &["--data", &data]].concat());
        assert_status(&output, 2);
    }
    let unknown = unwrapd(&["keys", "revoke", "0123456789abcdef", "--data", &data]);
    assert_status(&unknown, 1);
    assert!(last_error(&unknown).contains("0123456789abcdef"));
}
