//! The matrix of `tests/bench/crash.rs`, with few moments and few jobs: nine faults, and nothing is
//! lost, done twice with effect, left, or unproven.

use std::time::Duration;

use crate::harness::crash::Run;
use crate::harness::fault::Fault;

const JOBS: usize = 20;
const MOMENTS: usize = 2;
/// Jobs that have not ended by then are lost.
const PATIENCE: Duration = Duration::from_mins(10);

macro_rules! faults {
    ($($name:ident: $fault:ident, $seed:literal;)*) => {$(
        #[tokio::test(flavor = "multi_thread", worker_threads = 4)]
        async fn $name() {
            nothing_goes_wrong(Fault::$fault, $seed).await;
        }
    )*};
}

faults! {
    killed_services: Api, 1;
    killed_workers: Worker, 2;
    killed_children: Child, 3;
    a_killed_database: Database, 4;
    a_killed_store: Store, 5;
    a_stopped_store: StoreStopped, 6;
    full_disks: Disk, 7;
    cut_connections: Network, 8;
    jumping_clocks: Clock, 9;
}

async fn nothing_goes_wrong(fault: Fault, seed: u64) {
    let run = Run {
        fault,
        jobs: JOBS,
        moments: MOMENTS,
        seed,
        patience: PATIENCE,
    };
    if let Some(judged) = run.judged(None).await {
        println!("{run:?}: {:?}", judged.took);
        assert_eq!(judged.judgment.counts(), [0; 4], "{:#?}", judged.judgment);
        assert!(0 < judged.happened);
    }
}
