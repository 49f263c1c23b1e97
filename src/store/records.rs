//! Records of jobs in a database.

use std::time::Duration;

use futures_util::FutureExt;
use futures_util::future::BoxFuture;
use sqlx::any::AnyRow;
use sqlx::{Any, AnyConnection, AssertSqlSafe, Row, Transaction};

use super::database::Database;
use super::hints::Hints;
use super::{idempotency, reserve, rows, transitions};
use crate::jobs::{
    Beat, Capacity, Changed, Enqueued, Event, Happening, IdempotencyKey, Job, JobId, JobStore,
    Listing, Reason, Rules, State, StoreError, StoreResult, Sweep, Timestamp, WorkerId,
};

/// How long a call may take, a lost connection included.
const PATIENCE: Duration = Duration::from_secs(15);
/// Jobs that are looked at together.
const BATCH: usize = 64;
/// How long the job of a call is kept after its end, if the call does not remove it.
const EPHEMERAL_MS: i64 = 10 * 60_000;

/// Records in SQLite or PostgreSQL. Every change is one transaction, durable when the method returns;
/// a sweep is several.
pub struct RecordStore {
    database: Database,
    hints: Hints,
    rules: Rules,
}

impl RecordStore {
    /// Opens the database at a URL such as `sqlite:///folder/file?mode=rwc` or
    /// `postgres://user@host/name`.
    pub async fn open(url: &str, rules: Rules) -> StoreResult<Self> {
        let database = Database::open(url).await?;
        reserve::keep(&database).await?;
        Ok(Self {
            hints: Hints::of(url, database.dialect),
            database,
            rules,
        })
    }

    async fn enqueue_new(
        &self,
        job: &Job,
        key: Option<&IdempotencyKey>,
        capacity: Capacity,
    ) -> StoreResult<Enqueued> {
        let mut transaction = self.database.begin().await?;
        if let Some(lock) = self.database.dialect.lock_submissions() {
            sqlx::query(lock).execute(&mut *transaction).await?;
        }
        let (queued, now) = self.queued(&mut transaction).await?;
        let mut job = job.clone();
        (job.created, job.due) = (now, now);
        job.finished = job.finished.map(|_| now);
        if let Some(key) = key
            && let Some(earlier) =
                idempotency::earlier_use(&self.database, key, now, &mut transaction).await?
        {
            return Ok(earlier);
        }
        if job.state == State::Queued && i64::from(capacity.depth) <= queued {
            return Ok(Enqueued::Full);
        }
        if let Some(bytes) = capacity.bytes
            && bytes < stored_bytes(&mut transaction).await? + job.stored_bytes()
        {
            return Ok(Enqueued::OverQuota);
        }
        rows::insert(&job, &mut transaction).await?;
        if let Some(key) = key {
            idempotency::remember(key, &job, &mut transaction).await?;
        }
        self.hints.give(&job, &mut transaction).await?;
        transaction.commit().await.map_err(unanswered)?;
        Ok(Enqueued::New(Box::new(job)))
    }

    /// How many jobs wait, and what time it is.
    async fn queued(
        &self,
        transaction: &mut Transaction<'_, Any>,
    ) -> StoreResult<(i64, Timestamp)> {
        let count = "SELECT count(*) AS queued, {now} AS now FROM job WHERE state = 'queued'";
        let row = sqlx::query(self.database.sql(count))
            .fetch_one(&mut **transaction)
            .await?;
        Ok((row.try_get("queued")?, rows::now(&row)?))
    }

    async fn page(&self, listing: Listing) -> StoreResult<Vec<Job>> {
        let page = "SELECT {columns} FROM job
             WHERE ephemeral = 0 AND ($1 = '' OR state = $1) AND ($2 = '' OR id < $2)
             ORDER BY id DESC LIMIT $3";
        let found = sqlx::query(self.database.sql(page))
            .bind(listing.state.map_or("", State::word))
            .bind(listing.before.map_or_else(String::new, |id| id.to_string()))
            .bind(i64::from(listing.limit))
            .fetch_all(&self.database.readers)
            .await?;
        jobs(&found)
    }

    async fn events_of(&self, ids: &[JobId]) -> StoreResult<Vec<(JobId, Event)>> {
        let places: Vec<String> = (1..=BATCH).map(|place| format!("${place}")).collect();
        let statement = self.database.sql(&format!(
            "SELECT id, state, seq, progress, started, finished, {{now}} AS now
             FROM job WHERE id IN ({})",
            places.join(", ")
        ));
        let mut events = Vec::new();
        for batch in ids.chunks(BATCH) {
            let mut query = sqlx::query(AssertSqlSafe(statement.0.clone()));
            // One statement for all: the last batch is filled up with its own last id.
            for place in 0..BATCH {
                query = query.bind(batch[place.min(batch.len() - 1)].to_string());
            }
            for row in query.fetch_all(&self.database.readers).await? {
                events.push(rows::event(&row)?);
            }
        }
        Ok(events)
    }

    async fn counted(&self) -> StoreResult<Vec<(State, u64)>> {
        let found = sqlx::query("SELECT state, count(*) AS jobs FROM job GROUP BY state")
            .fetch_all(&self.database.readers)
            .await?;
        let mut counts = State::ALL.map(|state| (state, 0)).to_vec();
        for row in found {
            let state: State = rows::word(&row.try_get::<String, _>("state")?)?;
            let count: i64 = row.try_get("jobs")?;
            counts
                .iter_mut()
                .filter(|(s, _)| *s == state)
                .for_each(|c| c.1 = count as u64);
        }
        Ok(counts)
    }

    async fn ids(&self, statement: &str, numbers: &[i64]) -> StoreResult<Vec<JobId>> {
        let mut query = sqlx::query(self.database.sql(statement));
        for number in numbers {
            query = query.bind(*number);
        }
        let found = query.fetch_all(&self.database.readers).await?;
        found.iter().map(rows::id).collect()
    }
}

/// A call that does not wait for ever: a connection may be cut without anybody noticing.
fn bounded<'a, T: 'a>(
    call: impl Future<Output = StoreResult<T>> + Send + 'a,
) -> BoxFuture<'a, StoreResult<T>> {
    async move {
        let answer = tokio::time::timeout(PATIENCE, call).await;
        let detail = "the database did not answer in time";
        answer.unwrap_or_else(|_| Err(StoreError::Unanswered(detail.to_owned())))
    }
    .boxed()
}

impl JobStore for RecordStore {
    fn enqueue<'a>(
        &'a self,
        job: &'a Job,
        key: Option<&'a IdempotencyKey>,
        capacity: Capacity,
    ) -> BoxFuture<'a, StoreResult<Enqueued>> {
        bounded(self.enqueue_new(job, key, capacity))
    }

    fn get(&self, id: JobId) -> BoxFuture<'_, StoreResult<Option<Job>>> {
        bounded(async move {
            let job = self.database.sql("SELECT {columns} FROM job WHERE id = $1");
            let row = sqlx::query(job)
                .bind(id.to_string())
                .fetch_optional(&self.database.readers)
                .await?;
            row.as_ref().map(rows::job).transpose()
        })
    }

    fn list(&self, listing: Listing) -> BoxFuture<'_, StoreResult<Vec<Job>>> {
        bounded(self.page(listing))
    }

    fn events<'a>(&'a self, ids: &'a [JobId]) -> BoxFuture<'a, StoreResult<Vec<(JobId, Event)>>> {
        bounded(self.events_of(ids))
    }

    fn equal<'a>(&'a self, digest: &'a str) -> BoxFuture<'a, StoreResult<Vec<Job>>> {
        bounded(async move {
            let equal = "SELECT {columns} FROM job
                 WHERE digest = $1 AND state = 'succeeded' AND ephemeral = 0
                 ORDER BY id DESC LIMIT 4";
            let found = sqlx::query(self.database.sql(equal))
                .bind(digest)
                .fetch_all(&self.database.readers)
                .await?;
            jobs(&found)
        })
    }

    fn claim(&self, worker: WorkerId) -> BoxFuture<'_, StoreResult<Option<Job>>> {
        bounded(transitions::claim(&self.database, worker, &self.rules))
    }

    fn hint(&self) -> BoxFuture<'_, ()> {
        self.hints.next().boxed()
    }

    fn change<'a>(
        &'a self,
        id: JobId,
        happening: &'a Happening,
    ) -> BoxFuture<'a, StoreResult<Changed>> {
        bounded(transitions::change(
            &self.database,
            id,
            happening,
            &self.rules,
        ))
    }

    fn beat<'a>(&'a self, beats: &'a [Beat]) -> BoxFuture<'a, StoreResult<Vec<Changed>>> {
        bounded(transitions::beat(&self.database, beats, &self.rules))
    }

    fn sweep(&self, sweep: Sweep) -> BoxFuture<'_, StoreResult<Vec<Job>>> {
        bounded(transitions::sweep(&self.database, sweep, &self.rules))
    }

    fn delete(&self, id: JobId, reason: Reason) -> BoxFuture<'_, StoreResult<bool>> {
        bounded(transitions::delete(&self.database, id, reason))
    }

    fn has_expired(&self, id: JobId) -> BoxFuture<'_, StoreResult<bool>> {
        bounded(async move {
            let row = sqlx::query("SELECT id FROM expired WHERE id = $1")
                .bind(id.to_string())
                .fetch_optional(&self.database.readers)
                .await?;
            Ok(row.is_some())
        })
    }

    fn ended_before(&self, kept: Duration) -> BoxFuture<'_, StoreResult<Vec<JobId>>> {
        let kept_ms = kept.as_millis() as i64;
        bounded(async move {
            let ended = "SELECT id FROM job WHERE finished < {now} - $1
                         OR (ephemeral = 1 AND finished < {now} - $2) LIMIT 1000";
            self.ids(ended, &[kept_ms, EPHEMERAL_MS]).await
        })
    }

    fn ephemeral(&self) -> BoxFuture<'_, StoreResult<Vec<JobId>>> {
        bounded(self.ids("SELECT id FROM job WHERE ephemeral = 1", &[]))
    }

    fn counts(&self) -> BoxFuture<'_, StoreResult<Vec<(State, u64)>>> {
        bounded(self.counted())
    }

    fn stored_bytes(&self) -> BoxFuture<'_, StoreResult<u64>> {
        bounded(async move {
            let mut connection = self.database.readers.acquire().await?;
            stored_bytes(&mut connection).await
        })
    }

    fn check(&self) -> BoxFuture<'_, StoreResult<()>> {
        bounded(async move {
            // Whether records can be written cannot be told otherwise.
            sqlx::query(self.database.sql("UPDATE pulse SET at = {now}"))
                .execute(&self.database.writers)
                .await?;
            reserve::keep(&self.database).await
        })
    }
}

/// Why nobody knows whether a transaction was committed, if so.
fn unanswered(error: sqlx::Error) -> StoreError {
    match error.into() {
        StoreError::Unavailable(text) => StoreError::Unanswered(text),
        error => error,
    }
}

async fn stored_bytes(connection: &mut AnyConnection) -> StoreResult<u64> {
    let sum = "SELECT CAST(coalesce(sum(bytes), 0) AS BIGINT) AS bytes FROM job";
    let row = sqlx::query(sum).fetch_one(connection).await?;
    Ok(row.try_get::<i64, _>("bytes")? as u64)
}

fn jobs(found: &[AnyRow]) -> StoreResult<Vec<Job>> {
    found.iter().map(rows::job).collect()
}
