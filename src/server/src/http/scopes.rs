//! Which scopes an operation takes: whoever looks reads, and everything else writes.

use axum::http::Method;

use crate::jobs::access::Scope;

/// Operations that any key may use: it tells of itself.
const OF_ANY_KEY: &str = "/v1/sign-in";
/// Operations that look like looking, and change something.
const WRITTEN: &str = "/v1/sessions/{id}/live";
/// Operations on what belongs to no owner.
const OF_ALL: [&str; 3] = ["/v1/drain", "/v1/pause", "/metrics"];

/// What a key must be good for.
pub(super) fn needed(method: &Method, path: &str) -> Vec<Scope> {
    if path == OF_ANY_KEY {
        return Vec::new();
    }
    let is_looking = [Method::GET, Method::HEAD].contains(method) && path != WRITTEN;
    let verb = if is_looking {
        Scope::Read
    } else {
        Scope::Write
    };
    let admin = OF_ALL.contains(&path).then_some(Scope::Admin);
    std::iter::once(verb).chain(admin).collect()
}
