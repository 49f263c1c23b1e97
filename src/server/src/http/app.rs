//! The state that all handlers share, the settings of the interface, and the form of JSON responses.

use std::net::IpAddr;
use std::sync::Arc;
use std::time::Duration;

use axum::http::{StatusCode, header};
use axum::response::{IntoResponse, Response};
use tokio_util::sync::CancellationToken;
use tokio_util::task::TaskTracker;

use super::connections::Connections;
use super::exposition::Exposition;
use super::limits::{Crowds, Windows};
use super::problem::Problem;
use crate::jobs::Jobs;
use crate::jobs::access::{KeyRing, Owner};
use crate::sessions::Sessions;
use crate::webhooks::Reachable;

/// State shared by all handlers.
pub(super) struct App {
    pub jobs: Arc<Jobs>,
    pub sessions: Arc<Sessions>,
    pub keys: Arc<KeyRing>,
    pub exposition: Exposition,
    /// Rate limit per owner; `None` without a limit.
    pub requests: Option<Windows<Owner>>,
    /// Archives of each owner that are being built or sent.
    pub archives: Arc<Crowds<Owner>>,
    /// Rate limit of wrong keys per address.
    pub wrong_keys: Windows<IpAddr>,
    pub settings: Settings,
    pub stop: CancellationToken,
    pub sockets: TaskTracker,
}

/// Extractor of the shared state.
pub(super) type Shared = axum::extract::State<Arc<App>>;

/// Limits of requests and permitted origins.
#[derive(Clone, Debug)]
pub struct Settings {
    /// Maximum bytes of an upload, all files together.
    pub upload_bytes: u64,
    /// Time limit of a synchronous request.
    pub synchronous_time: Duration,
    /// Limits of connections.
    pub connections: Connections,
    /// Time limit of an upload.
    pub upload_time: Duration,
    /// Minimum rate of a body in bytes per second, on average over each period of `connections.silence`.
    pub upload_rate: u64,
    /// Maximum number of requests per owner and minute; `None` without a limit.
    pub owner_requests: Option<u32>,
    /// Maximum number of wrong keys per address and minute.
    pub wrong_keys: u32,
    /// Origins, such as `https://example.org`, whose pages may use the service.
    pub origins: Vec<String>,
    /// Permitted host names beside addresses and `localhost`; `None` if any name is permitted.
    pub hosts: Option<Vec<String>>,
    /// Addresses that webhooks may use; `None` if there are no webhooks.
    pub webhooks: Option<Reachable>,
    /// Path that a proxy puts in front of all paths; empty without one.
    pub base_path: String,
}

/// Returns a response with a JSON body.
pub(super) fn json<T: serde::Serialize>(status: StatusCode, body: &T) -> Response {
    match serde_json::to_vec(body) {
        Ok(bytes) => (status, [(header::CONTENT_TYPE, "application/json")], bytes).into_response(),
        Err(error) => Problem::internal(&error).into_response(),
    }
}
