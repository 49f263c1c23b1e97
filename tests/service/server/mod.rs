//! Tests that talk to a real server, each to one of its own.

mod applications;
mod backup;
mod bad_inputs;
mod drain;
mod equal;
mod failures;
mod full_disk;
mod idle_options;
mod jobs;
pub mod progress;
mod requests;
mod restarts;
mod results;
mod retention;
mod submitted;
mod synchronous;
mod verdicts;

use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, ChildStdout, Command, Stdio};
use std::time::Duration;

use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;
use reqwest::{Client, RequestBuilder, Response};
use serde_json::Value;
use tempfile::TempDir;

pub use applications::{ended, form};

use crate::children;

/// For what must happen soon, on however busy a machine.
pub const SOON: Duration = Duration::from_mins(1);

/// A running server; it ends and its data go when this is dropped.
pub struct Server {
    process: Child,
    /// Kept open: a server that cannot print ends.
    stdout: BufReader<ChildStdout>,
    settings: Vec<(String, String)>,
    data: TempDir,
    address: String,
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
        // Another test of this process may have chosen already.
        let _ = rustls::crypto::ring::default_provider().install_default();
        let (process, stdout, address) = spawn(data.path(), settings);
        Self {
            process,
            stdout,
            settings: settings.to_vec(),
            data,
            address,
            client: client(),
        }
    }

    /// Ends it without warning, as a power cut would.
    pub fn kill(&mut self) {
        self.process.kill().expect("the server is ours");
        self.process.wait().expect("the server is ours");
    }

    /// Waits until it has stopped, after it was told to.
    pub fn stopped(&mut self) {
        assert!(self.process.wait().expect("the server is ours").success());
    }

    pub fn signal(&self, signal: Signal) {
        kill(Pid::from_raw(self.process.id() as i32), signal).expect("the server is ours");
    }

    /// Starts it again on the same data, with other environment variables.
    pub fn restart_with(&mut self, settings: &[(&str, &str)]) {
        self.settings = owned(settings);
        self.restart();
    }

    /// Starts it again on the same data.
    pub fn restart(&mut self) {
        (self.process, self.stdout, self.address) = spawn(self.data.path(), &self.settings);
    }

    /// Process ids of the compute children of this server.
    pub fn children(&self) -> Vec<i32> {
        children::within(self.data.path())
    }

    pub fn data(&self) -> &Path {
        self.data.path()
    }

    /// Names of the folders that hold files of jobs.
    pub fn owners_of_files(&self) -> Vec<String> {
        let folders = std::fs::read_dir(self.data().join("blobs")).expect("a folder");
        folders
            .map(|folder| folder.expect("an entry").file_name())
            .map(|name| name.into_string().expect("text"))
            .collect()
    }

    pub fn url(&self, path: &str) -> String {
        format!("http://{}{path}", self.address)
    }

    pub fn socket_url(&self, path: &str) -> String {
        format!("ws://{}{path}", self.address)
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

impl Drop for Server {
    fn drop(&mut self) {
        let _ = self.process.kill();
        let _ = self.process.wait();
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

fn spawn(data: &Path, settings: &[(String, String)]) -> (Child, BufReader<ChildStdout>, String) {
    let mut process = Command::new(env!("CARGO_BIN_EXE_unwrapd"))
        .args(["serve", "--listen", "127.0.0.1:0", "--data"])
        .arg(data)
        .envs(settings.iter().cloned())
        .stdout(Stdio::piped())
        .spawn()
        .expect("the server starts");
    let mut stdout = BufReader::new(process.stdout.take().expect("piped"));
    let mut line = String::new();
    stdout.read_line(&mut line).expect("its address");
    let address = line.trim().strip_prefix("listening on http://");
    let address = address.expect("its address").to_owned();
    (process, stdout, address)
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
