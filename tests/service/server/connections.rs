//! Clients that are silent, slow, or many.

use std::net::{Ipv4Addr, SocketAddr};
use std::time::{Duration, Instant};

use serde_json::Value;
use tokio::io::{AsyncReadExt, AsyncWriteExt};
use tokio::net::{TcpSocket, TcpStream};

use crate::cli::assert_status;
use crate::harness::program;
use crate::meshes;
use crate::server::keys;
use crate::server::watchable::{metrics, value};
use crate::server::{SOON, Server};

/// A connection that has sent so much.
async fn connected(server: &Server, sent: &str) -> TcpStream {
    connected_from(Ipv4Addr::LOCALHOST, server, sent).await
}

async fn connected_from(source: Ipv4Addr, server: &Server, sent: &str) -> TcpStream {
    let address = server.url("").replace("http://", "");
    let socket = TcpSocket::new_v4().expect("a socket");
    let bound = socket.bind(SocketAddr::from((source, 0)));
    bound.expect("an address of this machine");
    let connected = socket.connect(address.parse().expect("an address"));
    let mut stream = connected.await.expect("a connection");
    let written = stream.write_all(sent.as_bytes()).await;
    written.expect("it takes what is sent");
    stream
}

/// What comes until the service closes the connection.
async fn answer(mut stream: TcpStream) -> String {
    let mut answer = Vec::new();
    let read = tokio::time::timeout(SOON, stream.read_to_end(&mut answer)).await;
    read.expect("it is closed soon").expect("it can be read");
    String::from_utf8(answer).expect("text")
}

/// Headers of an upload whose body has a length.
fn upload(length: u64, more: &str) -> String {
    format!(
        "POST /v1/jobs HTTP/1.1\r\nHost: localhost\r\nContent-Length: {length}\r\n\
         Content-Type: application/octet-stream\r\n{more}\r\n"
    )
}

/// RFC 9112, 3.2: two names are no name, and what is behind one is a port.
#[tokio::test]
async fn a_request_names_one_host() {
    let server = Server::start();
    for hosts in [
        "Host: localhost\r\nHost: localhost",
        "Host: localhost\r\nHost: evil.com",
        "Host: 127.0.0.1:18083.evil.com",
        "Host: user@localhost",
    ] {
        let sent = format!("GET /healthz HTTP/1.1\r\n{hosts}\r\nConnection: close\r\n\r\n");
        let answered = answer(connected(&server, &sent).await).await;
        assert!(answered.starts_with("HTTP/1.1 400"), "{hosts}: {answered}");
        assert!(answered.contains("invalid_request"), "{hosts}: {answered}");
    }
    for host in [
        "localhost",
        "127.0.0.1:18083",
        "[::1]:80",
        "[::1]",
        "localhost:",
    ] {
        let sent = format!("GET /healthz HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\n\r\n");
        let answered = answer(connected(&server, &sent).await).await;
        assert!(answered.starts_with("HTTP/1.1 200"), "{host}: {answered}");
    }
}

/// Who has no key learns that before the body is sent, and at once.
#[tokio::test]
async fn an_upload_without_a_key_is_refused_at_once() {
    let server = keys::closed();
    let mut stream = connected(&server, &upload(100_000_000, "")).await;
    let start = Instant::now();
    let mut answered = vec![0; 64];
    let read = tokio::time::timeout(SOON, stream.read(&mut answered)).await;
    let count = read.expect("soon").expect("it can be read");
    let answered = String::from_utf8_lossy(&answered[..count]).into_owned();
    assert!(answered.starts_with("HTTP/1.1 401"), "{answered}");
    assert!(
        start.elapsed() < Duration::from_secs(3),
        "{:?}",
        start.elapsed()
    );
    // The rest of the body is read meanwhile: the connection is not reset.
    stream
        .write_all(&vec![0; 1 << 16])
        .await
        .expect("it takes more");
}

#[tokio::test]
async fn who_is_silent_loses_the_connection() {
    let server = Server::with(&[
        ("UNWRAPD_HEADER_SECONDS", "0.3"),
        ("UNWRAPD_SILENCE_SECONDS", "0.3"),
    ]);
    for sent in ["", "GET /healthz HTTP/1.1\r\nHost: loc"] {
        assert_eq!(answer(connected(&server, sent).await).await, "");
    }
    let kept = "GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n";
    let answered = answer(connected(&server, kept).await).await;
    assert!(answered.starts_with("HTTP/1.1 200") && answered.ends_with("ok\n"));
    let stalled = answer(connected(&server, &(upload(100, "") + "solid")).await).await;
    assert!(stalled.starts_with("HTTP/1.1 408"), "{stalled}");
    assert!(stalled.contains("request_timeout"), "{stalled}");
}

/// A byte now and then is no silence, and still holds a connection and two files.
#[tokio::test]
async fn a_body_that_drips_ends() {
    let server = Server::with(&[
        ("UNWRAPD_SILENCE_SECONDS", "0.3"),
        ("UNWRAPD_UPLOAD_RATE", "1000"),
    ]);
    let stream = connected(&server, &upload(100_000, "")).await;
    let (mut reader, mut writer) = stream.into_split();
    let drip = tokio::spawn(async move {
        while writer.write_all(b"#").await.is_ok() {
            tokio::time::sleep(Duration::from_millis(20)).await;
        }
    });
    let mut answer = [0; 4096];
    let read = tokio::time::timeout(SOON, reader.read(&mut answer)).await;
    let length = read.expect("it is answered soon").expect("an answer");
    let answer = String::from_utf8_lossy(&answer[..length]);
    assert!(answer.starts_with("HTTP/1.1 408"), "{answer}");
    assert!(answer.contains("request_timeout") && answer.contains("1000 bytes a second"));
    drip.abort();

    // One that comes in small pieces, but fast enough, is taken.
    let steady = connected(&server, &upload(2_000, "")).await;
    let (mut reader, mut writer) = steady.into_split();
    for _ in 0..20 {
        writer.write_all(&[b'#'; 100]).await.expect("it is taken");
        tokio::time::sleep(Duration::from_millis(25)).await;
    }
    let mut head = [0; 12];
    let read = tokio::time::timeout(SOON, reader.read_exact(&mut head)).await;
    read.expect("it is answered soon").expect("an answer");
    assert_eq!(&head, b"HTTP/1.1 422");
}

#[tokio::test]
async fn an_upload_that_trickles_ends() {
    let server = Server::with(&[("UNWRAPD_UPLOAD_SECONDS", "0.5")]);
    let stream = connected(&server, &upload(1000, "")).await;
    let (mut reader, mut writer) = stream.into_split();
    let trickle = tokio::spawn(async move {
        while writer.write_all(b"#").await.is_ok() {
            tokio::time::sleep(Duration::from_millis(20)).await;
        }
    });
    let mut head = [0; 12];
    let read = tokio::time::timeout(SOON, reader.read_exact(&mut head)).await;
    read.expect("it is answered soon").expect("an answer");
    assert_eq!(&head, b"HTTP/1.1 408");
    trickle.abort();
}

#[tokio::test]
async fn an_upload_that_is_announced_as_too_large_is_refused_before_it_is_sent() {
    let server = Server::with(&[("UNWRAPD_HEADER_SECONDS", "0.3")]);
    let asked = upload(9_999_999_999, "Expect: 100-continue\r\n");
    let refused = answer(connected(&server, &asked).await).await;
    assert!(refused.starts_with("HTTP/1.1 413"), "{refused}");
    assert!(refused.contains("upload_too_large"), "{refused}");
    let small = upload(5, "Expect: 100-continue\r\nConnection: close\r\n");
    let mut stream = connected(&server, &small).await;
    let mut head = [0; 12];
    stream.read_exact(&mut head).await.expect("an answer");
    assert_eq!(&head, b"HTTP/1.1 100");
    stream.write_all(b"solid").await.expect("it takes the body");
    assert!(answer(stream).await.contains("HTTP/1.1 422"));
}

#[tokio::test]
async fn an_address_has_no_more_connections_than_it_may() {
    let server = Server::with(&[("UNWRAPD_MAX_ADDRESS_CONNECTIONS", "2")]);
    let request = "GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n";
    let mut first = connected(&server, request).await;
    let second = connected(&server, request).await;
    let mut head = [0; 12];
    first.read_exact(&mut head).await.expect("an answer");
    assert_eq!(&head, b"HTTP/1.1 200");
    let third = answer(connected(&server, request).await).await;
    assert!(third.starts_with("HTTP/1.1 429"), "{third}");
    assert!(third.contains("too_many_connections") && third.contains("retry-after"));
    drop((first, second));
    let start = Instant::now();
    let closing = "GET /healthz HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n";
    while !answer(connected(&server, closing).await)
        .await
        .starts_with("HTTP/1.1 200")
    {
        assert!(start.elapsed() < SOON, "their places are not free");
    }
}

#[tokio::test]
async fn who_is_refused_keeps_nobody_waiting() {
    let server = Server::with(&[
        ("UNWRAPD_MAX_CONNECTIONS", "4"),
        ("UNWRAPD_MAX_ADDRESS_CONNECTIONS", "2"),
    ]);
    let mut others = Vec::new();
    for _ in 0..200 {
        others.push(connected_from(Ipv4Addr::new(127, 0, 0, 2), &server, "").await);
    }
    let asked = "GET /healthz HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n";
    let answered = answer(connected(&server, asked).await).await;
    assert!(answered.starts_with("HTTP/1.1 200"), "{answered}");
    // Two that may stay, ours, and the last of those that are refused.
    let open = value(&metrics(&server).await, "unwrapd_connections");
    assert!(open.is_some_and(|open| open < 40.0), "{open:?}");
}

#[tokio::test]
async fn silent_connections_keep_nobody_out() {
    let server = Server::with(&[
        ("UNWRAPD_MAX_CONNECTIONS", "8"),
        ("UNWRAPD_HEADER_SECONDS", "0.3"),
    ]);
    let mut silent = Vec::new();
    for _ in 0..20 {
        silent.push(connected(&server, "POST /v1/jobs HTTP/1.1\r\n").await);
    }
    let job = server.submit(meshes::small(), "").await;
    assert_eq!(server.ended(&job).await["state"], "succeeded");
}

#[test]
fn connections_leave_half_of_the_open_files_to_uploads() {
    for (files, connections) in [(1024, "384"), (256, "64"), (20_000, "4096")] {
        let config = "ulimit -n \"$2\" && exec \"$1\" config --json";
        let output = std::process::Command::new("sh")
            .args(["-c", config, "sh"])
            .arg(program())
            .arg(files.to_string())
            .output()
            .expect("a shell");
        assert_status(&output, 0);
        let rows: Vec<Value> = serde_json::from_slice(&output.stdout).expect("JSON");
        let mut rows = rows.iter();
        let row = rows.find(|row| row["option"] == "--max-connections");
        assert_eq!(row.expect("a row")["value"], connections, "{files}");
    }
}
