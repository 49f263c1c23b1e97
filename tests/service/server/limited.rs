//! What one owner may ask for, and what becomes of more.

use reqwest::Response;

use super::keys::{closed, key};
use super::{Server, assert_problem};
use crate::meshes;

fn header<'a>(answer: &'a Response, name: &str) -> &'a str {
    let value = answer.headers().get(name);
    value.and_then(|value| value.to_str().ok()).unwrap_or("")
}

fn retry_after(answer: &Response) -> u64 {
    header(answer, "retry-after").parse().expect("seconds")
}

#[tokio::test]
async fn an_owner_sends_so_many_requests_in_a_minute() {
    let server = Server::with(&[
        ("UNWRAPD_REQUIRE_KEYS", "1"),
        ("UNWRAPD_OWNER_REQUESTS", "3"),
    ]);
    // Two keys of one owner share what the owner has.
    let [first, second, other] = ["alice", "alice", "bob"].map(|owner| key(&server, owner, &[]));
    let ask = async |key: &str| {
        let answer = server.get("/v1/jobs").bearer_auth(key).send().await;
        answer.expect("an answer")
    };
    // The minute may end while they are sent.
    let refused = loop {
        let mut answers = Vec::new();
        for key in [&first, &second, &first, &second] {
            answers.push(ask(key).await);
        }
        let last = answers.pop().expect("four");
        if last.status() == 429 && answers.iter().all(|it| it.status() == 200) {
            assert_eq!(
                header(&answers[0], "ratelimit-policy"),
                "\"requests\";q=3;w=60"
            );
            let left = |answer| header(answer, "ratelimit").split(";t=").next();
            let left: Vec<_> = answers.iter().filter_map(left).collect();
            let expected = ["\"requests\";r=2", "\"requests\";r=1", "\"requests\";r=0"];
            assert_eq!(left, expected);
            break last;
        }
    };
    assert!((1..=60).contains(&retry_after(&refused)));
    assert!(header(&refused, "ratelimit").starts_with("\"requests\";r=0;t="));
    assert_problem(refused, 429, "rate_limited").await;
    assert_eq!(ask(&other).await.status(), 200);
}

#[tokio::test]
async fn wrong_keys_of_an_address_are_told_to_wait() {
    let server = Server::with(&[("UNWRAPD_REQUIRE_KEYS", "1"), ("UNWRAPD_WRONG_KEYS", "2")]);
    let good = key(&server, "alice", &[]);
    let wrong = key(&closed(), "alice", &[]);
    let ask = async |key: &str| {
        let answer = server.get("/v1/jobs").bearer_auth(key).send().await;
        answer.expect("an answer")
    };
    for _ in 0..2 {
        assert_problem(ask(&wrong).await, 401, "key_refused").await;
    }
    let refused = ask(&wrong).await;
    if refused.status() == 429 {
        assert!((1..=60).contains(&retry_after(&refused)));
        assert_problem(refused, 429, "rate_limited").await;
    } else {
        // A new minute has begun.
        ask(&wrong).await;
        assert_problem(ask(&wrong).await, 429, "rate_limited").await;
    }
    assert_eq!(ask(&good).await.status(), 200);
}

#[tokio::test]
async fn an_owner_has_so_many_jobs_and_so_much_processor_time() {
    let server = Server::with(&[
        ("UNWRAPD_OWNER_JOBS", "1"),
        ("UNWRAPD_OWNER_CPU_SECONDS", "0.001"),
    ]);
    let post = async || {
        let glb = meshes::hills(3);
        let sent = server.post("/v1/jobs?filename=a.glb").body(glb).send();
        sent.await.expect("an answer")
    };
    let pause = async |method| server.request(method, "/v1/pause").send().await;
    pause("PUT").await.expect("an answer");
    let job = super::json(post().await).await;
    let refused = post().await;
    assert_eq!(retry_after(&refused), 60);
    let problem = assert_problem(refused, 429, "owner_quota_used").await;
    assert!(
        problem["detail"]
            .as_str()
            .is_some_and(|it| it.contains("jobs"))
    );
    pause("DELETE").await.expect("an answer");
    assert_eq!(server.ended(&job).await["state"], "succeeded");
    let refused = post().await;
    assert!((1..=86_400).contains(&retry_after(&refused)));
    let problem = assert_problem(refused, 429, "owner_quota_used").await;
    assert!(
        problem["detail"]
            .as_str()
            .is_some_and(|it| it.contains("processor time"))
    );
}
