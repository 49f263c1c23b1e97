//! Errors as RFC 9457 problems with stable codes.

use axum::http::{HeaderValue, StatusCode, header};
use axum::response::{IntoResponse, Response};
use serde::Serialize;

use super::causes;
use crate::jobs::{Failure, StoreError};

/// What went wrong (RFC 9457). `code` is stable and meant for programs, `detail` is for people.
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
    /// What went wrong in this case, in one line.
    detail: String,
    /// Stable code in snake_case.
    code: String,
    /// The limit that was exceeded, if any.
    #[serde(skip_serializing_if = "Option::is_none")]
    limit: Option<u64>,
}

/// Codes of the service itself. Those of inputs that cannot be used are [`causes`], and have status 422.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Code {
    InvalidRequest,
    InvalidOptions,
    MissingMesh,
    NeedsJob,
    NotFound,
    JobNotFound,
    NoSuchFile,
    MethodNotAllowed,
    NotFinished,
    AlreadyFinished,
    NoResult,
    NotFailed,
    Conflict,
    JobExpired,
    UploadTooLarge,
    UnsupportedMediaType,
    RangeNotSatisfiable,
    UnknownFormat,
    InvalidGltf,
    IdempotencyKeyReused,
    UpgradeRequired,
    OutOfMemory,
    InternalError,
    Crashed,
    DamagedFile,
    QueueFull,
    Stopping,
    Draining,
    NotReady,
    StoreUnavailable,
    WorkerLost,
    TimedOut,
    StorageFull,
}

impl Code {
    pub const ALL: [Self; 33] = [
        Self::InvalidRequest,
        Self::InvalidOptions,
        Self::MissingMesh,
        Self::NeedsJob,
        Self::NotFound,
        Self::JobNotFound,
        Self::NoSuchFile,
        Self::MethodNotAllowed,
        Self::NotFinished,
        Self::AlreadyFinished,
        Self::NoResult,
        Self::NotFailed,
        Self::Conflict,
        Self::JobExpired,
        Self::UploadTooLarge,
        Self::UnsupportedMediaType,
        Self::RangeNotSatisfiable,
        Self::UnknownFormat,
        Self::InvalidGltf,
        Self::IdempotencyKeyReused,
        Self::UpgradeRequired,
        Self::OutOfMemory,
        Self::InternalError,
        Self::Crashed,
        Self::DamagedFile,
        Self::QueueFull,
        Self::Stopping,
        Self::Draining,
        Self::NotReady,
        Self::StoreUnavailable,
        Self::WorkerLost,
        Self::TimedOut,
        Self::StorageFull,
    ];

    /// Its word, its status, and what it says.
    pub fn row(self) -> (&'static str, u16, &'static str) {
        match self {
            Self::InvalidRequest => (
                "invalid_request",
                400,
                "A parameter, header or body is malformed",
            ),
            Self::InvalidOptions => (
                "invalid_options",
                400,
                "An option is unknown or has an invalid value",
            ),
            Self::MissingMesh => ("missing_mesh", 400, "The upload has no input"),
            Self::NeedsJob => ("needs_job", 400, "This result is only available from a job"),
            Self::NotFound => ("not_found", 404, "The path does not exist"),
            Self::JobNotFound => ("job_not_found", 404, "The job does not exist"),
            Self::NoSuchFile => ("no_such_file", 404, "The job does not produce this file"),
            Self::MethodNotAllowed => (
                "method_not_allowed",
                405,
                "The path does not support this method",
            ),
            Self::NotFinished => ("not_finished", 409, "The job is not finished"),
            Self::AlreadyFinished => ("already_finished", 409, "The job has already ended"),
            Self::NoResult => ("no_result", 409, "The job failed or was cancelled"),
            Self::NotFailed => ("not_failed", 409, "Only failed jobs can be tried again"),
            Self::JobExpired => ("job_expired", 410, "The job was removed after its time"),
            Self::Conflict => ("conflict", 409, "Another request changed it meanwhile"),
            Self::UploadTooLarge => ("upload_too_large", 413, "The upload is too large"),
            Self::UnsupportedMediaType => (
                "unsupported_media_type",
                415,
                "The content type is not supported",
            ),
            Self::RangeNotSatisfiable => (
                "range_not_satisfiable",
                416,
                "The range lies outside the file",
            ),
            Self::UnknownFormat => (
                "unknown_format",
                422,
                "The job kind does not read this file format",
            ),
            Self::InvalidGltf => ("invalid_gltf", 422, "The file is not valid glTF 2.0"),
            Self::IdempotencyKeyReused => (
                "idempotency_key_reused",
                422,
                "The Idempotency-Key belongs to a different submission",
            ),
            Self::UpgradeRequired => (
                "upgrade_required",
                426,
                "Events require a WebSocket, or Accept: text/event-stream",
            ),
            Self::OutOfMemory => (
                "out_of_memory",
                422,
                "The input needs more memory than a job may use",
            ),
            Self::InternalError => ("internal_error", 500, "The service failed"),
            Self::Crashed => ("crashed", 500, "A bug in the service ended the computation"),
            Self::DamagedFile => ("damaged_file", 500, "A stored file is damaged"),
            Self::QueueFull => ("queue_full", 503, "The queue is full"),
            Self::Stopping => ("stopping", 503, "The service is shutting down"),
            Self::Draining => ("draining", 503, "The process takes in no more jobs"),
            Self::NotReady => ("not_ready", 503, "The service would not accept a job now"),
            Self::StoreUnavailable => (
                "store_unavailable",
                503,
                "The job database or the files cannot be reached",
            ),
            Self::WorkerLost => (
                "worker_lost",
                503,
                "The computation was terminated from outside",
            ),
            Self::TimedOut => ("timed_out", 504, "The computation exceeded its time limit"),
            Self::StorageFull => (
                "storage_full",
                507,
                "The disk is full, or the quota is used up",
            ),
        }
    }
}

impl Problem {
    /// A problem of the service.
    pub fn new(code: Code, detail: impl Into<String>) -> Self {
        let (word, status, title) = code.row();
        Self {
            kind: format!("/docs#{word}"),
            title: title.to_owned(),
            status,
            detail: detail.into(),
            code: word.to_owned(),
            limit: None,
        }
    }

    /// Names the limit that was exceeded.
    pub fn with_limit(mut self, limit: u64) -> Self {
        self.limit = Some(limit);
        self
    }

    /// Something that should not happen: clients get no details, the log does.
    pub fn internal(error: &dyn std::fmt::Display) -> Self {
        tracing::error!(%error, "internal error");
        Self::new(Code::InternalError, "the log of the service has details")
    }

    /// Why a job failed. A code that is not in the table belongs to the input.
    pub fn of_failure(failure: &Failure) -> Self {
        let known = Code::ALL.into_iter().find(|c| c.row().0 == failure.code);
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
        }
    }
}

impl From<StoreError> for Problem {
    fn from(error: StoreError) -> Self {
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
            StatusCode::SERVICE_UNAVAILABLE => {
                set(header::RETRY_AFTER, "5");
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
