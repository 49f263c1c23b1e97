//! What a job made.

use std::io::SeekFrom;
use std::ops::Range;

use axum::body::Body;
use axum::extract::State;
use axum::http::{HeaderMap, HeaderValue, StatusCode, header};
use axum::response::{IntoResponse, Response};
use tokio::io::{AsyncReadExt, AsyncSeekExt};
use tokio_util::io::ReaderStream;

use super::extract::{PathId, PathName, job_not_found};
use super::problem::{Code, Problem};
use super::{App, Shared};
use crate::jobs::{Job, JobId, OutputFile, State as JobState};

/// Get the mesh with its new UVs.
///
/// In the format that the option `format` named. What belongs to it (the `.bin` of a `.gltf`) is listed in the job's
/// `links.files`. Ranges and `If-None-Match` are understood.
#[utoipa::path(
    get, path = "/v1/jobs/{id}/result", operation_id = "getResult", tag = "results",
    params(("id" = String, Path, format = "uuid", description = "The job")),
    responses(
        (status = 200, description = "The file", content((Vec<u8> = "model/gltf-binary"), (Vec<u8> = "model/gltf+json"), (Vec<u8> = "model/obj"))),
        (status = 206, description = "The asked range of it", content((Vec<u8> = "model/gltf-binary"), (Vec<u8> = "model/gltf+json"), (Vec<u8> = "model/obj"))),
        (status = 304, description = "Unchanged"),
        (status = 404, description = "`job_not_found`; `no_such_file`: a job of this kind makes none", body = Problem, content_type = "application/problem+json"),
        (status = 409, description = "`not_finished`; `no_result`: it failed or was cancelled", body = Problem, content_type = "application/problem+json"),
        (status = 416, description = "`range_not_satisfiable`", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn get_result(
    State(app): Shared,
    PathId(id): PathId,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    file(&app, id, "result", &headers).await
}

/// Get the report: distortion, seams, packing, the certificate, what was changed.
#[utoipa::path(
    get, path = "/v1/jobs/{id}/report", operation_id = "getReport", tag = "results",
    params(("id" = String, Path, format = "uuid", description = "The job")),
    responses(
        (status = 200, description = "The report", body = crate::pipeline::Report),
        (status = 206, description = "The asked range of it", body = String, content_type = "application/json"),
        (status = 304, description = "Unchanged"),
        (status = 404, description = "`job_not_found`", body = Problem, content_type = "application/problem+json"),
        (status = 409, description = "`not_finished`; `no_result`: it failed or was cancelled", body = Problem, content_type = "application/problem+json"),
        (status = 416, description = "`range_not_satisfiable`", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn get_report(
    State(app): Shared,
    PathId(id): PathId,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    file(&app, id, "report", &headers).await
}

/// Get a drawing of the UV layout, as the texture lies.
#[utoipa::path(
    get, path = "/v1/jobs/{id}/layout.png", operation_id = "getLayout", tag = "results",
    params(("id" = String, Path, format = "uuid", description = "The job")),
    responses(
        (status = 200, description = "The picture", body = Vec<u8>, content_type = "image/png"),
        (status = 206, description = "The asked range of it", body = Vec<u8>, content_type = "image/png"),
        (status = 304, description = "Unchanged"),
        (status = 404, description = "`job_not_found`, `no_such_file`", body = Problem, content_type = "application/problem+json"),
        (status = 409, description = "`not_finished`, `no_result`", body = Problem, content_type = "application/problem+json"),
        (status = 416, description = "`range_not_satisfiable`", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn get_layout(
    State(app): Shared,
    PathId(id): PathId,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    file(&app, id, "layout.png", &headers).await
}

/// Get a heat map of the distortion, as the texture lies.
///
/// It shows what the option `heatmap_measure` named, with a legend; flipped faces are yellow.
#[utoipa::path(
    get, path = "/v1/jobs/{id}/heatmap.png", operation_id = "getHeatmap", tag = "results",
    params(("id" = String, Path, format = "uuid", description = "The job")),
    responses(
        (status = 200, description = "The picture", body = Vec<u8>, content_type = "image/png"),
        (status = 206, description = "The asked range of it", body = Vec<u8>, content_type = "image/png"),
        (status = 304, description = "Unchanged"),
        (status = 404, description = "`job_not_found`, `no_such_file`", body = Problem, content_type = "application/problem+json"),
        (status = 409, description = "`not_finished`, `no_result`", body = Problem, content_type = "application/problem+json"),
        (status = 416, description = "`range_not_satisfiable`", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn get_heatmap(
    State(app): Shared,
    PathId(id): PathId,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    file(&app, id, "heatmap.png", &headers).await
}

/// Get a file that belongs to the result.
#[utoipa::path(
    get, path = "/v1/jobs/{id}/files/{name}", operation_id = "getFile", tag = "results",
    params(
        ("id" = String, Path, format = "uuid", description = "The job"),
        ("name" = String, Path, description = "Its name, as the result references it"),
    ),
    responses(
        (status = 200, description = "The file", body = Vec<u8>, content_type = "application/octet-stream"),
        (status = 206, description = "The asked range of it", body = Vec<u8>, content_type = "application/octet-stream"),
        (status = 304, description = "Unchanged"),
        (status = 404, description = "`job_not_found`, `no_such_file`", body = Problem, content_type = "application/problem+json"),
        (status = 409, description = "`not_finished`, `no_result`", body = Problem, content_type = "application/problem+json"),
        (status = 416, description = "`range_not_satisfiable`", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn get_file(
    State(app): Shared,
    PathId(id): PathId,
    PathName(name): PathName,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    file(&app, id, &format!("files/{name}"), &headers).await
}

async fn file(app: &App, id: JobId, role: &str, headers: &HeaderMap) -> Result<Response, Problem> {
    let job = app.jobs.get(id).await?.ok_or_else(job_not_found)?;
    match job.state {
        JobState::Succeeded => {}
        JobState::Queued | JobState::Running => {
            let detail = format!("the job is {}", job.state.word());
            return Err(Problem::new(Code::NotFinished, detail));
        }
        JobState::Failed | JobState::Cancelled => {
            let why = job.failure.map_or_else(
                || "the job was cancelled".to_owned(),
                |failure| format!("the job failed: {}", failure.detail),
            );
            return Err(Problem::new(Code::NoResult, why));
        }
    }
    let file = job.output(role).ok_or_else(|| {
        let detail = format!("this {} job made no {role}", job.kind.word());
        Problem::new(Code::NoSuchFile, detail)
    })?;
    answer(app, &job, file, headers).await
}

/// A file that a job made, or what of it was asked for. The name of its version is job, attempt and role: files never
/// change.
pub(super) async fn answer(
    app: &App,
    job: &Job,
    file: &OutputFile,
    headers: &HeaderMap,
) -> Result<Response, Problem> {
    let tag = format!(
        "\"{}-{}-{}\"",
        job.id,
        job.attempt,
        file.role.replace('/', "-")
    );
    if names(headers, header::IF_NONE_MATCH, &tag) {
        return Ok((StatusCode::NOT_MODIFIED, [(header::ETAG, tag)]).into_response());
    }
    let is_same = !headers.contains_key(header::IF_RANGE) || names(headers, header::IF_RANGE, &tag);
    let range = match headers.get(header::RANGE).filter(|_| is_same) {
        Some(value) => range(value, file.bytes),
        None => Ok(None),
    };
    let Ok(range) = range else {
        let detail = format!("the file has {} bytes", file.bytes);
        let problem = Problem::new(Code::RangeNotSatisfiable, detail).with_limit(file.bytes);
        let size = [(header::CONTENT_RANGE, format!("bytes */{}", file.bytes))];
        return Ok((size, problem).into_response());
    };
    let part = range.clone().unwrap_or(0..file.bytes);
    let mut content = app.jobs.open(job, file).await?;
    content.seek(SeekFrom::Start(part.start)).await?;
    let length = part.end - part.start;
    let body = Body::from_stream(ReaderStream::new(content.take(length)));
    let mut response = body.into_response();
    let headers = response.headers_mut();
    let mut set = |name, value: &str| {
        if let Ok(value) = HeaderValue::from_str(value) {
            headers.insert(name, value);
        }
    };
    set(header::CONTENT_TYPE, content_type(&file.name));
    set(header::CONTENT_LENGTH, &length.to_string());
    set(header::CONTENT_DISPOSITION, &disposition(&file.name));
    set(header::ACCEPT_RANGES, "bytes");
    set(header::CACHE_CONTROL, "private, no-cache");
    set(header::ETAG, &tag);
    if range.is_some() {
        let range = format!("bytes {}-{}/{}", part.start, part.end - 1, file.bytes);
        set(header::CONTENT_RANGE, &range);
        *response.status_mut() = StatusCode::PARTIAL_CONTENT;
    }
    Ok(response)
}

fn names(headers: &HeaderMap, name: header::HeaderName, tag: &str) -> bool {
    headers
        .get_all(name)
        .iter()
        .filter_map(|value| value.to_str().ok())
        .flat_map(|value| value.split(','))
        .any(|given| given.trim() == tag || given.trim() == "*")
}

/// The one range of a Range header. What is no single range of bytes is ignored, as RFC 9110 asks; `Err` has no byte
/// of the file in it.
fn range(value: &HeaderValue, size: u64) -> Result<Option<Range<u64>>, ()> {
    let spec = value
        .to_str()
        .ok()
        .and_then(|text| text.strip_prefix("bytes="));
    let Some((first, last)) = spec.and_then(|spec| spec.split_once('-')) else {
        return Ok(None);
    };
    let range = match (first.trim().parse::<u64>(), last.trim().parse::<u64>()) {
        (Ok(first), Ok(last)) if first <= last => first..size.min(last.saturating_add(1)),
        (Ok(first), Err(_)) if last.trim().is_empty() => first..size,
        (Err(_), Ok(count)) if first.trim().is_empty() => size - size.min(count)..size,
        _ => return Ok(None),
    };
    if range.is_empty() {
        Err(())
    } else {
        Ok(Some(range))
    }
}

fn content_type(name: &str) -> &'static str {
    let extension = name.rsplit_once('.').map_or("", |(_, extension)| extension);
    match extension {
        "glb" => "model/gltf-binary",
        "gltf" => "model/gltf+json",
        "obj" => "model/obj",
        "json" => "application/json",
        "png" => "image/png",
        _ => "application/octet-stream",
    }
}

/// Pictures and reports are shown, everything else is saved. The name is given in ASCII, and in UTF-8 if it needs it.
fn disposition(name: &str) -> String {
    let kind = match content_type(name) {
        "image/png" | "application/json" => "inline",
        _ => "attachment",
    };
    let plain = |c: char| c.is_ascii_alphanumeric() || matches!(c, '.' | '-' | '_' | ' ');
    let ascii: String = name
        .chars()
        .map(|c| if plain(c) { c } else { '_' })
        .collect();
    if ascii == name {
        return format!("{kind}; filename=\"{ascii}\"");
    }
    let encoded = percent_encoding::utf8_percent_encode(name, percent_encoding::NON_ALPHANUMERIC);
    format!("{kind}; filename=\"{ascii}\"; filename*=UTF-8''{encoded}")
}
