//! All results of a job as one ZIP.

use std::collections::BTreeSet;
use std::fs::File;
use std::io::{Seek, Write};

use axum::body::Body;
use axum::extract::State;
use axum::http::{HeaderValue, header};
use axum::response::{IntoResponse, Response};
use futures_util::StreamExt;
use futures_util::stream::poll_fn;
use tokio::runtime::Handle;
use tokio_util::io::ReaderStream;
use zip::result::ZipError;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

use super::answers::ArchiveProblems;
use super::app::{App, Shared};
use super::crowds::Crowds;
use super::download;
use super::extract::PathId;
use super::missing::existing;
use super::problem::{Code, Problem};
use super::results::check_succeeded;
use crate::jobs::access::Caller;
use crate::jobs::{Job, JobId, Scratch};

/// Size in bytes from which files need the larger records of ZIP64, since ZIP stores sizes as 32-bit numbers.
const LARGE: u64 = u32::MAX as u64;

/// Maximum number of archives that one owner receives at a time: each is a copy on the disk until it is sent. A higher
/// limit lets one owner fill the disk, a lower one makes scripts wait.
const MOST_OF_OWNER: usize = 16;
/// Retry delay for an owner at that limit, in seconds. It is unknown when a download will end.
const LATER: u64 = 5;

/// Get all files that a job produced as one ZIP.
///
/// The archive is complete when the answer begins. Files have the names of `links.files`, and are
/// stored as they are. Pictures that nobody has asked for are drawn first. An owner can receive 16 archives at a time.
#[utoipa::path(
    get, path = "/v1/jobs/{id}/files.zip", operation_id = "getFiles", tag = "results",
    params(("id" = String, Path, format = "uuid", description = "The job")),
    responses(
        (status = 200, description = "The archive", body = Vec<u8>, content_type = "application/zip"),
        ArchiveProblems,
    )
)]
pub(super) async fn get_files(
    State(app): Shared,
    caller: Caller,
    PathId(id): PathId,
) -> Result<Response, Problem> {
    // Check the job and the limit of its owner.
    let job = existing(&app, &caller.visibility(), id).await?;
    check_succeeded(&job)?;
    let seat = Crowds::enter(&app.archives, caller.owner().clone(), Some(MOST_OF_OWNER));
    let Some(seat) = seat else {
        let detail = format!("an owner can receive {MOST_OF_OWNER} archives at a time");
        return Err(Problem::new(Code::RateLimited, detail).retried_after(LATER));
    };
    // Build the archive on a thread for blocking work.
    let name = format!("{}.zip", job.id);
    let handle = Handle::current();
    let packed = tokio::task::spawn_blocking(move || packed(&app, &job, &handle)).await;
    let (scratch, file, bytes) = packed.map_err(|error| Problem::internal(&error))??;
    // Send it.
    let mut blocks = ReaderStream::new(tokio::fs::File::from_std(file));
    let content = poll_fn(move |context| {
        // The closure owns the folder and the seat, so both are released with the response.
        let _ = (&scratch, &seat);
        blocks.poll_next_unpin(context)
    });
    let mut response = Body::from_stream(content).into_response();
    let headers = response.headers_mut();
    let zip = HeaderValue::from_static("application/zip");
    headers.insert(header::CONTENT_TYPE, zip);
    headers.insert(header::CONTENT_LENGTH, bytes.into());
    let disposition = HeaderValue::from_str(&format!("attachment; filename=\"{name}\""));
    headers.extend(disposition.map(|value| (header::CONTENT_DISPOSITION, value)));
    Ok(response)
}

/// Builds the archive in a folder of its own. Returns the folder, the open file and its size in bytes.
fn packed(app: &App, job: &Job, handle: &Handle) -> Result<(Scratch, File, u64), Problem> {
    // Create the file.
    app.jobs.has_room()?;
    let folder = app
        .jobs
        .settings()
        .scratch
        .join(format!("pack-{}", JobId::fresh()));
    let scratch = Scratch::make(folder)?;
    let path = scratch.path().join("files.zip");
    let file = File::options()
        .read(true)
        .write(true)
        .create_new(true)
        .open(path)?;
    // Copy the results; of two files with one name, the second is named by its role.
    let mut archive = ZipWriter::new(file);
    let mut names = BTreeSet::new();
    for output in job.results() {
        let name = if names.insert(&output.name) {
            &output.name
        } else {
            &output.role
        };
        let options = SimpleFileOptions::default()
            .compression_method(CompressionMethod::Stored)
            .large_file(LARGE <= output.bytes);
        archive.start_file(name.as_str(), options)?;
        let mut content = handle.block_on(app.jobs.read(job, output, 0..output.bytes))?;
        while let Some(block) = handle.block_on(content.next()) {
            archive.write_all(&block?)?;
        }
    }
    // Draw the pictures and add them.
    for &picture in job.pictures() {
        let content = handle.block_on(download::picture(app, job, picture))?;
        let options = SimpleFileOptions::default().compression_method(CompressionMethod::Stored);
        archive.start_file(picture.role(), options)?;
        archive.write_all(&content)?;
    }
    // Rewind the file for the response.
    let mut file = archive.finish()?;
    let bytes = file.stream_position()?;
    file.rewind()?;
    Ok((scratch, file, bytes))
}

impl From<ZipError> for Problem {
    fn from(error: ZipError) -> Self {
        match error {
            ZipError::Io(error) => error.into(),
            error => Self::internal(&error),
        }
    }
}
