//! Processes of the service.

use std::ffi::OsStr;
use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, ChildStdout, Command, Stdio};

use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;
use tempfile::TempDir;

use super::{children, clock};

/// Address of a server that chooses its port.
const ANY_PORT: &str = "127.0.0.1:0";

/// What a process does.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// Answers requests, and works unless it is told not to.
    Serve,
    /// Only works.
    Worker,
}

/// A running process with a folder of its own; it ends and its folder goes when this is dropped.
pub struct Process {
    role: Role,
    command: Command,
    running: Child,
    /// Kept open: a server that cannot print ends.
    stdout: Option<BufReader<ChildStdout>>,
    address: String,
    folder: TempDir,
}

impl Process {
    /// Starts one on a folder with these environment variables.
    pub fn start(role: Role, folder: TempDir, settings: &[(String, String)]) -> Self {
        Self::of(&super::program(), role, folder, settings, None)
    }

    /// The same by this program, which tells what it does to a file instead of the reader of the
    /// test, if there is one.
    pub fn of(
        program: &Path,
        role: Role,
        folder: TempDir,
        settings: &[(String, String)],
        log: Option<File>,
    ) -> Self {
        let mut command = command(program, role, folder.path(), settings);
        if let Some(log) = log {
            command.stderr(log);
        }
        let (running, stdout, address) = spawn(role, &mut command);
        Self {
            role,
            command,
            running,
            stdout,
            address,
            folder,
        }
    }

    /// Where it answers, as `HOST:PORT`.
    pub fn address(&self) -> &str {
        &self.address
    }

    pub fn folder(&self) -> &Path {
        self.folder.path()
    }

    pub fn id(&self) -> u32 {
        self.running.id()
    }

    pub fn signal(&self, signal: Signal) {
        kill(Pid::from_raw(self.running.id() as i32), signal).expect("it is ours");
    }

    /// Ends it without warning, as a power cut would.
    pub fn kill(&mut self) {
        self.running.kill().expect("it is ours");
        self.running.wait().expect("it is ours");
        clock::forget(self.running.id());
    }

    /// Waits until it has stopped, after it was told to.
    pub fn stopped(&mut self) {
        assert!(self.running.wait().expect("it is ours").success());
    }

    /// Starts it again on the same folder.
    pub fn restart(&mut self) {
        (self.running, self.stdout, self.address) = spawn(self.role, &mut self.command);
    }

    /// Starts it again on the same folder and at the same address, where its clients look for it.
    pub fn restart_in_place(&mut self) {
        let mut command = Command::new(self.command.get_program());
        for argument in self.command.get_args() {
            command.arg(if argument == ANY_PORT {
                OsStr::new(&self.address)
            } else {
                argument
            });
        }
        for (name, value) in self.command.get_envs() {
            command.env(name, value.expect("none is removed"));
        }
        self.command = command;
        self.restart();
    }

    /// Starts another program in its place.
    pub fn restart_as(&mut self, program: &Path) {
        let mut command = Command::new(program);
        command.args(self.command.get_args());
        for (name, value) in self.command.get_envs() {
            command.env(name, value.expect("none is removed"));
        }
        self.command = command;
        self.restart();
    }

    /// Starts it again on the same folder, with other environment variables.
    pub fn restart_with(&mut self, settings: &[(String, String)]) {
        let program = super::program();
        self.command = command(&program, self.role, self.folder.path(), settings);
        self.restart();
    }

    /// Process ids of its compute children.
    pub fn children(&self) -> Vec<i32> {
        children::within(self.folder.path())
    }

    /// What its attempts and uploads left.
    pub fn scratch(&self) -> Vec<String> {
        let entries = std::fs::read_dir(self.folder.path().join("scratch"));
        let names = entries.into_iter().flatten().flatten();
        names
            .map(|entry| entry.file_name().to_string_lossy().into_owned())
            .collect()
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        let _ = self.running.kill();
        let _ = self.running.wait();
        clock::forget(self.running.id());
    }
}

fn command(program: &Path, role: Role, folder: &Path, settings: &[(String, String)]) -> Command {
    let mut command = Command::new(program);
    match role {
        Role::Serve => command.args(["serve", "--listen", ANY_PORT]),
        Role::Worker => command.args(["worker", "--workers", "1"]),
    };
    command
        .arg("--data")
        .arg(folder)
        // Tests that count slots mean all of them.
        .env("UNWRAPD_SMALL_KIB", "0")
        .envs(settings.iter().cloned());
    command
}

/// A process and, of a server, its output and its address.
fn spawn(role: Role, command: &mut Command) -> (Child, Option<BufReader<ChildStdout>>, String) {
    if role == Role::Worker {
        let process = command.stdout(Stdio::null()).spawn();
        return (process.expect("the worker starts"), None, String::new());
    }
    let process = command.stdout(Stdio::piped()).spawn();
    let mut process = process.expect("the server starts");
    let mut stdout = BufReader::new(process.stdout.take().expect("piped"));
    let mut line = String::new();
    stdout.read_line(&mut line).expect("its address");
    let address = line.trim().strip_prefix("listening on http://");
    let address = address.expect("its address").to_owned();
    (process, Some(stdout), address)
}
