//! Clients that submit jobs until they are accepted, wait for them, and write down what they got.

use std::collections::BTreeMap;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

use reqwest::{Client, StatusCode};
use serde_json::Value;
use sha2::{Digest, Sha256};
use tokio::sync::watch;
use tokio::time::{Instant, sleep};
use unwrapd::numerics::random::Random;

use crate::meshes;

/// Clients at a time.
const CLIENTS: usize = 8;
/// For one answer. Some never come.
const ANSWER: Duration = Duration::from_secs(10);
/// Before a request that failed is sent again.
const PAUSE: Duration = Duration::from_millis(200);

/// Answers with a part of a file, after which it is taken for damaged.
const TORN: u32 = 10;

/// An answer that said: this job is accepted.
#[derive(Clone, Debug)]
pub struct Accepted {
    /// Which of the jobs.
    pub number: usize,
    /// What the service calls it.
    pub id: String,
}

/// The record of a job with its files, as a client sees both.
#[derive(Clone, Debug)]
pub struct Seen {
    pub job: Value,
    /// Those that came, by the names of their roles.
    pub files: BTreeMap<String, Vec<u8>>,
}

impl Seen {
    /// Whether nothing that was seen has changed. A newer program may show more.
    pub fn is_still(&self, now: &Self) -> bool {
        let mut files = self.files.iter();
        has(&now.job, &self.job) && files.all(|(role, bytes)| now.files.get(role) == Some(bytes))
    }
}

/// Whether a value has all that is in another: a picture gets its size when it is drawn.
fn has(value: &Value, part: &Value) -> bool {
    match part {
        Value::Object(members) => members.iter().all(|(name, part)| has(&value[name], part)),
        Value::Array(parts) => {
            let values = value.as_array().map_or(&[][..], Vec::as_slice);
            let mut pairs = values.iter().zip(parts);
            values.len() == parts.len() && pairs.all(|(value, part)| has(value, part))
        }
        _ => value == part,
    }
}

/// The jobs of a run, and what the clients know of them.
pub struct Clients {
    seed: u64,
    jobs: usize,
    http: Client,
    addresses: Mutex<Vec<String>>,
    next: AtomicUsize,
    accepted: Mutex<Vec<Accepted>>,
    ended: Mutex<BTreeMap<String, Seen>>,
    /// How many jobs were accepted, and seen to have ended.
    events: watch::Sender<usize>,
}

impl Clients {
    /// Clients with so many different jobs.
    pub fn new(jobs: usize, seed: u64) -> Self {
        // Another client of this process may have done it.
        let _ = rustls::crypto::ring::default_provider().install_default();
        let http = Client::builder().timeout(ANSWER).build();
        Self {
            seed,
            jobs,
            http: http.expect("a client"),
            addresses: Mutex::default(),
            next: AtomicUsize::new(0),
            accepted: Mutex::default(),
            ended: Mutex::default(),
            events: watch::Sender::new(0),
        }
    }

    /// Tells them where the services answer now.
    pub fn tell(&self, addresses: Vec<String>) {
        *self.addresses.lock().expect("nobody panics") = addresses;
    }

    /// Submits all jobs and sees their ends.
    pub async fn run(&self) {
        let clients = (0..CLIENTS).map(|client| self.submit_all(client));
        futures_util::future::join_all(clients).await;
    }

    /// Waits until so many jobs were accepted and so many seen to have ended, together.
    pub async fn events(&self, count: usize) {
        let mut events = self.events.subscribe();
        let seen = events.wait_for(|events| count <= *events).await;
        seen.expect("it is here");
    }

    /// Every answer that said that a job is accepted.
    pub fn accepted(&self) -> Vec<Accepted> {
        self.accepted.lock().expect("nobody panics").clone()
    }

    /// What was seen of a job when it had just ended.
    pub fn ended(&self, id: &str) -> Option<Seen> {
        self.ended.lock().expect("nobody panics").get(id).cloned()
    }

    /// What is sent as the job of a number, all of them different.
    pub fn mesh(&self, number: usize) -> Vec<u8> {
        let phase = Random::new(self.seed.wrapping_add(number as u64)).unit();
        meshes::hills_of(self.sides(number), phase)
    }

    /// How many triangles it has.
    pub fn triangles(&self, number: usize) -> u32 {
        self.sides(number).iter().product::<u32>() * 2
    }

    /// Squares of a sheet of 12 to 1,500 triangles; most have few.
    fn sides(&self, number: usize) -> [u32; 2] {
        let mut random = Random::new(!self.seed.wrapping_add(number as u64));
        let small = random.unit() * random.unit();
        [2 + (24.0 * small) as u32, 3 + random.below(28) as u32]
    }

    async fn submit_all(&self, client: usize) {
        loop {
            let number = self.next.fetch_add(1, Ordering::Relaxed);
            if self.jobs <= number {
                return;
            }
            let id = self.submit(number, client).await;
            self.events.send_modify(|events| *events += 1);
            let seen = self.until_end(&id, client).await;
            self.ended.lock().expect("nobody panics").insert(id, seen);
            self.events.send_modify(|events| *events += 1);
        }
    }

    /// Submits a job under one key until that is answered.
    async fn submit(&self, number: usize, client: usize) -> String {
        let query = ["cut=fast", "cut=disk", "cut=auto"][number % 3];
        let mesh = self.mesh(number);
        for attempt in client.. {
            let url = self.url(attempt, &format!("/v1/jobs?{query}"));
            let request = self
                .http
                .post(url)
                .header("content-type", "model/gltf-binary")
                .header("idempotency-key", format!("{}-{number}", self.seed))
                .body(mesh.clone());
            if let Ok(answer) = request.send().await {
                let status = answer.status();
                let job = answer.json::<Value>().await;
                if let (StatusCode::ACCEPTED, Ok(job)) = (status, &job) {
                    let id = job["id"].as_str().expect("an id").to_owned();
                    let accepted = Accepted {
                        number,
                        id: id.clone(),
                    };
                    self.accepted.lock().expect("nobody panics").push(accepted);
                    return id;
                }
                assert!(
                    status.is_server_error() || job.is_err(),
                    "{status}: {job:?}"
                );
            }
            sleep(PAUSE).await;
        }
        unreachable!("it tries for ever")
    }

    /// Asks for a job until it has ended, then for its files.
    async fn until_end(&self, id: &str, client: usize) -> Seen {
        for attempt in client.. {
            if let Ok(job) = self
                .get_json(attempt, &format!("/v1/jobs/{id}?wait=5"))
                .await
                && job["finished_at"].is_string()
            {
                return self.seen(job).await;
            }
        }
        unreachable!("it asks for ever")
    }

    /// What there is of a job now, and `None` if there is none.
    pub async fn look(&self, id: &str) -> Option<Seen> {
        let begin = Instant::now();
        for attempt in 0.. {
            match self.get_json(attempt, &format!("/v1/jobs/{id}")).await {
                Ok(job) => return Some(self.seen(job).await),
                Err(Some(StatusCode::NOT_FOUND)) => return None,
                _ if super::SOON < begin.elapsed() => return None,
                _ => {}
            }
        }
        unreachable!("it ends at some time")
    }

    /// A job with its files, those that can be fetched.
    async fn seen(&self, job: Value) -> Seen {
        let mut files = BTreeMap::new();
        for file in job["links"]["files"].as_array().expect("links") {
            let href = file["href"].as_str().expect("a path");
            let itself = job["links"]["self"].as_str().expect("a path");
            let role = href.strip_prefix(itself).expect("below the job");
            if let Some(bytes) = self.file(href).await {
                files.insert(role.trim_start_matches('/').to_owned(), bytes);
            }
        }
        Seen { job, files }
    }

    /// A file, if it comes whole.
    async fn file(&self, path: &str) -> Option<Vec<u8>> {
        let (begin, mut torn) = (Instant::now(), 0);
        for attempt in 0.. {
            if let Ok(answer) = self.http.get(self.url(attempt, path)).send().await {
                let status = answer.status();
                match answer.bytes().await {
                    Ok(bytes) if status == StatusCode::OK => return Some(bytes.into()),
                    _ if status == StatusCode::NOT_FOUND => return None,
                    Err(_) => torn += 1,
                    Ok(_) => {}
                }
            }
            if TORN < torn || super::SOON < begin.elapsed() {
                break;
            }
            sleep(PAUSE).await;
        }
        None
    }

    /// Removes a job; whether that was done. Without an answer it may have been.
    pub async fn delete(&self, id: &str) -> bool {
        let begin = Instant::now();
        for attempt in 0.. {
            let url = self.url(attempt, &format!("/v1/jobs/{id}"));
            let answer = self.http.delete(url).send().await;
            match answer.map(|answer| answer.status()) {
                Ok(StatusCode::NO_CONTENT) => return true,
                Ok(StatusCode::NOT_FOUND) => return 0 < attempt,
                _ if super::SOON < begin.elapsed() => break,
                _ => sleep(PAUSE).await,
            }
        }
        false
    }

    /// What is at a path; or the status of the answer, if there was one, after a pause.
    async fn get_json(&self, attempt: usize, path: &str) -> Result<Value, Option<StatusCode>> {
        let answer = self.http.get(self.url(attempt, path)).send().await;
        let status = answer.as_ref().ok().map(reqwest::Response::status);
        if let Ok(answer) = answer
            && status == Some(StatusCode::OK)
            && let Ok(json) = answer.json().await
        {
            return Ok(json);
        }
        sleep(PAUSE).await;
        Err(status)
    }

    fn url(&self, attempt: usize, path: &str) -> String {
        let addresses = self.addresses.lock().expect("nobody panics");
        format!("http://{}{path}", addresses[attempt % addresses.len()])
    }
}

/// The checksum of some bytes, as records have it.
pub fn sha256(bytes: &[u8]) -> String {
    format!("{:x}", Sha256::digest(bytes))
}
