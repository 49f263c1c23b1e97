//! Records of jobs in SQLite.

use std::path::Path;

use futures_util::FutureExt;
use futures_util::future::BoxFuture;
use sqlx::sqlite::SqliteRow;
use sqlx::{Row, SqliteConnection};

use super::database::Database;
use super::{idempotency, reserve, rows};
use crate::jobs::{
    Capacity, Enqueued, Event, IdempotencyKey, Job, JobId, JobStore, Listing, State, StoreResult,
    Timestamp, Wish, next_attempt_seq,
};

/// Records in a database file. Every method is one transaction, durable when it returns.
pub struct SqliteStore {
    database: Database,
}

impl SqliteStore {
    /// Opens the database file, and makes it if need be.
    pub async fn open(file: &Path) -> StoreResult<Self> {
        let database = Database::open(file).await?;
        Ok(Self { database })
    }
}

impl JobStore for SqliteStore {
    fn enqueue<'a>(
        &'a self,
        job: &'a Job,
        key: Option<&'a IdempotencyKey>,
        capacity: Capacity,
    ) -> BoxFuture<'a, StoreResult<Enqueued>> {
        async move {
            let mut transaction = self.database.begin().await?;
            if let Some(key) = key
                && let Some(earlier) =
                    idempotency::earlier_use(key, job.created, &mut transaction).await?
            {
                return Ok(earlier);
            }
            let queued: i64 = sqlx::query("SELECT count(*) FROM job WHERE state = 'queued'")
                .fetch_one(&mut *transaction)
                .await?
                .try_get(0)?;
            if i64::from(capacity.depth) <= queued {
                return Ok(Enqueued::Full);
            }
            if let Some(bytes) = capacity.bytes
                && bytes < stored_bytes(&mut transaction).await? + job.stored_bytes()
            {
                return Ok(Enqueued::OverQuota);
            }
            rows::insert(job, &mut transaction).await?;
            if let Some(key) = key {
                idempotency::remember(key, job, &mut transaction).await?;
            }
            transaction.commit().await?;
            Ok(Enqueued::New)
        }
        .boxed()
    }

    fn get(&self, id: JobId) -> BoxFuture<'_, StoreResult<Option<Job>>> {
        async move {
            let row = sqlx::query("SELECT * FROM job WHERE id = ?")
                .bind(id.to_string())
                .fetch_optional(&self.database.pool)
                .await?;
            row.as_ref().map(rows::job).transpose()
        }
        .boxed()
    }

    fn list(&self, listing: Listing) -> BoxFuture<'_, StoreResult<Vec<Job>>> {
        async move {
            let found = sqlx::query(
                "SELECT * FROM job
                 WHERE NOT ephemeral AND (?1 IS NULL OR state = ?1) AND (?2 IS NULL OR id < ?2)
                 ORDER BY id DESC LIMIT ?3",
            )
            .bind(listing.state.map(State::word))
            .bind(listing.before.map(|id| id.to_string()))
            .bind(i64::from(listing.limit))
            .fetch_all(&self.database.pool)
            .await?;
            jobs(&found)
        }
        .boxed()
    }

    fn claim(&self) -> BoxFuture<'_, StoreResult<Option<Job>>> {
        async move {
            let mut transaction = self.database.begin().await?;
            let oldest = "SELECT * FROM job WHERE state = 'queued' ORDER BY id LIMIT 1";
            let Some(row) = sqlx::query(oldest)
                .fetch_optional(&mut *transaction)
                .await?
            else {
                return Ok(None);
            };
            let mut job = rows::job(&row)?;
            job.state = State::Running;
            job.attempt += 1;
            job.seq = next_attempt_seq(job.seq);
            job.started = Some(Timestamp::now());
            sqlx::query(
                "UPDATE job SET state = 'running', attempt = ?, seq = ?, started = ? WHERE id = ?",
            )
            .bind(i64::from(job.attempt))
            .bind(job.seq as i64)
            .bind(job.started.map(|time| time.0))
            .bind(job.id.to_string())
            .execute(&mut *transaction)
            .await?;
            transaction.commit().await?;
            Ok(Some(job))
        }
        .boxed()
    }

    fn record_progress(
        &self,
        id: JobId,
        attempt: u32,
        event: Event,
    ) -> BoxFuture<'static, StoreResult<()>> {
        let pool = self.database.pool.clone();
        async move {
            sqlx::query(
                "UPDATE job SET seq = ?, progress = ? WHERE id = ? AND attempt = ? AND state = 'running'",
            )
            .bind(event.seq as i64)
            .bind(rows::json(&event.progress)?)
            .bind(id.to_string())
            .bind(i64::from(attempt))
            .execute(&pool)
            .await?;
            Ok(())
        }
        .boxed()
    }

    fn update<'a>(&'a self, job: &'a Job) -> BoxFuture<'a, StoreResult<bool>> {
        async move {
            let failure = job.failure.as_ref().map(rows::json).transpose()?;
            let changed = sqlx::query(
                "UPDATE job SET state = ?, output = ?, verdict = ?, seq = ?, progress = ?, failure = ?, finished = ?, bytes = ?
                 WHERE id = ? AND attempt = ? AND state IN ('queued', 'running')",
            )
            .bind(job.state.word())
            .bind(rows::json(&job.output)?)
            .bind(rows::json(&job.verdict)?)
            .bind(job.seq as i64)
            .bind(rows::json(&job.progress)?)
            .bind(failure)
            .bind(job.finished.map(|time| time.0))
            .bind(job.stored_bytes() as i64)
            .bind(job.id.to_string())
            .bind(i64::from(job.attempt))
            .execute(&self.database.pool)
            .await?;
            Ok(changed.rows_affected() == 1)
        }
        .boxed()
    }

    fn wish(&self, id: JobId, wish: Wish) -> BoxFuture<'_, StoreResult<Option<Job>>> {
        async move {
            let mut transaction = self.database.begin().await?;
            let recorded = match wish {
                Wish::Cancel => {
                    "UPDATE job SET cancel = 1, seq = seq + (state = 'queued'),
                                    finished = iif(state = 'queued', ?2, NULL),
                                    bytes = iif(state = 'queued', 0, bytes),
                                    state = iif(state = 'queued', 'cancelled', state)
                     WHERE id = ?1 AND state IN ('queued', 'running')"
                }
                Wish::FinishEarly => {
                    "UPDATE job SET finish_early = 1
                     WHERE id = ?1 AND state IN ('queued', 'running') AND ?2 IS NOT NULL"
                }
            };
            sqlx::query(recorded)
                .bind(id.to_string())
                .bind(Timestamp::now().0)
                .execute(&mut *transaction)
                .await?;
            let row = sqlx::query("SELECT * FROM job WHERE id = ?")
                .bind(id.to_string())
                .fetch_optional(&mut *transaction)
                .await?;
            transaction.commit().await?;
            row.as_ref().map(rows::job).transpose()
        }
        .boxed()
    }

    fn recover(&self) -> BoxFuture<'_, StoreResult<Vec<Job>>> {
        async move {
            let mut transaction = self.database.begin().await?;
            sqlx::query(
                "UPDATE job SET state = 'cancelled', seq = seq + 1, bytes = 0, finished = ?
                 WHERE state IN ('queued', 'running') AND cancel",
            )
            .bind(Timestamp::now().0)
            .execute(&mut *transaction)
            .await?;
            sqlx::query("UPDATE job SET state = 'queued', lost = lost + 1 WHERE state = 'running'")
                .execute(&mut *transaction)
                .await?;
            let found = sqlx::query("SELECT * FROM job WHERE state = 'queued' OR ephemeral")
                .fetch_all(&mut *transaction)
                .await?;
            transaction.commit().await?;
            jobs(&found)
        }
        .boxed()
    }

    fn delete(&self, id: JobId) -> BoxFuture<'_, StoreResult<()>> {
        async move {
            sqlx::query("DELETE FROM job WHERE id = ?")
                .bind(id.to_string())
                .execute(&self.database.pool)
                .await?;
            Ok(())
        }
        .boxed()
    }

    fn ended_before(&self, moment: Timestamp) -> BoxFuture<'_, StoreResult<Vec<JobId>>> {
        async move {
            let found = sqlx::query("SELECT id FROM job WHERE finished < ?")
                .bind(moment.0)
                .fetch_all(&self.database.pool)
                .await?;
            found.iter().map(rows::id).collect()
        }
        .boxed()
    }

    fn counts(&self) -> BoxFuture<'_, StoreResult<Vec<(State, u64)>>> {
        async move {
            let found = sqlx::query("SELECT state, count(*) FROM job GROUP BY state")
                .fetch_all(&self.database.pool)
                .await?;
            let mut counts = State::ALL.map(|state| (state, 0)).to_vec();
            for row in found {
                let state: State = rows::word(&row.try_get::<String, _>(0)?)?;
                let count: i64 = row.try_get(1)?;
                counts
                    .iter_mut()
                    .filter(|(s, _)| *s == state)
                    .for_each(|c| c.1 = count as u64);
            }
            Ok(counts)
        }
        .boxed()
    }

    fn stored_bytes(&self) -> BoxFuture<'_, StoreResult<u64>> {
        async move {
            let mut connection = self.database.pool.acquire().await?;
            stored_bytes(&mut connection).await
        }
        .boxed()
    }

    fn check(&self) -> BoxFuture<'_, StoreResult<()>> {
        async move {
            reserve::write(&self.database.pool).await?;
            reserve::keep(&self.database.pool).await
        }
        .boxed()
    }
}

async fn stored_bytes(connection: &mut SqliteConnection) -> StoreResult<u64> {
    let sum: i64 = sqlx::query("SELECT coalesce(sum(bytes), 0) FROM job")
        .fetch_one(connection)
        .await?
        .try_get(0)?;
    Ok(sum as u64)
}

fn jobs(found: &[SqliteRow]) -> StoreResult<Vec<Job>> {
    found.iter().map(rows::job).collect()
}
