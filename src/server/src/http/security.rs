//! Keys in the OpenAPI document: how they are sent, and which scopes each operation requires.

use axum::http::Method;
use serde_json::{Map, Value, json};

use super::admission::COOKIE;
use super::answers::problems;
use super::code::Code;
use super::scopes::needed;
use crate::jobs::access::Scope;

/// Names of the security schemes.
const BEARER: &str = "key";
const OF_PAGE: &str = "page";

/// Adds the security requirements of all operations; those at `open` paths have none.
pub(super) fn describe(document: &mut Value, open: &[String]) {
    document["components"]["securitySchemes"] = json!({
        BEARER: {
            "type": "http",
            "scheme": "bearer",
            "description": "A key that `unwrapd keys create` made. Without any key, a service asks for none.",
        },
        OF_PAGE: {
            "type": "apiKey",
            "in": "cookie",
            "name": COOKIE,
            "description": "The cookie of a page that signed in",
        },
    });
    let paths = document["paths"].as_object_mut();
    for (path, operations) in paths.into_iter().flatten() {
        let operations = operations.as_object_mut();
        for (method, operation) in operations.into_iter().flatten() {
            if open.contains(path) {
                operation["security"] = json!([]);
            } else {
                ask(operation, method, path);
            }
        }
    }
}

fn ask(operation: &mut Value, method: &str, path: &str) {
    let method = method.to_ascii_uppercase();
    let method = Method::from_bytes(method.as_bytes()).unwrap_or_default();
    let scopes: Vec<&str> = needed(&method, path).into_iter().map(Scope::word).collect();
    operation["security"] = json!([{ BEARER: scopes }, { OF_PAGE: scopes }, {}]);
    let mut codes = vec![
        Code::KeyRequired,
        Code::KeyRefused,
        Code::MissingScope,
        Code::RateLimited,
    ];
    // What a page of another site must not do: change something, or open a WebSocket.
    if method != Method::GET || !operation["responses"]["101"].is_null() {
        codes.push(Code::ForeignOrigin);
    }
    let mut refusals = json!(problems(&codes));
    let challenge = json!({ "description": "How to send a key", "schema": { "type": "string" } });
    refusals["401"]["headers"] = json!({ "WWW-Authenticate": challenge });
    for (status, refusal) in refusals.as_object().into_iter().flatten() {
        let answer = &mut operation["responses"][status];
        match answer["description"].as_str() {
            Some(known) => {
                let both = format!("{known}; {}", refusal["description"].as_str().unwrap_or(""));
                answer["description"] = both.into();
            }
            None => *answer = refusal.clone(),
        }
    }
    let answers = operation["responses"].as_object_mut();
    answers.into_iter().for_each(Map::sort_keys);
}
