//! A job as clients see it.

use serde::Serialize;
use serde_json::Value;

use super::problem::Problem;
use crate::document::Warning;
use crate::jobs::{Event, Job, Kind, Timestamp};

/// A job: what was asked, how far it is, what came of it.
#[derive(Serialize, utoipa::ToSchema)]
#[schema(as = Job)]
pub(super) struct JobView {
    /// Names it.
    #[schema(format = "uuid")]
    id: String,
    /// What it does.
    kind: Kind,
    #[serde(flatten)]
    event: Event,
    /// Name of the uploaded mesh file.
    filename: String,
    /// Bytes of all uploaded files.
    input_bytes: u64,
    /// All options, with defaults filled in.
    #[schema(value_type = Object)]
    options: Value,
    /// How often it was started.
    attempt: u32,
    /// When it was accepted.
    #[schema(value_type = String, format = DateTime)]
    created_at: Timestamp,
    /// When its latest attempt started.
    #[schema(value_type = Option<String>, format = DateTime)]
    started_at: Option<Timestamp>,
    /// When it reached its final state.
    #[schema(value_type = Option<String>, format = DateTime)]
    finished_at: Option<Timestamp>,
    /// Whether everything that was asked for is proven on the bytes written; null until it succeeded, and of kinds of jobs that prove
    /// nothing of a result. If false there is a result, and `warnings` say what is missing.
    certified: Option<bool>,
    /// What users should know of the input, of the work and of the result; empty until it succeeded.
    warnings: Vec<Warning>,
    /// Why it failed; absent unless it did.
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<Problem>,
    /// Where to go from here.
    links: Links,
}

/// Paths of what belongs to a job. Files are listed when they can be fetched.
#[derive(Serialize, utoipa::ToSchema)]
struct Links {
    /// The job.
    #[serde(rename = "self")]
    itself: String,
    /// Its events.
    events: String,
    /// The files it made.
    files: Vec<FileLink>,
}

/// A file that a job made.
#[derive(Serialize, utoipa::ToSchema)]
struct FileLink {
    /// Its path.
    href: String,
    /// Name to save it under.
    name: String,
    /// Its size.
    bytes: u64,
}

/// The path of a job.
pub(super) fn job_path(job: &Job) -> String {
    format!("/v1/jobs/{}", job.id)
}

impl From<&Job> for JobView {
    fn from(job: &Job) -> Self {
        let path = job_path(job);
        let files = job.output.iter().map(|file| FileLink {
            href: format!("{path}/{}", file.role),
            name: file.name.clone(),
            bytes: file.bytes,
        });
        Self {
            id: job.id.to_string(),
            kind: job.kind,
            event: job.event(),
            filename: job
                .input
                .first()
                .map_or_else(String::new, |f| f.name.clone()),
            input_bytes: job.input.iter().map(|file| file.bytes).sum(),
            options: job.options.clone(),
            attempt: job.attempt,
            created_at: job.created,
            started_at: job.started,
            finished_at: job.finished,
            certified: job.verdict.certified,
            warnings: job.verdict.warnings.clone(),
            error: job.failure.as_ref().map(Problem::of_failure),
            links: Links {
                files: files.collect(),
                events: format!("{path}/events"),
                itself: path,
            },
        }
    }
}

/// A page of jobs, the newest first.
#[derive(Serialize, utoipa::ToSchema)]
pub(super) struct JobPage {
    /// The jobs of this page.
    pub jobs: Vec<JobView>,
    /// `cursor` of the next page; null on the last one.
    #[schema(format = "uuid")]
    pub next: Option<String>,
}
