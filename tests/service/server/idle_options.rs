//! The service refuses the options that would do nothing, as the command line does.

use crate::cli_options::IDLE;
use crate::meshes;
use crate::server::{Server, assert_problem};

#[tokio::test]
async fn options_that_would_do_nothing_are_refused() {
    let server = Server::start();
    for (_, query, name) in IDLE {
        let request = server.post(&format!("/v1/jobs?{query}"));
        let answer = request.body(meshes::small()).send().await;
        let problem = assert_problem(answer.expect("an answer"), 400, "invalid_options").await;
        let detail = problem["detail"].as_str().expect("text");
        assert!(detail.contains(&format!("`{name}`")), "{detail}");
    }
}
