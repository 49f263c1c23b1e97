//! The OpenAPI document.

use serde_json::Value;

use crate::server::{Server, json};

const STORED: &str = include_str!("../../openapi/openapi.json");

#[test]
fn the_stored_document_is_fresh() {
    let fresh = unwrapd::http::openapi();
    let (fresh, stored) = (
        fresh.lines().collect::<Vec<_>>(),
        STORED.lines().collect::<Vec<_>>(),
    );
    let differs = fresh.iter().zip(&stored).find(|(new, old)| new != old);
    let hint = "run: unwrapd openapi > openapi/openapi.json";
    assert_eq!((differs, fresh.len()), (None, stored.len()), "{hint}");
}

#[test]
fn every_operation_says_what_it_answers() {
    let document: Value = serde_json::from_str(STORED).expect("JSON");
    assert!(
        document["openapi"]
            .as_str()
            .is_some_and(|version| version.starts_with("3.1"))
    );
    let mut ids = Vec::new();
    for (path, methods) in document["paths"].as_object().expect("paths") {
        for (method, operation) in methods.as_object().expect("methods") {
            ids.push(operation["operationId"].as_str().expect("an id"));
            assert!(operation["summary"].is_string(), "{method} {path}");
            for (status, answer) in operation["responses"].as_object().expect("answers") {
                let described = answer["description"].as_str();
                assert!(
                    described.is_some_and(|text| !text.is_empty()),
                    "{method} {path} {status}"
                );
            }
        }
    }
    let count = ids.len();
    ids.sort_unstable();
    ids.dedup();
    assert_eq!(ids.len(), count, "each has its own id");
}

#[tokio::test]
async fn the_service_hands_out_the_same_document() {
    let server = Server::start();
    let served = json(server.get("/openapi.json").send().await.expect("an answer")).await;
    assert_eq!(served, serde_json::from_str::<Value>(STORED).expect("JSON"));
}
