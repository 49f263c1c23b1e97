//! `unwrapd drain` and `unwrapd health`: calls of the service on a data folder.

use std::io::{Read, Write};
use std::net::{Ipv4Addr, Ipv6Addr, SocketAddr, TcpStream};
use std::path::{Path, PathBuf};
use std::time::Duration;

use serde::Deserialize;

use super::console::{CommandFailure, print};
use super::process::ADDRESS_FILE;

/// Interval between checks of running jobs. A longer interval delays the end of the command, a shorter one sends more
/// requests.
const PAUSE: Duration = Duration::from_millis(500);

/// The arguments of `drain`.
#[derive(clap::Args)]
pub(super) struct Args {
    /// Wait until no job runs in it
    #[arg(long, conflicts_with = "undo")]
    wait: bool,
    /// Have it take in and start jobs again
    #[arg(long)]
    undo: bool,
    /// API key with the scope admin, if the service asks for one
    #[arg(long, value_name = "KEY", env = "UNWRAPD_KEY", hide_env_values = true)]
    key: Option<String>,
    #[command(flatten)]
    local: LocalService,
}

/// Part of the response that is read.
#[derive(Deserialize)]
struct DrainAnswer {
    draining: bool,
    running: usize,
}

/// Runs the command.
pub(super) fn run(args: &Args) -> Result<(), CommandFailure> {
    let method = if args.undo { "DELETE" } else { "PUT" };
    let mut drain = call(args, method)?;
    while args.wait && 0 < drain.running {
        std::thread::sleep(PAUSE);
        drain = call(args, "GET")?;
        if !drain.draining {
            return Err(CommandFailure::other("somebody ended the draining"));
        }
    }
    let state = if drain.draining {
        "draining"
    } else {
        "accepting"
    };
    print(format!("{state}\t{} running", drain.running));
    Ok(())
}

fn call(args: &Args, method: &str) -> Result<DrainAnswer, CommandFailure> {
    let answer = args
        .local
        .call(&format!("{method} /v1/drain"), args.key.as_deref());
    let answer = answer.map_err(CommandFailure::other)?;
    if !answer.is_ok() {
        return Err(CommandFailure::other(format!("refused: {}", answer.body)));
    }
    let drain = serde_json::from_str(&answer.body);
    drain.map_err(|error| {
        CommandFailure::other(format!("the answer is not that of a service: {error}"))
    })
}

// `unwrapd health`: the container's health check.

/// The arguments of `health`.
#[derive(clap::Args)]
pub(super) struct HealthArgs {
    #[command(flatten)]
    local: LocalService,
}

/// Requests `/readyz`; fails unless the service is ready.
pub(super) fn health(args: &HealthArgs) -> Result<(), String> {
    let answer = args.local.call("GET /readyz", None)?;
    if answer.is_ok() {
        return Ok(());
    }
    let address = args.local.address()?;
    Err(format!("{address} is not ready: {}", answer.status_line))
}

// Requests to the service on a data folder over a plain socket, for images without a shell or curl.

/// Timeout of connecting and of each read. It is below the 5 s that the health check of the container image allows.
const TIMEOUT: Duration = Duration::from_secs(3);
/// Maximum length of a response in bytes, far above that of the responses that are read here.
const MOST: u64 = 64 << 10;

/// Address of the service to call.
#[derive(clap::Args)]
pub(super) struct LocalService {
    /// Address of the service [default: the one that the service on the data folder listens on]
    #[arg(long, value_name = "ADDRESS")]
    listen: Option<SocketAddr>,
    /// Data folder of the service
    #[arg(
        long,
        value_name = "DIR",
        env = "UNWRAPD_DATA",
        default_value = "./data"
    )]
    data: PathBuf,
}

/// Response of a service.
pub(super) struct LocalAnswer {
    pub(super) status_line: String,
    pub(super) body: String,
}

impl LocalService {
    /// Returns the address of the service.
    pub(super) fn address(&self) -> Result<SocketAddr, String> {
        let mut address = match self.listen {
            Some(address) => address,
            None => written(&self.data.join(ADDRESS_FILE))?,
        };
        if address.ip().is_unspecified() {
            address.set_ip(match address {
                SocketAddr::V4(_) => Ipv4Addr::LOCALHOST.into(),
                SocketAddr::V6(_) => Ipv6Addr::LOCALHOST.into(),
            });
        }
        Ok(address)
    }

    /// Sends a request such as `GET /readyz`, with a key if there is one.
    pub(super) fn call(&self, call: &str, key: Option<&str>) -> Result<LocalAnswer, String> {
        let address = self.address()?;
        answer(address, call, key).map_err(|error| format!("{address} does not answer: {error}"))
    }
}

impl LocalAnswer {
    /// Returns whether the status is 200.
    pub(super) fn is_ok(&self) -> bool {
        self.status_line.split(' ').nth(1) == Some("200")
    }
}

/// Reads the address that a service wrote when it started.
fn written(path: &Path) -> Result<SocketAddr, String> {
    let text = std::fs::read_to_string(path)
        .map_err(|error| format!("no service on this folder: {}: {error}", path.display()))?;
    text.trim()
        .parse()
        .map_err(|_| format!("{} has no address in it", path.display()))
}

fn answer(address: SocketAddr, call: &str, key: Option<&str>) -> std::io::Result<LocalAnswer> {
    let key = key.map_or_else(String::new, |key| {
        format!("Authorization: Bearer {key}\r\n")
    });
    let mut stream = TcpStream::connect_timeout(&address, TIMEOUT)?;
    stream.set_read_timeout(Some(TIMEOUT))?;
    let head = format!(
        "{call} HTTP/1.1\r\nHost: {address}\r\n{key}Content-Length: 0\r\nConnection: close\r\n\r\n"
    );
    stream.write_all(head.as_bytes())?;
    let mut answer = Vec::new();
    stream.take(MOST).read_to_end(&mut answer)?;
    let answer = String::from_utf8_lossy(&answer);
    let (head, body) = answer.split_once("\r\n\r\n").unwrap_or((&answer, ""));
    Ok(LocalAnswer {
        status_line: head.lines().next().unwrap_or_default().to_owned(),
        body: body.to_owned(),
    })
}
