//! Progress over WebSocket and server-sent events.

use futures_util::{SinkExt, StreamExt};
use nix::sys::signal::Signal;
use serde_json::Value;
use tokio::net::TcpStream;
use tokio_tungstenite::tungstenite::Message;
use tokio_tungstenite::tungstenite::client::IntoClientRequest;
use tokio_tungstenite::{MaybeTlsStream, WebSocketStream, connect_async};

use crate::meshes;
use crate::server::sessions::sheet;
use crate::server::{SOON, Server, assert_problem, form, json};

/// A WebSocket client of one job's events.
pub struct Socket {
    stream: WebSocketStream<MaybeTlsStream<TcpStream>>,
    /// The code it was closed with.
    pub closed: Option<u16>,
}

impl Socket {
    pub async fn connect(request: impl IntoClientRequest + Unpin) -> Self {
        let (stream, _) = connect_async(request).await.expect("a WebSocket");
        Self {
            stream,
            closed: None,
        }
    }

    /// Says something; the server may stop reading before its end.
    pub async fn say(&mut self, text: String) {
        let _ = self.stream.send(Message::text(text)).await;
    }

    /// The next event; `None` when the server closes.
    pub async fn next(&mut self) -> Option<Value> {
        loop {
            let message = tokio::time::timeout(SOON, self.stream.next()).await;
            match message.expect("a message in time")?.expect("a message") {
                Message::Text(text) => return Some(serde_json::from_str(&text).expect("JSON")),
                Message::Close(frame) => {
                    self.closed = frame.map(|frame| frame.code.into());
                    let _ = self.stream.flush().await;
                    return None;
                }
                _ => {}
            }
        }
    }
}

fn events_path(job: &Value) -> String {
    job["links"]["events"].as_str().expect("a link").to_owned()
}

/// `seq` rises, `fraction` does not fall, and the last state is final.
fn assert_monotone(events: &[Value]) {
    for pair in events.windows(2) {
        assert!(
            pair[0]["seq"].as_u64() < pair[1]["seq"].as_u64(),
            "{pair:?}"
        );
        assert!(
            pair[0]["fraction"].as_f64() <= pair[1]["fraction"].as_f64(),
            "{pair:?}"
        );
    }
    let last = events.last().expect("an event");
    assert_eq!(
        (&last["state"], last["fraction"].as_f64()),
        (&"succeeded".into(), Some(1.0))
    );
}

#[tokio::test]
async fn a_websocket_sees_monotone_progress_and_the_end() {
    let server = Server::start();
    let job = server.submit(meshes::hills(150), "").await;
    let mut socket = Socket::connect(&server.socket_url(&events_path(&job))).await;
    let mut events = Vec::new();
    while let Some(event) = socket.next().await {
        events.push(event);
    }
    assert_monotone(&events);
    assert_eq!(socket.closed, Some(1000));
    assert!(
        events.iter().any(|e| e["iteration"].as_u64() > Some(0)),
        "{events:?}"
    );

    let after = events[events.len() - 2]["seq"].as_u64().expect("a number");
    let path = format!("{}?after={after}", events_path(&job));
    let mut late = Socket::connect(&server.socket_url(&path)).await;
    assert_eq!(
        late.next().await.as_ref().map(|e| &e["state"]),
        Some(&"succeeded".into())
    );
    assert_eq!(late.next().await, None);
}

#[tokio::test]
async fn server_sent_events_are_the_same() {
    let server = Server::start();
    let job = server.submit(meshes::hills(60), "").await;
    let request = server
        .get(&events_path(&job))
        .header("accept", "text/event-stream");
    let answer = request.send().await.expect("an answer");
    assert_eq!(answer.headers()["x-accel-buffering"], "no");
    let text = answer.text().await.expect("text");
    let events: Vec<Value> = text
        .lines()
        .filter_map(|line| line.strip_prefix("data: "))
        .map(|data| serde_json::from_str(data).expect("JSON"))
        .collect();
    assert_monotone(&events);
    let last = events.last().expect("an event");
    assert!(text.contains(&format!("id: {}", last["seq"])));
}

#[tokio::test]
async fn events_need_one_of_the_two_protocols() {
    let server = Server::start();
    let job = server.submit(meshes::small(), "").await;
    let plain = server
        .get(&events_path(&job))
        .send()
        .await
        .expect("an answer");
    assert_eq!(plain.headers()["upgrade"], "websocket");
    assert_problem(plain, 426, "upgrade_required").await;
}

#[tokio::test]
async fn a_message_beyond_the_limit_is_answered_with_its_close_code() {
    let server = Server::start();
    let (_, off) = sheet(6);
    let job = server.submit(meshes::large(), "cut=disk").await;
    let form = form("deform", "{}", ("sheet.off", off));
    let opened = server.post("/v1/sessions").multipart(form).send().await;
    let session = json(opened.expect("an answer")).await;
    let live = session["links"]["live"].as_str().expect("a link");
    for path in [&events_path(&job), live] {
        for bytes in [(64 << 10) + 1, 8 << 20] {
            let mut socket = Socket::connect(&server.socket_url(path)).await;
            socket.say("x".repeat(bytes)).await;
            while socket.next().await.is_some() {}
            assert_eq!(socket.closed, Some(1009), "{path}: {bytes}");
        }
    }
}

#[tokio::test]
async fn a_stop_says_goodbye_and_the_job_goes_on_afterward() {
    let mut server = Server::with(&[("UNWRAPD_GRACE_SECONDS", "0")]);
    let job = server.submit(meshes::large(), "cut=disk").await;
    server.mapping(&job).await;
    let mut socket = Socket::connect(&server.socket_url(&events_path(&job))).await;
    socket.next().await.expect("an event");
    server.signal(Signal::SIGTERM);
    while socket.next().await.is_some() {}
    assert_eq!(socket.closed, Some(1001));
    drop(socket);
    server.stopped();
    assert_eq!(server.children(), Vec::<i32>::new());

    server.restart();
    let path = format!("{}/finish", job["links"]["self"].as_str().expect("a link"));
    let again = json(server.post(&path).send().await.expect("an answer")).await;
    assert_eq!(again["id"], job["id"]);
    let ended = server.ended(&job).await;
    assert_eq!(
        (&ended["state"], &ended["attempt"]),
        (&"succeeded".into(), &2.into())
    );
}

#[tokio::test]
async fn a_stop_lets_a_short_job_end() {
    let mut server = Server::with(&[("UNWRAPD_GRACE_SECONDS", "50"), ("UNWRAPD_WORKERS", "1")]);
    let job = server.submit(meshes::hills(150), "").await;
    let waiting = server.submit(meshes::small(), "").await;
    server.mapping(&job).await;
    server.signal(Signal::SIGTERM);
    server.stopped();
    assert_eq!(server.children(), Vec::<i32>::new());

    server.restart_with(&[("UNWRAPD_WORKERS", "0")]);
    let now = async |job: &Value| {
        let path = job["links"]["self"].as_str().expect("a link");
        json(server.get(path).send().await.expect("an answer")).await
    };
    let ended = now(&job).await;
    assert_eq!(
        (&ended["state"], &ended["attempt"]),
        (&"succeeded".into(), &1.into())
    );
    assert_eq!(now(&waiting).await["state"], "queued");
}
