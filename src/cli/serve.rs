//! `unwrapd serve`: settings, start and graceful stop of the service.

use std::io::Write;
use std::net::SocketAddr;
use std::sync::Arc;
use std::time::Duration;

use super::exposure_args::ExposureArgs;
use super::listen::{ADDRESS_FILE, Listen, listener};
use super::owner_args::OwnerArgs;
use super::process;
use super::watch_args::measured;
use super::webhook_args::WebhookArgs;
use super::work_args::{WorkArgs, seconds};
use unwrapd_server::http;
use unwrapd_server::jobs::{self, Program};
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
    let text = |error: &dyn std::fmt::Display| error.to_string();
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
    let address = listener.local_addr().map_err(|e| text(&e))?;
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
        Some((Ok(()), Ok(served))) => served.map_err(|e| text(&e)),
        Some((Err(error), _) | (_, Err(error))) => Err(text(&error)),
        None => {
            tracing::warn!("connections were still open");
            Ok(())
        }
    }
}
