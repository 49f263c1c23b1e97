//! Codes of problems of the service itself.

/// Declares the codes, each once: variant, code, status, title.
macro_rules! codes {
    ($($name:ident => ($word:literal, $status:literal, $title:literal $(,)?),)*) => {
        /// Codes of the service itself. Those of unusable inputs are [`super::causes`],
        /// and have status 422.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub(super) enum Code {
            $($name),*
        }

        impl Code {
            /// All codes.
            pub const ALL: &[Self] = &[$(Self::$name),*];

            /// Returns the word, the HTTP status and the title of the code.
            pub fn row(self) -> (&'static str, u16, &'static str) {
                match self {
                    $(Self::$name => ($word, $status, $title)),*
                }
            }
        }
    };
}

codes! {
    InvalidRequest => ("invalid_request", 400, "A parameter, header or body is malformed"),
    InvalidOptions => ("invalid_options", 400, "An option is unknown or has an invalid value"),
    MissingMesh => ("missing_mesh", 400, "The upload has no input"),
    NeedsJob => ("needs_job", 400, "This result is only available from a job"),
    KeyRequired => ("key_required", 401, "The call needs an API key"),
    KeyRefused => ("key_refused", 401, "The API key is not valid"),
    MissingScope => ("missing_scope", 403, "The API key may not do this"),
    ForeignOrigin => ("foreign_origin", 403, "Pages of this origin may not use the service"),
    NotFound => ("not_found", 404, "The path does not exist"),
    JobNotFound => ("job_not_found", 404, "The job does not exist"),
    NoSuchFile => ("no_such_file", 404, "The job does not produce this file"),
    SessionNotFound => ("session_not_found", 404, "The session does not exist"),
    MethodNotAllowed => ("method_not_allowed", 405, "The path does not support this method"),
    RequestTimeout => ("request_timeout", 408, "The body did not arrive in time"),
    NotFinished => ("not_finished", 409, "The job is not finished"),
    AlreadyFinished => ("already_finished", 409, "The job has already ended"),
    NoResult => ("no_result", 409, "The job failed or was cancelled"),
    NotFailed => ("not_failed", 409, "Only failed jobs can be tried again"),
    NoKeys => ("no_keys", 409, "The service does not ask for keys"),
    ComputedElsewhere => ("computed_elsewhere", 409, "Another process computes the job"),
    JobExpired => ("job_expired", 410, "The job was removed after its time"),
    Conflict => ("conflict", 409, "Another request changed it meanwhile"),
    UploadTooLarge => ("upload_too_large", 413, "The upload is too large"),
    UnsupportedMediaType => ("unsupported_media_type", 415, "The content type is not supported"),
    RangeNotSatisfiable => ("range_not_satisfiable", 416, "The range lies outside the file"),
    UnknownHost => ("unknown_host", 421, "The service is not reached under this name"),
    UnknownFormat => ("unknown_format", 422, "The job kind does not read this file format"),
    InvalidArchive => ("invalid_archive", 422, "The ZIP is damaged, or has not one input"),
    InvalidGltf => ("invalid_gltf", 422, "The file is not valid glTF 2.0"),
    IdempotencyKeyReused => (
        "idempotency_key_reused",
        422,
        "The Idempotency-Key belongs to a different submission",
    ),
    UpgradeRequired => (
        "upgrade_required",
        426,
        "The path requires a WebSocket; events can also be had as text/event-stream",
    ),
    TooManyConnections => ("too_many_connections", 429, "The client has too many connections"),
    RateLimited => ("rate_limited", 429, "Too many requests; Retry-After says when to go on"),
    OwnerQuotaUsed => ("owner_quota_used", 429, "The owner of the key has used up a quota"),
    OutOfMemory => ("out_of_memory", 422, "The input needs more memory than a job may use"),
    InternalError => ("internal_error", 500, "The service failed"),
    Crashed => ("crashed", 500, "A bug in the service ended the computation"),
    DamagedFile => ("damaged_file", 500, "A stored file is damaged"),
    MissingFile => ("missing_file", 500, "A stored file is missing"),
    QueueFull => ("queue_full", 503, "The queue is full"),
    SessionsTaken => ("sessions_taken", 503, "All live sessions are taken"),
    Stopping => ("stopping", 503, "The service is shutting down"),
    Draining => ("draining", 503, "The process takes in no more jobs"),
    NotReady => ("not_ready", 503, "The service would not accept a job now"),
    StoreUnavailable => (
        "store_unavailable",
        503,
        "The job database or the files cannot be reached",
    ),
    WorkerLost => ("worker_lost", 503, "The computation was terminated from outside"),
    TimedOut => ("timed_out", 504, "The computation was not done within its time limit"),
    StorageFull => ("storage_full", 507, "The disk is full, or the quota is used up"),
}
