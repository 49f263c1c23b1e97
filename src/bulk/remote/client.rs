//! Requests that are repeated as long as that may help.

use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use reqwest::header::{AUTHORIZATION, HeaderMap, HeaderValue, RETRY_AFTER};
use reqwest::{Method, RequestBuilder, Response, StatusCode, Url};
use serde::Deserialize;

use super::job::Problem;
use crate::bulk::trouble::Trouble;
use unwrapd_api::Failure;

/// Between the first two tries; then twice as long each time.
const FIRST_PAUSE: Duration = Duration::from_millis(250);
const LONGEST_PAUSE: Duration = Duration::from_secs(30);
/// How long one request is tried before the service counts as gone.
const PATIENCE: Duration = Duration::from_mins(10);
/// An answer may be held back by the service, and a file may be large: a limit between two bytes.
const SILENCE: Duration = Duration::from_mins(2);

/// Why a service cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum RemoteError {
    /// The address is none.
    #[error("{server:?} is not the address of a service: {cause}")]
    Address {
        /// What was given.
        server: String,
        /// What is wrong with it.
        cause: String,
    },
    /// The key has characters that no key has.
    #[error("the API key has characters that no key has")]
    Key,
    /// Nothing answers, or something else does.
    #[error("no service answers at {server}: {cause}")]
    NoService {
        /// Its address.
        server: String,
        /// What happened.
        cause: String,
    },
}

/// A service, and whether it is still there.
pub(super) struct Client {
    http: reqwest::Client,
    root: Url,
    /// Once one request has been given up, the others of a run need not be tried as long.
    is_given_up: AtomicBool,
}

/// What is read of the service's own description.
#[derive(Deserialize)]
struct Description {
    info: Info,
}

#[derive(Deserialize)]
struct Info {
    version: String,
}

impl Client {
    pub fn new(server: &str, key: Option<&str>) -> Result<Self, RemoteError> {
        let wrong = |cause: String| RemoteError::Address {
            server: server.to_owned(),
            cause,
        };
        let root: Url = server.parse().map_err(|error| wrong(format!("{error}")))?;
        if !matches!(root.scheme(), "http" | "https") || root.cannot_be_a_base() {
            return Err(wrong(
                "it does not begin with http:// or https://".to_owned(),
            ));
        }
        // Another part of the process may have chosen already.
        let _ = rustls::crypto::ring::default_provider().install_default();
        let http = reqwest::Client::builder()
            .read_timeout(SILENCE)
            .default_headers(authorization(key)?)
            .build()
            .map_err(|error| wrong(text(&error)))?;
        Ok(Self {
            http,
            root,
            is_given_up: AtomicBool::new(false),
        })
    }

    /// A path below the address of the service.
    pub fn url(&self, segments: &[&str]) -> Url {
        let mut url = self.root.clone();
        if let Ok(mut path) = url.path_segments_mut() {
            path.pop_if_empty().extend(segments);
        }
        url
    }

    /// Version of the service, asked for once.
    pub async fn version(&self) -> Result<String, RemoteError> {
        let no_service = |cause: String| RemoteError::NoService {
            server: self.root.to_string(),
            cause,
        };
        let request = self.http.get(self.url(&["openapi.json"])).send();
        let answer = request.await.and_then(Response::error_for_status);
        let answer = answer.map_err(|error| no_service(text(&error)))?;
        let description = answer.json::<Description>().await;
        let description = description.map_err(|error| no_service(text(&error)))?;
        Ok(description.info.version)
    }

    /// The answer to a request that may be repeated. What the service refuses for good, and what
    /// it does not answer for a long time, is a failure.
    pub async fn answer(
        &self,
        request: impl Fn(&reqwest::Client) -> RequestBuilder,
    ) -> Result<Response, Failure> {
        let begin = Instant::now();
        let mut pause = FIRST_PAUSE;
        loop {
            let (cause, told) = match request(&self.http).send().await {
                Ok(answer) if answer.status().is_success() => {
                    self.is_given_up.store(false, Ordering::Relaxed);
                    return Ok(answer);
                }
                Ok(answer) if may_pass(answer.status()) => {
                    let told = retry_after(&answer);
                    (refusal(answer).await.detail, told)
                }
                Ok(answer) => return Err(refusal(answer).await),
                Err(error) => (text(&error), None),
            };
            let is_over = PATIENCE <= begin.elapsed() || self.is_given_up.load(Ordering::Relaxed);
            if is_over {
                self.is_given_up.store(true, Ordering::Relaxed);
                return Err(Trouble::ServerUnavailable.with(cause));
            }
            tokio::time::sleep(told.unwrap_or(pause)).await;
            pause = LONGEST_PAUSE.min(2 * pause);
        }
    }
}

/// The header with which every call says who calls.
fn authorization(key: Option<&str>) -> Result<HeaderMap, RemoteError> {
    let mut headers = HeaderMap::new();
    if let Some(key) = key {
        let value = HeaderValue::from_str(&format!("Bearer {key}"));
        let mut value = value.map_err(|_| RemoteError::Key)?;
        value.set_sensitive(true);
        headers.insert(AUTHORIZATION, value);
    }
    Ok(headers)
}

/// The content of an answer, asked for again if it breaks off.
pub(super) async fn answered(
    client: &Client,
    method: Method,
    url: &Url,
) -> Result<Vec<u8>, Failure> {
    let mut tries = 0..3;
    loop {
        let answer = client.answer(|http| http.request(method.clone(), url.clone()));
        match answer.await?.bytes().await {
            Ok(content) => return Ok(content.into()),
            Err(error) if tries.next().is_none() => return Err(unreadable(&error)),
            Err(_) => {}
        }
    }
}

/// Whether the same request may be answered otherwise later.
fn may_pass(status: StatusCode) -> bool {
    matches!(
        status,
        StatusCode::REQUEST_TIMEOUT
            | StatusCode::TOO_MANY_REQUESTS
            | StatusCode::BAD_GATEWAY
            | StatusCode::SERVICE_UNAVAILABLE
            | StatusCode::GATEWAY_TIMEOUT
            | StatusCode::INSUFFICIENT_STORAGE
    )
}

/// The seconds that the service asks to wait for.
fn retry_after(answer: &Response) -> Option<Duration> {
    let seconds = answer.headers().get(RETRY_AFTER)?.to_str().ok()?;
    let seconds = Duration::from_secs(seconds.trim().parse().ok()?);
    Some(seconds.min(PATIENCE))
}

/// What the service says of a request that it did not do.
async fn refusal(answer: Response) -> Failure {
    let status = answer.status();
    match answer.json::<Problem>().await {
        Ok(problem) => Failure::new(&problem.code, problem.detail),
        Err(_) => Trouble::ServerUnavailable.with(format!("the server answers {status}")),
    }
}

/// An answer that is not what it should be.
pub(super) fn unreadable(error: &reqwest::Error) -> Failure {
    Trouble::ServerUnavailable.with(text(error))
}

/// An error with its causes, on one line.
fn text(error: &dyn std::error::Error) -> String {
    let causes = std::iter::successors(Some(error), |error| error.source());
    let mut words: Vec<String> = causes.map(ToString::to_string).collect();
    words.dedup();
    words.join(": ")
}
