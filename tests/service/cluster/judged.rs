//! A judge who finds nothing is of no use: what he looks for is done here, and he finds it.

use std::time::Duration;

use crate::harness::crash::{Done, Run};
use crate::harness::fault::Fault;
use crate::harness::judge::judge;

/// For what will not go.
const PATIENCE: Duration = Duration::from_millis(100);

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn all_that_is_wrong_is_found() {
    let run = Run {
        fault: Fault::Worker,
        jobs: 4,
        moments: 0,
        seed: 1,
        patience: Duration::from_mins(1),
    };
    let Done {
        mut machines,
        clients,
        ..
    } = run.done(None).await.expect("machines");
    let mut accepted = clients.accepted();
    accepted.sort_by_key(|job| job.number);
    let [lost, changed, taken, damaged] = [0, 1, 2, 3].map(|job| accepted[job].id.clone());
    let psql = |statement: String| machines.postgres.psql("unwrapd", &statement);
    psql(format!("DELETE FROM job WHERE id = '{lost}'"));
    psql(format!(
        "UPDATE job SET finished = finished + 1 WHERE id = '{changed}'"
    ));
    psql(format!(
        "UPDATE history SET job = job || '{{\"attempt\": 2}}' WHERE job->>'id' = '{taken}' AND job->>'state' = 'running'"
    ));
    let objects = machines.s3.objects();
    let result = objects
        .iter()
        .find(|key| key.starts_with(&damaged) && key.ends_with("/0") && key.contains("output"));
    let root = machines.s3.root();
    std::fs::write(root.join(result.expect("a result")), "damaged").expect("a file");
    let nobody = root.join("nobody");
    std::fs::create_dir(&nobody).expect("a folder");
    std::fs::write(nobody.join("0"), "left").expect("a file");
    let worker = machines.processes[2].folder();
    std::fs::create_dir(worker.join("scratch/attempt")).expect("a folder");

    let judgment = judge(&mut machines, &clients, PATIENCE).await;
    let [losses, twice, orphans, unverified] = judgment.all().map(|(_, found)| found.join("\n"));
    assert!(
        losses.contains(&lost) && losses.contains(&damaged),
        "{losses}"
    );
    assert!(!losses.contains(&changed), "{losses}");
    assert!(
        twice.contains(&changed) && twice.contains(&taken),
        "{twice}"
    );
    assert!(
        orphans.contains("attempt") && orphans.contains("nobody"),
        "{orphans}"
    );
    assert!(unverified.contains(&damaged), "{unverified}");
}
