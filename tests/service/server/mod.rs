//! Tests that talk to a real server, each to one of its own.

mod applications;
mod archives;
mod assets;
mod backup;
mod bad_inputs;
mod connections;
mod drain;
mod equal;
mod failures;
mod fair;
mod full_disk;
mod idle_options;
mod inputs;
mod islands;
mod jobs;
pub mod keys;
mod limited;
mod maps;
mod messages;
mod noted;
mod origins;
mod pictures;
mod private;
pub mod progress;
mod requests;
mod restarts;
mod results;
mod retention;
pub mod sessions;
mod sessions_end;
mod submitted;
mod synchronous;
mod uvs;
mod verdicts;
pub mod watchable;
mod webhooks;

use std::path::Path;

use nix::sys::signal::Signal;
use reqwest::{Client, RequestBuilder, Response};
use serde_json::Value;
use tempfile::TempDir;

pub use applications::{ended, form};

pub use crate::harness::SOON;
use crate::harness::process::{Process, Role};

/// A running server; it ends and its data go when this is dropped.
pub struct Server {
    process: Process,
    client: Client,
}

impl Server {
    pub fn start() -> Self {
        Self::with(&[])
    }

    /// Starts one with these environment variables.
    pub fn with(settings: &[(&str, &str)]) -> Self {
        let data = tempfile::tempdir().expect("a folder for the data");
        Self::on(data, &owned(settings))
    }

    /// Starts one on this folder.
    pub fn on(data: TempDir, settings: &[(String, String)]) -> Self {
        Self {
            process: Process::start(Role::Serve, data, settings),
            client: client(),
        }
    }

    /// Ends it without warning, as a power cut would.
    pub fn kill(&mut self) {
        self.process.kill();
    }

    /// Waits until it has stopped, after it was told to.
    pub fn stopped(&mut self) {
        self.process.stopped();
    }

    pub fn signal(&self, signal: Signal) {
        self.process.signal(signal);
    }

    /// Starts it again on the same data, with other environment variables.
    pub fn restart_with(&mut self, settings: &[(&str, &str)]) {
        self.process.restart_with(&owned(settings));
    }

    /// Starts it again on the same data and at the same address, where a page looks for it.
    pub fn restart_in_place(&mut self) {
        self.process.restart_in_place();
    }

    /// Starts it again on the same data.
    pub fn restart(&mut self) {
        self.process.restart();
    }

    pub fn process_id(&self) -> u32 {
        self.process.id()
    }

    /// Process ids of the compute children of this server.
    pub fn children(&self) -> Vec<i32> {
        self.process.children()
    }

    pub fn data(&self) -> &Path {
        self.process.folder()
    }

    /// Names of the folders that hold files of jobs.
    pub fn owners_of_files(&self) -> Vec<String> {
        let folders = std::fs::read_dir(self.data().join("blobs")).expect("a folder");
        folders
            .map(|folder| folder.expect("an entry").file_name())
            .map(|name| name.into_string().expect("text"))
            .filter(|name| name != "store-id")
            .collect()
    }

    pub fn url(&self, path: &str) -> String {
        format!("http://{}{path}", self.process.address())
    }

    pub fn socket_url(&self, path: &str) -> String {
        format!("ws://{}{path}", self.process.address())
    }

    pub fn get(&self, path: &str) -> RequestBuilder {
        self.client.get(self.url(path))
    }

    pub fn post(&self, path: &str) -> RequestBuilder {
        self.client.post(self.url(path))
    }

    pub fn request(&self, method: &str, path: &str) -> RequestBuilder {
        let method = method.parse().expect("a method");
        self.client.request(method, self.url(path))
    }

    /// Submits a GLB and returns the accepted job.
    pub async fn submit(&self, glb: Vec<u8>, query: &str) -> Value {
        let answer = self
            .post(&format!("/v1/jobs?{query}"))
            .header("content-type", "model/gltf-binary")
            .body(glb)
            .send()
            .await
            .expect("an answer");
        assert_eq!(answer.status(), 202);
        answer.json().await.expect("the job")
    }

    /// Waits for the end of a job.
    pub async fn ended(&self, job: &Value) -> Value {
        let path = format!("{}?wait=60", job["links"]["self"].as_str().expect("a link"));
        loop {
            let job = json(self.get(&path).send().await.expect("an answer")).await;
            if job["finished_at"].is_string() {
                return job;
            }
        }
    }

    /// Waits until a job is being mapped.
    pub async fn mapping(&self, job: &Value) -> Value {
        let path = format!("{}/events", job["links"]["self"].as_str().expect("a link"));
        let mut events = progress::Socket::connect(&self.socket_url(&path)).await;
        loop {
            let event = events.next().await.expect("an event");
            assert_ne!(
                event["state"], "succeeded",
                "the mesh is too small for this test"
            );
            if event["iteration"].as_u64() > Some(0) {
                return event;
            }
        }
    }
}

/// Variables of the environment.
pub fn owned(settings: &[(&str, &str)]) -> Vec<(String, String)> {
    let owned = |(name, value): &(&str, &str)| ((*name).to_owned(), (*value).to_owned());
    settings.iter().map(owned).collect()
}

/// A client. The service chooses its TLS itself, and so must whoever is built with it.
pub fn client() -> Client {
    // Another client of this process may have done it.
    let _ = rustls::crypto::ring::default_provider().install_default();
    Client::new()
}

pub async fn json(answer: Response) -> Value {
    answer.json().await.expect("JSON")
}

/// Asserts that an answer is a problem with this status and code.
pub async fn assert_problem(answer: Response, status: u16, code: &str) -> Value {
    let content_type = answer.headers()["content-type"]
        .to_str()
        .expect("text")
        .to_owned();
    let got = answer.status().as_u16();
    let problem = json(answer).await;
    assert_eq!(problem["code"], code, "{problem}");
    assert_eq!(
        (got, content_type.as_str()),
        (status, "application/problem+json")
    );
    assert_eq!(problem["status"], status);
    assert!(problem["detail"].is_string() && problem["title"].is_string());
    problem
}
