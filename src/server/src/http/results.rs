//! Files of jobs: results, inputs, and all results as one ZIP.

use std::collections::BTreeSet;
use std::fs::File;
use std::io::{Seek, Write};

use axum::body::Body;
use axum::extract::{FromRequestParts, Path, State};
use axum::http::request::Parts;
use axum::http::{HeaderMap, HeaderValue, header};
use axum::response::{IntoResponse, Response};
use futures_util::StreamExt;
use futures_util::stream::poll_fn;
use tokio::runtime::Handle;
use tokio_util::io::ReaderStream;
use zip::result::ZipError;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

use super::app::{App, Shared};
use super::download::{self, StoredFile};
use super::extract::{PathId, PathName, existing};
use super::limits::Crowds;
use super::problem::{Code, Problem};
use super::schemas::{ArchiveProblems, FileAnswers, PictureAnswers};
use crate::jobs::access::Caller;
use crate::jobs::{Job, JobId, Scratch, State as JobState};
use unwrapd_api::Picture;

/// Get the result: the mesh with its new UVs, the deformed body, the warped picture.
///
/// The option `format` sets its format. Files that belong to it, such as the `.bin` of a `.gltf`, are
/// listed in `links.files` of the job. Ranges and `If-None-Match` are supported.
///
/// A file of up to 16 MiB is verified before its first byte, also for a range of it. A larger one is
/// verified as it is sent as a whole: if it is damaged, the answer ends early.
#[utoipa::path(
    get, path = "/v1/jobs/{id}/result", operation_id = "getResult", tag = "results",
    params(("id" = String, Path, format = "uuid", description = "The job")),
    responses(
        (status = 200, description = "The file", content((Vec<u8> = "model/gltf-binary"), (Vec<u8> = "model/gltf+json"), (Vec<u8> = "model/obj"), (Vec<u8> = "image/png"), (Vec<u8> = "text/plain"), (Vec<u8> = "application/octet-stream"))),
        FileAnswers,
    )
)]
pub(super) async fn get_result(
    State(app): Shared,
    caller: Caller,
    PathId(id): PathId,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    file(&app, &caller, id, "result", &headers).await
}

/// Get the report: what was done, the quality of the result, and what is proven.
///
/// `Report` of `unwrap`, `repack` and `measure`, `Verified` of `verify`, `DeformReport` of `solve` and `deform`, `WarpReport` of `warp`, `EditReport` of
/// `edit_uv` and `texture_map`.
#[utoipa::path(
    get, path = "/v1/jobs/{id}/report", operation_id = "getReport", tag = "results",
    params(("id" = String, Path, format = "uuid", description = "The job")),
    responses(
        (status = 200, description = "The report", body = ref("#/components/schemas/Report")),
        FileAnswers,
    )
)]
pub(super) async fn get_report(
    State(app): Shared,
    caller: Caller,
    PathId(id): PathId,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    file(&app, &caller, id, "report", &headers).await
}

/// Get a picture of the UV layout, oriented like the texture.
///
/// The first request draws it, which takes a fraction of a second for a small mesh; from then on it is
/// kept with the job.
#[utoipa::path(
    get, path = "/v1/jobs/{id}/layout.png", operation_id = "getLayout", tag = "results",
    params(("id" = String, Path, format = "uuid", description = "The job")),
    responses(
        (status = 200, description = "The picture", body = Vec<u8>, content_type = "image/png"),
        PictureAnswers,
    )
)]
pub(super) async fn get_layout(
    State(app): Shared,
    caller: Caller,
    PathId(id): PathId,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    picture(&app, &caller, id, Picture::Layout, &headers).await
}

/// Get a heat map of the distortion, oriented like the texture.
///
/// It shows the measure of the option `heatmap_measure`, with a legend. Flipped faces are yellow.
/// The first request draws it, and it is kept with the job.
#[utoipa::path(
    get, path = "/v1/jobs/{id}/heatmap.png", operation_id = "getHeatmap", tag = "results",
    params(("id" = String, Path, format = "uuid", description = "The job")),
    responses(
        (status = 200, description = "The picture", body = Vec<u8>, content_type = "image/png"),
        PictureAnswers,
    )
)]
pub(super) async fn get_heatmap(
    State(app): Shared,
    caller: Caller,
    PathId(id): PathId,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    picture(&app, &caller, id, Picture::Heatmap, &headers).await
}

/// Get a small picture for lists, 72 pixels along its shorter side.
///
/// It shows the UV layout, or the warped picture. Jobs of other kinds have none.
/// The first request draws it, and it is kept with the job.
#[utoipa::path(
    get, path = "/v1/jobs/{id}/thumbnail.png", operation_id = "getThumbnail", tag = "results",
    params(("id" = String, Path, format = "uuid", description = "The job")),
    responses(
        (status = 200, description = "The picture", body = Vec<u8>, content_type = "image/png"),
        PictureAnswers,
    )
)]
pub(super) async fn get_thumbnail(
    State(app): Shared,
    caller: Caller,
    PathId(id): PathId,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    picture(&app, &caller, id, Picture::Thumbnail, &headers).await
}

/// Get the UVs as arrays, with the vertices and faces that they belong to.
///
/// For programs that keep the mesh that they sent. `unwrap` and `repack` make it. All numbers have 4
/// bytes and are little-endian:
///
/// - the bytes `UVS1`, then the number of primitives;
/// - for each primitive its mesh and its number in that, as the result counts them before
///   `merge_materials` joins any, and its numbers of faces F and of vertices V;
/// - for each primitive 6 F floats: u and v of the three corners of each face, in the numbers of the
///   result; F integers: which triangle of the input each face is; V integers: which vertex of the
///   input each vertex of the result is.
///
/// Integers are unsigned, and all count from 0. For glTF, vertices are elements of the primitive's
/// accessors; triangles of the input are those of the primitive. Other formats count over the whole
/// file, with a polygon of n corners as n − 2 triangles.
#[utoipa::path(
    get, path = "/v1/jobs/{id}/uvs.bin", operation_id = "getUvs", tag = "results",
    params(("id" = String, Path, format = "uuid", description = "The job")),
    responses(
        (status = 200, description = "The arrays", body = Vec<u8>, content_type = "application/octet-stream"),
        FileAnswers,
    )
)]
pub(super) async fn get_uvs(
    State(app): Shared,
    caller: Caller,
    PathId(id): PathId,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    file(&app, &caller, id, "uvs.bin", &headers).await
}

/// Get a file that belongs to the result.
#[utoipa::path(
    get, path = "/v1/jobs/{id}/files/{name}", operation_id = "getFile", tag = "results",
    params(
        ("id" = String, Path, format = "uuid", description = "The job"),
        ("name" = String, Path, description = "File name, as the result references it"),
    ),
    responses(
        (status = 200, description = "The file", content((Vec<u8> = "application/octet-stream"), (Vec<u8> = "text/csv"), (Vec<u8> = "text/plain"), (Vec<u8> = "model/obj"), (Vec<u8> = "image/png"))),
        FileAnswers,
    )
)]
pub(super) async fn get_file(
    State(app): Shared,
    caller: Caller,
    PathId(id): PathId,
    PathName(name): PathName,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    file(&app, &caller, id, &format!("files/{name}"), &headers).await
}

/// Checks that a job has succeeded, so that it has files.
fn check_succeeded(job: &Job) -> Result<(), Problem> {
    match job.state {
        JobState::Succeeded => Ok(()),
        JobState::Queued | JobState::Running => {
            let detail = format!("the job is {}", job.state.word());
            Err(Problem::new(Code::NotFinished, detail))
        }
        JobState::Failed | JobState::Cancelled => {
            let why = job.failure.as_ref().map_or_else(
                || "the job was cancelled".to_owned(),
                |failure| format!("the job failed: {}", failure.detail),
            );
            Err(Problem::new(Code::NoResult, why))
        }
    }
}

async fn file(
    app: &App,
    caller: &Caller,
    id: JobId,
    role: &str,
    headers: &HeaderMap,
) -> Result<Response, Problem> {
    let job = existing(app, &caller.visibility(), id).await?;
    check_succeeded(&job)?;
    let file = job.output(role).ok_or_else(|| no_such_file(&job, role))?;
    download::answer(app, &job, StoredFile::Output(file), headers).await
}

async fn picture(
    app: &App,
    caller: &Caller,
    id: JobId,
    picture: Picture,
    headers: &HeaderMap,
) -> Result<Response, Problem> {
    let job = existing(app, &caller.visibility(), id).await?;
    check_succeeded(&job)?;
    if !job.pictures().contains(&picture) {
        return Err(no_such_file(&job, picture.role()));
    }
    download::answer(app, &job, StoredFile::Picture(picture), headers).await
}

fn no_such_file(job: &Job, role: &str) -> Problem {
    let detail = format!("this {} job made no {role}", job.kind.word());
    Problem::new(Code::NoSuchFile, detail)
}

// Input files of jobs.

/// The `{index}` of the path. A malformed number is treated as the index of no file.
pub(super) struct PathIndex(usize);

impl<S: Send + Sync> FromRequestParts<S> for PathIndex {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, state: &S) -> Result<Self, Problem> {
        #[derive(serde::Deserialize)]
        struct Named {
            index: String,
        }
        let named = Path::<Named>::from_request_parts(parts, state).await;
        let index = named.ok().and_then(|Path(named)| named.index.parse().ok());
        Ok(Self(index.unwrap_or(usize::MAX)))
    }
}

/// Get a file of the input.
///
/// The mesh, picture or problem is number 0; the files that it references follow. They are listed in
/// `links.inputs` of the job, in any of its states. Ranges and `If-None-Match` are supported.
#[utoipa::path(
    get, path = "/v1/jobs/{id}/input/{index}", operation_id = "getInput", tag = "results",
    params(
        ("id" = String, Path, format = "uuid", description = "The job"),
        ("index" = u32, Path, description = "Number of the file, from 0"),
    ),
    responses(
        (status = 200, description = "The file", content((Vec<u8> = "application/octet-stream"), (Vec<u8> = "model/gltf-binary"), (Vec<u8> = "model/gltf+json"), (Vec<u8> = "model/obj"), (Vec<u8> = "image/png"), (Vec<u8> = "text/plain"), (Vec<u8> = "application/json"))),
        FileAnswers,
    )
)]
pub(super) async fn get_input(
    State(app): Shared,
    caller: Caller,
    PathId(id): PathId,
    PathIndex(index): PathIndex,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    let job = existing(&app, &caller.visibility(), id).await?;
    let file = job.input.get(index).ok_or_else(|| {
        let detail = format!("the job has {} input files", job.input.len());
        Problem::new(Code::NoSuchFile, detail)
    })?;
    download::answer(&app, &job, StoredFile::Input(index, file), &headers).await
}

// All results of a job as one ZIP.

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
