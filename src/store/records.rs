//! Records of jobs in a database.

use std::time::Duration;

use futures_util::FutureExt;
use futures_util::future::BoxFuture;

use super::database::Database;
use super::hints::Hints;
use super::{reading, reserve, rows, submissions, transitions};
use crate::jobs::{
    Beat, Capacity, Changed, Enqueued, Event, Happening, IdempotencyKey, Job, JobId, JobStore,
    Listing, Reason, Rules, State, StoreError, StoreResult, Sweep, WorkerId,
};

/// How long a call may take, a lost connection included.
const PATIENCE: Duration = Duration::from_secs(15);
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
        bounded(submissions::enqueue(
            &self.database,
            &self.hints,
            job,
            key,
            capacity,
        ))
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
        bounded(reading::page(&self.database, listing))
    }

    fn events<'a>(&'a self, ids: &'a [JobId]) -> BoxFuture<'a, StoreResult<Vec<(JobId, Event)>>> {
        bounded(reading::events(&self.database, ids))
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
            reading::jobs(&found)
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
            reading::ids(&self.database, ended, &[kept_ms, EPHEMERAL_MS]).await
        })
    }

    fn ephemeral(&self) -> BoxFuture<'_, StoreResult<Vec<JobId>>> {
        bounded(reading::ids(
            &self.database,
            "SELECT id FROM job WHERE ephemeral = 1",
            &[],
        ))
    }

    fn counts(&self) -> BoxFuture<'_, StoreResult<Vec<(State, u64)>>> {
        bounded(reading::counts(&self.database))
    }

    fn stored_bytes(&self) -> BoxFuture<'_, StoreResult<u64>> {
        bounded(async move {
            let mut connection = self.database.readers.acquire().await?;
            reading::stored_bytes(&mut connection).await
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
