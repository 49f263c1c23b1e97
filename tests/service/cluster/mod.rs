//! Several processes that share a PostgreSQL and an S3 server.

mod crash;
mod cuts;
mod faults;
mod holders;
mod judged;
mod keys;
mod s3;
mod sharing;
mod starts;
mod update;

use std::collections::HashMap;
use std::ops::Range;

use serde_json::Value;

use crate::harness::machines::LEASE;
use crate::harness::postgres::Postgres;
use crate::harness::process::{Process, Role};
use crate::harness::s3::S3;
use crate::meshes;
use crate::server::Server;

/// What all processes share.
pub struct Cluster {
    pub postgres: Postgres,
    pub s3: S3,
    settings: Vec<(String, String)>,
}

impl Cluster {
    pub fn start() -> Self {
        Self::with_lease(LEASE)
    }

    /// With leases of so many seconds: long ones where no worker is lost, since a worker of a busy
    /// machine that does not renew a short one in time hands its job back.
    pub fn with_lease(seconds: &str) -> Self {
        let (postgres, s3) = (Postgres::start(), S3::start());
        let mut settings = s3.settings();
        settings.push((
            "UNWRAPD_DATABASE_URL".to_owned(),
            postgres.database("unwrapd"),
        ));
        settings.push(("UNWRAPD_LEASE_SECONDS".to_owned(), seconds.to_owned()));
        Self {
            postgres,
            s3,
            settings,
        }
    }

    /// A service that computes nothing itself.
    pub fn api(&self) -> Server {
        let mut settings = self.settings.clone();
        settings.push(("UNWRAPD_WORKERS".to_owned(), "0".to_owned()));
        Server::on(tempfile::tempdir().expect("a folder"), &settings)
    }

    /// A worker with one slot.
    pub fn worker(&self) -> Process {
        let folder = tempfile::tempdir().expect("a folder");
        Process::start(Role::Worker, folder, &self.settings)
    }

    /// Every attempt that was recorded, by job: how often it was started and lost.
    pub fn attempts(&self) -> HashMap<String, (String, u32, u32)> {
        let rows = "SELECT id, state, attempt, lost + interrupted FROM job ORDER BY id";
        let rows = self.postgres.psql("unwrapd", rows);
        let row = |line: &str| {
            let fields: Vec<&str> = line.split('|').collect();
            let number = |field: &str| field.parse::<u32>().expect("a number");
            let (attempt, lost) = (number(fields[2]), number(fields[3]));
            (fields[0].to_owned(), (fields[1].to_owned(), attempt, lost))
        };
        rows.lines().map(row).collect()
    }
}

/// Jobs that one service accepted, one for each resolution: none is equal to another.
pub async fn submitted(api: &Server, resolutions: Range<u32>) -> Vec<Value> {
    let mut jobs = Vec::new();
    for resolution in resolutions {
        let query = format!("resolution={resolution}");
        jobs.push(api.submit(meshes::small(), &query).await);
    }
    jobs
}

/// Asserts that a job succeeded and that its result is the one that its record names.
pub async fn assert_whole(api: &Server, job: &Value) {
    let job = api.ended(job).await;
    assert_eq!(job["state"], "succeeded", "{job}");
    for file in job["links"]["files"].as_array().expect("links") {
        let href = file["href"].as_str().expect("a link");
        let answer = api.get(href).send().await.expect("an answer");
        assert_eq!(answer.status(), 200);
        let bytes = answer.bytes().await.expect("a whole file");
        assert!(!bytes.is_empty());
        // The size of a picture is known once it is drawn.
        let size = file["bytes"].as_u64();
        assert!(size.is_none_or(|size| size == bytes.len() as u64), "{file}");
    }
}
