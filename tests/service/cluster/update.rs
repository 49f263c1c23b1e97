//! A newer program takes the place of an older one while jobs run.

use std::time::Duration;

use crate::harness::machines::Machines;
use crate::harness::update::Update;

/// `cargo bench --bench update` does the same with two programs.
#[tokio::test(flavor = "multi_thread", worker_threads = 4)]
async fn a_rolling_update_loses_nothing() {
    let update = Update {
        older: None,
        jobs: 42,
        seed: 10,
        patience: Duration::from_mins(2),
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
