//! The compute child as a process: starting, signaling and ending it.

use std::os::unix::process::ExitStatusExt;
use std::path::Path;
use std::process::{ExitStatus, Stdio};
use std::time::Duration;

use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;
use tokio::io::{AsyncBufReadExt, AsyncReadExt, AsyncWriteExt, BufReader, Lines};
use tokio::process::{ChildStdin, ChildStdout};
use tokio::task::JoinHandle;

use super::program::Program;
use unwrapd_api::{Failure, Message};

/// Time between SIGTERM and SIGKILL. The child has no handler for SIGTERM, so it normally ends at once.
const GRACE: Duration = Duration::from_millis(100);
/// Time for a child to exit after its last message. A child that takes longer is taken to hang.
const LAST_WORDS: Duration = Duration::from_secs(5);
/// Milliseconds per clock tick in `/proc`. Linux reports 100 ticks per second (`USER_HZ`) on every machine.
const TICK_MS: u64 = 10;
/// Maximum number of bytes kept of a child's standard error: enough for a panic with its backtrace, and little
/// memory if a child floods it.
const STDERR_BYTES: u64 = 64 << 10;

/// A running compute child. Dropping it kills the process.
pub(super) struct Child {
    process: tokio::process::Child,
    messages: Lines<BufReader<ChildStdout>>,
    stderr: JoinHandle<String>,
    /// Kept open: the child exits when this pipe closes, which also happens when this process dies.
    stdin: Option<ChildStdin>,
}

/// Exit of a child that ended by itself.
pub(super) enum Exit {
    Code(i32),
    Signal(i32),
    OutOfMemory,
}

/// Starts the program with `WORD FOLDER` in its own process group, with pipes. Sets the allocator in its environment
/// to return freed address space, which must not count against the memory limit. Dropping it kills the process.
pub fn spawn(
    program: &Program,
    word: &str,
    folder: &Path,
) -> std::io::Result<tokio::process::Child> {
    program
        .command(word, folder)
        .env("_RJEM_MALLOC_CONF", "retain:false")
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .process_group(0)
        .kill_on_drop(true)
        .spawn()
}

impl Child {
    /// Starts the program with `WORD FOLDER`.
    pub fn start(program: &Program, word: &str, folder: &Path) -> std::io::Result<Self> {
        let mut process = spawn(program, word, folder)?;
        let gone = || std::io::Error::other("a pipe of the compute child is missing");
        let stdout = process.stdout.take().ok_or_else(gone)?;
        let stderr = process.stderr.take().ok_or_else(gone)?;
        Ok(Self {
            stdin: process.stdin.take(),
            messages: BufReader::new(stdout).lines(),
            stderr: tokio::spawn(read_stderr(stderr)),
            process,
        })
    }

    /// Returns the next message; `None` at the end of the output. Skips lines that are not messages.
    pub async fn next_message(&mut self) -> Option<Message> {
        loop {
            let line = self.messages.next_line().await.ok()??;
            if let Ok(message) = serde_json::from_str(&line) {
                return Some(message);
            }
        }
    }

    /// Asks the child to finish early with its current valid map.
    pub fn interrupt(&self) {
        self.signal(Signal::SIGINT);
    }

    /// Asks the child for its current maps.
    pub async fn ask_for_maps(&mut self) {
        if let Some(stdin) = &mut self.stdin {
            // The child may have exited already; then there are no maps.
            let _ = stdin.write_all(&[0]).await;
        }
    }

    /// Ends the child with SIGTERM, then with SIGKILL after a grace period.
    pub async fn terminate(&mut self) -> std::io::Result<()> {
        self.signal(Signal::SIGTERM);
        if tokio::time::timeout(GRACE, self.process.wait())
            .await
            .is_err()
        {
            self.process.kill().await?;
        }
        Ok(())
    }

    /// Waits for the child to exit after its last message, and kills it if it does not.
    pub async fn wait(mut self) -> std::io::Result<Exit> {
        let status = if let Ok(status) = tokio::time::timeout(LAST_WORDS, self.process.wait()).await
        {
            status?
        } else {
            self.process.kill().await?;
            self.process.wait().await?
        };
        let stderr = self.stderr.await.unwrap_or_default();
        if !stderr.is_empty() {
            tracing::warn!(%status, stderr, "compute child");
        }
        Ok(exit(status, &stderr))
    }

    /// Returns the resident memory of the child in bytes; 0 if unknown.
    pub fn resident_bytes(&self) -> u64 {
        let Some(pid) = self.process.id() else {
            return 0;
        };
        let status = std::fs::read_to_string(format!("/proc/{pid}/status")).unwrap_or_default();
        let resident = status.lines().find_map(|line| line.strip_prefix("VmRSS:"));
        let kib = resident.and_then(|text| text.trim().strip_suffix(" kB")?.parse::<u64>().ok());
        kib.unwrap_or(0) << 10
    }

    /// Returns the processor time that the child has used, in milliseconds.
    pub fn cpu_ms(&self) -> u64 {
        let Some(pid) = self.process.id() else {
            return 0;
        };
        let stat = std::fs::read_to_string(format!("/proc/{pid}/stat")).unwrap_or_default();
        // The program name is in parentheses and may contain spaces, so the fields start after the last one. Fields 14
        // and 15 of the whole line are the times in user and kernel mode (proc(5)).
        let fields = stat.rsplit_once(") ").map_or("", |(_, fields)| fields);
        let ticks = fields.split(' ').skip(11).take(2);
        ticks.filter_map(|it| it.parse::<u64>().ok()).sum::<u64>() * TICK_MS
    }

    fn signal(&self, signal: Signal) {
        if let Some(pid) = self.process.id() {
            // The child may have exited already.
            let _ = kill(Pid::from_raw(pid as i32), signal);
        }
    }
}

/// Reads the standard error of a process to its end and keeps the first 64 KiB.
pub async fn read_stderr(stderr: tokio::process::ChildStderr) -> String {
    let mut kept = Vec::new();
    let mut limited = stderr.take(STDERR_BYTES);
    let _ = limited.read_to_end(&mut kept).await;
    let _ = tokio::io::copy(&mut limited.into_inner(), &mut tokio::io::sink()).await;
    String::from_utf8_lossy(&kept).trim_end().to_owned()
}

fn exit(status: ExitStatus, stderr: &str) -> Exit {
    // The standard library prints this before it aborts on a failed allocation.
    if status.signal() == Some(Signal::SIGABRT as i32) && stderr.contains("memory allocation of ") {
        return Exit::OutOfMemory;
    }
    match status.signal() {
        Some(signal) => Exit::Signal(signal),
        None => Exit::Code(status.code().unwrap_or_default()),
    }
}

impl Exit {
    /// Returns whether the child was ended from outside, by SIGKILL, SIGTERM or SIGINT.
    pub fn is_from_outside(&self) -> bool {
        let outside = [Signal::SIGKILL, Signal::SIGTERM, Signal::SIGINT];
        matches!(self, Self::Signal(number) if outside.iter().any(|it| *it as i32 == *number))
    }

    /// Returns whether it was killed by SIGKILL, as the system does for lack of memory.
    pub fn is_kill(&self) -> bool {
        matches!(self, Self::Signal(number) if *number == Signal::SIGKILL as i32)
    }

    /// Returns the failure of a child that ended without reporting one.
    pub fn cause(&self) -> Failure {
        match *self {
            Self::OutOfMemory => {
                Failure::new("out_of_memory", "needs more memory than the limit allows")
            }
            Self::Code(code) => Failure::new(
                "crashed",
                format!(
                    "the computation ended with exit code {code}, which is a bug in the service"
                ),
            ),
            Self::Signal(number) => {
                let signal = Signal::try_from(number).ok();
                let name = signal.map_or_else(|| number.to_string(), |s| s.to_string());
                if self.is_from_outside() {
                    let detail = format!("the computation was terminated from outside by {name}");
                    return Failure::new("worker_lost", detail);
                }
                let detail = format!(
                    "the computation was terminated by {name}, which is a bug in the service"
                );
                Failure::new("crashed", detail)
            }
        }
    }
}
