//! Many watchers of running jobs.

use std::time::{Duration, Instant};

use futures_util::{StreamExt, future, stream};
use serde_json::Value;
use tokio::net::TcpStream;
use tokio_tungstenite::tungstenite::Message;
use tokio_tungstenite::{MaybeTlsStream, WebSocketStream, connect_async};

use super::service::Service;
use super::{count, meshes, quantiles};

/// Jobs that are watched, each by as many sockets.
const JOBS: usize = 50;
const RINGS: usize = 21;

type Socket = WebSocketStream<MaybeTlsStream<TcpStream>>;

pub async fn run() {
    let count = count("SOCKETS", 1000);
    let service = Service::start();
    let at_start = service.resident_mib();
    let meshes = (0..JOBS).map(|number| meshes::bumpy_sphere(number, RINGS));
    let jobs = service.submit_all(meshes, 8).await.0;
    let (begin, service) = (Instant::now(), &service);
    let connected = stream::iter(0..count).map(|number| {
        let job = number % JOBS;
        let path = jobs[job]["links"]["events"].as_str();
        let url = service.socket_url(path.expect("a link"));
        async move { (job, connect_async(url).await.expect("a WebSocket").0) }
    });
    let sockets: Vec<(usize, Socket)> = connected.buffer_unordered(64).collect().await;
    let seconds = begin.elapsed().as_secs_f64();
    let with_sockets = service.resident_mib();
    let watched: Vec<Watched> = future::join_all(sockets.into_iter().map(watch)).await;
    let (all, at_end) = (begin.elapsed().as_secs_f64(), service.resident_mib());
    let events: usize = watched.iter().map(|watched| watched.events).sum();
    let unended = watched
        .iter()
        .filter(|watched| watched.end.is_none())
        .count();
    let losses = service.losses(&jobs).await;
    println!(
        "{count} WebSockets on {JOBS} jobs of {} faces",
        80 * (RINGS - 1)
    );
    println!("  connected in {seconds:.1} s, {events} events in {all:.1} s, lost {losses}");
    println!("  without the end of their job: {unended}");
    println!(
        "  spread of an end over its watchers: {}",
        quantiles::of(spreads(&watched))
    );
    println!("  memory: {at_start} MiB, {with_sockets} with sockets, {at_end} at the end");
}

/// What one socket saw: events, and the job that ended with the moment of that.
struct Watched {
    events: usize,
    end: Option<(usize, Instant)>,
}

async fn watch((job, mut socket): (usize, Socket)) -> Watched {
    let (mut events, mut end) = (0, None);
    while let Some(Ok(message)) = socket.next().await {
        if let Message::Text(text) = message {
            let event: Value = serde_json::from_str(&text).expect("JSON");
            events += 1;
            if event["state"] == "succeeded" {
                end = Some((job, Instant::now()));
            }
        }
    }
    Watched { events, end }
}

/// How much later than the first watcher of the same job each one saw the end.
fn spreads(watched: &[Watched]) -> Vec<Duration> {
    let ends = || watched.iter().filter_map(|watched| watched.end.as_ref());
    let first = |job: usize| ends().filter(|end| end.0 == job).map(|end| end.1).min();
    ends()
        .filter_map(|&(job, when)| Some(when.duration_since(first(job)?)))
        .collect()
}
