//! The compute child as a process: starting, signaling and ending it, and what its end means.

use std::ffi::OsString;
use std::os::unix::process::ExitStatusExt;
use std::path::{Path, PathBuf};
use std::process::{ExitStatus, Stdio};
use std::time::Duration;

use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;
use tokio::io::{AsyncBufReadExt, AsyncReadExt, AsyncWriteExt, BufReader, Lines};
use tokio::process::{ChildStdin, ChildStdout};
use tokio::task::JoinHandle;

use unwrapd_api::{
    ERROR, Failure, Kind, Limits, Message, NO_SPACE, OUTCOME, Outcome, OutputFile, Pictures, TASK,
    Task, Upload, input_file, read_json, write_json,
};

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
        let (Some(stdout), Some(stderr)) = (process.stdout.take(), process.stderr.take()) else {
            let detail = "a pipe of the compute child is missing";
            return Err(std::io::Error::other(detail));
        };
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

// The program that compute children run.

/// Environment variable with the search path of the dynamic linker.
const LIBRARY_PATH: &str = "LD_LIBRARY_PATH";

/// Command line that starts this program as a child.
#[derive(Clone, Debug)]
pub struct Program {
    /// File to execute.
    pub file: PathBuf,
    /// Arguments before those of the child.
    pub arguments: Vec<OsString>,
    /// File whose checksum identifies the build that computes.
    pub engine: PathBuf,
}

impl Program {
    /// Returns the running executable.
    pub fn current() -> std::io::Result<Self> {
        std::env::current_exe().map(Self::from)
    }

    /// Returns a command with these arguments and an empty environment. Only an interpreter keeps the library search
    /// path, where it may find its own libraries.
    pub(super) fn command(&self, word: &str, folder: &Path) -> tokio::process::Command {
        let mut command = tokio::process::Command::new(&self.file);
        command.args(&self.arguments).arg(word).arg(folder);
        command.env_clear();
        if self.file != self.engine
            && let Some(path) = std::env::var_os(LIBRARY_PATH)
        {
            command.env(LIBRARY_PATH, path);
        }
        command
    }
}

impl From<PathBuf> for Program {
    fn from(file: PathBuf) -> Self {
        Self {
            engine: file.clone(),
            file,
            arguments: Vec::new(),
        }
    }
}

// A single computation in a child process, without a queue, for commands that run many.

/// Settings of a contained computation, whose crash ends only its child process.
#[derive(Clone, Debug)]
pub struct Contained {
    /// Program started as the compute child.
    pub program: Program,
    /// Maximum number of threads.
    pub threads: usize,
    /// Wall-clock time limit, after which the current valid map becomes the result.
    pub time: Duration,
    /// Memory limit in bytes.
    pub memory: u64,
    /// Time at which the pictures of an atlas are drawn.
    pub pictures: Pictures,
}

impl Contained {
    /// Runs a job of this kind. Leaves the n-th output file as [`output_file`](unwrapd_api::output_file)`(n)` in
    /// `folder`, which must exist and be empty. Dropping the future kills the child.
    ///
    /// # Errors
    /// Returns the failure that the computation reports, or the reason why it could not report one.
    pub async fn run(
        &self,
        kind: Kind,
        options: &serde_json::Value,
        upload: &Upload,
        folder: &Path,
    ) -> Result<Vec<OutputFile>, Failure> {
        let task = Task {
            kind,
            input: names(upload).map(str::to_owned).collect(),
            options: options.clone(),
            limits: Limits {
                triangles: None,
                threads: Some(self.threads),
                seconds: Some(self.time.as_secs_f64()),
            },
            memory: self.memory,
            pictures: self.pictures,
        };
        prepare(&task, upload, folder).await?;
        let child = Child::start(&self.program, "compute", folder)?;
        let at_most = given_up_after(self.time);
        finished(child, folder, at_most, timed_out(self.time)).await?;
        let outcome: Outcome = read_json(folder, OUTCOME)?;
        Ok(outcome.output)
    }
}

/// Waits until a child that works in `folder` has finished. Ends it after `at_most` and returns `late`.
pub(super) async fn finished(
    mut child: Child,
    folder: &Path,
    at_most: Duration,
    late: Failure,
) -> Result<(), Failure> {
    let heard = async { while child.next_message().await.is_some() {} };
    if tokio::time::timeout(at_most, heard).await.is_err() {
        child.terminate().await?;
        return Err(late);
    }
    let exit = child.wait().await?;
    match exit {
        Exit::Code(0) => Ok(()),
        Exit::Code(NO_SPACE) => {
            let detail = format!("no space left in {}", folder.display());
            Err(Failure::new("storage_full", detail))
        }
        _ => Err(read_json(folder, ERROR).unwrap_or_else(|_| exit.cause())),
    }
}

/// Returns the name of the mesh, then the names of the files it refers to.
fn names(upload: &Upload) -> impl Iterator<Item = &str> {
    let resources = upload.resources.keys().map(String::as_str);
    std::iter::once(upload.name.as_str()).chain(resources)
}

async fn prepare(task: &Task, upload: &Upload, folder: &Path) -> std::io::Result<()> {
    let contents = std::iter::once(&upload.bytes).chain(upload.resources.values());
    for (index, content) in contents.enumerate() {
        tokio::fs::write(folder.join(input_file(index)), content).await?;
    }
    write_json(folder, TASK, task)
}

// Termination of computations that overrun their time limit.

/// Grace period after the time limit for a computation to end with its current map: this share of the limit, but at
/// least `LEAST_GRACE`. A longer period lets a hanging computation occupy its slot; a shorter one discards valid
/// maps. `tests/bench/ends.rs` measures how long an early end takes.
const GRACE_SHARE: f64 = 0.25;
const LEAST_GRACE: Duration = Duration::from_secs(10);

/// Returns the time after which a computation with a time limit is terminated.
pub(super) fn given_up_after(limit: Duration) -> Duration {
    limit + limit.mul_f64(GRACE_SHARE).max(LEAST_GRACE)
}

/// Returns the failure of a computation that was terminated.
pub(super) fn timed_out(limit: Duration) -> Failure {
    let seconds = limit.as_secs_f64();
    let detail = format!("no valid map within the time limit of {seconds} s");
    Failure::new("timed_out", detail)
}

// Failures of computations that run out of memory.

/// Returns the failure of a job that exceeds its memory limit of `limit` bytes.
pub(super) fn out_of_memory(limit: u64) -> Failure {
    let detail = format!(
        "needs more than {} MiB, the memory limit of a job",
        limit >> 20
    );
    Failure::new("out_of_memory", detail)
}

/// Returns the failure of a job that the system killed because the container or machine ran out of memory.
pub(super) fn killed_for_memory() -> Failure {
    let detail = "the system ended it because the memory of the container or machine was used up";
    Failure::new("out_of_memory", detail)
}

// Detection of out-of-memory kills in this container.

/// Counter of each cgroup version: marker in `/proc/self/cgroup`, mount point, file name.
const COUNTERS: [(&str, &str, &str); 2] = [
    ("0::", "/sys/fs/cgroup", "memory.events"),
    ("memory", "/sys/fs/cgroup/memory", "memory.oom_control"),
];

/// Number of processes that the system killed for lack of memory in the cgroups of this process, which include its
/// compute children.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Kills(u64);

impl Kills {
    /// Returns the count so far; 0 if the system does not count.
    pub fn so_far() -> Self {
        let groups = std::fs::read_to_string("/proc/self/cgroup").unwrap_or_default();
        let counters = counters(&groups).into_iter();
        let texts = counters.filter_map(|path| std::fs::read_to_string(path).ok());
        Self(texts.filter_map(|text| count(&text)).sum())
    }

    /// Returns whether the count has grown since.
    pub fn is_one_more(&self) -> bool {
        self.0 < Self::so_far().0
    }
}

/// Returns the counter files listed by the text of `/proc/self/cgroup`: version 2 has one line `0::PATH`, version 1
/// one line `N:CONTROLLERS:PATH` per controller. Within a container, the path may be that of the host, and the files
/// lie at the top.
fn counters(groups: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for line in groups.lines() {
        for (mark, root, file) in COUNTERS {
            let mut fields = line.splitn(3, ':').skip(1);
            let (Some(controllers), Some(path)) = (fields.next(), fields.next()) else {
                continue;
            };
            let is_meant = line.starts_with(mark) || controllers.split(',').any(|it| it == mark);
            if is_meant {
                let own = PathBuf::from(format!("{root}{path}")).join(file);
                let top = PathBuf::from(root).join(file);
                found.push(if own.exists() { own } else { top });
            }
        }
    }
    found
}

/// Returns the count in the line `oom_kill N`, which both versions have.
fn count(text: &str) -> Option<u64> {
    let mut lines = text.lines();
    lines.find_map(|line| line.strip_prefix("oom_kill ")?.trim().parse().ok())
}
