//! Worker that computes in child processes on this machine.

use std::time::Duration;

use super::worker::{Task, Worker};
use unwrapd_api::{Failure, Kind};
use unwrapd_server::jobs::Contained;

/// Unwraps each asset in a child process.
#[derive(Clone, Debug)]
pub struct Local {
    /// Settings of the child processes.
    pub contained: Contained,
    /// Options of unwrapping.
    pub options: serde_json::Value,
}

impl Worker for Local {
    fn version(&self) -> &'static str {
        env!("CARGO_PKG_VERSION")
    }

    fn time_limit(&self) -> Option<Duration> {
        Some(self.contained.time)
    }

    async fn work(&self, task: Task<'_>) -> Result<Vec<String>, Failure> {
        let (kind, options) = (Kind::Unwrap, &self.options);
        let made = (self.contained).run(kind, options, task.upload, task.folder);
        Ok(made.await?.into_iter().map(|file| file.role).collect())
    }
}
