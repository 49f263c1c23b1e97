//! A backup of a running service, as `docker/backup.md` says: first the records, then the files.

use std::fs;
use std::path::Path;

use sqlx::{Connection, SqliteConnection};

use super::watchable::{metrics, value};
use super::{Server, json};
use crate::meshes;

/// Copies a folder; what goes away meanwhile is no more needed.
fn copy(from: &Path, to: &Path) {
    fs::create_dir_all(to).expect("a folder");
    for entry in fs::read_dir(from).into_iter().flatten().flatten() {
        let (from, to) = (entry.path(), to.join(entry.file_name()));
        if from.is_dir() {
            copy(&from, &to);
        } else {
            let _ = fs::copy(from, to);
        }
    }
}

/// Copies the database as one moment has it, while others write to it.
async fn copy_records(from: &Path, to: &Path) {
    let url = format!("sqlite://{}", from.display());
    let mut records = SqliteConnection::connect(&url).await.expect("a database");
    sqlx::query("VACUUM INTO $1")
        .bind(to.to_str())
        .execute(&mut records)
        .await
        .expect("a copy");
}

#[tokio::test]
async fn a_backup_of_a_running_service_has_every_accepted_job() {
    let server = Server::with(&[("UNWRAPD_WORKERS", "1")]);
    let mut jobs = Vec::new();
    for n in 0..3 {
        jobs.push(
            server
                .submit(meshes::small(), &format!("resolution={}", 256 + n))
                .await,
        );
    }
    for job in &jobs {
        server.ended(job).await;
    }
    let running = server.submit(meshes::hills(350), "cut=disk").await;
    server.mapping(&running).await;
    let waiting = server.submit(meshes::small(), "resolution=500").await;

    let backup = tempfile::tempdir().expect("a folder");
    let records = "unwrapd.sqlite";
    copy_records(&server.data().join(records), &backup.path().join(records)).await;
    // What comes between the two has files, but no record.
    let late = server.submit(meshes::small(), "resolution=501").await;
    copy(&server.data().join("blobs"), &backup.path().join("blobs"));
    drop(server);

    let restored = Server::on(backup, &[]);
    let path = running["links"]["self"].as_str().expect("a link");
    let finish = restored.post(&format!("{path}/finish")).send().await;
    assert_eq!(finish.expect("an answer").status(), 202);
    jobs.extend([running, waiting]);
    for job in &jobs {
        let job = restored.ended(job).await;
        assert_eq!(job["state"], "succeeded", "{job}");
        for file in job["links"]["files"].as_array().expect("links") {
            let href = file["href"].as_str().expect("a link");
            let answer = restored.get(href).send().await.expect("an answer");
            let bytes = answer.bytes().await.expect("a whole file");
            // The size of a picture is known once it is drawn.
            let size = file["bytes"].as_u64();
            assert!(size.is_none_or(|size| size == bytes.len() as u64), "{file}");
        }
    }
    let path = late["links"]["self"].as_str().expect("a link");
    let unknown = restored.get(path).send().await.expect("an answer");
    assert_eq!(json(unknown).await["code"], "job_not_found");
    let late = late["id"].as_str().expect("an id").to_owned();
    // A newer backup of the records may know it.
    assert!(restored.owners_of_files().contains(&late));
    let metrics = metrics(&restored).await;
    let held = value(&metrics, "unwrapd_quarantined_jobs");
    assert_eq!(held, Some(1.0), "{metrics}");
}
