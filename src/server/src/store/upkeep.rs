//! Facts about the store as a whole: identity, clock, files without a job.

use std::time::Duration;

use sqlx::Row;
use sqlx::any::AnyRow;

use super::database::Database;
use super::rows;
use crate::jobs::{Census, JobId, Quarantined, StoreId, StoreResult, Timestamp};

/// Time between checks after which quarantined files count as newly found. Processes check every day, so a longer gap
/// means that the database was restored or its clock has jumped; three days allow for two missed checks.
const GAP_MS: i64 = 3 * 86_400_000;

/// Returns the current time by the clock of the database.
pub(super) async fn now(database: &Database) -> StoreResult<Timestamp> {
    let row = sqlx::query(database.sql("SELECT {now} AS now"))
        .fetch_one(&database.readers)
        .await?;
    rows::now(&row)
}

/// Returns the id of the store; `None` if it has none yet.
pub(super) async fn identity(database: &Database) -> StoreResult<Option<StoreId>> {
    let row = sqlx::query("SELECT store FROM identity WHERE id = 1")
        .fetch_optional(&database.readers)
        .await?;
    let Some(row) = row else {
        return Ok(None);
    };
    let id = rows::text(&row, "store")?.parse();
    id.map(Some).map_err(rows::damaged)
}

/// Sets the id of the store if it has none. Returns its id.
pub(super) async fn identify(database: &Database, identity: StoreId) -> StoreResult<StoreId> {
    let insert = "INSERT INTO identity (id, store) VALUES (1, $1) ON CONFLICT (id) DO NOTHING";
    sqlx::query(insert)
        .bind(identity.to_string())
        .execute(&database.writers)
        .await?;
    let present = self::identity(database).await?;
    Ok(present.unwrap_or(identity))
}

/// Returns the number of jobs, and of those that have files.
pub(super) async fn census(database: &Database) -> StoreResult<Census> {
    let count = "SELECT count(*) AS jobs,
         CAST(coalesce(sum(CASE WHEN 0 < bytes THEN 1 ELSE 0 END), 0) AS BIGINT) AS with_files
         FROM job";
    let row = sqlx::query(count).fetch_one(&database.readers).await?;
    Ok(Census {
        jobs: row.try_get::<i64, _>("jobs")? as u64,
        with_files: row.try_get::<i64, _>("with_files")? as u64,
    })
}

/// Records files without a job, or that they still have none.
pub(super) async fn quarantine(database: &Database, files: &[(JobId, u64)]) -> StoreResult<()> {
    let mut transaction = database.begin().await?;
    for (job, bytes) in files {
        let note = "INSERT INTO quarantine (job, bytes, since, seen)
             VALUES ($1, $2, {now}, {now})
             ON CONFLICT (job) DO UPDATE SET bytes = excluded.bytes, seen = excluded.seen,
                 since = CASE WHEN quarantine.seen <= excluded.seen
                                   AND excluded.seen <= quarantine.seen + $3
                              THEN quarantine.since ELSE excluded.since END";
        sqlx::query(database.sql(note))
            .bind(job.to_string())
            .bind(*bytes as i64)
            .bind(GAP_MS)
            .execute(&mut *transaction)
            .await?;
    }
    transaction.commit().await?;
    Ok(())
}

/// Returns all quarantined files, oldest first.
pub(super) async fn quarantined(database: &Database) -> StoreResult<Vec<Quarantined>> {
    let all = "SELECT job AS id, bytes, since, {now} AS now FROM quarantine ORDER BY since, job";
    let found = sqlx::query(database.sql(all))
        .fetch_all(&database.readers)
        .await?;
    found.iter().map(quarantined_files).collect()
}

fn quarantined_files(row: &AnyRow) -> StoreResult<Quarantined> {
    let since = Timestamp(row.try_get("since").map_err(rows::damaged)?);
    Ok(Quarantined {
        job: rows::id(row)?,
        bytes: row.try_get::<i64, _>("bytes").map_err(rows::damaged)? as u64,
        age: Duration::from_millis(rows::now(row)?.since(since)),
    })
}

/// Removes files from quarantine.
pub(super) async fn release(database: &Database, jobs: &[JobId]) -> StoreResult<()> {
    for job in jobs {
        sqlx::query("DELETE FROM quarantine WHERE job = $1")
            .bind(job.to_string())
            .execute(&database.writers)
            .await?;
    }
    Ok(())
}

/// Excludes a job with damaged files from being copied, by clearing its digest.
pub(super) async fn spoil(database: &Database, id: JobId) -> StoreResult<()> {
    sqlx::query("UPDATE job SET digest = '' WHERE id = $1")
        .bind(id.to_string())
        .execute(&database.writers)
        .await?;
    Ok(())
}
