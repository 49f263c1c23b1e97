//! Errors as RFC 9457 problems with stable codes.

use std::num::NonZeroU16;

use axum::http::{HeaderValue, StatusCode, header};
use axum::response::{IntoResponse, Response};
use serde::Serialize;

use crate::jobs::{StoreError, meters};
use unwrapd_api::Failure;

/// Challenge of responses that need a key (RFC 6750).
const CHALLENGE: &str = "Bearer realm=\"unwrapd\"";

/// Problem details (RFC 9457). `code` is stable and meant for programs, `detail` is for people.
#[derive(Clone, Debug, Serialize, utoipa::ToSchema)]
pub(super) struct Problem {
    /// Address at which the code is explained.
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
                let meaning = meaning(&failure.code);
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
        let media_type = HeaderValue::from_static("application/problem+json");
        headers.insert(header::CONTENT_TYPE, media_type);
        match status {
            StatusCode::SERVICE_UNAVAILABLE | StatusCode::TOO_MANY_REQUESTS => {
                headers.insert(header::RETRY_AFTER, self.retry_after.into());
            }
            StatusCode::UNAUTHORIZED => {
                let challenge = HeaderValue::from_static(CHALLENGE);
                headers.insert(header::WWW_AUTHENTICATE, challenge);
            }
            StatusCode::UPGRADE_REQUIRED => {
                headers.insert(header::UPGRADE, HeaderValue::from_static("websocket"));
                headers.insert(header::CONNECTION, HeaderValue::from_static("upgrade"));
            }
            _ => {}
        }
        response
    }
}

// Codes of problems of the service itself.

/// Declares the codes, each once: variant, code, status, title.
macro_rules! codes {
    ($($name:ident => ($word:literal, $status:literal, $title:literal $(,)?),)*) => {
        /// Codes of the service itself. Those of unusable inputs are in [`CAUSES`],
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

// Codes of invalid inputs. They come from the pipeline, mean the same on the command line, and have status 422.

/// Codes with their meanings.
pub(super) const CAUSES: [(&str, &str); 75] = [
    // Handles.
    ("malformed_handles", "The list of handles cannot be parsed"),
    ("no_handle", "There is no handle"),
    ("handle_count", "There is no handle, or there are too many"),
    (
        "unknown_handle",
        "A handle names a vertex that does not exist",
    ),
    (
        "handle_outside",
        "A handle lies outside the mesh or picture",
    ),
    (
        "bad_target",
        "A target has the wrong number of coordinates, or one is not finite or out of range",
    ),
    (
        "contradictory_handles",
        "Two handles pull the same vertex to different targets",
    ),
    (
        "unpaired_handles",
        "The numbers of handles and targets differ",
    ),
    (
        "vertex_of_cage",
        "A handle names a vertex; in a cage, handles must be places",
    ),
    (
        "ambiguous_vertex",
        "An anchor names a vertex that has several UVs",
    ),
    (
        "anchor_on_boundary",
        "An anchor moves a vertex of a fixed boundary",
    ),
    (
        "empty_region",
        "A disc or box of a handle holds no vertex that may move",
    ),
    (
        "grid_too_coarse",
        "The grid has no vertex inside its fixed border",
    ),
    // Meshes.
    ("invalid_mesh", "The mesh file does not follow its format"),
    ("no_triangles", "The mesh has no triangle"),
    ("no_elements", "There is nothing to deform"),
    ("no_uvs", "The mesh does not have this UV set"),
    (
        "index_out_of_range",
        "A face or element names a vertex that does not exist",
    ),
    ("non_finite_position", "A coordinate is not a finite number"),
    ("limit_exceeded", "The input exceeds a limit"),
    (
        "folded_mesh",
        "The mesh is folded: two elements lie on the same side of their common face or edge",
    ),
    ("zero_size_element", "An element has zero area or volume"),
    (
        "not_planar",
        "The mesh has no tetrahedra, and its vertices differ in z",
    ),
    (
        "flipped_uvs",
        "The chart has a flipped or degenerate face, and untangling failed",
    ),
    ("nonorientable_chart", "The chart is not orientable"),
    (
        "not_orientable",
        "The elements cannot be wound alike: three meet at a face or edge, or the mesh has one side only",
    ),
    (
        "missing_resource",
        "The input references a file that was not uploaded",
    ),
    ("unsupported_version", "The glTF version is not 2.x"),
    (
        "unsupported_extension",
        "The glTF requires an unsupported extension",
    ),
    (
        "unsupported_output",
        "The requested format cannot hold this document",
    ),
    (
        "indivisible",
        "The triangles cannot be split: an attribute cannot be interpolated",
    ),
    (
        "texcoord_in_use",
        "Textures sample the UV set that would be replaced",
    ),
    (
        "texture_too_small",
        "The charts do not fit at this texel density; the detail names a resolution or page count that suffices",
    ),
    (
        "stacks_differ",
        "Stacked islands show different texels, so they cannot share those of a new texture",
    ),
    (
        "unknown_material",
        "A weight or a rule names a material that the file does not have",
    ),
    ("invalid_seams", "The seams do not match the mesh"),
    // Islands.
    (
        "unknown_face",
        "An island is named by a face that does not exist or names a vertex twice",
    ),
    ("island_named_twice", "Two entries name the same island"),
    ("island_off_page", "An island leaves the page"),
    (
        "islands_too_near",
        "Two islands that stay overlap, or are closer than the padding",
    ),
    (
        "no_room",
        "The other islands do not fit around those that stay",
    ),
    (
        "selects_nothing",
        "A rule for islands selects none; the detail names it",
    ),
    (
        "island_in_two_groups",
        "Two rules contradict each other: an island is in two groups, or locked and in a group",
    ),
    (
        "divided_group",
        "Islands of a group have different places, densities or scales",
    ),
    (
        "rectangle_too_small",
        "A rectangle has no room for its islands, even without others; the detail names it",
    ),
    (
        "too_many_islands",
        "The atlas has more islands than a session can arrange",
    ),
    ("invalid_uvs", "The new UVs do not match the document"),
    (
        "planar_bijectivity",
        "Only maps of the plane can be kept bijective",
    ),
    (
        "overlapping_start",
        "The initial map overlaps or touches itself",
    ),
    // Pictures and drawings.
    ("invalid_image", "The picture is damaged"),
    (
        "image_too_large",
        "The picture exceeds the limit of bytes or pixels",
    ),
    ("empty_image", "The picture has no pixels"),
    ("empty_outline", "There is nothing to outline"),
    ("invalid_svg", "The drawing cannot be read"),
    ("open_path", "A filled path of the drawing is open"),
    (
        "self_intersecting_outline",
        "The outline crosses or touches itself",
    ),
    (
        "outline_too_detailed",
        "The outline has too many vertices, pieces or holes",
    ),
    (
        "outline_too_fine",
        "The details of the outline are too small for its coordinates",
    ),
    (
        "too_many_triangles",
        "The mesh would have too many triangles",
    ),
    // Problems.
    ("malformed_problem", "The problem file cannot be parsed"),
    // Sessions.
    (
        "invalid_message",
        "The message is not JSON, or is not a known request",
    ),
    ("nothing_to_undo", "Nothing was remembered"),
    ("nothing_to_redo", "Nothing was undone"),
    (
        "outside_domain",
        "The present map is outside the domain of the new energy, barrier or bound",
    ),
    (
        "wrong_start",
        "The numbers of coordinates of start and mesh differ",
    ),
    (
        "infeasible_start",
        "An element of the start is inverted or too small, and untangling failed",
    ),
    (
        "ended_early",
        "The work ended, at its time limit or on request, before a valid result was found",
    ),
    (
        "held_element_inverted",
        "The targets of its held corners leave an element inverted or empty",
    ),
    (
        "boundary_inverted",
        "The targets of the boundary enclose no positive signed size",
    ),
    (
        "boundary_turns_too_little",
        "The targets of the boundary turn less often than a map without inversions needs",
    ),
    (
        "planar_energy",
        "The energy or bound exists only in the plane",
    ),
    ("bad_parameter", "A model parameter is out of range"),
    (
        "invalid_formula",
        "An energy has neither a name nor a formula of its own that the input's dimension has",
    ),
    ("invalid_setting", "A setting is out of range"),
    ("no_valid_result", "No valid result was found"),
];

/// Returns the meaning of a code; `None` if it is not about the input.
pub(super) fn meaning(code: &str) -> Option<&'static str> {
    let mut all = CAUSES.iter();
    all.find_map(|(word, meaning)| (*word == code).then_some(*meaning))
}
