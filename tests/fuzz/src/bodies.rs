//! Multipart bodies with boundary `x`, sent to a whole service in this process. No job gets beyond its queue, which takes none.
#![no_main]

use std::io::{BufRead, BufReader, Read, Write};
use std::net::{SocketAddr, TcpStream};
use std::path::PathBuf;
use std::sync::{Arc, LazyLock};
use std::time::Duration;

use libfuzzer_sys::fuzz_target;
use tokio::net::TcpListener;
use tokio_util::sync::CancellationToken;
use unwrapd::http::{self, Connections, Exposition};
use unwrapd::jobs::access::KeyRing;
use unwrapd::jobs::{self, Deployment, Jobs, OwnerQuotas, Rules};
use unwrapd::sessions::{self, Sessions};
use unwrapd::store::{FileBlobs, RecordStore};

/// Far beyond what a body of some kilobytes takes.
const LONG: Duration = Duration::from_secs(60);

static SERVICE: LazyLock<SocketAddr> = LazyLock::new(|| {
    let runtime = tokio::runtime::Runtime::new().expect("a runtime");
    let address = runtime.block_on(served());
    std::mem::forget(runtime);
    address
});

/// Starts a service that takes in no job.
async fn served() -> SocketAddr {
    let data = tempfile::tempdir().expect("a folder").keep();
    let settings = jobs::Settings {
        deployment: Deployment::Embedded,
        rules: Rules::default(),
        scratch: data.join("scratch"),
        program: PathBuf::from("/bin/false").into(),
        catalog: &unwrapd_worker::Computations,
        workers: 0,
        cores: 1,
        owner_running: None,
        small: None,
        queue_depth: 0,
        time: LONG,
        memory: 1 << 30,
        triangles: 1_000_000,
        quota: None,
        of_owner: OwnerQuotas::default(),
        min_free: 0,
        retention: None,
        quarantine: Duration::ZERO,
        grace: Duration::ZERO,
    };
    let url = format!("sqlite:{}?mode=rwc", data.join("records").display());
    let store = RecordStore::open(&url, settings.rules).await;
    let store = Arc::new(store.expect("records"));
    let blobs = Arc::new(FileBlobs::open(&data.join("blobs")).expect("files"));
    let jobs = Arc::new(Jobs::new(settings.clone(), Arc::clone(&store) as _, blobs));
    jobs.recover().await.expect("an empty queue");
    let sessions = sessions::Settings {
        most: 1,
        most_of_owner: None,
        idle: LONG,
    };
    let sessions = Arc::new(Sessions::new(sessions, settings));
    let exposition = Exposition::new(
        http::measure().expect("measured"),
        Arc::clone(&jobs),
        Some(Arc::clone(&sessions)),
    );
    let listener = TcpListener::bind("127.0.0.1:0").await.expect("a port");
    let address = listener.local_addr().expect("an address");
    let settings = http::Settings {
        upload_bytes: 1 << 20,
        synchronous_time: LONG,
        connections: Connections {
            most: 16,
            most_of_address: None,
            header_time: LONG,
            silence: LONG,
        },
        upload_time: LONG,
        upload_rate: 0,
        owner_requests: None,
        wrong_keys: 1,
        origins: Vec::new(),
        hosts: None,
        webhooks: None,
        base_path: String::new(),
    };
    let parts = (jobs, sessions, Arc::new(KeyRing::new(store)));
    let stop = CancellationToken::new();
    tokio::spawn(http::serve(listener, parts, exposition, settings, stop));
    address
}

/// The status of the answer to a form.
fn status(body: &[u8]) -> std::io::Result<u16> {
    let mut stream = TcpStream::connect(*SERVICE)?;
    write!(
        stream,
        "POST /v1/jobs HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\nContent-Length: {}\r\n\
         Content-Type: multipart/form-data; boundary=x\r\n\r\n",
        body.len()
    )?;
    stream.write_all(body)?;
    let mut answer = BufReader::new(stream);
    let mut line = String::new();
    answer.read_line(&mut line)?;
    answer.read_to_end(&mut Vec::new())?;
    let code = line.split(' ').nth(1).and_then(|code| code.parse().ok());
    code.ok_or_else(|| std::io::Error::other(line))
}

fuzz_target!(|body: &[u8]| {
    let status = status(body).expect("an answer");
    // `queue_full` is the best that can come of it.
    assert!(status < 500 || status == 503, "{status}");
});
