//! A PostgreSQL of a test's own.

use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;
use tempfile::TempDir;

use super::ports::free_port;
use super::{SOON, children, clock};

/// Between two looks at whether something happened.
const PAUSE: Duration = Duration::from_millis(50);

/// A running cluster in a folder of its own, reached over a port of this machine. It ends when this
/// is dropped.
pub struct Postgres {
    folder: TempDir,
    port: u16,
    settings: Vec<(String, String)>,
    process: Child,
}

impl Postgres {
    pub fn start() -> Self {
        Self::with(Vec::new())
    }

    /// Starts one with these environment variables.
    pub fn with(settings: Vec<(String, String)>) -> Self {
        let folder = tempfile::tempdir().expect("a folder");
        own(folder.path());
        let made = program("initdb", &[])
            .args(["--auth=trust", "--username=unwrapd", "--no-sync"])
            .args(["--encoding=UTF8", "--locale=C.UTF-8", "-D"])
            .arg(folder.path().join("data"))
            .output()
            .expect("PostgreSQL is installed");
        assert!(made.status.success(), "{made:?}");
        let port = free_port();
        let process = spawn(folder.path(), port, &settings);
        let mut postgres = Self {
            folder,
            port,
            settings,
            process,
        };
        postgres.wait();
        postgres
    }

    pub fn port(&self) -> u16 {
        self.port
    }

    /// A fresh database of this name: its URL.
    pub fn database(&self, name: &str) -> String {
        self.psql("postgres", &format!("CREATE DATABASE {name}"));
        format!("postgres://unwrapd@127.0.0.1:{}/{name}", self.port)
    }

    /// What a statement answers, one row a line, columns separated by bars.
    pub fn psql(&self, database: &str, statement: &str) -> String {
        let answer = self.run_psql(database, statement);
        assert!(answer.status.success(), "{answer:?}");
        String::from_utf8(answer.stdout).expect("text")
    }

    fn run_psql(&self, database: &str, statement: &str) -> std::process::Output {
        Command::new("psql")
            .args([
                "-h",
                "127.0.0.1",
                "-U",
                "unwrapd",
                "-AtX",
                "-v",
                "ON_ERROR_STOP=1",
            ])
            .args([
                "-p",
                &self.port.to_string(),
                "-d",
                database,
                "-c",
                statement,
            ])
            .output()
            .expect("psql is installed")
    }

    /// Sends a signal to all its processes.
    pub fn signal(&self, signal: Signal) {
        let children = children::of(self.process.id());
        for process in children.into_iter().chain([self.process.id() as i32]) {
            // It may have ended.
            let _ = kill(Pid::from_raw(process), signal);
        }
    }

    /// Ends it without warning, with all its processes, as a power cut would.
    pub fn kill(&mut self) {
        let children = children::of(self.process.id());
        self.process.kill().expect("it is ours");
        self.process.wait().expect("it is ours");
        clock::forget(self.process.id());
        for &child in &children {
            // It may have noticed.
            let _ = kill(Pid::from_raw(child), Signal::SIGKILL);
        }
        let start = Instant::now();
        while children.iter().any(|child| children::is_alive(*child)) {
            assert!(start.elapsed() < SOON, "PostgreSQL does not end");
            std::thread::sleep(PAUSE);
        }
    }

    /// Starts it again on the same data.
    pub fn restart(&mut self) {
        self.process = spawn(self.folder.path(), self.port, &self.settings);
        self.wait();
    }

    fn wait(&mut self) {
        let start = Instant::now();
        while !self.run_psql("postgres", "SELECT 1").status.success() {
            let log = || std::fs::read_to_string(self.folder.path().join("log"));
            assert!(
                start.elapsed() < SOON,
                "PostgreSQL does not start: {:?}",
                log()
            );
            // A process of a killed one may not have noticed yet.
            if self.process.try_wait().expect("it is ours").is_some() {
                self.process = spawn(self.folder.path(), self.port, &self.settings);
            }
            std::thread::sleep(PAUSE);
        }
    }
}

impl Drop for Postgres {
    fn drop(&mut self) {
        // An immediate shutdown: the processes of its connections go, too.
        let _ = kill(Pid::from_raw(self.process.id() as i32), Signal::SIGQUIT);
        let _ = self.process.wait();
        clock::forget(self.process.id());
    }
}

fn spawn(folder: &Path, port: u16, settings: &[(String, String)]) -> Child {
    let log = std::fs::File::create(folder.join("log")).expect("a file");
    program("postgres", settings)
        .arg("-D")
        .arg(folder.join("data"))
        .args(["-p", &port.to_string(), "-h", "127.0.0.1", "-k"])
        .arg(folder)
        .args([
            "-c",
            "max_connections=100",
            "-c",
            "shared_buffers=16MB",
            "-c",
            "fsync=off",
        ])
        .stdout(Stdio::null())
        .stderr(log)
        .spawn()
        .expect("PostgreSQL is installed")
}

/// A program of PostgreSQL with these environment variables, as a user that is not root: it refuses
/// that one.
fn program(name: &str, settings: &[(String, String)]) -> Command {
    let path = binaries().join(name);
    if !is_root() {
        let mut command = Command::new(path);
        command.envs(settings.iter().cloned());
        return command;
    }
    let mut command = Command::new("setpriv");
    command
        .args([
            "--reuid=postgres",
            "--regid=postgres",
            "--clear-groups",
            "--pdeathsig=KILL",
            "env",
        ])
        .args(
            settings
                .iter()
                .map(|(name, value)| format!("{name}={value}")),
        )
        .arg(path);
    command
}

fn is_root() -> bool {
    use std::os::unix::fs::MetadataExt;
    std::fs::metadata("/proc/self").expect("/proc").uid() == 0
}

fn own(folder: &Path) {
    if is_root() {
        let owned = Command::new("chown").arg("postgres").arg(folder).status();
        assert!(owned.expect("it runs").success());
    }
}

/// Debian keeps them apart by version.
fn binaries() -> PathBuf {
    let versions = std::fs::read_dir("/usr/lib/postgresql").expect("PostgreSQL is installed");
    let mut versions: Vec<PathBuf> = versions.flatten().map(|entry| entry.path()).collect();
    versions.sort();
    versions.pop().expect("PostgreSQL is installed").join("bin")
}
