//! What clients note of jobs and ask of their results; jobs that are looked for.

use reqwest::multipart::{Form, Part};
use serde_json::{Value, json as object};

use crate::meshes;
use crate::server::{Server, assert_problem, json};

/// The path of a list.
fn asked(server: &Server, query: &[(&str, &str)]) -> String {
    let url = reqwest::Url::parse_with_params(&server.url("/v1/jobs"), query);
    let url = url.expect("an address");
    format!("/v1/jobs?{}", url.query().unwrap_or_default())
}

/// The ids of a list.
async fn listed(server: &Server, query: &[(&str, &str)]) -> Vec<Value> {
    let answer = server.get(&asked(server, query)).send().await;
    let answer = answer.expect("an answer");
    assert_eq!(answer.status(), 200, "{query:?}");
    let list = json(answer).await;
    let jobs = list["jobs"].as_array().expect("jobs").iter();
    jobs.map(|job| job["id"].clone()).collect()
}

async fn submitted(server: &Server, form: Form) -> Value {
    let form = form.part("mesh", Part::bytes(meshes::small()).file_name("sheet.glb"));
    let answer = server.post("/v1/jobs").multipart(form).send().await;
    let answer = answer.expect("an answer");
    assert_eq!(answer.status(), 202);
    json(answer).await
}

#[tokio::test]
async fn metadata_is_repeated_and_finds_jobs() {
    let server = Server::start();
    let form = Form::new().text("metadata", r#"{"project": "atlas", "frame": 7}"#);
    let first = submitted(&server, form).await;
    assert_eq!(
        first["metadata"],
        object!({ "project": "atlas", "frame": 7 })
    );
    let second = server
        .submit(
            meshes::small(),
            "kind=measure&metadata=%7B%22project%22%3A%22atlas%22%7D",
        )
        .await;
    let third = server.submit(meshes::small(), "resolution=256").await;
    assert_eq!(third["metadata"], object!({}));
    let (first, second, third) = (&first["id"], &second["id"], &third["id"]);
    let found = async |query: &[(&str, &str)]| listed(&server, query).await;
    let atlas = ("metadata", r#"{"project": "atlas"}"#);
    assert_eq!(found(&[atlas]).await, [second.clone(), first.clone()]);
    assert_eq!(
        found(&[atlas, ("kind", "measure")]).await,
        std::slice::from_ref(second)
    );
    assert_eq!(
        found(&[("order", "oldest_first"), ("limit", "2")]).await,
        [first.clone(), second.clone()]
    );
    let after_first = [
        ("order", "oldest_first"),
        ("cursor", first.as_str().expect("an id")),
    ];
    assert_eq!(found(&after_first).await, [second.clone(), third.clone()]);
    assert_eq!(
        found(&[("created_from", "2026-01-01T00:00:00Z")])
            .await
            .len(),
        3
    );
    assert!(
        found(&[("created_before", "2026-01-01T00:00:00Z")])
            .await
            .is_empty()
    );
    assert!(found(&[("owner", "alice")]).await.is_empty());
    assert_eq!(found(&[("owner", "")]).await.len(), 3);
}

#[tokio::test]
async fn metadata_is_changed_in_any_state() {
    let server = Server::start();
    let form = Form::new().text("metadata", r#"{"project": "atlas"}"#);
    let job = submitted(&server, form).await;
    let path = job["links"]["self"].as_str().expect("a link");
    let change = |metadata: &str| {
        let query = [("metadata", metadata)];
        let url = reqwest::Url::parse_with_params(&server.url(path), query).expect("an address");
        server.request(
            "PATCH",
            &format!("{path}?{}", url.query().unwrap_or_default()),
        )
    };
    let answer = change(r#"{"name": "Chair", "hero": true}"#).send().await;
    let answer = answer.expect("an answer");
    assert_eq!(answer.status(), 200);
    let named = object!({ "name": "Chair", "hero": true });
    assert_eq!(json(answer).await["metadata"], named);
    // The end of the job keeps them, and they are changed after it.
    let ended = server.get(&format!("{path}?wait=60")).send().await;
    let ended = json(ended.expect("an answer")).await;
    assert_eq!(
        (&ended["state"], &ended["metadata"]),
        (&object!("succeeded"), &named)
    );
    assert_eq!(
        listed(&server, &[("metadata", r#"{"hero": true}"#)]).await,
        [job["id"].clone()]
    );
    assert!(
        listed(&server, &[("metadata", r#"{"project": "atlas"}"#)])
            .await
            .is_empty()
    );
    let answer = change("{}").send().await.expect("an answer");
    assert_eq!(json(answer).await["metadata"], object!({}));
    assert!(
        listed(&server, &[("metadata", r#"{"hero": true}"#)])
            .await
            .is_empty()
    );
    // What is no metadata changes nothing.
    for wrong in ["7", "{"] {
        assert_problem(
            change(wrong).send().await.expect("an answer"),
            400,
            "invalid_request",
        )
        .await;
    }
    let bare = server
        .request("PATCH", path)
        .send()
        .await
        .expect("an answer");
    assert_problem(bare, 400, "invalid_request").await;
    let gone = server
        .request(
            "PATCH",
            "/v1/jobs/01a22773-0000-7000-8000-000000000000?metadata={}",
        )
        .send()
        .await;
    assert_problem(gone.expect("an answer"), 404, "job_not_found").await;
}

#[tokio::test]
async fn what_cannot_be_looked_for_is_named() {
    let server = Server::start();
    for (name, value) in [
        ("metadata", "7"),
        ("metadata", "{"),
        ("created_from", "yesterday"),
        ("owner", "no such name"),
        ("order", "upwards"),
        ("kind", "fold"),
    ] {
        let answer = server.get(&asked(&server, &[(name, value)])).send().await;
        let problem = assert_problem(answer.expect("an answer"), 400, "invalid_request").await;
        let detail = problem["detail"].as_str().expect("a detail");
        assert!(detail.contains(name), "{detail}");
    }
    let long = format!("{{\"a\":\"{}\"}}", "x".repeat(4096));
    let many: Vec<String> = (0..65).map(|n| format!("\"{n}\":0")).collect();
    let many = format!("{{{}}}", many.join(","));
    for metadata in [&*long, &many, "[]"] {
        let form = Form::new().text("metadata", metadata.to_owned());
        let form = form.part("mesh", Part::bytes(meshes::small()).file_name("sheet.glb"));
        let answer = server.post("/v1/jobs").multipart(form).send().await;
        assert_problem(answer.expect("an answer"), 400, "invalid_request").await;
    }
    // Nothing is kept of a synchronous call.
    let answer = server
        .post("/v1/unwrap?metadata=%7B%7D")
        .body(meshes::small());
    let answer = answer.send().await.expect("an answer");
    assert_problem(answer, 400, "invalid_request").await;
}

#[tokio::test]
async fn gates_say_whether_a_result_is_accepted() {
    let server = Server::start();
    let accepted = async |query: &str| {
        let job = server.submit(meshes::small(), query).await;
        assert!(job["accepted"].is_null() || job["cached"] == true, "{job}");
        let job = server.ended(&job).await;
        assert_eq!(job["state"], "succeeded", "{job}");
        (job["accepted"].clone(), job["accept"].clone())
    };
    let (yes, no) = (object!(true), object!(false));
    assert_eq!(accepted("resolution=512").await, (Value::Null, Value::Null));
    let gates = "accept=certified,max_charts%3D99";
    let expected = (yes, object!("certified,max_charts=99"));
    assert_eq!(accepted(&format!("resolution=512&{gates}")).await, expected);
    // The result of an equal job is judged anew.
    let (verdict, _) = accepted("resolution=512&accept=max_charts%3D0").await;
    assert_eq!(verdict, no);
    let (verdict, _) = accepted("resolution=512&accept=max_distortion%3D3.9").await;
    assert_eq!(verdict, no, "an isometry has 4");
    for (query, named) in [
        ("accept=certain", "certain"),
        (
            "kind=measure&accept=certified",
            "measure job proves nothing",
        ),
    ] {
        let answer = server
            .post(&format!("/v1/jobs?{query}"))
            .body(meshes::small());
        let answer = answer.send().await.expect("an answer");
        let problem = json(answer).await;
        let detail = problem["detail"].as_str().expect("a detail");
        assert!(detail.contains(named), "{detail}");
    }
}

#[tokio::test]
async fn a_failed_job_meets_no_gate() {
    let server = Server::start();
    let job = server
        .submit(meshes::small(), "kind=verify&accept=written")
        .await;
    let job = server.ended(&job).await;
    assert_eq!(
        (&job["state"], &job["accepted"]),
        (&"failed".into(), &false.into()),
        "{job}"
    );
}

#[tokio::test]
async fn verify_is_a_kind_of_job() {
    let server = Server::start();
    let job = server
        .ended(&server.submit(meshes::small(), "resolution=512").await)
        .await;
    let path = format!("{}/result", job["links"]["self"].as_str().expect("a link"));
    let glb = server.get(&path).send().await.expect("an answer");
    let glb = glb.bytes().await.expect("bytes").to_vec();
    let verified = async |query: &str| {
        let job = server
            .submit(glb.clone(), &format!("kind=verify&{query}"))
            .await;
        let job = server.ended(&job).await;
        let path = format!("{}/report", job["links"]["self"].as_str().expect("a link"));
        let report = json(server.get(&path).send().await.expect("an answer")).await;
        (job, report)
    };
    let (job, report) = verified("bijective=true").await;
    assert_eq!(job["certified"], true, "{job}");
    assert_eq!(
        (&report["certified"], &report["lacking"]),
        (&true.into(), &object!([]))
    );
    assert_eq!(report["proven"]["bijective"], true);
    // More than was asked for when it was made.
    let (job, report) = verified("aligned=true").await;
    assert_eq!(job["certified"], false, "{job}");
    assert_eq!(job["warnings"][0]["code"], "not_proven");
    assert_eq!(report["lacking"], object!(["charts not aligned to texels"]));
}
