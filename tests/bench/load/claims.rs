//! Claims and ends by workers that do nothing else.

use std::sync::Arc;
use std::time::Instant;

use futures_util::future;
use unwrapd::jobs::access::Visibility;
use unwrapd::jobs::{
    Capacity, Ending, Enqueued, Job, JobId, JobStore, OwnerQuotas, ProgressReport, Rules, Share,
    Transition, WorkerId,
};
use unwrapd::store::RecordStore;
use unwrapd_api::{Kind, Verdict};

use super::count;

const WORKERS: usize = 8;
const ROOM: Capacity = Capacity {
    depth: u32::MAX,
    bytes: None,
    of_owner: OwnerQuotas {
        jobs: None,
        bytes: None,
        cpu_of_day: None,
    },
};

pub async fn run() {
    let folder = tempfile::tempdir().expect("a folder");
    let sqlite = format!("sqlite://{}?mode=rwc", folder.path().join("jobs").display());
    measure("SQLite", &sqlite).await;
    match std::env::var("DATABASE_URL") {
        Ok(url) => measure("PostgreSQL", &url).await,
        Err(_) => println!("PostgreSQL: left out, no DATABASE_URL"),
    }
}

async fn measure(engine: &str, url: &str) {
    let count = count("JOBS", 2000);
    let store = Arc::new(
        RecordStore::open(url, Rules::default())
            .await
            .expect("a store"),
    );
    let begin = Instant::now();
    for _ in 0..count {
        let job = Job::queued(JobId::fresh(), Kind::Unwrap, serde_json::json!({}));
        let new = store.enqueue(&job, None, ROOM).await.expect("an answer");
        assert!(matches!(new, Enqueued::New(_)));
    }
    let enqueued = begin.elapsed().as_secs_f64();
    let begin = Instant::now();
    // SQLite belongs to one process; workers on PostgreSQL have stores of their own.
    let mut stores = vec![store; WORKERS];
    if engine == "PostgreSQL" {
        for own in stores.iter_mut().skip(1) {
            *own = Arc::new(
                RecordStore::open(url, Rules::default())
                    .await
                    .expect("a store"),
            );
        }
    }
    let done = future::join_all(stores.into_iter().map(|store| tokio::spawn(work(store))));
    let done: usize = done
        .await
        .into_iter()
        .map(|done| done.expect("a count"))
        .sum();
    let seconds = begin.elapsed().as_secs_f64();
    assert_eq!(done, count, "claimed twice or never");
    println!("{engine}: {count} jobs, {WORKERS} workers");
    println!(
        "  enqueued {:.0} a second, by one client",
        count as f64 / enqueued
    );
    println!("  claimed and ended {:.0} a second", count as f64 / seconds);
}

/// Claims and ends jobs until there is none; how many.
async fn work(store: Arc<RecordStore>) -> usize {
    let mut done = 0;
    while let Some(job) = store
        .claim(WorkerId::fresh(), Share::default())
        .await
        .expect("an answer")
    {
        let report = ProgressReport {
            seq: job.seq,
            ..ProgressReport::default()
        };
        let ending = Ending::Succeeded(Vec::new(), Verdict::default());
        let ended = Transition::Ended(job.token, report, ending);
        store
            .change(&Visibility::All, job.id, &ended)
            .await
            .expect("an answer");
        done += 1;
    }
    done
}
