//! A newer program takes the place of an older one while jobs run.

use std::time::Duration;

use super::faults::soon;
use super::{Cluster, assert_whole, submitted};
use crate::harness::machines::Machines;
use crate::harness::update::Update;

/// `cargo bench --bench update` does the same with two programs.
#[tokio::test(flavor = "multi_thread", worker_threads = 4)]
async fn a_rolling_update_loses_nothing() {
    let update = Update {
        older: None,
        workers_first: false,
        jobs: 42,
        seed: 10,
        patience: Duration::from_mins(10),
    };
    let updated = update.judged(None).await;
    println!(
        "{} jobs in work stopped, {} attempts lost, the longest stop {:?}",
        updated.interrupted, updated.lost, updated.stop
    );
    assert_eq!(updated.judgment.counts(), [0; 4], "{:#?}", updated.judgment);
    assert_eq!(updated.replaced, 5);
    // Old ones and new ones had jobs.
    assert!(Machines::WORKERS.len() < updated.holders);
}

#[tokio::test]
async fn a_job_of_a_newer_program_waits_for_a_newer_worker() {
    let cluster = Cluster::with_lease("60");
    let api = cluster.api();
    let job = &submitted(&api, 256..257).await[0];
    let id = job["id"].as_str().expect("an id");
    let options = |change: &str| {
        let options = format!("options = (options::jsonb {change})::text");
        let change = format!("UPDATE job SET {options} WHERE id = '{id}'");
        cluster.postgres.psql("unwrapd", &change);
    };
    options(r#"|| '{"newer": true}'"#);
    let _worker = cluster.worker();
    soon("the job is not handed back", || {
        let (state, attempts, lost) = &cluster.attempts()[id];
        state == "queued" && *attempts > 0 && *lost == 0
    })
    .await;
    options("- 'newer'");
    assert_whole(&api, job).await;
}
