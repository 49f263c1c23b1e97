//! What stands in a job beside its files: whether the result is certified, and warnings.

use sqlx::sqlite::{SqliteConnectOptions, SqlitePool};

use crate::certified::cards;
use crate::meshes;
use crate::server::{Server, json};

/// A query under which the writer fills UV set 0 too, and says so.
const WITH_A_WARNING: &str = "texcoord=1&overwrite=true";

#[tokio::test]
async fn warnings_stand_in_the_job_and_survive_a_restart() {
    let mut server = Server::start();
    let job = server.submit(meshes::small(), WITH_A_WARNING).await;
    assert_eq!(job["certified"], serde_json::Value::Null);
    assert_eq!(job["warnings"], serde_json::json!([]));
    let job = server.ended(&job).await;
    assert_eq!(job["certified"], true, "{job}");
    assert_eq!(job["warnings"][0]["code"], "uv_sets_filled", "{job}");
    let path = job["links"]["self"].as_str().expect("a link").to_owned();
    let report = server.get(&format!("{path}/report")).send().await;
    let report = json(report.expect("an answer")).await;
    assert_eq!(report["warnings"], job["warnings"]);
    server.kill();
    server.restart();
    let again = json(server.get(&path).send().await.expect("an answer")).await;
    assert_eq!(again["warnings"], job["warnings"]);
    assert_eq!(again["certified"], true);
}

#[tokio::test]
async fn a_synchronous_answer_names_its_warnings() {
    let server = Server::start();
    let call = format!("/v1/unwrap?{WITH_A_WARNING}");
    let answer = server.post(&call).body(meshes::small()).send().await;
    let answer = answer.expect("an answer");
    assert_eq!(answer.headers()["unwrapd-certified"], "true");
    assert_eq!(answer.headers()["unwrapd-warnings"], "uv_sets_filled");
    let quiet = server.post("/v1/unwrap").body(meshes::small()).send().await;
    let quiet = quiet.expect("an answer");
    assert!(!quiet.headers().contains_key("unwrapd-warnings"));
}

#[tokio::test]
async fn a_data_folder_of_the_first_version_is_brought_up_to_date() {
    let mut server = Server::start();
    server.kill();
    let id = "019a0000-0000-7000-8000-000000000000";
    let file = server.data().join("unwrapd.sqlite");
    for suffix in ["", "-wal", "-shm"] {
        let _ = std::fs::remove_file(format!("{}{suffix}", file.display()));
    }
    let options = SqliteConnectOptions::new().filename(&file);
    let pool = SqlitePool::connect_with(options.create_if_missing(true)).await;
    let pool = pool.expect("a database");
    let first_version = include_str!("../../../src/server/src/store/schema/sqlite/1.sql");
    let row = "INSERT INTO job (id, kind, state, options, input, output, attempt, lost, finish_early, ephemeral, seq, progress, created)
               VALUES ('019a0000-0000-7000-8000-000000000000', 'unwrap', 'succeeded', '{}', '[]', '[]', 1, 0, 0, 0, 9,
                       '{\"stage\":null,\"fraction\":1,\"chart\":0,\"charts\":0,\"iteration\":0,\"energy\":null,\"smallest\":null}', 0)";
    for sql in [first_version, row] {
        sqlx::raw_sql(sql).execute(&pool).await.expect("it is SQL");
    }
    pool.close().await;

    server.restart();
    let old = server.get(&format!("/v1/jobs/{id}")).send().await;
    let old = json(old.expect("an answer")).await;
    assert_eq!(old["state"], "succeeded", "{old}");
    assert_eq!(old["warnings"], serde_json::json!([]));
    let job = server.submit(meshes::small(), WITH_A_WARNING).await;
    assert_eq!(server.ended(&job).await["certified"], true);
}

#[tokio::test]
async fn a_job_that_is_not_certified_succeeds_and_says_so() {
    let server = Server::start();
    let post = async |path: &str| {
        let body = server
            .post(path)
            .header("content-type", "model/obj")
            .body(cards(400));
        body.send().await.expect("an answer")
    };
    let job = json(post("/v1/jobs?resolution=32").await).await;
    let job = server.ended(&job).await;
    assert_eq!(
        (&job["state"], &job["certified"]),
        (&"succeeded".into(), &false.into())
    );
    assert_eq!(job["warnings"][0]["code"], "padding_missed");
    let answer = post("/v1/unwrap?resolution=32").await;
    assert_eq!(answer.status(), 200);
    assert_eq!(answer.headers()["unwrapd-certified"], "false");
    assert_eq!(answer.headers()["unwrapd-warnings"], "padding_missed");
}

#[tokio::test]
async fn a_missed_bound_is_seen_without_reading_the_report() {
    let server = Server::start();
    // Without time, a curved sheet stays in one piece.
    let bound = async |bound: &str| {
        let query = format!("max_distortion={bound}&time_budget=0&resolution=256");
        let job = server.submit(meshes::small(), &query).await;
        let job = server.ended(&job).await;
        assert_eq!(job["state"], "succeeded", "{job}");
        let answer = server
            .post(&format!("/v1/unwrap?{query}"))
            .body(meshes::small())
            .send()
            .await
            .expect("an answer");
        let header = answer.headers()["unwrapd-within-bound"].clone();
        let code = job["warnings"][0]["code"].clone();
        (job["within_bound"].clone(), header, code)
    };
    let (kept, header, _) = bound("9").await;
    assert_eq!((kept, header.as_bytes()), (true.into(), &b"true"[..]));
    let (kept, header, code) = bound("4.0001").await;
    assert_eq!((kept, header.as_bytes()), (false.into(), &b"false"[..]));
    assert_eq!(code, "too_distorted");
}
