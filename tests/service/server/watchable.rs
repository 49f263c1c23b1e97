//! What those who run the service see: metrics, logs, settings.

use std::collections::BTreeSet;
use std::fs::File;

use serde_json::Value;
use tempfile::TempDir;

use super::{Server, client, json, owned};
use crate::cli::{assert_status, last_error, unwrapd};
use crate::harness::ports::free_port;
use crate::harness::process::{Process, Role};
use crate::meshes;
use crate::places;

pub async fn metrics(server: &Server) -> String {
    let answer = server.get("/metrics").send().await.expect("an answer");
    assert_eq!(answer.status(), 200);
    answer.text().await.expect("text")
}

/// The value of a series.
pub fn value(metrics: &str, series: &str) -> Option<f64> {
    let mut lines = metrics.lines();
    let text = lines.find_map(|line| line.strip_prefix(series)?.strip_prefix(' '))?;
    text.parse().ok()
}

/// One job that succeeds, one that is a copy of it, one that fails.
async fn some_jobs(server: &Server) {
    for _ in 0..2 {
        let job = server.submit(meshes::hills(3), "").await;
        assert_eq!(server.ended(&job).await["state"], "succeeded");
    }
    let answer = server.post("/v1/jobs?filename=flat.obj");
    let job = json(
        answer
            .body("v 0 0 0\nv 1 0 0\nv 2 0 0\n")
            .send()
            .await
            .expect("an answer"),
    )
    .await;
    assert_eq!(server.ended(&job).await["state"], "failed", "{job}");
}

#[tokio::test]
async fn jobs_are_counted_and_timed() {
    let server = Server::start();
    let before = metrics(&server).await;
    let finished =
        |result| format!("unwrapd_jobs_finished_total{{kind=\"unwrap\",result=\"{result}\"}}");
    assert_eq!(value(&before, &finished("failed")), Some(0.0), "{before}");
    some_jobs(&server).await;
    let after = metrics(&server).await;
    for (series, expected) in [
        ("unwrapd_jobs_enqueued_total{kind=\"unwrap\"}", 3.0),
        (&finished("succeeded"), 1.0),
        (&finished("reused"), 1.0),
        (&finished("failed"), 1.0),
        ("unwrapd_jobs{state=\"succeeded\"}", 2.0),
        ("unwrapd_job_wait_seconds_count{kind=\"unwrap\"}", 2.0),
        (
            "unwrapd_job_stage_seconds_count{kind=\"unwrap\",stage=\"pack\"}",
            1.0,
        ),
        ("unwrapd_store_up", 1.0),
    ] {
        assert_eq!(value(&after, series), Some(expected), "{series}\n{after}");
    }
    assert!(after.contains("unwrapd_build_info{version=\""));
    assert!(Some(1.0) <= value(&after, "unwrapd_connections"), "{after}");
    let route = "unwrapd_http_requests_total{method=\"POST\",route=\"/v1/jobs\",status=\"202\"}";
    assert_eq!(value(&after, route), Some(3.0), "{after}");
}

#[tokio::test]
async fn dashboard_and_alerts_name_metrics_that_exist() {
    let server = Server::with(&[
        ("UNWRAPD_QUOTA_MIB", "64"),
        (
            "UNWRAPD_WEBHOOK_SECRET",
            "a-secret-of-at-least-24-characters",
        ),
    ]);
    some_jobs(&server).await;
    metrics(&server).await;
    let metrics = metrics(&server).await;
    let series: BTreeSet<&str> = metrics
        .lines()
        .filter_map(|line| line.split(['{', ' ']).next())
        .collect();
    let read = |path| std::fs::read_to_string(places::repository(path)).expect("text");
    let (dashboard, alerts) = (read("docker/dashboard.json"), read("docker/alerts.yml"));
    let panels: Value = serde_json::from_str(&dashboard).expect("JSON");
    assert!(panels["panels"].as_array().expect("panels").len() > 10);
    for text in [&dashboard, &alerts] {
        let names = text.match_indices("unwrapd_").map(|(at, _)| &text[at..]);
        let names: BTreeSet<&str> = names
            .map(|rest| {
                let end = rest.find(|c: char| !c.is_ascii_lowercase() && c != '_');
                &rest[..end.unwrap_or(rest.len())]
            })
            .collect();
        let missing: Vec<_> = names.difference(&series).collect();
        assert!(missing.is_empty(), "{missing:?}\n{metrics}");
        assert!(names.len() > 10);
    }
    let rules: Vec<&str> = alerts.split("- alert: ").skip(1).collect();
    assert_eq!(rules.len(), 14);
    for rule in rules {
        let action = rule.split("action: ").nth(1).expect("what to do");
        let sentence = action.lines().next().expect("a line");
        assert!(
            sentence.ends_with('.') && !sentence.contains(". "),
            "{rule}"
        );
    }
}

#[tokio::test]
async fn metrics_may_have_an_address_of_their_own() {
    let address = format!("127.0.0.1:{}", free_port());
    let server = Server::with(&[
        ("UNWRAPD_REQUIRE_KEYS", "1"),
        ("UNWRAPD_METRICS_LISTEN", &address),
    ]);
    let own = server.get("/metrics").send().await.expect("an answer");
    assert_eq!(own.status(), 401);
    let open = client().get(format!("http://{address}/metrics")).send();
    let text = open.await.expect("an answer").text().await.expect("text");
    assert_eq!(value(&text, "unwrapd_store_up"), Some(1.0), "{text}");
    let other = client().get(format!("http://{address}/v1/jobs")).send();
    assert_eq!(other.await.expect("an answer").status(), 404);
}

const TRACE: &str = "00-0af7651916cd43dd8448eb211c80319c-b7ad6b7169203331-01";

#[tokio::test]
async fn logs_lead_from_a_request_to_its_job() {
    let data = TempDir::new().expect("a folder");
    let path = data.path().join("log");
    let log = File::create(&path).expect("a file");
    let settings = owned(&[("UNWRAPD_LOG_FORMAT", "json")]);
    let program = crate::harness::program();
    let process = Process::of(&program, Role::Serve, data, &settings, Some(log));
    let root = format!("http://{}", process.address());
    let submit = client()
        .post(format!("{root}/v1/jobs?filename=a.glb"))
        .header("traceparent", TRACE)
        .header("x-request-id", "night-run.7")
        .body(meshes::hills(3));
    let answer = submit.send().await.expect("an answer");
    assert_eq!(answer.headers()["x-request-id"], "night-run.7");
    let job = json(answer).await;
    let ended = client().get(format!(
        "{root}{}?wait=60",
        job["links"]["self"].as_str().expect("a link")
    ));
    ended.send().await.expect("an answer");
    let text = std::fs::read_to_string(&path).expect("a log");
    let lines: Vec<Value> = text
        .lines()
        .map(|line| serde_json::from_str(line).expect("an object"))
        .collect();
    let about = |message: &str| {
        let mut lines = lines.iter();
        let line = lines.find(|line| line["message"] == message && line["job"] == job["id"]);
        line.unwrap_or_else(|| panic!("{message}: {text}"))
    };
    let accepted = about("accepted");
    assert_eq!(accepted["trace"], TRACE);
    assert_eq!(accepted["span"]["id"], "night-run.7");
    let ended = about("ended");
    assert_eq!(ended["span"]["trace"], TRACE);
}

#[tokio::test]
async fn names_of_requests_are_plain() {
    let server = Server::start();
    for bad in ["", "a b", &"x".repeat(65), "{}"] {
        let answer = server.get("/healthz").header("x-request-id", bad).send();
        let answer = answer.await.expect("an answer");
        let id = answer.headers()["x-request-id"].to_str().expect("text");
        assert_eq!(id.len(), 36, "{bad}: {id}");
    }
}

#[test]
fn config_says_what_is_in_force_and_where_it_comes_from() {
    let output = std::process::Command::new(crate::harness::program())
        .args(["config", "--json", "--sessions", "3", "--blobs", "s3://a/b"])
        .env(
            "UNWRAPD_DATABASE_URL",
            "postgres://me:hush@host/name?password=hush",
        )
        .env("UNWRAPD_QUEUE_DEPHT", "7")
        .env("AWS_ENDPOINT_URL", "http://127.0.0.1:9000")
        .env("AWS_SECRET_ACCESS_KEY", "hush")
        .output()
        .expect("the binary runs");
    assert_status(&output, 0);
    assert!(last_error(&output).contains("UNWRAPD_QUEUE_DEPHT"));
    let text = String::from_utf8(output.stdout).expect("text");
    assert!(!text.contains("hush"), "{text}");
    let rows: Vec<Value> = serde_json::from_str(&text).expect("JSON");
    let row = |option: &str| {
        let found = rows.iter().find(|row| row["option"] == option);
        found.unwrap_or_else(|| panic!("{option}: {text}"))
    };
    for (option, value, source) in [
        ("--sessions", "3", "flag"),
        ("--owner-sessions", "2", "default"),
        (
            "--database",
            "postgres://me:***@host/name?***",
            "environment",
        ),
        ("--queue-depth", "1000", "default"),
        ("--blobs", "s3://a/b", "flag"),
        ("AWS_ENDPOINT_URL", "http://127.0.0.1:9000", "environment"),
        ("AWS_SECRET_ACCESS_KEY", "***", "environment"),
    ] {
        let row = row(option);
        assert_eq!(
            (&row["value"], &row["source"]),
            (&value.into(), &source.into()),
            "{row}"
        );
    }
    assert!(row("--workers")["value"].is_string());
    assert!(row("--quota-mib")["value"].is_null());
}

#[test]
fn every_setting_of_the_service_has_a_variable_with_the_prefix() {
    for command in ["serve", "worker"] {
        let output = unwrapd(&[command, "--help"]);
        let text = String::from_utf8(output.stdout).expect("text");
        let options: Vec<&str> = text.split("\n      --").skip(1).collect();
        assert!(options.len() > 10);
        for option in options {
            assert!(option.contains("[env: UNWRAPD_"), "{command}: --{option}");
        }
    }
}
