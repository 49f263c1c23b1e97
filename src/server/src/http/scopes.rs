//! Scopes required by operations: reading needs `read`, anything else `write`.

use axum::http::Method;

use crate::jobs::access::Scope;

/// Path of operations for any key, which concern the key itself.
const OF_ANY_KEY: &str = "/v1/sign-in";
/// Path of an operation that changes something although its method is GET.
const WRITTEN: &str = "/v1/sessions/{id}/live";
/// Paths of operations on things that belong to no owner, which need `admin`.
const OF_ALL: [&str; 3] = ["/v1/drain", "/v1/pause", "/metrics"];

/// Returns the scopes that an operation requires.
pub(super) fn needed(method: &Method, path: &str) -> Vec<Scope> {
    if path == OF_ANY_KEY {
        return Vec::new();
    }
    let is_reading = [Method::GET, Method::HEAD].contains(method) && path != WRITTEN;
    let verb = if is_reading {
        Scope::Read
    } else {
        Scope::Write
    };
    let admin = OF_ALL.contains(&path).then_some(Scope::Admin);
    std::iter::once(verb).chain(admin).collect()
}
