//! Starts that are refused, with the cause.

use std::process::Command;

use super::Cluster;
use crate::harness::ports::free_port;
use crate::harness::program;
use crate::harness::s3::URL;
use crate::server::assert_problem;
use crate::server::watchable::{metrics, value};

/// The last line of a service that does not start.
fn refusal(settings: &[(String, String)]) -> String {
    let data = tempfile::tempdir().expect("a folder");
    let output = Command::new(program())
        .args(["serve", "--listen", "127.0.0.1:0", "--data"])
        .arg(data.path())
        .envs(settings.iter().cloned())
        .output()
        .expect("it runs");
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(1), "{said}");
    said.lines().last().unwrap_or_default().to_owned()
}

/// The settings with one that is another.
fn with(cluster: &Cluster, name: &str, value: &str) -> Vec<(String, String)> {
    let mut settings = cluster.settings.clone();
    settings.push((name.to_owned(), value.to_owned()));
    settings
}

#[tokio::test]
async fn a_missing_bucket_is_refused_and_a_lost_one_is_not_ready() {
    let cluster = Cluster::start();
    let why = refusal(&with(&cluster, "UNWRAPD_BLOBS_URL", "s3://absent/jobs"));
    assert!(why.contains("does the bucket exist?"), "{why}");
    let why = refusal(&with(&cluster, "AWS_ALLOW_HTTP", "false"));
    assert!(why.contains("AWS_ALLOW_HTTP=true"), "{why}");
    let api = cluster.api();
    let ready = api.get("/readyz").send().await.expect("an answer");
    assert_eq!(ready.status(), 200);
    let bucket = cluster.s3.root().parent().expect("a bucket").to_owned();
    std::fs::rename(&bucket, bucket.with_extension("aside")).expect("a folder");
    let ready = api.get("/readyz").send().await.expect("an answer");
    assert_problem(ready, 503, "not_ready").await;
    let metrics = metrics(&api).await;
    assert_eq!(value(&metrics, "unwrapd_blobs_up"), Some(0.0), "{metrics}");
    assert_eq!(value(&metrics, "unwrapd_store_up"), Some(1.0), "{metrics}");
    assert!(URL.starts_with("s3://meshes"));
}

#[tokio::test]
async fn a_database_that_cannot_be_reached_says_why() {
    let cluster = Cluster::start();
    let at = |place: &str| {
        with(
            &cluster,
            "UNWRAPD_DATABASE_URL",
            &format!("postgres://unwrapd@{place}"),
        )
    };
    let port = cluster.postgres.port();
    for (place, cause) in [
        (
            format!("127.0.0.1:{}/unwrapd", free_port()),
            "Connection refused",
        ),
        (
            format!("127.0.0.1:{port}/absent"),
            "database \"absent\" does not exist",
        ),
        ("nowhere.invalid/unwrapd".to_owned(), "lookup"),
    ] {
        let why = refusal(&at(&place));
        assert!(why.contains(cause) && !why.contains("timed out"), "{why}");
    }
}
