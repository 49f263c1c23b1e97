//! From a request to a received upload.

use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use axum::body::Body;
use axum::extract::{FromRequest, Multipart, Request};
use axum::http::{HeaderMap, header};
use futures_util::{StreamExt, stream};

use super::App;
use super::options::UploadQuery;
use super::problem::{Code, Problem};
use super::receiver::{Received, Receiver};
use crate::jobs::{JobId, Kind};
use crate::mesh::io::{Content, Format};

/// How long the rest of a refused body is waited for.
const DRAIN_TIME: Duration = Duration::from_secs(5);

/// Media types of raw bodies that leave the format to the content.
const UNTOLD: [&str; 2] = ["text/plain", BYTES];
const BYTES: &str = "application/octet-stream";
/// What `curl --data-binary` says of every body if it is not told otherwise.
const CURL: &str = "application/x-www-form-urlencoded";

/// Those of surfaces.
pub(super) fn surface_types() -> impl Iterator<Item = &'static str> {
    let named = Format::that_hold(Content::Surface).flat_map(Format::media_types);
    named.chain(&UNTOLD).copied()
}

/// Those of pictures, drawings and problem files.
pub(super) fn other_types() -> impl Iterator<Item = &'static str> {
    let others = formats().filter(|format| !format.holds(Content::Surface));
    others.flat_map(Format::media_types).copied()
}

/// The formats that jobs of some kind read.
fn formats() -> impl Iterator<Item = Format> {
    Format::all().filter(|format| Kind::ALL.iter().any(|kind| format.holds(kind.reads())))
}

/// Receives an upload to disk and checks what can be checked without computing: size, framing, options. `kind` is
/// given where the path already says it.
///
/// What is left of the body of a refused upload is read and forgotten, for a while: a client that is still sending
/// when the connection closes may never see the answer.
pub(super) async fn receive(
    app: &Arc<App>,
    kind: Option<Kind>,
    request: Request,
) -> Result<Received, Problem> {
    let (head, body) = request.into_parts();
    let body = Arc::new(Mutex::new(body.into_data_stream()));
    let shared = Arc::clone(&body);
    let mut rest = stream::poll_fn(move |context| {
        shared
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .poll_next_unpin(context)
    });
    let reader = stream::poll_fn(move |context| {
        body.lock()
            .unwrap_or_else(PoisonError::into_inner)
            .poll_next_unpin(context)
    });
    let received = match accepts(app) {
        Ok(()) => {
            let request = Request::from_parts(head, Body::from_stream(reader));
            parse(app, kind, request).await
        }
        Err(problem) => Err(problem),
    };
    if received.is_err() {
        let drained = async { while let Some(Ok(_)) = rest.next().await {} };
        let _ = tokio::time::timeout(DRAIN_TIME, drained).await;
    }
    received
}

/// Whether this process takes in jobs now.
fn accepts(app: &App) -> Result<(), Problem> {
    if app.jobs.is_draining() {
        return Err(Problem::new(Code::Draining, "try again elsewhere"));
    }
    Ok(app.jobs.has_room()?)
}

async fn parse(app: &App, kind: Option<Kind>, request: Request) -> Result<Received, Problem> {
    let query = UploadQuery::read(request.uri())?;
    if kind.is_some() && query.kind.is_some() {
        return Err(Problem::new(
            Code::InvalidRequest,
            "the path already sets the kind",
        ));
    }
    let limit = app.settings.upload_bytes;
    let scratch = &app.jobs.settings().scratch;
    let mut receiver = Receiver::new(scratch.join(format!("upload-{}", JobId::fresh())), limit)?;
    let media_type = media_type(request.headers());
    if media_type == "multipart/form-data" {
        let form = Multipart::from_request(request, &())
            .await
            .map_err(|error| Problem::new(Code::InvalidRequest, error.body_text()))?;
        receiver.form(form).await?;
    } else {
        let has_type = |format: &Format| format.media_types().contains(&media_type.as_str());
        let format = formats().find(has_type);
        if format.is_none() && !UNTOLD.contains(&media_type.as_str()) {
            let detail = format!(
                "{media_type:?} is not the type of a mesh, a picture, a drawing or a problem"
            );
            return Err(Problem::new(Code::UnsupportedMediaType, detail));
        }
        let given = disposition_name(request.headers());
        let made = || format.map(|format| format!("input.{}", format.extension()));
        let name = given.or_else(made).unwrap_or_default();
        receiver.body(name, request.into_body()).await?;
    }
    receiver.finish(kind, query).await
}

/// The media type without parameters, in lower case. A missing one is that of bytes, and so is the
/// one that says nothing.
fn media_type(headers: &HeaderMap) -> String {
    let value = headers.get(header::CONTENT_TYPE);
    let value = value.map_or(BYTES, |value| value.to_str().unwrap_or_default());
    let essence = value.split(';').next().unwrap_or_default();
    match essence.trim().to_ascii_lowercase() {
        essence if essence == CURL => BYTES.to_owned(),
        essence => essence,
    }
}

/// `filename="…"` of a Content-Disposition header.
fn disposition_name(headers: &HeaderMap) -> Option<String> {
    let value = headers.get(header::CONTENT_DISPOSITION)?.to_str().ok()?;
    let (_, name) = value.split_once("filename=")?;
    let name = name.split(';').next()?.trim();
    Some(name.trim_matches('"').to_owned())
}
