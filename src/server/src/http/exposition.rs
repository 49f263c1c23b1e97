//! Metrics in the text format of Prometheus.
//!
//! Metrics are pulled, not pushed. The `prometheus` receiver of an OpenTelemetry collector pulls like Prometheus, and
//! pushes over OTLP. Pushing from here would take a dozen crates and a second registry. Gauges such as the depth of
//! the queue are read on each request.

use std::sync::Arc;
use std::time::Duration;

use axum::http::header;
use axum::response::{IntoResponse, Response};
use axum::{Router, routing::get};
use metrics::{describe_gauge, gauge};
use metrics_exporter_prometheus::{BuildError, PrometheusBuilder, PrometheusHandle};
use tokio::net::TcpListener;
use tokio_util::sync::CancellationToken;

use super::connections::Connections;
use super::{connections, observation};
use crate::jobs::{Jobs, StoreResult, meters};
use crate::sessions::Sessions;

/// Upper bounds of histogram buckets in seconds: from a fast response to a job of ten minutes, the default time limit.
const SECONDS: [f64; 13] = [
    0.005, 0.025, 0.1, 0.25, 1.0, 2.5, 5.0, 10.0, 30.0, 60.0, 120.0, 300.0, 600.0,
];
/// Interval at which pending samples of histograms are merged: the default of `metrics-exporter-prometheus`.
const UPKEEP: Duration = Duration::from_secs(5);

/// Gauges with their descriptions.
const GAUGES: [(&str, &str); 19] = [
    (BUILD_INFO, "Always 1; the version of the program"),
    (JOBS, "Jobs in the store by state"),
    (OLDEST, "For how long the oldest queued job has waited"),
    (QUEUE_DEPTH, "Jobs that may be queued"),
    (STORE_UP, "Whether the job database answered just now"),
    (
        BLOBS_UP,
        "Whether files of jobs could be stored and read just now",
    ),
    (
        STORED,
        "Bytes of the files of all jobs, and of those in quarantine",
    ),
    (QUARANTINED, "Jobs without a record whose files are kept"),
    (QUARANTINED_BYTES, "Bytes of these files"),
    (QUOTA, "Bytes that they may take together"),
    (FREE, "Bytes free where files of jobs lie"),
    (SCRATCH_FREE, "Bytes free where uploads and attempts lie"),
    (
        MIN_FREE,
        "Bytes that must be free for a job to be accepted or started",
    ),
    (RUNNING, "Jobs that this process computes"),
    (SLOTS, "Jobs that this process computes at the same time"),
    (DRAINING, "Whether this process takes in no jobs"),
    (SESSIONS, "Live sessions of this process"),
    (
        SESSIONS_LIMIT,
        "Live sessions that this process may have at the same time",
    ),
    (connections::OPEN, "Connections of this process"),
];
const BUILD_INFO: &str = "unwrapd_build_info";
const JOBS: &str = "unwrapd_jobs";
const OLDEST: &str = "unwrapd_queue_oldest_seconds";
const QUEUE_DEPTH: &str = "unwrapd_queue_limit";
const STORE_UP: &str = "unwrapd_store_up";
const BLOBS_UP: &str = "unwrapd_blobs_up";
const QUARANTINED: &str = "unwrapd_quarantined_jobs";
const QUARANTINED_BYTES: &str = "unwrapd_quarantined_bytes";
const STORED: &str = "unwrapd_stored_bytes";
const QUOTA: &str = "unwrapd_quota_bytes";
const FREE: &str = "unwrapd_free_bytes";
const SCRATCH_FREE: &str = "unwrapd_scratch_free_bytes";
const MIN_FREE: &str = "unwrapd_min_free_bytes";
const RUNNING: &str = "unwrapd_jobs_running";
const SLOTS: &str = "unwrapd_worker_slots";
const DRAINING: &str = "unwrapd_draining";
const SESSIONS: &str = "unwrapd_sessions";
const SESSIONS_LIMIT: &str = "unwrapd_sessions_limit";

/// Source of the metrics of a process.
#[derive(Clone)]
pub struct Exposition {
    jobs: Arc<Jobs>,
    /// Sessions; `None` in a worker.
    sessions: Option<Arc<Sessions>>,
    measured: Measured,
}

/// Handle to the metrics recorded since [`measure`] was called.
pub type Measured = PrometheusHandle;

/// Installs the recorder of metrics. Call it once per process.
pub fn measure() -> Result<Measured, BuildError> {
    let measured = PrometheusBuilder::new()
        .set_buckets(&SECONDS)?
        .install_recorder()?;
    for (name, meaning) in GAUGES {
        describe_gauge!(name, meaning);
    }
    gauge!(BUILD_INFO, "version" => env!("CARGO_PKG_VERSION")).set(1.0);
    gauge!(connections::OPEN).set(0.0);
    meters::describe();
    observation::describe();
    connections::describe();
    Ok(measured)
}

impl Exposition {
    /// Creates a source of recorded metrics and of the present state of these.
    pub fn new(measured: Measured, jobs: Arc<Jobs>, sessions: Option<Arc<Sessions>>) -> Self {
        Self {
            jobs,
            sessions,
            measured,
        }
    }

    /// Returns the metrics as text.
    pub(super) async fn text(&self) -> String {
        let (store, blobs) = tokio::join!(self.read_store(), self.jobs.check_blobs());
        let is_up = store.is_ok();
        gauge!(STORE_UP).set(f64::from(u8::from(is_up)));
        gauge!(BLOBS_UP).set(f64::from(u8::from(blobs.is_ok())));
        if !is_up {
            meters::store_failed();
            // The age is unknown now, and its last value would look current.
            gauge!(OLDEST).set(f64::NAN);
        }
        self.read_process();
        self.measured.render()
    }

    async fn read_store(&self) -> StoreResult<()> {
        let queue = self.jobs.queue().await?;
        for (state, count) in queue.counts {
            gauge!(JOBS, "state" => state.word()).set(count as f64);
        }
        gauge!(OLDEST).set(queue.oldest_wait.as_secs_f64());
        let usage = self.jobs.usage().await?;
        gauge!(QUARANTINED).set(usage.quarantined as f64);
        for (name, bytes) in [
            (STORED, Some(usage.stored)),
            (QUARANTINED_BYTES, Some(usage.quarantined_bytes)),
            (QUOTA, usage.quota),
            (FREE, usage.free),
            (SCRATCH_FREE, Some(usage.scratch_free)),
        ] {
            if let Some(bytes) = bytes {
                gauge!(name).set(bytes as f64);
            }
        }
        Ok(())
    }

    fn read_process(&self) {
        let settings = self.jobs.settings();
        gauge!(QUEUE_DEPTH).set(f64::from(settings.queue_depth));
        gauge!(MIN_FREE).set(settings.min_free as f64);
        gauge!(RUNNING).set(self.jobs.running() as f64);
        gauge!(SLOTS).set(settings.workers as f64);
        gauge!(DRAINING).set(f64::from(u8::from(self.jobs.is_draining())));
        if let Some(sessions) = &self.sessions {
            gauge!(SESSIONS).set(sessions.count() as f64);
            gauge!(SESSIONS_LIMIT).set(sessions.settings().most as f64);
        }
    }

    /// Responds to a collector.
    pub(super) async fn answer(&self) -> Response {
        let content_type = [(header::CONTENT_TYPE, "text/plain; version=0.0.4")];
        (content_type, self.text().await).into_response()
    }

    /// Merges pending samples of histograms until told to stop, even if nobody collects them.
    pub async fn keep_until(&self, stop: CancellationToken) {
        while let Err(_elapsed) = tokio::time::timeout(UPKEEP, stop.cancelled()).await {
            self.measured.run_upkeep();
        }
    }

    /// Serves `/metrics` at a separate address, without keys, until told to stop.
    pub async fn serve(self, listener: TcpListener, stop: CancellationToken) {
        let router = Router::new().route("/metrics", get(async move || self.answer().await));
        connections::serve(listener, router, &Connections::OF_COLLECTORS, stop).await;
    }
}
