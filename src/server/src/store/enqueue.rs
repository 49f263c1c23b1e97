//! Recording of new jobs, subject to capacity and idempotency.

use std::time::Duration;

use futures_util::future;
use sqlx::postgres::PgListener;
use sqlx::{Any, Row, Transaction};
use tokio::sync::Mutex;

use super::database::{Database, Dialect};
use super::reading::stored_bytes;
use super::{rows, transitions};
use crate::jobs::access::Owner;
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
        && let Some(earlier) = earlier_use(database, key, &job.owner, &mut transaction).await?
    {
        return Ok(earlier);
    }
    // Check the capacity, the quotas of the owner and the total.
    if job.state == State::Queued && i64::from(capacity.depth) <= queued {
        return Ok(Enqueued::Full);
    }
    let quotas = capacity.of_owner;
    if let Some(quota) = transitions::exceeded(&job, quotas, now, &mut transaction).await? {
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
        remember(key, &job, &mut transaction).await?;
    }
    transitions::tell(&job, now, &mut transaction).await?;
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

// Idempotency keys and the submissions that used them first.

/// Minimum lifetime of a key: one day, as the OpenAPI document promises.
const LIFE_MS: i64 = 86_400_000;

/// Returns the outcome for a key that was used before; `None` for a new key.
async fn earlier_use(
    database: &Database,
    key: &IdempotencyKey,
    owner: &Owner,
    transaction: &mut Transaction<'_, Any>,
) -> StoreResult<Option<Enqueued>> {
    let used = "SELECT {columns}, fingerprint FROM job
         JOIN (SELECT job AS of_key, fingerprint FROM idempotency WHERE key = $1) AS used
         ON id = of_key";
    let row = sqlx::query(database.sql(used))
        .bind(of_owner(key, owner))
        .fetch_optional(&mut **transaction)
        .await?;
    let Some(row) = row else {
        return Ok(None);
    };
    if row.try_get::<String, _>("fingerprint")? != key.fingerprint {
        return Ok(Some(Enqueued::KeyReused));
    }
    Ok(Some(Enqueued::Replay(Box::new(rows::job(&row)?))))
}

/// Deletes expired keys.
pub(super) async fn forget(database: &Database) -> StoreResult<()> {
    let mut transaction = database.begin().await?;
    sqlx::query(database.sql("DELETE FROM idempotency WHERE created < {now} - $1"))
        .bind(LIFE_MS)
        .execute(&mut *transaction)
        .await?;
    transaction.commit().await?;
    Ok(())
}

/// Returns the key with its owner. Neither contains a line break.
fn of_owner(IdempotencyKey { key, .. }: &IdempotencyKey, owner: &Owner) -> String {
    let owner = owner.name().map(|name| format!("{name}\n"));
    owner.unwrap_or_default() + key
}

/// Records the submission that used a key.
async fn remember(
    key: &IdempotencyKey,
    job: &Job,
    transaction: &mut Transaction<'_, Any>,
) -> StoreResult<()> {
    let insert = "INSERT INTO idempotency (key, fingerprint, job, created) VALUES ($1, $2, $3, $4)";
    sqlx::query(insert)
        .bind(of_owner(key, &job.owner))
        .bind(&key.fingerprint)
        .bind(job.id.to_string())
        .bind(job.created.0)
        .execute(&mut **transaction)
        .await?;
    Ok(())
}

// Notifications from PostgreSQL that a job can be claimed, which save idle workers from polling.

/// Notification channel.
const CHANNEL: &str = "unwrapd_queued";
const NOTIFY: &str = "SELECT pg_notify('unwrapd_queued', '')";
/// Delay before reconnecting after a failure. Without hints, workers still poll, so a longer delay costs little.
const PAUSE: Duration = Duration::from_secs(5);

/// A dedicated listening connection, opened when needed.
pub(super) struct Hints {
    url: String,
    dialect: Dialect,
    listener: Mutex<Option<PgListener>>,
}

impl Hints {
    /// Creates the hints of the database at a URL.
    pub fn of(url: &str, dialect: Dialect) -> Self {
        Self {
            url: url.to_owned(),
            dialect,
            listener: Mutex::new(None),
        }
    }

    /// Sends a hint when the transaction commits, if the job is queued. SQLite sends none.
    pub async fn give(
        &self,
        job: &Job,
        transaction: &mut Transaction<'_, Any>,
    ) -> sqlx::Result<()> {
        if self.dialect == Dialect::Postgres && job.state == State::Queued {
            sqlx::query(NOTIFY).execute(&mut **transaction).await?;
        }
        Ok(())
    }

    /// Waits for a hint. With SQLite there is none: its only process knows its jobs.
    pub async fn next(&self) {
        if self.dialect == Dialect::Sqlite {
            return future::pending().await;
        }
        let mut listener = self.listener.lock().await;
        while let Err(error) = self.received(&mut listener).await {
            tracing::debug!(%error, "no hints of the database");
            *listener = None;
            tokio::time::sleep(PAUSE).await;
        }
    }

    async fn received(&self, listener: &mut Option<PgListener>) -> sqlx::Result<()> {
        let listener = if let Some(listener) = listener {
            listener
        } else {
            let mut fresh = PgListener::connect(&self.url).await?;
            fresh.listen(CHANNEL).await?;
            listener.insert(fresh)
        };
        listener.recv().await.map(|_| ())
    }
}
