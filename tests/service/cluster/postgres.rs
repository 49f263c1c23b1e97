//! A PostgreSQL of a test's own.

use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::Instant;

use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;
use tempfile::TempDir;

use crate::server::SOON;

/// A running cluster in a folder of its own, reached over a port of this machine. It ends when this
/// is dropped.
pub struct Postgres {
    folder: TempDir,
    port: u16,
    process: Child,
}

impl Postgres {
    pub fn start() -> Self {
        let folder = tempfile::tempdir().expect("a folder");
        own(folder.path());
        let made = program("initdb")
            .args(["--auth=trust", "--username=unwrapd", "--no-sync"])
            .args(["--encoding=UTF8", "--locale=C.UTF-8", "-D"])
            .arg(folder.path().join("data"))
            .output()
            .expect("PostgreSQL is installed");
        assert!(made.status.success(), "{made:?}");
        let port = free_port();
        let process = spawn(folder.path(), port);
        let postgres = Self {
            folder,
            port,
            process,
        };
        postgres.wait();
        postgres
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

    /// Ends it without warning, with all its processes, as a power cut would.
    pub fn kill(&mut self) {
        self.process.kill().expect("it is ours");
        self.process.wait().expect("it is ours");
    }

    /// Starts it again on the same data.
    pub fn restart(&mut self) {
        self.process = spawn(self.folder.path(), self.port);
        self.wait();
    }

    fn wait(&self) {
        let start = Instant::now();
        while !self.run_psql("postgres", "SELECT 1").status.success() {
            assert!(start.elapsed() < SOON, "PostgreSQL does not start");
            std::thread::sleep(std::time::Duration::from_millis(50));
        }
    }
}

impl Drop for Postgres {
    fn drop(&mut self) {
        // An immediate shutdown: the processes of its connections go, too.
        let _ = kill(Pid::from_raw(self.process.id() as i32), Signal::SIGQUIT);
        let _ = self.process.wait();
    }
}

/// A port that is free now, for a process that cannot choose one and tell.
pub fn free_port() -> u16 {
    let listener = std::net::TcpListener::bind("127.0.0.1:0").expect("a port");
    listener.local_addr().expect("an address").port()
}

fn spawn(folder: &Path, port: u16) -> Child {
    let log = std::fs::File::create(folder.join("log")).expect("a file");
    program("postgres")
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

/// A program of PostgreSQL, as a user that is not root: it refuses that one.
fn program(name: &str) -> Command {
    let path = binaries().join(name);
    if !is_root() {
        return Command::new(path);
    }
    let mut command = Command::new("setpriv");
    command
        .args([
            "--reuid=postgres",
            "--regid=postgres",
            "--clear-groups",
            "--pdeathsig=KILL",
        ])
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
