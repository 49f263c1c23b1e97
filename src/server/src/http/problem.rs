//! Errors as RFC 9457 problems with stable codes.

use std::num::NonZeroU16;

use axum::http::{HeaderValue, StatusCode, header};
use axum::response::{IntoResponse, Response};
use serde::Serialize;

use super::causes;
pub(super) use super::code::Code;
use crate::jobs::{StoreError, meters};
use unwrapd_api::Failure;

/// Challenge of responses that need a key (RFC 6750).
const CHALLENGE: &str = "Bearer realm=\"unwrapd\"";

/// Problem details (RFC 9457). `code` is stable and meant for programs, `detail` is for people.
#[derive(Clone, Debug, Serialize, utoipa::ToSchema)]
pub(super) struct Problem {
    /// Where the code is explained.
    #[serde(rename = "type")]
    #[schema(format = "uri-reference")]
    kind: String,
    /// Summary of the code.
    title: String,
    /// The HTTP status.
    status: u16,
    /// Description of this case, in one line.
    detail: String,
    /// Stable code in snake_case.
    code: String,
    /// The limit that was exceeded, if any.
    #[serde(skip_serializing_if = "Option::is_none")]
    limit: Option<u64>,
    /// The column of a formula at which it is wrong, from 1, if one is.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(value_type = Option<u16>, minimum = 1)]
    column: Option<NonZeroU16>,
    /// Seconds after which it may be tried again; those that are usual if nothing else is known.
    #[serde(skip)]
    retry_after: u32,
}

/// Default retry delay in seconds, for problems whose duration is unknown.
const USUAL_PAUSE: u32 = 5;

impl Problem {
    /// Creates a problem of the service itself.
    pub fn new(code: Code, detail: impl Into<String>) -> Self {
        let (word, status, title) = code.row();
        Self {
            kind: format!("/docs#{word}"),
            title: title.to_owned(),
            status,
            detail: detail.into(),
            code: word.to_owned(),
            limit: None,
            column: None,
            retry_after: USUAL_PAUSE,
        }
    }

    /// Sets the limit that was exceeded.
    pub fn with_limit(mut self, limit: u64) -> Self {
        self.limit = Some(limit);
        self
    }

    /// Sets the column of the error in a formula, if known.
    pub fn with_column(self, column: Option<usize>) -> Self {
        let column = column.and_then(|column| u16::try_from(column).ok());
        let column = column.and_then(NonZeroU16::new);
        Self { column, ..self }
    }

    /// Sets the retry delay in seconds.
    pub fn retried_after(mut self, seconds: u64) -> Self {
        self.retry_after = seconds as u32;
        self
    }

    /// Logs an unexpected error and returns a problem without its details.
    pub fn internal(error: &dyn std::fmt::Display) -> Self {
        tracing::error!(%error, "internal error");
        let detail = "the log of the service says why, under the X-Request-Id of this answer";
        Self::new(Code::InternalError, detail)
    }

    /// Returns the problem of a failed job. A code that is not in the table is about the input.
    pub fn of_failure(failure: &Failure) -> Self {
        let known = Code::ALL.iter().find(|c| c.row().0 == failure.code);
        let (status, title) = known.map_or_else(
            || {
                let meaning = causes::meaning(&failure.code);
                (422, meaning.unwrap_or("The input cannot be used"))
            },
            |code| (code.row().1, code.row().2),
        );
        Self {
            kind: format!("/docs#{}", failure.code),
            title: title.to_owned(),
            status,
            detail: failure.detail.clone(),
            code: failure.code.clone(),
            limit: None,
            column: None,
            retry_after: USUAL_PAUSE,
        }
    }
}

impl From<StoreError> for Problem {
    fn from(error: StoreError) -> Self {
        meters::store_failed();
        tracing::error!(%error, "store");
        match error {
            StoreError::Full(why) => Self::new(
                Code::StorageFull,
                format!("delete jobs, or try again later: {why}"),
            ),
            StoreError::Conflict(_) => Self::new(Code::Conflict, "look again, then try again"),
            StoreError::Unavailable(_) | StoreError::Unanswered(_) => {
                Self::new(Code::StoreUnavailable, "try again later")
            }
            StoreError::Damaged(what) => Self::new(Code::DamagedFile, what),
            StoreError::Missing(what) => Self::new(Code::MissingFile, what),
            // The path concerns only the operator, who finds it in the log.
            StoreError::File { why, .. } => {
                let detail = format!("a file of the service cannot be used: {why}");
                Self::new(Code::InternalError, detail)
            }
            StoreError::Other(_) => Self::internal(&error),
        }
    }
}

impl From<std::io::Error> for Problem {
    fn from(error: std::io::Error) -> Self {
        StoreError::from(error).into()
    }
}

impl IntoResponse for Problem {
    fn into_response(self) -> Response {
        let status = StatusCode::from_u16(self.status).unwrap_or(StatusCode::INTERNAL_SERVER_ERROR);
        let mut response = (status, serde_json::to_vec(&self).unwrap_or_default()).into_response();
        let headers = response.headers_mut();
        let mut set = |name, value| headers.insert(name, HeaderValue::from_static(value));
        set(header::CONTENT_TYPE, "application/problem+json");
        match status {
            StatusCode::SERVICE_UNAVAILABLE | StatusCode::TOO_MANY_REQUESTS => {
                headers.insert(header::RETRY_AFTER, self.retry_after.into());
            }
            StatusCode::UNAUTHORIZED => {
                set(header::WWW_AUTHENTICATE, CHALLENGE);
            }
            StatusCode::UPGRADE_REQUIRED => {
                set(header::UPGRADE, "websocket");
                set(header::CONNECTION, "upgrade");
            }
            _ => {}
        }
        response
    }
}
