//! The lines of the matrix.

use std::fs;
use std::time::Instant;

use super::setup::{Setup, damage};
use crate::server::watchable::{metrics, value};
use crate::server::{SOON, assert_problem, json};

const DAY: i64 = 86_400;

pub async fn a_missing_database_is_refused(mut setup: Setup) {
    let files = setup.count_files();
    setup.stop();
    setup.exchange_records("aside", None);
    for _ in 0..2 {
        let why = setup.refusal();
        assert!(
            why.contains("the database is empty, but there are files of 3 jobs"),
            "{why}"
        );
    }
    assert_eq!(setup.count_files(), files);
    setup.replace_records("aside");
    setup.start();
    setup.assert_whole().await;
}

pub async fn an_older_database_deletes_nothing(mut setup: Setup) {
    setup.stop();
    setup.keep_records("older").await;
    setup.start();
    for n in 3..5 {
        setup.add(n).await;
    }
    // Old enough to be no submission under way.
    let files = setup.count_files();
    setup.stop();
    setup.exchange_records("newer", Some("older"));
    setup.clock.set(2 * DAY);
    setup.start();
    let start = Instant::now();
    while value(&metrics(&setup.server).await, "unwrapd_quarantined_jobs") != Some(2.0) {
        assert!(start.elapsed() < SOON, "no quarantine");
        tokio::task::yield_now().await;
    }
    let (code, found) = setup.check(&[]);
    let unknown = found["unknown"].as_array().expect("a list");
    assert_eq!((code, unknown.len()), (1, 2), "{found}");
    assert!(
        unknown.iter().all(|it| it["quarantine_days"].is_f64()),
        "{found}"
    );
    assert_eq!(setup.count_files(), files);

    setup.stop();
    setup.replace_records("newer");
    setup.clock.set(0);
    setup.start();
    setup.assert_whole().await;
    assert_eq!(setup.check(&[]).0, 0);
    let start = Instant::now();
    while value(&metrics(&setup.server).await, "unwrapd_quarantined_jobs") != Some(0.0) {
        assert!(start.elapsed() < SOON, "still in quarantine");
        tokio::task::yield_now().await;
    }
}

pub async fn the_database_of_another_service_is_refused(mut setup: Setup) {
    let files = setup.count_files();
    setup.stop();
    setup.keep_records("other").await;
    setup.exchange_records("aside", Some("other"));
    setup
        .sql("UPDATE identity SET store = '019a0000-0000-7000-8000-000000000000'")
        .await;
    let why = setup.refusal();
    assert!(why.contains("the database is of store 019a0000-"), "{why}");
    // One of an earlier version has no name, but other jobs.
    setup.sql("DELETE FROM identity").await;
    setup
        .sql("UPDATE job SET id = '019a' || substr(id, 5)")
        .await;
    let root = setup.files_root();
    let identity = fs::read(root.join("store-id")).expect("a name");
    fs::remove_file(root.join("store-id")).expect("a name");
    let why = setup.refusal();
    assert!(
        why.contains("the database knows none of the 3 jobs"),
        "{why}"
    );
    assert_eq!(setup.count_files(), files);
    fs::write(root.join("store-id"), identity).expect("a name");
    setup.replace_records("aside");
    setup.start();
    setup.assert_whole().await;
}

pub async fn missing_files_are_refused(mut setup: Setup) {
    setup.stop();
    let root = setup.files_root();
    let aside = root.with_extension("aside");
    fs::rename(&root, &aside).expect("a folder");
    for _ in 0..2 {
        let why = setup.refusal();
        assert!(
            why.contains("3 jobs with files, but the place for files is empty"),
            "{why}"
        );
    }
    let _ = fs::remove_dir_all(&root);
    fs::rename(&aside, &root).expect("a folder");
    setup.start();
    setup.assert_whole().await;

    // They go while the service runs: that is no fault of any job.
    fs::rename(&root, &aside).expect("a folder");
    let ready = setup.server.get("/readyz").send().await.expect("an answer");
    assert_problem(ready, 503, "not_ready").await;
    let href = format!(
        "{}/result",
        setup.jobs[0]["links"]["self"].as_str().expect("a link")
    );
    let result = setup.server.get(&href).send().await.expect("an answer");
    assert_problem(result, 503, "store_unavailable").await;
    let metrics = metrics(&setup.server).await;
    assert_eq!(value(&metrics, "unwrapd_blobs_up"), Some(0.0), "{metrics}");
    let _ = fs::remove_dir_all(&root);
    fs::rename(&aside, &root).expect("a folder");
    setup.assert_whole().await;
}

pub async fn the_files_of_another_service_are_refused(mut setup: Setup) {
    setup.stop();
    let root = setup.files_root();
    let identity = fs::read(root.join("store-id")).expect("a name");
    fs::write(
        root.join("store-id"),
        "019a0000-0000-7000-8000-000000000000",
    )
    .expect("a name");
    let why = setup.refusal();
    assert!(why.contains("the files are of store 019a0000-"), "{why}");
    fs::write(root.join("store-id"), identity).expect("a name");
    setup.start();
    setup.assert_whole().await;
}

/// A store of 0.1.0 has no identity.
pub async fn a_store_of_an_earlier_version_is_adopted(mut setup: Setup) {
    setup.stop();
    setup.sql("DELETE FROM identity").await;
    let identity = setup.files_root().join("store-id");
    fs::remove_file(&identity).expect("a name");
    setup.start();
    setup.assert_whole().await;
    assert!(identity.exists());
    assert_eq!(setup.check(&[]).0, 0);
}

/// The checksum that a record has is not that of the file any more.
pub async fn a_damaged_record_gives_no_wrong_answer(mut setup: Setup) {
    setup
        .sql("UPDATE job SET output = replace(output, '\"sha256\":\"', '\"sha256\":\"0')")
        .await;
    let href = format!(
        "{}/result",
        setup.jobs[0]["links"]["self"].as_str().expect("a link")
    );
    let result = setup.server.get(&href).send().await.expect("an answer");
    assert_problem(result, 500, "damaged_file").await;
    let (again, is_copy) = setup.again(0).await;
    assert!(!is_copy && again["state"] == "succeeded", "{again}");
    // What cannot be read at all is reported.
    setup.sql("UPDATE job SET output = 'x' || output").await;
    let result = setup.server.get(&href).send().await.expect("an answer");
    assert_problem(result, 500, "internal_error").await;
    setup.sql("UPDATE job SET output = substr(output, 2)").await;
    setup
        .sql("UPDATE job SET output = replace(output, '\"sha256\":\"0', '\"sha256\":\"')")
        .await;
    setup.jobs.truncate(3);
}

pub async fn a_damaged_input_fails_its_job(setup: Setup) {
    let paused = setup.server.request("PUT", "/v1/pause").send().await;
    assert_eq!(paused.expect("an answer").status(), 200);
    let mut setup = setup;
    let job = setup
        .server
        .submit(crate::meshes::hills(1), "resolution=400")
        .await;
    setup.jobs.push(job.clone());
    damage(&setup.stored(3, "input"));
    setup.jobs.pop();
    let resumed = setup.server.request("DELETE", "/v1/pause").send().await;
    assert_eq!(resumed.expect("an answer").status(), 200);
    let ended = setup.server.ended(&job).await;
    assert_eq!(ended["error"]["code"], "damaged_file", "{ended}");
    let input = format!("{}/input/0", job["links"]["self"].as_str().expect("a link"));
    let input = setup.server.get(&input).send().await.expect("an answer");
    assert_problem(input, 500, "damaged_file").await;
    setup.assert_whole().await;
}

pub async fn a_damaged_result_is_not_served_and_not_copied(setup: Setup) {
    damage(&setup.stored(0, "output"));
    lost_result(setup, "damaged_file", "damaged").await;
}

pub async fn a_missing_result_is_not_served_and_not_copied(setup: Setup) {
    fs::remove_file(setup.stored(0, "output")).expect("a file");
    lost_result(setup, "missing_file", "missing").await;
}

async fn lost_result(setup: Setup, code: &str, list: &str) {
    let (status, found) = setup.check(&["--repair"]);
    let keys = found[list].as_array().expect("a list");
    assert_eq!((status, keys.len()), (1, 1), "{found}");
    let href = format!(
        "{}/result",
        setup.jobs[0]["links"]["self"].as_str().expect("a link")
    );
    for range in [None, Some("bytes=0-3")] {
        let mut get = setup.server.get(&href);
        if let Some(range) = range {
            get = get.header("range", range);
        }
        assert_problem(get.send().await.expect("an answer"), 500, code).await;
    }
    let (again, is_copy) = setup.again(0).await;
    assert!(!is_copy && again["certified"] == true, "{again}");
    let href = format!(
        "{}/result",
        again["links"]["self"].as_str().expect("a link")
    );
    let result = setup.server.get(&href).send().await.expect("an answer");
    assert_eq!(result.status(), 200);
    // The new result serves as the copy from now on.
    assert!(setup.again(0).await.1);
    let metrics = metrics(&setup.server).await;
    assert!(
        value(&metrics, "unwrapd_damaged_files_total") > Some(0.0),
        "{metrics}"
    );
}

pub async fn a_clock_that_is_wrong_removes_nothing(mut setup: Setup) {
    let files = setup.count_files();
    for days in [40, -40] {
        // While it runs, and at a start.
        setup.clock.set(days * DAY);
        setup.assert_whole().await;
        setup.stop();
        setup.start();
        // The first search is over when a job has ended that was submitted after the start.
        let (job, _) = setup.again(0).await;
        assert_eq!(job["state"], "succeeded", "{job}");
        setup.assert_whole().await;
        let path = job["links"]["self"].as_str().expect("a link");
        let deleted = setup.server.request("DELETE", path).send().await;
        assert_eq!(deleted.expect("an answer").status(), 204);
        assert_eq!(setup.count_files(), files);
        setup.clock.set(0);
    }
    let all = json(
        setup
            .server
            .get("/v1/jobs")
            .send()
            .await
            .expect("an answer"),
    )
    .await;
    assert_eq!(all["jobs"].as_array().map(Vec::len), Some(3));
}
