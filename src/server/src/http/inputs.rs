//! Input files of jobs.

use axum::extract::{FromRequestParts, Path, State};
use axum::http::HeaderMap;
use axum::http::request::Parts;
use axum::response::Response;

use super::answers::FileAnswers;
use super::app::Shared;
use super::download::{self, File};
use super::extract::PathId;
use super::missing::existing;
use super::problem::{Code, Problem};
use crate::jobs::access::Caller;

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
    download::answer(&app, &job, File::Input(index, file), &headers).await
}
