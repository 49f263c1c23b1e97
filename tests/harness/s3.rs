//! An S3 server of a test's own, as a process of its own: this binary, started again.

use std::net::TcpStream;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::Instant;

use hyper_util::rt::{TokioExecutor, TokioIo};
use hyper_util::server::conn::auto::Builder;
use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;
use s3s::auth::SimpleAuth;
use s3s::service::S3ServiceBuilder;
use s3s_fs::FileSystem;
use tempfile::TempDir;
use tokio::net::TcpListener;

use super::ports::free_port;
use super::{SOON, clock};

const BUCKET: &str = "meshes";
pub const URL: &str = "s3://meshes/jobs";
const KEY: &str = "key";
const SECRET: &str = "secret";
/// Objects of the service itself.
const OWN: [&str; 2] = ["store-id", "probe"];
/// Where the process finds its folder and its port.
const FOLDER: &str = "UNWRAPD_TEST_S3_FOLDER";
const PORT: &str = "UNWRAPD_TEST_S3_PORT";

/// A running server with one bucket. It ends when this is dropped.
pub struct S3 {
    folder: TempDir,
    port: u16,
    process: Child,
}

impl S3 {
    pub fn start() -> Self {
        Self::on(tempfile::tempdir().expect("a folder"), &[])
    }

    /// Starts one on an empty folder with these environment variables.
    pub fn on(folder: TempDir, settings: &[(String, String)]) -> Self {
        std::fs::create_dir(folder.path().join(BUCKET)).expect("a bucket");
        let port = free_port();
        let process = spawn(folder.path(), port, settings);
        let mut server = Self {
            folder,
            port,
            process,
        };
        server.wait();
        server
    }

    pub fn port(&self) -> u16 {
        self.port
    }

    /// What the service is told of it.
    pub fn settings(&self) -> Vec<(String, String)> {
        let settings = [
            ("UNWRAPD_BLOBS_URL", URL.to_owned()),
            (
                "AWS_ENDPOINT_URL",
                format!("http://127.0.0.1:{}", self.port),
            ),
            ("AWS_ALLOW_HTTP", "true".to_owned()),
            ("AWS_REGION", "us-east-1".to_owned()),
            ("AWS_ACCESS_KEY_ID", KEY.to_owned()),
            ("AWS_SECRET_ACCESS_KEY", SECRET.to_owned()),
        ];
        settings
            .map(|(name, value)| (name.to_owned(), value))
            .into()
    }

    /// Where the server keeps the files below the prefix of the service.
    pub fn root(&self) -> PathBuf {
        self.folder.path().join(BUCKET).join("jobs")
    }

    /// The files of jobs below the prefix of the service, by their keys.
    pub fn objects(&self) -> Vec<String> {
        let root = self.root();
        let mut found = Vec::new();
        let mut folders = vec![root.clone()];
        while let Some(folder) = folders.pop() {
            // A folder may be gone by now, or not be there yet.
            for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
                let path = entry.path();
                if path.is_dir() {
                    folders.push(path);
                } else {
                    let key = path.strip_prefix(&root).expect("below it");
                    found.push(key.to_string_lossy().into_owned());
                }
            }
        }
        found.retain(|key| !OWN.contains(&&**key));
        found.sort();
        found
    }

    pub fn signal(&self, signal: Signal) {
        kill(Pid::from_raw(self.process.id() as i32), signal).expect("it is ours");
    }

    /// Ends it without warning.
    pub fn kill(&mut self) {
        self.process.kill().expect("it is ours");
        self.process.wait().expect("it is ours");
        clock::forget(self.process.id());
    }

    /// Starts it again on the same files.
    pub fn restart(&mut self) {
        self.restart_with(&[]);
    }

    /// Starts it again on the same files with these environment variables.
    pub fn restart_with(&mut self, settings: &[(String, String)]) {
        self.process = spawn(self.folder.path(), self.port, settings);
        self.wait();
    }

    fn wait(&mut self) {
        let start = Instant::now();
        while TcpStream::connect(("127.0.0.1", self.port)).is_err() {
            let ended = self.process.try_wait().expect("it is ours");
            assert!(ended.is_none(), "the S3 server ended: {ended:?}");
            assert!(start.elapsed() < SOON, "the S3 server does not start");
            std::thread::sleep(std::time::Duration::from_millis(20));
        }
    }
}

impl Drop for S3 {
    fn drop(&mut self) {
        let _ = self.process.kill();
        let _ = self.process.wait();
        clock::forget(self.process.id());
    }
}

/// This binary, which calls [`serve_if_asked`] in the test of this name or at once.
fn spawn(folder: &Path, port: u16, settings: &[(String, String)]) -> Child {
    Command::new(std::env::current_exe().expect("this binary"))
        .args([
            "--exact",
            "cluster::s3::files_come_back_from_a_server_of_its_own",
        ])
        .env(FOLDER, folder)
        .env(PORT, port.to_string())
        .envs(settings.iter().cloned())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("this binary runs")
}

/// Serves for ever, if this process was started to be the server.
pub async fn serve_if_asked() {
    if let (Ok(folder), Ok(port)) = (std::env::var(FOLDER), std::env::var(PORT)) {
        serve(&folder, &port).await;
    }
}

/// Serves the files of a folder for ever.
async fn serve(folder: &str, port: &str) -> ! {
    let mut service = S3ServiceBuilder::new(FileSystem::new(folder).expect("a folder"));
    service.set_auth(SimpleAuth::from_single(KEY, SECRET));
    let service = service.build();
    let port: u16 = port.parse().expect("a port");
    let listener = TcpListener::bind(("127.0.0.1", port)).await;
    let listener = listener.expect("the port is free");
    let server = Builder::new(TokioExecutor::new());
    loop {
        let (socket, _) = listener.accept().await.expect("a connection");
        let connection = server.serve_connection(TokioIo::new(socket), service.clone());
        tokio::spawn(connection.into_owned());
    }
}
