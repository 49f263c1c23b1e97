//! What every store of records promises, and what becomes of a record when something happens.

mod faulty;
mod named;
mod place;
mod processes;
mod promises;
mod transitions;

use std::time::Duration;

use unwrapd::jobs::access::Visibility;
use unwrapd::jobs::{
    Capacity, Changed, Enqueued, IdempotencyKey, Job, JobId, JobStore, OwnerQuotas, ProgressReport,
    Rules, Share, Transition, WorkerId,
};
use unwrapd::store::RecordStore;
use unwrapd_api::{InputFile, Kind, Progress};

/// Short, since tests have to wait for the end of a lease.
pub const RULES: Rules = Rules {
    lease: Duration::from_millis(400),
    attempts: 3,
    interruptions: 5,
    pause: Duration::from_millis(50),
};

/// As much as anybody needs.
pub const ROOM: Capacity = Capacity {
    depth: 1000,
    bytes: None,
    of_owner: OwnerQuotas {
        jobs: None,
        bytes: None,
        cpu_of_day: None,
    },
};

/// A job that nobody has started.
pub fn job() -> Job {
    let options = serde_json::json!({ "resolution": 512 });
    Job {
        input: vec![InputFile {
            name: "mesh.glb".to_owned(),
            bytes: 100,
            sha256: Some("ab".to_owned()),
        }],
        digest: "cd".to_owned(),
        ..Job::queued(JobId::fresh(), Kind::Unwrap, options)
    }
}

pub fn report(seq: u64, fraction: f64) -> ProgressReport {
    let progress = Progress {
        fraction,
        ..Progress::default()
    };
    ProgressReport {
        seq,
        progress,
        cpu_ms: 0,
    }
}

/// Puts a job into a store.
pub async fn enqueued(store: &RecordStore, job: &Job) -> Job {
    let key: Option<&IdempotencyKey> = None;
    match store.enqueue(job, key, ROOM).await.expect("an answer") {
        Enqueued::New(job) => *job,
        other => panic!("{other:?}"),
    }
}

/// Puts a job into an empty store and has a worker take it.
pub async fn claimed(store: &RecordStore) -> Job {
    let new = enqueued(store, &job()).await;
    let job = claim(store).await.expect("it waits");
    assert_eq!(job.id, new.id);
    job
}

pub async fn claim(store: &RecordStore) -> Option<Job> {
    let claimed = store.claim(WorkerId::fresh(), Share::default()).await;
    claimed.expect("an answer")
}

/// Claims until there is one: pauses are short.
pub async fn claim_soon(store: &RecordStore) -> Job {
    loop {
        if let Some(job) = claim(store).await {
            return job;
        }
        tokio::task::yield_now().await;
    }
}

pub async fn change(store: &RecordStore, id: JobId, transition: Transition) -> Changed {
    store
        .change(&Visibility::All, id, &transition)
        .await
        .expect("an answer")
}

/// The record after a change that must take place.
pub fn yes(changed: Changed) -> Job {
    match changed {
        Changed::Yes(job) => *job,
        other => panic!("{other:?}"),
    }
}
