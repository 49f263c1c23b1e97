//! A service to be loaded, and what it takes.

use std::io::{BufRead, BufReader};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use futures_util::{StreamExt, stream};
use reqwest::Client;
use serde_json::Value;
use tempfile::TempDir;

/// The program, as it is built for benches.
pub const PROGRAM: &str = env!("CARGO_BIN_EXE_unwrapd");

/// A running service with an empty store. It ends when this is dropped.
pub struct Service {
    process: Child,
    address: String,
    client: Client,
    _data: TempDir,
}

impl Service {
    /// Starts one, with the defaults but for the length of its queue.
    pub fn start() -> Self {
        let _ = rustls::crypto::ring::default_provider().install_default();
        let data = tempfile::tempdir().expect("a folder");
        let mut process = Command::new(PROGRAM)
            .args([
                "serve",
                "--listen",
                "127.0.0.1:0",
                "--queue-depth",
                "100000",
            ])
            .arg("--data")
            .arg(data.path())
            .env("UNWRAPD_LOG", "error")
            .stdout(Stdio::piped())
            .spawn()
            .expect("the service starts");
        let mut line = String::new();
        let stdout = process.stdout.as_mut().expect("piped");
        BufReader::new(stdout).read_line(&mut line).expect("a line");
        let address = line.trim().strip_prefix("listening on http://");
        Self {
            address: address.expect("its address").to_owned(),
            client: Client::new(),
            process,
            _data: data,
        }
    }

    pub fn socket_url(&self, path: &str) -> String {
        format!("ws://{}{path}", self.address)
    }

    /// Submits a mesh: its job, and how long the answer took. Whoever is refused tries again.
    pub async fn submit(&self, obj: String) -> (Value, Duration) {
        let url = format!("http://{}/v1/jobs?filename=mesh.obj", self.address);
        loop {
            let begin = Instant::now();
            let request = self.client.post(&url).header("cache-control", "no-cache");
            let answer = request.body(obj.clone()).send().await.expect("an answer");
            if answer.status() == 202 {
                return (answer.json().await.expect("a job"), begin.elapsed());
            }
            eprintln!("refused with {}", answer.status());
            tokio::time::sleep(Duration::from_secs(1)).await;
        }
    }

    /// Submits meshes, so many at a time: their jobs, and how long each answer took.
    pub async fn submit_all(
        &self,
        meshes: impl Iterator<Item = String>,
        at_once: usize,
    ) -> (Vec<Value>, Vec<Duration>) {
        let answers = stream::iter(meshes).map(|obj| self.submit(obj));
        answers.buffer_unordered(at_once).unzip().await
    }

    /// What a path answers.
    pub async fn get(&self, path: &str) -> Value {
        let url = format!("http://{}{path}", self.address);
        let answer = self.client.get(url).send().await.expect("an answer");
        assert_eq!(answer.status(), 200, "{path}");
        answer.json().await.expect("JSON")
    }

    /// A whole file.
    pub async fn file(&self, path: &str) -> Vec<u8> {
        let url = format!("http://{}{path}", self.address);
        let answer = self.client.get(url).send().await.expect("an answer");
        assert_eq!(answer.status(), 200, "{path}");
        answer.bytes().await.expect("a whole file").to_vec()
    }

    /// Waits for the end of all of some jobs; how many of them did not succeed with a result.
    pub async fn losses(&self, jobs: &[Value]) -> usize {
        let mut losses = 0;
        for job in jobs {
            let path = job["links"]["self"].as_str().expect("a link");
            let ended = loop {
                let job = self.get(&format!("{path}?wait=60")).await;
                if job["finished_at"].is_string() {
                    break job;
                }
            };
            let has_result = ended["state"] == "succeeded"
                && !self.file(&format!("{path}/result")).await.is_empty();
            losses += usize::from(!has_result);
        }
        losses
    }

    /// Memory of the server alone, in MiB: compute children are not counted.
    pub fn resident_mib(&self) -> u64 {
        let status = format!("/proc/{}/status", self.process.id());
        let status = std::fs::read_to_string(status).expect("it is ours");
        let line = status.lines().find(|line| line.starts_with("VmRSS:"));
        let kib = line.and_then(|line| line.split_whitespace().nth(1)?.parse::<u64>().ok());
        kib.expect("a size") >> 10
    }
}

impl Drop for Service {
    fn drop(&mut self) {
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}
