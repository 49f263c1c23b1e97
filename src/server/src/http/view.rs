//! Public view of jobs.

use serde::Serialize;
use serde_json::Value;

use super::problem::Problem;
use crate::jobs::{Event, Job, Metadata, Settings, Timestamp};
use unwrapd_api::{Kind, OutputFile, Warning};

/// A job: request, state and outcome.
#[derive(Serialize, utoipa::ToSchema)]
#[schema(as = Job)]
pub(super) struct JobView {
    /// Identifies the job.
    #[schema(format = "uuid")]
    id: String,
    /// Owner of the key that made the job; null if it was made without one.
    owner: Option<String>,
    /// Kind of job.
    kind: Kind,
    #[serde(flatten)]
    event: Event,
    /// Name of the uploaded mesh file.
    filename: String,
    /// Total size of the uploaded files, in bytes.
    input_bytes: u64,
    /// All options, with defaults filled in.
    #[schema(value_type = Object)]
    options: Value,
    /// Of the waiting jobs of one owner, those of higher priority start first.
    priority: i32,
    /// Metadata that the client set.
    #[schema(value_type = Object)]
    metadata: Metadata,
    /// The gates that the result has to meet, if any.
    accept: Option<String>,
    /// The address to which the end of the job is posted, if any.
    #[schema(format = "uri")]
    webhook: Option<String>,
    /// Number of times the job was started.
    attempt: u32,
    /// `true` if the result is a copy of that of an earlier job with equal kind, options and input.
    cached: bool,
    /// Time of acceptance.
    #[schema(value_type = String, format = DateTime)]
    created_at: Timestamp,
    /// Start of the latest attempt.
    #[schema(value_type = Option<String>, format = DateTime)]
    started_at: Option<Timestamp>,
    /// Time of the final state.
    #[schema(value_type = Option<String>, format = DateTime)]
    finished_at: Option<Timestamp>,
    /// Time after which the job and its files are removed; null until the final state.
    #[schema(value_type = Option<String>, format = DateTime)]
    expires_at: Option<Timestamp>,
    /// `true` if everything requested is proven on the bytes written. Null until the job succeeded,
    /// and for kinds that prove nothing. If false there is a result, and `warnings` name what is
    /// missing.
    certified: Option<bool>,
    /// `true` if the distortion keeps the bound of `quality` or `max_distortion`. Null until the
    /// job succeeded, and where there is no bound.
    within_bound: Option<bool>,
    /// `true` if the result meets the gates of `accept`. Null without gates, and until the job has
    /// ended; a failed job meets none.
    accepted: Option<bool>,
    /// Warnings about the input, the work and the result; empty until the job succeeded.
    warnings: Vec<Warning>,
    /// Cause of the failure; null unless the job failed.
    error: Option<Problem>,
    /// Paths of related resources.
    links: Links,
}

/// Paths of the resources of a job. Results are listed once they can be fetched.
#[derive(Serialize, utoipa::ToSchema)]
struct Links {
    /// The job.
    #[serde(rename = "self")]
    itself: String,
    /// Its events.
    events: String,
    /// The files of the input, the mesh first.
    inputs: Vec<FileLink>,
    /// The files that the job produced.
    files: Vec<FileLink>,
}

/// A file that a job was given or produced.
#[derive(Serialize, utoipa::ToSchema)]
struct FileLink {
    /// Its path.
    href: String,
    /// Suggested file name, for an input that of the upload.
    name: String,
    /// Its size; absent while it is a picture that nobody has asked for: the first request draws it.
    #[serde(skip_serializing_if = "Option::is_none")]
    bytes: Option<u64>,
}

/// Returns the path of a job, with the prefix of a proxy.
pub(super) fn job_path(base: &str, job: &Job) -> String {
    format!("{base}/v1/jobs/{}", job.id)
}

impl JobView {
    /// Returns the view of a job for clients of a service with these settings.
    pub fn new(job: &Job, settings: &Settings, base: &str) -> Self {
        let path = job_path(base, job);
        // List the results, with pictures before reports.
        let files = job.results().map(|file| FileLink {
            href: format!("{path}/{}", file.role),
            name: file.name.clone(),
            bytes: Some(file.bytes),
        });
        let pictures = job.pictures().iter().map(|picture| FileLink {
            href: format!("{path}/{}", picture.role()),
            name: picture.role().to_owned(),
            bytes: job.drawn(*picture).map(|file| file.bytes),
        });
        // Put the pictures before the numbers, which are less often looked at.
        let place = job.results().take_while(|file| !is_numeric(file)).count();
        let mut files: Vec<FileLink> = files.collect();
        files.splice(place..place, pictures);
        let inputs = job.input.iter().enumerate().map(|(index, file)| FileLink {
            href: format!("{path}/input/{index}"),
            name: file.name.clone(),
            bytes: Some(file.bytes),
        });
        Self {
            id: job.id.to_string(),
            owner: job.owner.name().map(str::to_owned),
            kind: job.kind,
            event: job.event(),
            filename: job
                .input
                .first()
                .map_or_else(String::new, |f| f.name.clone()),
            input_bytes: job.input.iter().map(|file| file.bytes).sum(),
            options: job.options.clone(),
            priority: job.priority,
            metadata: job.metadata.clone(),
            accept: job.accept.as_ref().map(ToString::to_string),
            webhook: job.webhook.as_ref().map(ToString::to_string),
            attempt: job.attempt,
            cached: job.is_copy(),
            created_at: job.created,
            started_at: job.started,
            finished_at: job.finished,
            expires_at: job
                .finished
                .zip(settings.retention)
                .map(|(end, kept)| end.later(kept)),
            certified: job.verdict.quality.certified,
            accepted: job.accepted(),
            within_bound: job.verdict.within_bound,
            warnings: job.verdict.warnings.clone(),
            error: job.failure.as_ref().map(Problem::of_failure),
            links: Links {
                inputs: inputs.collect(),
                files,
                events: format!("{path}/events"),
                itself: path,
            },
        }
    }
}

/// Returns whether a file has numbers rather than something to look at.
fn is_numeric(file: &OutputFile) -> bool {
    matches!(&*file.role, "uvs.bin" | "report")
}

/// A page of jobs.
#[derive(Serialize, utoipa::ToSchema)]
pub(super) struct JobPage {
    /// The jobs of this page.
    pub jobs: Vec<JobView>,
    /// `cursor` of the next page; null on the last one.
    #[schema(format = "uuid")]
    pub next: Option<String>,
}
