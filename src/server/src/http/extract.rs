//! Extractors whose rejections are problems, and the problems of missing jobs.

use std::time::Duration;

use axum::extract::{FromRequestParts, Path, Query};
use axum::http::HeaderMap;
use axum::http::request::Parts;
use serde::de::DeserializeOwned;

use super::app::App;
use super::problem::{Code, Problem};
use crate::jobs::access::Visibility;
use crate::jobs::{Job, JobId};

/// Maximum time for which a request may wait for a job, in seconds. Longer waits keep connections open; clients can
/// repeat the request instead.
pub(super) const MAX_WAIT_SECONDS: u64 = 60;

/// The `{id}` of the path. A malformed id is treated as unknown.
pub(super) struct PathId(pub JobId);

impl<S: Send + Sync> FromRequestParts<S> for PathId {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, state: &S) -> Result<Self, Problem> {
        #[derive(serde::Deserialize)]
        struct Named {
            id: String,
        }
        let Path(named) = Path::<Named>::from_request_parts(parts, state)
            .await
            .map_err(|_| job_not_found())?;
        named.id.parse().map(Self).map_err(|_| job_not_found())
    }
}

/// The `{name}` of the path, which must be UTF-8.
pub(super) struct PathName(pub String);

impl<S: Send + Sync> FromRequestParts<S> for PathName {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, state: &S) -> Result<Self, Problem> {
        #[derive(serde::Deserialize)]
        struct Named {
            name: String,
        }
        match Path::<Named>::from_request_parts(parts, state).await {
            Ok(Path(named)) => Ok(Self(named.name)),
            Err(_) => Err(Problem::new(Code::NotFound, "the name is not UTF-8")),
        }
    }
}

/// Query parameters. Unknown ones are rejected if `T` does so.
pub(super) struct Parameters<T>(pub T);

impl<T: DeserializeOwned, S: Send + Sync> FromRequestParts<S> for Parameters<T> {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, _: &S) -> Result<Self, Problem> {
        match Query::try_from_uri(&parts.uri) {
            Ok(Query(parameters)) => Ok(Self(parameters)),
            Err(error) => Err(Problem::new(Code::InvalidRequest, error.body_text())),
        }
    }
}

/// Returns the wait of `Prefer: wait=N`, limited to the maximum.
pub(super) fn preferred_wait(headers: &HeaderMap) -> Option<Duration> {
    let preferences = headers.get_all("prefer").iter();
    let seconds = preferences
        .filter_map(|value| value.to_str().ok())
        .flat_map(|value| value.split([',', ';']))
        .find_map(|preference| preference.trim().strip_prefix("wait=")?.parse::<u64>().ok())?;
    Some(Duration::from_secs(seconds.min(MAX_WAIT_SECONDS)))
}

// Jobs that do not exist, no longer exist or belong to another owner; callers cannot tell which.

/// Returns a job, or the problem of a missing one.
pub(super) async fn existing(
    app: &App,
    visibility: &Visibility,
    id: JobId,
) -> Result<Job, Problem> {
    match app.jobs.get(visibility, id).await? {
        Some(job) => Ok(job),
        None => Err(missing(app, visibility, id).await),
    }
}

/// Returns the problem of a missing job.
pub(super) async fn missing(app: &App, visibility: &Visibility, id: JobId) -> Problem {
    match app.jobs.has_expired(visibility, id).await {
        Ok(true) => Problem::new(Code::JobExpired, "it was removed when its time was over"),
        Ok(false) => job_not_found(),
        Err(error) => error.into(),
    }
}

/// Returns the problem of an unknown id.
pub(super) fn job_not_found() -> Problem {
    Problem::new(
        Code::JobNotFound,
        "it never existed, or it has been deleted",
    )
}
