//! Input of a job or a session: an upload, or the files of an earlier job.
//!
//! Files of a job are copied, so that the job can be deleted while they are in use.

use std::sync::Arc;

use axum::extract::{Query, Request};
use futures_util::StreamExt;
use serde::Deserialize;
use tokio::io::AsyncWriteExt;

use super::app::App;
use super::extract::{existing, job_not_found};
use super::problem::{Code, Problem};
use super::submission::{Received, UploadQuery, complete_options};
use super::upload::{self, accepts};
use crate::jobs::access::Caller;
use crate::jobs::{Job, JobId, Scratch, State as JobState};
use unwrapd_api::{InputFile, Kind};

/// Files of a job that are the input of another computation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, utoipa::ToSchema)]
#[serde(rename_all = "snake_case")]
pub(super) enum JobFile {
    /// The result of the job.
    Result,
    /// The input of the job.
    Input,
}

/// Query that names a job instead of an upload.
#[derive(Deserialize)]
struct FromJob {
    job: Option<String>,
    file: Option<JobFile>,
}

/// Kind and files of a computation whose query names only the job.
pub(super) struct Defaults {
    pub kind: Kind,
    pub file: JobFile,
}

/// Receives the input and the options of a computation, from an upload or from the job that the query names.
pub(super) async fn receive(
    app: &Arc<App>,
    caller: &Caller,
    request: Request,
    defaults: Defaults,
) -> Result<Received, Problem> {
    // Receive an upload unless the query names a job.
    let Query(named) = Query::<FromJob>::try_from_uri(request.uri())
        .map_err(|error| Problem::new(Code::InvalidRequest, error.body_text()))?;
    let Some(job) = named.job else {
        return upload::receive(app, None, request).await;
    };
    // Read the options from the query.
    accepts(app)?;
    let mut query = UploadQuery::read(request.uri())?;
    query.options.shift_remove("job");
    query.options.shift_remove("file");
    let kind = query.kind.unwrap_or(defaults.kind);
    let options = complete_options(app.jobs.settings().catalog, kind, query.options)?;
    let handling = query.handling.into_handling(kind)?;
    // Copy the files of the job into a new folder.
    let id = job.parse().map_err(|_| job_not_found())?;
    let job = existing(app, &caller.visibility(), id).await?;
    let path = (app.jobs.settings().scratch).join(format!("upload-{}", JobId::fresh()));
    let folder = Scratch::make(path)?;
    let mut files = Vec::new();
    for (number, file) in wanted(&job, named.file.unwrap_or(defaults.file))?
        .into_iter()
        .enumerate()
    {
        let place = folder.path().join(format!("file-{number}"));
        let mut content = match file {
            Wanted::Input(file) => app.jobs.read_input(&job, file, 0..file.bytes).await?,
            Wanted::Output(file) => app.jobs.read(&job, file, 0..file.bytes).await?,
        };
        let mut copy = tokio::fs::File::create(&place).await?;
        while let Some(bytes) = content.next().await {
            copy.write_all(&bytes?).await?;
        }
        copy.flush().await?;
        files.push((file.listed(), place));
    }
    Ok(Received {
        folder,
        kind,
        options,
        files,
        handling,
    })
}

/// A file of a job.
enum Wanted<'a> {
    Input(&'a InputFile),
    Output(&'a unwrapd_api::OutputFile),
}

impl Wanted<'_> {
    fn listed(&self) -> InputFile {
        match self {
            Self::Input(file) => (*file).clone(),
            Self::Output(file) => InputFile {
                name: file.name.clone(),
                bytes: file.bytes,
                sha256: file.sha256.clone(),
            },
        }
    }
}

/// Returns the files of a job that are taken, the mesh first.
fn wanted(job: &Job, file: JobFile) -> Result<Vec<Wanted<'_>>, Problem> {
    if file == JobFile::Input {
        if job.state == JobState::Cancelled {
            let detail = "the files of a cancelled job are removed: upload them again";
            return Err(Problem::new(Code::NoResult, detail));
        }
        return Ok(job.input.iter().map(Wanted::Input).collect());
    }
    // Check that there is a result.
    match job.state {
        JobState::Succeeded => {}
        JobState::Queued | JobState::Running => {
            return Err(Problem::new(Code::NotFinished, "wait for its end"));
        }
        JobState::Failed | JobState::Cancelled => {
            let verb = if job.state == JobState::Failed {
                "has"
            } else {
                "has been"
            };
            let detail = format!("the job {verb} {}", job.state.word());
            return Err(Problem::new(Code::NoResult, detail));
        }
    }
    // Take the result with the files that belong to it.
    let Some(result) = job.output("result") else {
        return Err(Problem::new(Code::NoResult, "the job makes no file"));
    };
    let others = job
        .output
        .iter()
        .filter(|file| file.role.starts_with("files/"));
    let all = std::iter::once(result).chain(others);
    Ok(all.map(Wanted::Output).collect())
}
