//! Worker that uses a service over HTTP.
//!
//! The `Idempotency-Key` of a submission consists of the digest of the request and the number of the attempt. A run
//! that follows a killed one finds its jobs again and creates no new ones.

use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use reqwest::header::{AUTHORIZATION, CACHE_CONTROL, HeaderMap, HeaderValue, RETRY_AFTER};
use reqwest::multipart::{Form, Part};
use reqwest::{Client as HttpClient, Method, RequestBuilder, Response, StatusCode, Url};
use serde::Deserialize;

use super::record::Trouble;
use super::worker::{AssetTask, Extra, Worker};
use unwrapd_api::{Failure, output_file};
use unwrapd_files::document::Upload;

/// Seconds for which the service may delay a response about a job: half of the 60 that it accepts. Longer waits keep
/// connections open, shorter ones repeat the request more often.
const WAIT_SECONDS: u8 = 30;

/// Unwraps each asset as a job of a service.
pub struct RemoteWorker {
    client: Client,
    /// Options of unwrapping as JSON.
    options: String,
    /// Files to fetch beside outputs and reports.
    extras: Vec<Extra>,
    /// Version of the service.
    version: String,
    /// Set to refuse the results of equal jobs.
    pub is_fresh: bool,
}

impl RemoteWorker {
    /// Connects to the service at an address, which may include a path, with a key.
    ///
    /// # Errors
    /// Fails if the address or the key is invalid, or no service responds.
    pub async fn connect(
        server: &str,
        key: Option<&str>,
        options: &serde_json::Value,
        extras: Vec<Extra>,
    ) -> Result<Self, RemoteError> {
        let client = Client::new(server, key)?;
        let version = client.version().await?;
        Ok(Self {
            client,
            options: options.to_string(),
            extras,
            version,
            is_fresh: false,
        })
    }

    /// Submits the job of an asset. Returns a new job, or the one that an earlier submission created.
    async fn submitted(&self, task: &AssetTask<'_>) -> Result<RemoteJob, Failure> {
        let url = self.client.url(&["v1", "jobs"]);
        // A run that refuses copies must not find the job of a run that accepts them.
        let suffix = if self.is_fresh { "-fresh" } else { "" };
        let key = format!("{}-{}{suffix}", task.digest, task.attempt);
        let answer = self.client.answer(|http| {
            let mut request = http.post(url.clone()).header("idempotency-key", &key);
            if self.is_fresh {
                request = request.header(CACHE_CONTROL, "no-cache");
            }
            request.multipart(form(task.upload, &self.options))
        });
        let answer = answer.await?;
        answer.json().await.map_err(|error| unreadable(&error))
    }

    /// Waits for the end of a job.
    async fn ended(&self, mut job: RemoteJob) -> Result<RemoteJob, Failure> {
        let mut url = self.client.url(&["v1", "jobs", &job.id]);
        url.query_pairs_mut()
            .append_pair("wait", &WAIT_SECONDS.to_string());
        while !job.state.is_final() {
            let answer = self.client.answer(|http| http.get(url.clone())).await?;
            job = answer.json().await.map_err(|error| unreadable(&error))?;
        }
        Ok(job)
    }

    /// Fetches a file of a job.
    async fn fetch(&self, job: &RemoteJob, role: &str, to: &Path) -> Result<(), Failure> {
        let segments: Vec<&str> = ["v1", "jobs", &job.id]
            .into_iter()
            .chain(role.split('/'))
            .collect();
        let url: Url = self.client.url(&segments);
        let content = answered(&self.client, Method::GET, &url).await?;
        let written = tokio::fs::write(to, &content).await;
        written.map_err(|error| Trouble::OutputUnwritable.with(error.to_string()))
    }

    fn is_wanted(&self, role: &str) -> bool {
        role == "result"
            || role.starts_with("files/")
            || role == Extra::Report.role()
            || self.extras.iter().any(|extra| extra.role() == role)
    }
}

impl Worker for RemoteWorker {
    fn version(&self) -> &str {
        &self.version
    }

    /// Returns `None`: the limit is the service's.
    fn time_limit(&self) -> Option<Duration> {
        None
    }

    async fn work(&self, task: AssetTask<'_>) -> Result<Vec<String>, Failure> {
        let job = self.ended(self.submitted(&task).await?).await?;
        match job.state {
            RemoteState::Succeeded => {}
            RemoteState::Cancelled => {
                let detail = format!("job {} was cancelled", job.id);
                return Err(Trouble::Cancelled.with(detail));
            }
            _ => return Err(job.failure()),
        }
        let mut made = Vec::new();
        for role in job.roles().filter(|role| self.is_wanted(role)) {
            let to = task.folder.join(output_file(made.len()));
            self.fetch(&job, role, &to).await?;
            made.push(role.to_owned());
        }
        Ok(made)
    }
}

fn form(upload: &Upload, options: &str) -> Form {
    let mut form = Form::new()
        .text("kind", "unwrap")
        .text("options", options.to_owned())
        .part("mesh", file_part(&upload.bytes, &upload.name));
    for (name, bytes) in &upload.resources {
        form = form.part("resource", file_part(bytes, name));
    }
    form
}

fn file_part(bytes: &[u8], name: &str) -> Part {
    Part::bytes(bytes.to_vec()).file_name(name.to_owned())
}

// HTTP client with retries.

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
struct Client {
    http: HttpClient,
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
        let root = Url::parse(server).map_err(|error| bad_address(server, error.to_string()))?;
        if !matches!(root.scheme(), "http" | "https") || root.cannot_be_a_base() {
            let cause = "it does not begin with http:// or https://".to_owned();
            return Err(bad_address(server, cause));
        }
        // The call fails if another part of the process has chosen a provider already.
        let _ = rustls::crypto::ring::default_provider().install_default();
        let http = HttpClient::builder()
            .read_timeout(SILENCE)
            .default_headers(authorization(key)?)
            .build()
            .map_err(|error| bad_address(server, text(&error)))?;
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
        match self.description().await {
            Ok(description) => Ok(description.info.version),
            Err(error) => Err(RemoteError::NoService {
                server: self.root.to_string(),
                cause: text(&error),
            }),
        }
    }

    async fn description(&self) -> reqwest::Result<Description> {
        let answer = self.http.get(self.url(&["openapi.json"])).send().await?;
        answer.error_for_status()?.json().await
    }

    /// Sends a repeatable request until it succeeds. Fails if the service rejects it permanently, or does not respond
    /// for a long time.
    pub async fn answer(
        &self,
        request: impl Fn(&HttpClient) -> RequestBuilder,
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

fn bad_address(server: &str, cause: String) -> RemoteError {
    RemoteError::Address {
        server: server.to_owned(),
        cause,
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
async fn answered(client: &Client, method: Method, url: &Url) -> Result<Vec<u8>, Failure> {
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
    match answer.json::<RemoteProblem>().await {
        Ok(problem) => Failure::new(&problem.code, problem.detail),
        Err(_) => Trouble::ServerUnavailable.with(format!("the server answers {status}")),
    }
}

/// Returns the failure of a malformed response.
fn unreadable(error: &reqwest::Error) -> Failure {
    Trouble::ServerUnavailable.with(text(error))
}

/// Formats an error with its causes on one line.
fn text(error: &dyn std::error::Error) -> String {
    let causes = std::iter::successors(Some(error), |error| error.source());
    let mut words: Vec<String> = causes.map(ToString::to_string).collect();
    words.dedup();
    words.join(": ")
}

// The parts of a job's JSON that are read.

/// A job as the service describes it.
#[derive(Deserialize)]
struct RemoteJob {
    pub id: String,
    pub state: RemoteState,
    error: Option<RemoteProblem>,
    links: RemoteLinks,
}

/// State of a job.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
enum RemoteState {
    Succeeded,
    Failed,
    Cancelled,
    /// Queued, running, or any other state that is not final.
    #[serde(other)]
    Live,
}

/// Error description (RFC 9457).
#[derive(Deserialize)]
struct RemoteProblem {
    pub code: String,
    pub detail: String,
}

#[derive(Deserialize)]
struct RemoteLinks {
    #[serde(rename = "self")]
    itself: String,
    files: Vec<RemoteFile>,
}

#[derive(Deserialize)]
struct RemoteFile {
    href: String,
}

impl RemoteState {
    pub fn is_final(self) -> bool {
        self != Self::Live
    }
}

impl RemoteJob {
    /// Returns the roles of its files, which are the ends of their paths.
    pub fn roles(&self) -> impl Iterator<Item = &str> {
        let own = format!("{}/", self.links.itself);
        let files = self.links.files.iter();
        files.filter_map(move |file| file.href.strip_prefix(&own))
    }

    /// Returns the cause of its failure.
    pub fn failure(self) -> Failure {
        match self.error {
            Some(error) => Failure::new(&error.code, error.detail),
            None => Failure::new("internal_error", "the service gives no reason"),
        }
    }
}
