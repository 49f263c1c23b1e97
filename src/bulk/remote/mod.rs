//! Worker that uses a service over HTTP.
//!
//! The `Idempotency-Key` of a submission consists of the digest of the request and the number of the attempt. A run
//! that follows a killed one finds its jobs again and creates no new ones.

mod client;
mod job;

use std::path::Path;
use std::time::Duration;

use reqwest::header::CACHE_CONTROL;
use reqwest::multipart::{Form, Part};
use reqwest::{Method, Url};

use super::trouble::Trouble;
use super::worker::{Extra, Task, Worker};
use unwrapd_files::document::Upload;

pub use client::RemoteError;
use client::{Client, answered, unreadable};
use job::{Job, State};
use unwrapd_api::{Failure, output_file};

/// Seconds for which the service may delay a response about a job: half of the 60 that it accepts. Longer waits keep
/// connections open, shorter ones repeat the request more often.
const WAIT_SECONDS: u8 = 30;

/// Unwraps each asset as a job of a service.
pub struct Remote {
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

impl Remote {
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
    async fn submitted(&self, task: &Task<'_>) -> Result<Job, Failure> {
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
    async fn ended(&self, mut job: Job) -> Result<Job, Failure> {
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
    async fn fetch(&self, job: &Job, role: &str, to: &Path) -> Result<(), Failure> {
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
        let is_extra = |extra: &Extra| extra.role() == role;
        role == "result"
            || role.starts_with("files/")
            || role == Extra::Report.role()
            || self.extras.iter().any(is_extra)
    }
}

impl Worker for Remote {
    fn version(&self) -> &str {
        &self.version
    }

    /// Returns `None`: the limit is the service's.
    fn time_limit(&self) -> Option<Duration> {
        None
    }

    async fn work(&self, task: Task<'_>) -> Result<Vec<String>, Failure> {
        let job = self.ended(self.submitted(&task).await?).await?;
        match job.state {
            State::Succeeded => {}
            State::Cancelled => {
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
    let part = |bytes: &[u8], name: &str| Part::bytes(bytes.to_vec()).file_name(name.to_owned());
    let mut form = Form::new()
        .text("kind", "unwrap")
        .text("options", options.to_owned())
        .part("mesh", part(&upload.bytes, &upload.name));
    for (name, bytes) in &upload.resources {
        form = form.part("resource", part(bytes, name));
    }
    form
}
