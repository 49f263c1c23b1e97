//! Reception of uploads.

use std::pin::Pin;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use std::task::{Context, Poll};
use std::time::Duration;

use axum::BoxError;
use axum::body::{Body, BodyDataStream, Bytes};
use axum::extract::{FromRequest, Multipart, Request};
use axum::http::{HeaderMap, header};
use futures_util::{Stream, StreamExt, stream};
use tokio::time::{Instant, Sleep, sleep};

use super::app::App;
use super::problem::{Code, Problem};
use super::receiver::{self, Receiver};
use super::submission::{Received, UploadQuery};
use crate::jobs::{JobId, Scratch};
use unwrapd_api::{Content, Format, Kind, input_file};

/// Time for which the rest of a rejected body is read; data that comes later finds the connection closed. A longer
/// time lets slow clients keep connections open, a shorter one resets more clients before they see the answer.
const DRAIN_TIME: Duration = Duration::from_secs(1);

/// Maximum bytes of a form around its files. It covers the headers of 4096 parts with the longest names (5 MB) and six
/// text parts of the maximum length (1.5 MiB).
const FRAMING_BYTES: u64 = 8 << 20;

/// Media types of raw bodies that leave the format to the content.
const UNTOLD: [&str; 3] = ["text/plain", "application/zip", BYTES];
const BYTES: &str = "application/octet-stream";
/// Content type of `curl --data-binary` unless another one is given.
const CURL: &str = "application/x-www-form-urlencoded";

/// Returns the media types of surfaces.
pub(super) fn surface_types() -> impl Iterator<Item = &'static str> {
    let named = Format::that_hold(Content::Surface).flat_map(Format::media_types);
    named.chain(&UNTOLD).copied()
}

/// Returns the media types of pictures, drawings and problem files.
pub(super) fn other_types() -> impl Iterator<Item = &'static str> {
    let others = formats().filter(|format| !format.holds(Content::Surface));
    others.flat_map(Format::media_types).copied()
}

/// Returns the formats that jobs of some kind read.
fn formats() -> impl Iterator<Item = Format> {
    Format::all().filter(|format| Kind::ALL.iter().any(|kind| format.holds(kind.reads())))
}

/// Receives an upload to disk and checks what can be checked without computing: size, framing, options. `kind` is
/// given if the path determines it.
///
/// The rest of a rejected body is read and discarded for a while: a client that is still sending when the connection
/// closes may never see the response. A client that asks before it sends is answered at once.
pub(super) async fn receive(
    app: &Arc<App>,
    kind: Option<Kind>,
    request: Request,
) -> Result<Received, Problem> {
    guarded(app, request, |request| parse(app, kind, request)).await
}

/// Receives a texture to disk, as file 0 of the input in the folder of a child. Returns the folder. Limits are those of
/// [`receive`].
pub(super) async fn receive_texture(app: &Arc<App>, request: Request) -> Result<Scratch, Problem> {
    guarded(app, request, |request| async move {
        let media_type = media_type(request.headers());
        if !texture_types().any(|known| known == media_type) {
            let detail = format!("{media_type:?} is not the type of a texture");
            return Err(Problem::new(Code::UnsupportedMediaType, detail));
        }
        let scratch = &app.jobs.settings().scratch;
        let folder = Scratch::make(scratch.join(format!("decode-{}", JobId::fresh())))?;
        let path = folder.path().join(input_file(0));
        let mut left = app.settings.upload_bytes;
        let body = request.into_body().into_data_stream();
        receiver::write(&path, body, &mut left, app.settings.upload_bytes, |error| {
            receiver::broken(&error)
        })
        .await?;
        Ok(folder)
    })
    .await
}

/// Returns the media types of textures that can be decoded, and that of bytes.
pub(super) fn texture_types() -> impl Iterator<Item = &'static str> {
    let formats = [Format::Ktx2, Format::Png, Format::Jpeg, Format::Webp];
    let named = formats.into_iter().flat_map(Format::media_types);
    named.chain(&[BYTES]).copied()
}

/// Receives the body of a request by `parse`, with limits on its size, its speed and its time.
async fn guarded<T, F: Future<Output = Result<T, Problem>>>(
    app: &Arc<App>,
    request: Request,
    parse: impl FnOnce(Request) -> F,
) -> Result<T, Problem> {
    // Reject what the headers already rule out.
    let (head, body) = request.into_parts();
    let asks_first = head.headers.contains_key(header::EXPECT);
    let may_come = accepts(app).and_then(|()| may_fit(app, &head.headers));
    let tardy = Arc::new(OnceLock::new());
    // Limit the speed of the body, and keep a second handle to its rest.
    let tempo = Tempo {
        silence: app.settings.connections.silence,
        rate: app.settings.upload_rate,
    };
    let body = Steady::new(body.into_data_stream(), tempo, Arc::clone(&tardy));
    let body = Arc::new(Mutex::new(body));
    let mut rest = shared(Arc::clone(&body));
    // Receive the upload within its time limit. A client that waits for permission gets the rejection at once.
    let received = match may_come {
        Err(problem) if asks_first => return Err(problem),
        Err(problem) => Err(problem),
        Ok(()) => {
            let request = Request::from_parts(head, Body::from_stream(shared(body)));
            let all = tokio::time::timeout(app.settings.upload_time, parse(request));
            all.await
                .unwrap_or_else(|_| Err(late("the upload", app.settings.upload_time)))
        }
    };
    // If the body was slow, that is the cause of the failure.
    match tardy.get() {
        Some(Tardy::Silent) => return Err(late("the next piece of the body", tempo.silence)),
        Some(Tardy::Slow) => return Err(slow(tempo)),
        None => {}
    }
    if received.is_err() {
        drain(&mut rest).await;
    }
    received
}

/// Reads the rest of the body of a rejected request, for a while.
async fn drain<E>(rest: &mut (impl Stream<Item = Result<Bytes, E>> + Unpin)) {
    let drained = async { while let Some(Ok(_)) = rest.next().await {} };
    let _ = tokio::time::timeout(DRAIN_TIME, drained).await;
}

/// Reads the unread body of a rejected request, for a while, unless its client asks before it sends.
pub(super) async fn drain_refused(request: Request) {
    if !request.headers().contains_key(header::EXPECT) {
        drain(&mut request.into_body().into_data_stream()).await;
    }
}

/// Returns a stream of a body that has other readers.
fn shared(body: Arc<Mutex<Steady>>) -> impl Stream<Item = Result<Bytes, BoxError>> + Unpin + Send {
    stream::poll_fn(move |context| {
        let mut body = body.lock().unwrap_or_else(PoisonError::into_inner);
        body.poll_next_unpin(context)
    })
}

fn late(what: &str, time: Duration) -> Problem {
    let seconds = time.as_secs();
    let detail = format!("{what} did not arrive within {seconds} s");
    Problem::new(Code::RequestTimeout, detail).with_limit(seconds)
}

fn slow(Tempo { silence, rate }: Tempo) -> Problem {
    let seconds = silence.as_secs_f64();
    let detail = format!("the body came with less than {rate} bytes a second for {seconds} s");
    Problem::new(Code::RequestTimeout, detail).with_limit(rate)
}

/// Checks that the announced length is not too large for an upload.
fn may_fit(app: &App, headers: &HeaderMap) -> Result<(), Problem> {
    let length = headers.get(header::CONTENT_LENGTH);
    let length = length.and_then(|length| length.to_str().ok()?.parse::<u64>().ok());
    let limit = app.settings.upload_bytes;
    if length.is_some_and(|length| limit.saturating_add(FRAMING_BYTES) < length) {
        let detail = format!("an upload can have at most {limit} bytes");
        return Err(Problem::new(Code::UploadTooLarge, detail).with_limit(limit));
    }
    Ok(())
}

/// Checks that this process accepts jobs now.
pub(super) fn accepts(app: &App) -> Result<(), Problem> {
    if app.jobs.is_draining() {
        return Err(Problem::new(Code::Draining, "try again elsewhere"));
    }
    Ok(app.jobs.has_room()?)
}

async fn parse(app: &App, kind: Option<Kind>, request: Request) -> Result<Received, Problem> {
    // Read the query.
    let mut query = UploadQuery::read(request.uri())?;
    if kind.is_some() && query.kind.is_some() {
        return Err(Problem::new(
            Code::InvalidRequest,
            "the path already sets the kind",
        ));
    }
    let limit = app.settings.upload_bytes;
    // Make a folder for its files.
    let scratch = &app.jobs.settings().scratch;
    let folder = scratch.join(format!("upload-{}", JobId::fresh()));
    let mut receiver = Receiver::new(
        app.jobs.settings().catalog,
        folder,
        limit,
        std::mem::take(&mut query.handling),
    )?;
    // Read a form or a raw body.
    let media_type = media_type(request.headers());
    if media_type == "multipart/form-data" {
        let form = Multipart::from_request(request, &())
            .await
            .map_err(|error| Problem::new(Code::InvalidRequest, error.body_text()))?;
        receiver.form(form).await?;
    } else {
        let format = formats().find(|format| format.media_types().contains(&media_type.as_str()));
        if format.is_none() && !UNTOLD.contains(&media_type.as_str()) {
            let detail = format!(
                "{media_type:?} is not the type of a mesh, a picture, a drawing or a problem"
            );
            return Err(Problem::new(Code::UnsupportedMediaType, detail));
        }
        let given = disposition_name(request.headers());
        let name = given
            .or_else(|| Some(format!("input.{}", format?.extension())))
            .unwrap_or_default();
        receiver.body(name, request.into_body()).await?;
    }
    receiver.finish(kind, query).await
}

/// Returns the media type without parameters, in lower case. A missing or meaningless one stands for bytes.
fn media_type(headers: &HeaderMap) -> String {
    let value = headers.get(header::CONTENT_TYPE);
    let value = value.map_or(BYTES, |value| value.to_str().unwrap_or_default());
    let essence = value.split(';').next().unwrap_or_default();
    match essence.trim().to_ascii_lowercase() {
        essence if essence == CURL => BYTES.to_owned(),
        essence => essence,
    }
}

/// Parses `filename="…"` of a Content-Disposition header.
fn disposition_name(headers: &HeaderMap) -> Option<String> {
    let value = headers.get(header::CONTENT_DISPOSITION)?.to_str().ok()?;
    let (_, name) = value.split_once("filename=")?;
    let name = name.split(';').next()?.trim();
    Some(name.trim_matches('"').to_owned())
}

// Bodies with a minimum speed.

/// Reason for giving up a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Tardy {
    /// No chunk arrived within the timeout.
    Silent,
    /// The chunks are too small.
    Slow,
}

/// Minimum speed of a body.
#[derive(Clone, Copy, Debug)]
struct Tempo {
    /// Timeout between two chunks.
    pub silence: Duration,
    /// Minimum rate in bytes per second, on average over each period of `silence` spent waiting for chunks. The first
    /// period is the grace of a body that starts slowly.
    pub rate: u64,
}

/// A body that fails when it pauses for too long, or is too slow.
struct Steady {
    body: BodyDataStream,
    tempo: Tempo,
    alarm: Pin<Box<Sleep>>,
    /// Start of waiting for the next chunk. While this process is busy with the last one, the client is not slow.
    waits: Option<Instant>,
    waited: Duration,
    /// Bytes received in the time waited.
    came: u64,
    tardy: Arc<OnceLock<Tardy>>,
}

impl Steady {
    /// Creates a body with this minimum speed; `tardy` is set if it fails.
    pub fn new(body: BodyDataStream, tempo: Tempo, tardy: Arc<OnceLock<Tardy>>) -> Self {
        Self {
            body,
            tempo,
            alarm: Box::pin(sleep(tempo.silence)),
            waits: None,
            waited: Duration::ZERO,
            came: 0,
            tardy,
        }
    }

    /// Counts a chunk. Returns whether the body was too slow for a whole period.
    fn is_slow_with(&mut self, piece: &Bytes) -> bool {
        self.waited += self
            .waits
            .take()
            .map_or(Duration::ZERO, |since| since.elapsed());
        self.came += piece.len() as u64;
        if self.waited < self.tempo.silence {
            return false;
        }
        let least = self.tempo.rate as f64 * self.waited.as_secs_f64();
        let is_slow = (self.came as f64) < least;
        (self.waited, self.came) = (Duration::ZERO, 0);
        is_slow
    }

    fn end(&self, tardy: Tardy) -> Poll<Option<Result<Bytes, BoxError>>> {
        let _ = self.tardy.set(tardy);
        Poll::Ready(Some(Err("the body comes too slowly".into())))
    }
}

impl Stream for Steady {
    type Item = Result<Bytes, BoxError>;

    fn poll_next(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<Option<Self::Item>> {
        if let Poll::Ready(piece) = self.body.poll_next_unpin(context) {
            if let Some(Ok(piece)) = &piece
                && self.is_slow_with(piece)
            {
                return self.end(Tardy::Slow);
            }
            let next = Instant::now() + self.tempo.silence;
            self.alarm.as_mut().reset(next);
            return Poll::Ready(piece.map(|piece| piece.map_err(Into::into)));
        }
        self.waits.get_or_insert_with(Instant::now);
        if self.alarm.as_mut().poll(context).is_pending() {
            return Poll::Pending;
        }
        self.end(Tardy::Silent)
    }
}
