//! Routes, problems, OpenAPI, progress, the page.

/// The OpenAPI document of the service, as JSON.
pub fn openapi() -> String {
    "{}".to_owned()
}
