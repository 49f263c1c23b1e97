//! From sending a move to the frame that contains it.

use std::time::{Duration, Instant};

use futures_util::future::join_all;
use serde_json::json;

use crate::cases::{Case, sheet};
use crate::service::{Service, moved, until};

/// Moves one after the other.
pub async fn measure(case: &Case, moves: usize) {
    let service = Service::start(1);
    let begin = Instant::now();
    let mut session = service.open(case).await;
    let opened = begin.elapsed().as_secs_f64();
    let live = &mut session.live;
    let n = live.say(json!({ "list": {} })).await;
    while until(live, n).await.is_moving() {}
    let first = moved(live, &case.target(0.01)).await;
    for warm in 0..moves.min(50) {
        moved(live, &case.target(warm as f64 / 50.0)).await;
    }
    let (before, begin) = (service.worked(), Instant::now());
    let mut times = Vec::with_capacity(moves);
    for index in 0..moves {
        times.push(moved(live, &case.target(index as f64 / 100.0)).await);
    }
    let (wall, after) = (begin.elapsed().as_secs_f64(), service.worked());
    times.sort_by(f64::total_cmp);
    let quantile = |share: f64| times[((times.len() as f64 * share) as usize).min(times.len() - 1)];
    println!(
        "{}: opened in {opened:.2} s, first move {first:.1} ms; {moves} moves: median {:.1} ms, 95 of 100 {:.1}, 99 of 100 {:.1}, worst \
         {:.1}; server {:.2} ms a move, child {:.1} ms, {:.1} s on the wall; {} MiB",
        case.name,
        quantile(0.5),
        quantile(0.95),
        quantile(0.99),
        times[times.len() - 1],
        1e3 * (after.0 - before.0) / moves as f64,
        1e3 * (after.1 - before.1) / moves as f64,
        wall,
        service.resident(),
    );
    service.close(&session).await;
}

/// Fifty sessions at once, and one more.
pub async fn fifty() {
    let service = Service::start(50);
    let case = sheet(50);
    let mut sessions = Vec::new();
    for _ in 0..50 {
        sessions.push(service.open(&case).await);
    }
    let refused = service.post(&case).await;
    let (status, after) = (
        refused.status(),
        refused.headers().get("retry-after").cloned(),
    );
    let end = Instant::now() + Duration::from_secs(30);
    let work = sessions.iter_mut().enumerate().map(|(index, session)| {
        let case = &case;
        async move {
            let mut times = Vec::new();
            while Instant::now() < end {
                let turn = 0.01 * times.len() as f64 + 0.02 * index as f64;
                times.push(moved(&mut session.live, &case.target(turn)).await);
            }
            times
        }
    });
    let times = join_all(work).await;
    let counts: Vec<usize> = times.iter().map(Vec::len).collect();
    let mut all: Vec<f64> = times.concat();
    all.sort_by(f64::total_cmp);
    println!(
        "fifty sheets of 5000 triangles: {} moves in 30 s, {} to {} a session; median {:.0} ms, 95 of 100 {:.0}, worst {:.0}; one more: {status}, \
         retry-after {after:?}; {} MiB in {} children",
        all.len(),
        counts.iter().min().expect("sessions"),
        counts.iter().max().expect("sessions"),
        all[all.len() / 2],
        all[all.len() * 95 / 100],
        all[all.len() - 1],
        service.resident(),
        service.process.children().len(),
    );
    for session in &sessions {
        let url = format!("http://{}{}", service.process.address(), session.path);
        service.client.delete(url).send().await.expect("an answer");
    }
    let begin = Instant::now();
    while !service.process.children().is_empty() {
        tokio::time::sleep(Duration::from_millis(10)).await;
    }
    println!(
        "all children gone {:.0} ms later",
        1e3 * begin.elapsed().as_secs_f64()
    );
}
