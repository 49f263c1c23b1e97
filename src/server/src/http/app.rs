//! The state that all handlers share, and the form of their answers.

use std::net::IpAddr;
use std::sync::Arc;

use axum::http::{StatusCode, header};
use axum::response::{IntoResponse, Response};
use tokio_util::sync::CancellationToken;
use tokio_util::task::TaskTracker;

use super::crowds::Crowds;
use super::exposition::Exposition;
use super::problem::Problem;
use super::settings::Settings;
use super::windows::Windows;
use crate::jobs::Jobs;
use crate::jobs::access::{KeyRing, Owner};
use crate::sessions::Sessions;

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

/// Returns a response with a JSON body.
pub(super) fn json<T: serde::Serialize>(status: StatusCode, body: &T) -> Response {
    match serde_json::to_vec(body) {
        Ok(bytes) => (status, [(header::CONTENT_TYPE, "application/json")], bytes).into_response(),
        Err(error) => Problem::internal(&error).into_response(),
    }
}
