//! Arguments for access to the service and for connection limits.

use std::net::SocketAddr;
use std::sync::Arc;
use std::time::Duration;

use clap::builder::BoolishValueParser;
use nix::sys::resource::{Resource, getrlimit, setrlimit};

use super::work_args::seconds;
use unwrapd_server::http::{Connections, origin};
use unwrapd_server::jobs::access::{KeyRing, KeyStore};

/// Default maximum number of connections. It needs a limit of 8,448 open files: two per connection and `OTHER_FILES`.
const MOST_CONNECTIONS: u64 = 4096;
/// Number of open files reserved for everything else: database connections, files of jobs, pipes of children. A higher
/// number leaves fewer connections where the limit of open files is low.
const OTHER_FILES: u64 = 256;

/// Access to the service, and time limits for silent clients.
#[derive(clap::Args)]
#[command(next_help_heading = "Connections")]
pub(super) struct ExposureArgs {
    /// Refuse calls without an API key even if none was made yet. Once one was made, they are always
    /// refused
    #[arg(long, env = "UNWRAPD_REQUIRE_KEYS", value_parser = BoolishValueParser::new())]
    require_keys: bool,
    /// Start without API keys although others reach the service: anyone who does may do everything.
    /// On loopback, and once a key was made, this changes nothing
    #[arg(long, env = "UNWRAPD_ALLOW_ANONYMOUS", value_parser = BoolishValueParser::new())]
    allow_anonymous: bool,
    /// Wrong API keys that an address may send in a minute before it is told to wait. Good keys from
    /// there are accepted all the same
    #[arg(
        long,
        value_name = "N",
        env = "UNWRAPD_WRONG_KEYS",
        default_value_t = 30
    )]
    pub wrong_keys: u32,
    /// Origin whose pages may use the service, such as `https://example.org`; can be repeated
    #[arg(
        long = "allow-origin",
        value_name = "ORIGIN",
        env = "UNWRAPD_ALLOW_ORIGIN",
        value_delimiter = ',',
        value_parser = |text: &str| origin(text).map_err(|error| error.to_string())
    )]
    pub origins: Vec<String>,
    /// Name under which the service is reached; can be repeated. Addresses and localhost are always
    /// allowed. Without this option, any name is, unless the service listens on loopback only
    #[arg(
        long = "allow-host",
        value_name = "NAME",
        env = "UNWRAPD_ALLOW_HOST",
        value_delimiter = ','
    )]
    hosts: Vec<String>,
    /// Path under which a proxy offers the service, such as /unwrapd; links begin with it
    #[arg(
        long,
        value_name = "PATH",
        env = "UNWRAPD_BASE_PATH",
        default_value = "",
        value_parser = base_path
    )]
    pub base_path: String,
    /// Maximum number of connections [default: 4096, or half of what the limit of open
    /// files allows]
    #[arg(long, value_name = "N", env = "UNWRAPD_MAX_CONNECTIONS")]
    max_connections: Option<u32>,
    /// Maximum number of connections of one address [default: no limit]
    #[arg(long, value_name = "N", env = "UNWRAPD_MAX_ADDRESS_CONNECTIONS")]
    max_address_connections: Option<u32>,
    /// Seconds that a client has for the headers of a request, and between two requests
    #[arg(
        long,
        value_name = "S",
        env = "UNWRAPD_HEADER_SECONDS",
        default_value_t = 15.0,
        value_parser = seconds
    )]
    header_seconds: f64,
    /// Seconds that a body may pause, in either direction
    #[arg(
        long,
        value_name = "S",
        env = "UNWRAPD_SILENCE_SECONDS",
        default_value_t = 30.0,
        value_parser = seconds
    )]
    silence_seconds: f64,
    /// Seconds that an upload may take in all
    #[arg(
        long,
        value_name = "S",
        env = "UNWRAPD_UPLOAD_SECONDS",
        default_value_t = 1800.0,
        value_parser = seconds
    )]
    upload_seconds: f64,
    /// Bytes in a second that an upload must bring, on average over each `silence-seconds` spent
    /// waiting for it. 0: any number
    #[arg(
        long,
        value_name = "N",
        env = "UNWRAPD_UPLOAD_RATE",
        default_value_t = 1024
    )]
    pub upload_rate: u64,
}

fn base_path(text: &str) -> Result<String, String> {
    let path = text.trim_end_matches('/');
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "/-._~".contains(c);
    if path.is_empty()
        || path.starts_with('/') && !path.contains("//") && path.chars().all(is_plain)
    {
        Ok(path.to_owned())
    } else {
        Err("expected a path such as /unwrapd".to_owned())
    }
}

impl ExposureArgs {
    /// Returns the permitted host names of a service at an address; `None` permits any.
    pub fn hosts(&self, address: SocketAddr) -> Option<Vec<String>> {
        let is_known = !self.hosts.is_empty() || address.ip().is_loopback();
        is_known.then(|| self.hosts.clone())
    }

    /// Returns the key ring of a service at an address. A service that others can reach needs keys, unless anonymous
    /// access is allowed.
    pub async fn keys(
        &self,
        address: SocketAddr,
        store: Arc<dyn KeyStore>,
    ) -> Result<KeyRing, String> {
        let keys = KeyRing::new(store);
        let has_keys = keys.are_required().await;
        let has_keys = has_keys.map_err(|error| format!("no keys read: {error}"))?;
        if self.require_keys && !has_keys {
            tracing::warn!("nobody can use the API before `unwrapd keys create` has made a key");
        }
        if self.require_keys {
            return Ok(keys.requiring_keys());
        }
        if !has_keys && !address.ip().is_loopback() {
            if !self.allow_anonymous {
                return Err(format!(
                    "there is no API key, and others reach {address}: make one with `unwrapd keys \
                     create`, or let anybody in with --allow-anonymous"
                ));
            }
            tracing::warn!("NO API KEYS: whoever reaches {address} may do everything");
        }
        Ok(keys)
    }

    /// Returns the connection limits, reduced to what the limit of open files allows.
    pub fn connections(&self) -> Connections {
        let wished = self.max_connections.map_or(MOST_CONNECTIONS, u64::from);
        let open_files = more_open_files().unwrap_or(wished + OTHER_FILES);
        // A connection that uploads has a file open as well.
        let allowed = open_files.saturating_sub(OTHER_FILES).max(open_files / 2) / 2;
        if self.max_connections.is_some() && allowed < wished {
            tracing::warn!(
                open_files,
                "{allowed} connections at most: open files are limited"
            );
        }
        Connections {
            most: wished.min(allowed).max(1) as usize,
            most_of_address: self.max_address_connections.map(|most| most as usize),
            header_time: Duration::from_secs_f64(self.header_seconds),
            silence: Duration::from_secs_f64(self.silence_seconds),
        }
    }

    /// Returns the time limit of an upload.
    pub fn upload_time(&self) -> Duration {
        Duration::from_secs_f64(self.upload_seconds)
    }
}

/// Raises the limit of open files as far as possible and returns it.
fn more_open_files() -> nix::Result<u64> {
    let (now, most) = getrlimit(Resource::RLIMIT_NOFILE)?;
    match setrlimit(Resource::RLIMIT_NOFILE, most, most) {
        Ok(()) => Ok(most),
        Err(_) => Ok(now),
    }
}
