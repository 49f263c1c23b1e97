//! Arguments for logs and metrics.

use std::io::IsTerminal;
use std::net::SocketAddr;
use std::sync::Arc;

use clap::ValueEnum;
use tokio_util::sync::CancellationToken;
use tracing_subscriber::EnvFilter;

use super::listen::listener;
use unwrapd_server::http::{Exposition, Measured, measure};
use unwrapd_server::jobs::Jobs;
use unwrapd_server::sessions::Sessions;

/// Log and metrics of a process.
#[derive(clap::Args)]
#[command(next_help_heading = "Log and metrics")]
pub(super) struct WatchArgs {
    /// Level of the log, such as `warn`, or levels by part, such as `info,unwrapd_server::jobs=debug`
    #[arg(
        long,
        value_name = "LEVELS",
        env = "UNWRAPD_LOG",
        default_value = "info",
        value_parser = levels
    )]
    log: String,
    /// Format of the log, which goes to standard error
    #[arg(
        long,
        value_name = "FORMAT",
        env = "UNWRAPD_LOG_FORMAT",
        default_value = "text"
    )]
    log_format: LogFormat,
    /// Address at which anybody may get /metrics without a key [default: none; `serve` has them at
    /// its own address, for keys with the scope admin]
    #[arg(long, value_name = "ADDRESS", env = "UNWRAPD_METRICS_LISTEN")]
    metrics_listen: Option<SocketAddr>,
}

/// Format of the log's lines.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum LogFormat {
    /// For people.
    Text,
    /// An object per line.
    Json,
}

fn levels(text: &str) -> Result<String, String> {
    let read = EnvFilter::builder().parse(text);
    read.map(|_| text.to_owned())
        .map_err(|error| format!("expected levels such as warn or unwrapd=debug: {error}"))
}

/// Installs the metrics. Called first, so that nothing recorded at startup is lost.
pub(super) fn measured() -> Result<Measured, String> {
    measure().map_err(|error| format!("nothing is measured: {error}"))
}

impl WatchArgs {
    /// Starts the log.
    pub fn start_log(&self) {
        let log = tracing_subscriber::fmt()
            .with_env_filter(EnvFilter::new(&self.log))
            .with_writer(std::io::stderr);
        match self.log_format {
            LogFormat::Text => log.with_ansi(std::io::stderr().is_terminal()).init(),
            LogFormat::Json => log.json().flatten_event(true).init(),
        }
    }

    /// Serves the metrics at their address, if one is given, until told to stop.
    pub async fn exposition(
        &self,
        measured: Measured,
        jobs: Arc<Jobs>,
        sessions: Option<Arc<Sessions>>,
        stop: &CancellationToken,
    ) -> Result<Exposition, String> {
        let exposition = Exposition::new(measured, jobs, sessions);
        if let Some(address) = self.metrics_listen {
            let listener = listener(address).await?;
            tokio::spawn(exposition.clone().serve(listener, stop.clone()));
        }
        let (kept, stop) = (exposition.clone(), stop.clone());
        tokio::spawn(async move { kept.keep_until(stop).await });
        Ok(exposition)
    }
}
