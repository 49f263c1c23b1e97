//! Ends of jobs, told to others.

use std::io::{Read, Write};
use std::net::TcpListener;
use std::process::Command;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::time::Duration;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use hmac::{Hmac, Mac};
use serde_json::Value;
use sha2::Sha256;
use unwrapd::webhooks::{Secrets, is_public};

use crate::meshes;
use crate::server::{SOON, Server, assert_problem};

/// How long a notice is held by who delivers it.
const LEASE: Duration = Duration::from_mins(1);
const SECRET: &str = "a secret of at least 24 characters";
const SETTINGS: [(&str, &str); 2] = [
    (
        "UNWRAPD_WEBHOOK_SECRET",
        "a-secret-of-at-least-24-characters",
    ),
    ("UNWRAPD_WEBHOOK_ALLOW_PRIVATE", "true"),
];

/// A request as a receiver has it.
#[derive(Debug)]
struct Delivery {
    head: String,
    body: String,
}

impl Delivery {
    fn header(&self, name: &str) -> String {
        let start = format!("{name}: ");
        let line = self
            .head
            .lines()
            .find_map(|line| line.strip_prefix(&*start));
        line.unwrap_or_default().to_owned()
    }

    fn event(&self) -> Value {
        serde_json::from_str(&self.body).expect("JSON")
    }
}

/// Answers with these statuses, then with 204, and tells what came.
fn receiver(statuses: &'static [&'static str]) -> (String, Receiver<Delivery>) {
    let listener = TcpListener::bind("127.0.0.1:0").expect("a port");
    let address = format!(
        "http://{}/hook?token=secret",
        listener.local_addr().expect("it")
    );
    let (sender, deliveries) = channel();
    std::thread::spawn(move || {
        let mut statuses = statuses.iter();
        for stream in listener.incoming() {
            let status = statuses.next().unwrap_or(&"204 No Content");
            if answer(stream.expect("a stream"), status, &sender).is_none() {
                return;
            }
        }
    });
    (address, deliveries)
}

fn answer(mut stream: std::net::TcpStream, status: &str, to: &Sender<Delivery>) -> Option<()> {
    let mut all = Vec::new();
    let mut bytes = [0; 4096];
    loop {
        let count = stream.read(&mut bytes).ok()?;
        all.extend_from_slice(&bytes[..count]);
        let text = String::from_utf8_lossy(&all);
        let Some((head, body)) = text.split_once("\r\n\r\n") else {
            continue;
        };
        let length = head
            .lines()
            .find_map(|line| line.strip_prefix("content-length: "));
        if length.is_some_and(|length| length.parse() == Ok(body.len())) {
            let answer =
                format!("HTTP/1.1 {status}\r\ncontent-length: 0\r\nconnection: close\r\n\r\n");
            stream.write_all(answer.as_bytes()).ok()?;
            let (head, body) = (head.to_owned(), body.to_owned());
            return to.send(Delivery { head, body }).ok();
        }
    }
}

async fn submit(server: &Server, query: &str, webhook: &str) -> Value {
    let webhook =
        percent_encoding::utf8_percent_encode(webhook, percent_encoding::NON_ALPHANUMERIC);
    server
        .submit(meshes::small(), &format!("{query}&webhook={webhook}"))
        .await
}

fn secret_of(owner: &[&str]) -> Vec<u8> {
    let command = [&["webhook-secret"], owner].concat();
    let output = Command::new(env!("CARGO_BIN_EXE_unwrapd"))
        .args(command)
        .env(SETTINGS[0].0, SETTINGS[0].1)
        .output()
        .expect("the binary runs");
    let text = String::from_utf8(output.stdout).expect("text");
    let secret = text.trim().strip_prefix("whsec_").expect("a secret");
    STANDARD.decode(secret).expect("base64")
}

fn assert_signed(delivery: &Delivery, secret: &[u8]) {
    let mut mac = Hmac::<Sha256>::new_from_slice(secret).expect("a key");
    let (id, time) = (
        delivery.header("webhook-id"),
        delivery.header("webhook-timestamp"),
    );
    mac.update(format!("{id}.{time}.{}", delivery.body).as_bytes());
    let expected = format!("v1,{}", STANDARD.encode(mac.finalize().into_bytes()));
    assert_eq!(delivery.header("webhook-signature"), expected);
}

#[tokio::test]
async fn the_end_of_a_job_is_told() {
    let server = Server::with(&SETTINGS);
    let (address, deliveries) = receiver(&["500 Internal Server Error"]);
    let query = "resolution=512&accept=certified&metadata=%7B%22frame%22%3A7%7D";
    let job = submit(&server, query, &address).await;
    assert_eq!(job["webhook"], *address);
    let first = deliveries.recv_timeout(SOON).expect("a delivery");
    let event = first.event();
    assert_eq!(event["type"], "job.succeeded");
    let data = &event["data"];
    assert_eq!((&data["id"], &data["accepted"]), (&job["id"], &true.into()));
    assert_eq!(data["metadata"]["frame"], 7);
    let secret = secret_of(&[]);
    assert_ne!(secret, secret_of(&["--owner", "alice"]));
    assert_signed(&first, &secret);
    // It was not heard: it comes again, under the same name.
    let again = deliveries.recv_timeout(SOON).expect("a delivery");
    assert_eq!(again.header("webhook-id"), first.header("webhook-id"));
    assert_eq!(again.body, first.body);
    assert_signed(&again, &secret);
    let equal = submit(&server, query, &address).await;
    assert_eq!(equal["cached"], true);
    let told = deliveries.recv_timeout(SOON).expect("a delivery").event();
    assert_eq!(told["data"]["id"], equal["id"]);
    // Heard once is enough.
    assert!(deliveries.recv_timeout(Duration::from_secs(7)).is_err());
}

#[tokio::test]
async fn a_notice_survives_a_kill() {
    let mut server = Server::with(&SETTINGS);
    let (address, deliveries) = receiver(&["503 Service Unavailable"]);
    let job = submit(&server, "kind=verify", &address).await;
    let first = deliveries.recv_timeout(SOON).expect("a delivery");
    server.kill();
    server.restart();
    // At once if the first answer was recorded before the kill, else when the lease of the notice is over.
    let again = deliveries.recv_timeout(LEASE + SOON).expect("a delivery");
    assert_eq!(again.header("webhook-id"), first.header("webhook-id"));
    let event = again.event();
    assert_eq!(event["type"], "job.failed");
    assert_eq!(event["data"]["id"], job["id"]);
    assert_eq!(event["data"]["error"]["code"], "no_uvs");
}

#[tokio::test]
async fn private_addresses_are_not_reached() {
    let server = Server::with(&SETTINGS[..1]);
    for address in [
        "http://127.0.0.1:9/",
        "http://[::1]/",
        "http://10.0.0.1/hook",
        "http://169.254.169.254/latest/meta-data",
        "http://0x7f000001/",
        "http://[::ffff:127.0.0.1]/",
        "ftp://example.org/",
        "http://user:secret@example.org/",
        "nowhere",
    ] {
        let escaped =
            percent_encoding::utf8_percent_encode(address, percent_encoding::NON_ALPHANUMERIC);
        let request = server.post(&format!("/v1/jobs?webhook={escaped}"));
        let answer = request.body(meshes::small()).send().await;
        assert_problem(answer.expect("an answer"), 400, "invalid_request").await;
    }
    // A name is judged by what it means when the connection is made.
    let (address, deliveries) = receiver(&[]);
    let named = address.replace("127.0.0.1", "localhost");
    let job = submit(&server, "kind=verify", &named).await;
    server.ended(&job).await;
    assert!(deliveries.recv_timeout(Duration::from_secs(4)).is_err());
}

#[tokio::test]
async fn without_a_secret_there_are_no_webhooks() {
    let server = Server::start();
    let request = server.post("/v1/jobs?webhook=https%3A%2F%2Fexample.org");
    let answer = request.body(meshes::small()).send().await;
    let problem = assert_problem(answer.expect("an answer"), 400, "invalid_request").await;
    let detail = problem["detail"].as_str().expect("a detail");
    assert!(detail.contains("--webhook-secret"), "{detail}");
}

#[test]
fn what_is_public_is_known() {
    for (address, expected) in [
        ("1.1.1.1", true),
        ("100.63.0.1", true),
        ("100.64.0.1", false),
        ("192.168.0.1", false),
        ("172.16.0.1", false),
        ("172.32.0.1", true),
        ("198.18.0.1", false),
        ("0.0.0.0", false),
        ("255.255.255.255", false),
        ("2606:4700::1", true),
        ("fe80::1", false),
        ("fd00::1", false),
        ("::", false),
        ("::ffff:10.0.0.1", false),
        ("64:ff9b::a00:1", false),
        ("64:ff9b::101:101", true),
        ("2002:a00:1::", false),
        ("2001:db8::1", false),
    ] {
        let address = address.parse().expect("an address");
        assert_eq!(is_public(address), expected, "{address}");
    }
}

#[test]
fn a_secret_is_long_enough_and_never_shown() {
    assert!(SECRET.parse::<Secrets>().is_err(), "it has spaces");
    assert!("too-short".parse::<Secrets>().is_err());
    let secrets: Secrets = SETTINGS[0].1.parse().expect("a secret");
    assert!(!format!("{secrets:?}").contains("characters"));
}
