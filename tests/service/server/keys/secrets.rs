//! Where keys are not: in the log, in problems, in the database.

use std::fs::{File, read, read_to_string};

use super::key;
use crate::cli::{assert_status, last_error, unwrapd};
use crate::harness::process::{Process, Role};
use crate::harness::program;
use crate::meshes;
use crate::server::{Server, client, owned};

#[tokio::test]
async fn no_key_is_logged_or_stored() {
    let log = tempfile::NamedTempFile::new().expect("a file");
    let folder = tempfile::tempdir().expect("a folder");
    let settings = owned(&[("UNWRAPD_REQUIRE_KEYS", "1"), ("UNWRAPD_LOG", "trace")]);
    let said = File::create(log.path()).expect("a file");
    let process = Process::of(&program(), Role::Serve, folder, &settings, Some(said));
    let data = process.folder().to_string_lossy().into_owned();
    let made = unwrapd(&["keys", "create", "--owner", "alice", "--data", &data]);
    assert_status(&made, 0);
    let alice = String::from_utf8(made.stdout).expect("text");
    let secret = alice.trim().split('_').nth(2).expect("a secret").to_owned();

    let http = client();
    let url = |path: &str| format!("http://{}{path}", process.address());
    let job = http.post(url("/v1/jobs")).bearer_auth(alice.trim());
    let job = job.body(meshes::small()).send().await.expect("an answer");
    assert_eq!(job.status(), 202);
    let signed = http.post(url("/v1/sign-in")).bearer_auth(alice.trim());
    let signed = signed.send().await.expect("an answer");
    let cookie = signed.headers()["set-cookie"].to_str().expect("text");
    let cookie = cookie.split(';').next().unwrap_or_default().to_owned();
    let of_page = cookie.split('_').next_back().expect("a secret").to_owned();
    let seen = http.get(url("/v1/jobs")).header("cookie", &cookie).send();
    assert_eq!(seen.await.expect("an answer").status(), 200);
    let wrong = format!("{}0123", alice.trim());
    let refused = http.get(url("/v1/jobs")).bearer_auth(&wrong).send().await;
    let problem = refused.expect("an answer").text().await.expect("text");

    let log = read_to_string(log.path()).expect("text");
    assert!(log.contains("/v1/jobs"), "it logs much");
    let listed = unwrapd(&["keys", "list", "--json", "--data", &data]).stdout;
    let mut places = vec![
        ("log", log.into_bytes()),
        ("problem", problem.into_bytes()),
        ("list", listed),
    ];
    for name in ["unwrapd.sqlite", "unwrapd.sqlite-wal"] {
        let stored = process.folder().join(name);
        places.push((name, read(stored).unwrap_or_default()));
    }
    for secret in [&secret, &of_page] {
        assert_eq!(secret.len(), 64);
        for (name, text) in &places {
            let mut windows = text.windows(secret.len());
            let is_there = windows.any(|part| part == secret.as_bytes());
            assert!(!is_there, "a secret is in the {name}");
        }
    }
}

#[tokio::test]
async fn meshes_are_submitted_with_a_key() {
    let server: Server = super::closed();
    let alice = key(&server, "alice", &[]);
    let folders = crate::bulk::Folders::with(&["a.obj"]);
    let run = |key: Option<&str>| {
        let mut command = folders.submission(&server.url(""), &[]);
        if let Some(key) = key {
            command.env("UNWRAPD_KEY", key);
        }
        command.output().expect("it runs")
    };
    assert_status(&run(None), 4);
    let summary = read_to_string(folders.path("out/summary.csv")).expect("a summary");
    assert!(summary.contains("key_required"), "{summary}");
    let bad = run(Some("no\nkey"));
    assert_status(&bad, 2);
    assert!(!last_error(&bad).contains("no\nkey"));
    let mut again = folders.submission(&server.url(""), &["--retry-failed"]);
    let again = again.env("UNWRAPD_KEY", &alice).output();
    assert_status(&again.expect("it runs"), 0);
}
