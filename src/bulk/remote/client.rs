//! HTTP client with retries.

use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use reqwest::header::{AUTHORIZATION, HeaderMap, HeaderValue, RETRY_AFTER};
use reqwest::{Method, RequestBuilder, Response, StatusCode, Url};
use serde::Deserialize;

use super::job::Problem;
use crate::bulk::trouble::Trouble;
use unwrapd_api::Failure;

/// First pause between attempts, and the maximum after doubling. Shorter pauses burden a busy service, longer ones
/// leave it idle after it has recovered.
const FIRST_PAUSE: Duration = Duration::from_millis(250);
const LONGEST_PAUSE: Duration = Duration::from_secs(30);
/// Time after which a request is given up, and the service counts as gone: long enough for a restart. The help of
/// `submit` promises it.
const PATIENCE: Duration = Duration::from_mins(10);
/// Timeout between two bytes, far above the `WAIT_SECONDS` for which the service may delay a response.
const SILENCE: Duration = Duration::from_mins(2);

/// Reason why a service cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum RemoteError {
    /// The address is invalid.
    #[error("{server:?} is not the address of a service: {cause}")]
    Address {
        /// The given address.
        server: String,
        /// Cause.
        cause: String,
    },
    /// The key contains characters that no key has.
    #[error("the API key has characters that no key has")]
    Key,
    /// Nothing responds, or something other than the service does.
    #[error("no service answers at {server}: {cause}")]
    NoService {
        /// Address of the service.
        server: String,
        /// Cause.
        cause: String,
    },
}

/// Client of a service.
pub(super) struct Client {
    http: reqwest::Client,
    root: Url,
    /// Set once a request has been given up, so that the others of a run are not retried as long.
    is_given_up: AtomicBool,
}

/// Part of the OpenAPI document that is read.
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
        // The call fails if another part of the process has chosen a provider already.
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

    /// Returns the URL of a path below the address of the service.
    pub fn url(&self, segments: &[&str]) -> Url {
        let mut url = self.root.clone();
        if let Ok(mut path) = url.path_segments_mut() {
            path.pop_if_empty().extend(segments);
        }
        url
    }

    /// Requests the version of the service, without retries.
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

    /// Sends a repeatable request until it succeeds. Fails if the service rejects it permanently, or does not respond
    /// for a long time.
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
                // Temporary errors are retried, after the pause that the service asks for.
                Ok(answer) if may_pass(answer.status()) => {
                    let told = retry_after(&answer);
                    (refusal(answer).await.detail, told)
                }
                Ok(answer) => return Err(refusal(answer).await),
                Err(error) => (text(&error), None),
            };
            // Give up for all requests of the run once one of them has waited too long.
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

/// Returns the authorization header for all requests.
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

/// Returns the body of a response, requested again up to three times if it breaks off.
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

/// Returns whether a retry of the same request may succeed.
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

/// Returns the delay that the service asks for, limited to the total retry time.
fn retry_after(answer: &Response) -> Option<Duration> {
    let seconds = answer.headers().get(RETRY_AFTER)?.to_str().ok()?;
    let seconds = Duration::from_secs(seconds.trim().parse().ok()?);
    Some(seconds.min(PATIENCE))
}

/// Returns the failure that a rejection describes.
async fn refusal(answer: Response) -> Failure {
    let status = answer.status();
    match answer.json::<Problem>().await {
        Ok(problem) => Failure::new(&problem.code, problem.detail),
        Err(_) => Trouble::ServerUnavailable.with(format!("the server answers {status}")),
    }
}

/// Returns the failure of a malformed response.
pub(super) fn unreadable(error: &reqwest::Error) -> Failure {
    Trouble::ServerUnavailable.with(text(error))
}

/// Formats an error with its causes on one line.
fn text(error: &dyn std::error::Error) -> String {
    let causes = std::iter::successors(Some(error), |error| error.source());
    let mut words: Vec<String> = causes.map(ToString::to_string).collect();
    words.dedup();
    words.join(": ")
}
