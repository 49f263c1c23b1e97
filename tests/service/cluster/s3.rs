//! An S3 server of a test's own, as a process of its own: this test binary, started again.

use std::net::TcpStream;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::Instant;

use futures_util::TryStreamExt;
use hyper_util::rt::{TokioExecutor, TokioIo};
use hyper_util::server::conn::auto::Builder;
use s3s::auth::SimpleAuth;
use s3s::service::S3ServiceBuilder;
use s3s_fs::FileSystem;
use tempfile::TempDir;
use tokio::net::TcpListener;
use unwrapd::jobs::{Blobs, JobId};
use unwrapd::store::ObjectBlobs;

use super::postgres::free_port;
use crate::server::SOON;

const BUCKET: &str = "meshes";
const URL: &str = "s3://meshes/jobs";
const KEY: &str = "key";
const SECRET: &str = "secret";
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
        let folder = tempfile::tempdir().expect("a folder");
        std::fs::create_dir(folder.path().join(BUCKET)).expect("a bucket");
        let port = free_port();
        let process = spawn(folder.path(), port);
        let server = Self {
            folder,
            port,
            process,
        };
        server.wait();
        server
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

    /// The files below the prefix of the service, by their keys.
    pub fn objects(&self) -> Vec<String> {
        let root = self.folder.path().join(BUCKET).join("jobs");
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
        found.sort();
        found
    }

    /// Ends it without warning.
    pub fn kill(&mut self) {
        self.process.kill().expect("it is ours");
        self.process.wait().expect("it is ours");
    }

    /// Starts it again on the same files.
    pub fn restart(&mut self) {
        self.process = spawn(self.folder.path(), self.port);
        self.wait();
    }

    fn wait(&self) {
        let start = Instant::now();
        while TcpStream::connect(("127.0.0.1", self.port)).is_err() {
            assert!(start.elapsed() < SOON, "the S3 server does not start");
            std::thread::sleep(std::time::Duration::from_millis(20));
        }
    }
}

impl Drop for S3 {
    fn drop(&mut self) {
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

fn spawn(folder: &Path, port: u16) -> Child {
    Command::new(std::env::current_exe().expect("this binary"))
        .args([
            "--exact",
            "cluster::s3::files_come_back_from_a_server_of_its_own",
        ])
        .env(FOLDER, folder)
        .env(PORT, port.to_string())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("this binary runs")
}

/// Serves the files of a folder for ever.
async fn serve(folder: &str, port: &str) {
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

/// Without the two variables it is a test, with them the server.
#[tokio::test]
async fn files_come_back_from_a_server_of_its_own() {
    if let (Ok(folder), Ok(port)) = (std::env::var(FOLDER), std::env::var(PORT)) {
        return serve(&folder, &port).await;
    }
    let server = S3::start();
    let blobs = ObjectBlobs::open(URL, server.settings().into_iter()).expect("a bucket");
    let local = tempfile::tempdir().expect("a folder");
    let file = local.path().join("file");
    // Longer than what is sent at once.
    let content: Vec<u8> = (0..12_000_000_u32)
        .map(|n| (n.wrapping_mul(n) / 7) as u8)
        .collect();
    std::fs::write(&file, &content).expect("a file");
    let id = JobId::fresh();
    let (key, folder) = (format!("{id}/input/0"), format!("{id}/input"));
    blobs.put(&key, &file).await.expect("it is stored");
    assert_eq!(server.objects(), std::slice::from_ref(&key));
    assert_eq!(blobs.owners().await.expect("an answer"), [id]);
    let copy = local.path().join("copy");
    blobs.fetch(&key, &copy).await.expect("it is there");
    assert!(std::fs::read(&copy).expect("a file") == content);
    let part = blobs.read(&key, 5_000_000..5_000_007).await;
    let part: Vec<Vec<u8>> = part.expect("it is there").try_collect().await.expect("all");
    assert_eq!(part.concat(), content[5_000_000..5_000_007]);
    let second = format!("{folder}/1");
    blobs.copy(&key, &second).await.expect("it is copied");
    blobs.fetch(&second, &copy).await.expect("it is there");
    assert!(std::fs::read(&copy).expect("a file") == content);
    let missing = format!("{folder}/7");
    assert!(blobs.copy(&missing, &second).await.is_err());
    blobs.check().await.expect("it answers");
    // What begins alike is another folder.
    blobs
        .remove(&folder[..folder.len() - 1])
        .await
        .expect("none");
    assert_eq!(server.objects(), [key.clone(), second]);
    blobs.remove(&folder).await.expect("it is removed");
    assert_eq!(server.objects(), Vec::<String>::new());
    assert!(blobs.fetch(&key, &copy).await.is_err());
    drop(server);
    let down = blobs.check().await.expect_err("nobody answers");
    assert!(down.is_passing(), "{down}");
}
