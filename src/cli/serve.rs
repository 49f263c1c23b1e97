//! `unwrapd serve`: arguments, start and graceful stop of the service.

use std::io::Write;
use std::net::SocketAddr;
use std::sync::Arc;
use std::time::Duration;

use clap::builder::BoolishValueParser;
use nix::sys::resource::{Resource, getrlimit, setrlimit};

use super::process::{self, ADDRESS_FILE, Listen, WorkArgs, listener, measured, seconds};
use super::webhook::WebhookArgs;
use unwrapd_server::http::{self, Connections, origin};
use unwrapd_server::jobs::access::{KeyRing, KeyStore};
use unwrapd_server::jobs::{self, OwnerQuotas, Program};
use unwrapd_server::sessions::{self, Sessions};
use unwrapd_server::webhooks;

/// The arguments of `serve`. Each has an environment variable.
#[derive(clap::Args)]
pub(super) struct Args {
    #[command(flatten)]
    listen: Listen,
    #[command(flatten)]
    work: WorkArgs,
    /// Maximum number of queued jobs
    #[arg(
        long,
        value_name = "N",
        env = "UNWRAPD_QUEUE_DEPTH",
        default_value_t = 1000
    )]
    queue_depth: u32,
    /// Maximum size of an upload with all its files, in MiB
    #[arg(
        long,
        value_name = "MIB",
        env = "UNWRAPD_MAX_UPLOAD_MIB",
        default_value_t = 256
    )]
    max_upload_mib: u64,
    /// Wall-clock limit of a synchronous call, in seconds
    #[arg(
        long,
        value_name = "S",
        env = "UNWRAPD_SYNCHRONOUS_SECONDS",
        default_value_t = 60.0,
        value_parser = seconds
    )]
    synchronous_seconds: f64,
    /// Maximum size of the files of all jobs together, in MiB [default: no limit]
    #[arg(long, value_name = "MIB", env = "UNWRAPD_QUOTA_MIB")]
    quota_mib: Option<u64>,
    /// Days to keep a job and its files after it ended
    #[arg(
        long,
        value_name = "DAYS",
        env = "UNWRAPD_RETAIN_DAYS",
        default_value_t = 30.0,
        value_parser = days
    )]
    retain_days: f64,
    /// Days to keep files without a job, as a crash or the restore of an older database leaves them,
    /// before they are deleted
    #[arg(
        long,
        value_name = "DAYS",
        env = "UNWRAPD_QUARANTINE_DAYS",
        default_value_t = 7.0,
        value_parser = days
    )]
    quarantine_days: f64,
    /// Maximum number of live sessions, each with a process of its own
    #[arg(long, value_name = "N", env = "UNWRAPD_SESSIONS", default_value_t = 16)]
    sessions: u16,
    /// Seconds without a message after which a live session ends
    #[arg(
        long,
        value_name = "S",
        env = "UNWRAPD_SESSION_SECONDS",
        default_value_t = 600.0,
        value_parser = seconds
    )]
    session_seconds: f64,
    #[command(flatten)]
    owner: OwnerArgs,
    #[command(flatten)]
    exposure: ExposureArgs,
    #[command(flatten)]
    webhook: WebhookArgs,
}

fn days(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(days) if (0.0..=1e6).contains(&days) => Ok(days),
        _ => Err("expected a number of days between 0 and 1000000".to_owned()),
    }
}

/// Seconds per day.
const DAY_SECONDS: f64 = 86_400.0;

impl Args {
    /// Returns the settings that depend on the machine if they are not given.
    pub fn derived(&self) -> Vec<(&'static str, String)> {
        let connections = self.exposure.connections().most;
        vec![
            ("workers", self.work.workers().to_string()),
            ("job_memory_mib", (self.work.memory() >> 20).to_string()),
            ("max_connections", connections.to_string()),
            ("owner_sessions", self.sessions.div_ceil(2).to_string()),
        ]
    }

    fn job_settings(&self, program: Program) -> jobs::Settings {
        jobs::Settings {
            queue_depth: self.queue_depth,
            quota: self.quota_mib.map(|mib| mib.saturating_mul(1 << 20)),
            of_owner: self.owner.quotas(),
            retention: Some(Duration::from_secs_f64(self.retain_days * DAY_SECONDS)),
            quarantine: Duration::from_secs_f64(self.quarantine_days * DAY_SECONDS),
            ..self.work.settings(program)
        }
    }

    fn session_settings(&self) -> sessions::Settings {
        sessions::Settings {
            most: usize::from(self.sessions),
            most_of_owner: self.owner.owner_sessions.map(usize::from),
            idle: Duration::from_secs_f64(self.session_seconds),
        }
    }

    fn http_settings(&self, address: SocketAddr) -> http::Settings {
        http::Settings {
            upload_bytes: self.max_upload_mib.saturating_mul(1 << 20),
            synchronous_time: Duration::from_secs_f64(self.synchronous_seconds),
            connections: self.exposure.connections(),
            upload_time: self.exposure.upload_time(),
            upload_rate: self.exposure.upload_rate,
            owner_requests: self.owner.owner_requests,
            wrong_keys: self.exposure.wrong_keys,
            origins: self.exposure.origins.clone(),
            hosts: self.exposure.hosts(address),
            webhooks: self.webhook.settings().map(|settings| settings.reachable),
            base_path: self.exposure.base_path.clone(),
        }
    }
}

/// Serves until SIGTERM or SIGINT.
pub(super) fn run(args: &Args, program: Program) -> Result<(), String> {
    process::run(&args.work, serve(args, program))
}

async fn serve(args: &Args, program: Program) -> Result<(), String> {
    // Derive the settings.
    let settings = args.job_settings(program);
    let grace = settings.grace;
    let sessions = Arc::new(Sessions::new(args.session_settings(), settings.clone()));
    let stop = process::stop_on_signals()?;
    let wished = args.listen.address;
    // Open the queue, and start metrics and webhooks.
    let measured = measured()?;
    let (jobs, store) = process::queue(&args.work, settings).await?;
    let (watch, shown) = (&args.work.watch, Some(Arc::clone(&sessions)));
    let exposition = watch
        .exposition(measured, Arc::clone(&jobs), shown, &stop)
        .await?;
    if let Some(settings) = args.webhook.settings() {
        let outbox = Arc::clone(&store);
        tokio::spawn(webhooks::deliver(outbox, settings, stop.clone()));
    }
    let keys = args.exposure.keys(wished, store).await?;

    // Listen, and announce the address.
    let listener = listener(wished).await?;
    let address = listener.local_addr().map_err(|e| e.to_string())?;
    if let Err(error) = std::fs::write(args.work.store.data.join(ADDRESS_FILE), address.to_string())
    {
        tracing::warn!(%error, "`unwrapd health` cannot find the service");
    }
    // A reader may have closed the pipe.
    let _ = writeln!(std::io::stdout(), "listening on http://{address}");

    // Run the queue and the server until a signal comes.
    let queue = tokio::spawn(Arc::clone(&jobs).run(stop.clone()));
    let server = tokio::spawn(http::serve(
        listener,
        (jobs, sessions, Arc::new(keys)),
        exposition,
        args.http_settings(address),
        stop.clone(),
    ));
    stop.cancelled().await;
    let all = async { (queue.await, server.await) };
    match process::stopped(grace, all).await {
        Some((Ok(()), Ok(served))) => served.map_err(|e| e.to_string()),
        Some((Err(error), _) | (_, Err(error))) => Err(error.to_string()),
        None => {
            tracing::warn!("connections were still open");
            Ok(())
        }
    }
}

// Arguments for the limits of one owner.

/// Limits of one owner. All keys of an owner count as one, so a key that replaces another adds
/// nothing. Without keys, all callers are one owner.
#[derive(clap::Args)]
#[command(next_help_heading = "Limits of one owner")]
#[expect(
    clippy::struct_field_names,
    reason = "they are the names of the options"
)]
pub(super) struct OwnerArgs {
    /// Maximum number of requests of one owner in a minute, as each process counts them [default: no
    /// limit]
    #[arg(long, value_name = "N", env = "UNWRAPD_OWNER_REQUESTS")]
    pub owner_requests: Option<u32>,
    /// Maximum number of queued and running jobs of one owner [default: no limit]
    #[arg(long, value_name = "N", env = "UNWRAPD_OWNER_JOBS")]
    owner_jobs: Option<u32>,
    /// Maximum size of the files of all jobs of one owner, in MiB [default: no limit]
    #[arg(long, value_name = "MIB", env = "UNWRAPD_OWNER_MIB")]
    owner_mib: Option<u64>,
    /// Processor time of the jobs of one owner on a day in UTC, in seconds; when it is used up, new
    /// jobs are refused [default: no limit]
    #[arg(
        long,
        value_name = "S",
        env = "UNWRAPD_OWNER_CPU_SECONDS",
        value_parser = seconds
    )]
    owner_cpu_seconds: Option<f64>,
    /// Maximum number of live sessions of one owner [default: half of `sessions`, rounded up; without
    /// keys, all callers are one owner, and have all]
    #[arg(long, value_name = "N", env = "UNWRAPD_OWNER_SESSIONS")]
    pub owner_sessions: Option<u16>,
}

impl OwnerArgs {
    /// Returns the quotas of one owner.
    pub fn quotas(&self) -> OwnerQuotas {
        OwnerQuotas {
            jobs: self.owner_jobs,
            bytes: self.owner_mib.map(|mib| mib.saturating_mul(1 << 20)),
            cpu_of_day: self.owner_cpu_seconds.map(Duration::from_secs_f64),
        }
    }
}

// Arguments for access to the service and for connection limits.

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
    let is_plain = (path.chars()).all(|c| c.is_ascii_alphanumeric() || "/-._~".contains(c));
    if path.is_empty() || path.starts_with('/') && !path.contains("//") && is_plain {
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
            tracing::warn!("NO API KEYS: anyone who can reach {address} may do everything");
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
