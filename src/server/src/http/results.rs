//! Results of jobs.

use axum::extract::State;
use axum::http::HeaderMap;
use axum::response::Response;

use super::answers::{FileAnswers, PictureAnswers};
use super::app::{App, Shared};
use super::download::{self, File};
use super::extract::{PathId, PathName};
use super::missing::existing;
use super::problem::{Code, Problem};
use crate::jobs::access::Caller;
use crate::jobs::{Job, JobId, State as JobState};
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
/// - for each primitive its mesh and its number in that, as the result counts them, and its numbers of
///   faces F and of vertices V;
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
pub(super) fn check_succeeded(job: &Job) -> Result<(), Problem> {
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
    download::answer(app, &job, File::Output(file), headers).await
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
    download::answer(app, &job, File::Picture(picture), headers).await
}

fn no_such_file(job: &Job, role: &str) -> Problem {
    let detail = format!("this {} job made no {role}", job.kind.word());
    Problem::new(Code::NoSuchFile, detail)
}
