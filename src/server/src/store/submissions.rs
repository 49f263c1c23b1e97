//! Recording of new jobs, subject to capacity and idempotency.

use sqlx::{Any, Row, Transaction};

use super::database::Database;
use super::hints::Hints;
use super::reading::stored_bytes;
use super::{idempotency, notices, quotas, rows};
use crate::jobs::{
    Capacity, Enqueued, IdempotencyKey, Job, State, StoreError, StoreResult, Timestamp,
};

/// Adds a job, timed by the database.
pub(super) async fn enqueue(
    database: &Database,
    hints: &Hints,
    job: &Job,
    key: Option<&IdempotencyKey>,
    capacity: Capacity,
) -> StoreResult<Enqueued> {
    // One submission at a time counts jobs and looks for its key.
    let mut transaction = database.begin().await?;
    if let Some(lock) = database.dialect.lock_submissions() {
        sqlx::query(lock).execute(&mut *transaction).await?;
    }
    let (queued, now) = queued(database, &mut transaction).await?;
    let mut job = job.clone();
    (job.created, job.due) = (now, now);
    job.finished = job.finished.map(|_| now);
    // A repeated submission gets its earlier job.
    if let Some(key) = key
        && let Some(earlier) =
            idempotency::earlier_use(database, key, &job.owner, &mut transaction).await?
    {
        return Ok(earlier);
    }
    // Check the capacity, the quotas of the owner and the total.
    if job.state == State::Queued && i64::from(capacity.depth) <= queued {
        return Ok(Enqueued::Full);
    }
    let quotas = capacity.of_owner;
    if let Some(quota) = quotas::exceeded(&job, quotas, now, &mut transaction).await? {
        return Ok(Enqueued::OwnerOverQuota(quota));
    }
    if let Some(bytes) = capacity.bytes
        && bytes < stored_bytes(&mut transaction).await? + job.stored_bytes()
    {
        return Ok(Enqueued::OverQuota);
    }
    // Insert the job, its key and its notice, and hint at it.
    rows::insert(&job, &mut transaction).await?;
    if let Some(key) = key {
        idempotency::remember(key, &job, &mut transaction).await?;
    }
    notices::tell(&job, now, &mut transaction).await?;
    hints.give(&job, &mut transaction).await?;
    transaction.commit().await.map_err(unanswered)?;
    Ok(Enqueued::New(Box::new(job)))
}

/// Returns the number of queued jobs and the current time.
async fn queued(
    database: &Database,
    transaction: &mut Transaction<'_, Any>,
) -> StoreResult<(i64, Timestamp)> {
    let count = "SELECT count(*) AS queued, {now} AS now FROM job WHERE state = 'queued'";
    let row = sqlx::query(database.sql(count))
        .fetch_one(&mut **transaction)
        .await?;
    Ok((row.try_get("queued")?, rows::now(&row)?))
}

/// Converts the error of a commit: after a lost connection its outcome is unknown.
fn unanswered(error: sqlx::Error) -> StoreError {
    match error.into() {
        StoreError::Unavailable(text) => StoreError::Unanswered(text),
        error => error,
    }
}
