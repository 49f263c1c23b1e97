//! The job store in a database.

use std::time::Duration;

use futures_util::FutureExt;
use futures_util::future::BoxFuture;

use super::database::Database;
use super::hints::Hints;
use super::{claims, idempotency, listing, reading, reserve, submissions, transitions, upkeep};
use crate::jobs::access::Reach;
use crate::jobs::{
    Beat, Capacity, Census, Changed, Enqueued, Event, Happening, IdempotencyKey, Job, JobId,
    JobStore, Listing, Quarantined, Queue, Reason, Rules, Share, StoreError, StoreId, StoreResult,
    Sweep, Timestamp, WorkerId,
};

/// Time limit of a call, including a lost connection.
const PATIENCE: Duration = Duration::from_secs(15);
/// Time for which the job of a synchronous request is kept after its end, if the request does not remove it.
const EPHEMERAL_MS: i64 = 10 * 60_000;

/// Records in SQLite or PostgreSQL. Every change is one transaction, durable when the method returns;
/// a sweep is several.
pub struct RecordStore {
    pub(super) database: Database,
    hints: Hints,
    rules: Rules,
}

impl RecordStore {
    /// Opens the database at a URL such as `sqlite:///folder/file?mode=rwc` or `postgres://user@host/name`.
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

/// Limits the duration of a call, since a connection may be silently cut.
pub(super) fn bounded<'a, T: 'a>(
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

    fn get<'a>(&'a self, reach: &'a Reach, id: JobId) -> BoxFuture<'a, StoreResult<Option<Job>>> {
        bounded(reading::one(&self.database, reach, id))
    }

    fn list<'a>(
        &'a self,
        reach: &'a Reach,
        listing: &'a Listing,
    ) -> BoxFuture<'a, StoreResult<Vec<Job>>> {
        bounded(listing::page(&self.database, reach, listing))
    }

    fn events<'a>(&'a self, ids: &'a [JobId]) -> BoxFuture<'a, StoreResult<Vec<(JobId, Event)>>> {
        bounded(reading::events(&self.database, ids))
    }

    fn equal<'a>(&'a self, job: &'a Job) -> BoxFuture<'a, StoreResult<Vec<Job>>> {
        bounded(reading::equal(&self.database, job))
    }

    fn claim(&self, worker: WorkerId, share: Share) -> BoxFuture<'_, StoreResult<Option<Job>>> {
        let claim = claims::claim(&self.database, worker, share, &self.rules);
        bounded(claim)
    }

    fn set_paused(&self, paused: bool) -> BoxFuture<'_, StoreResult<()>> {
        bounded(claims::set_paused(&self.database, paused))
    }

    fn is_paused(&self) -> BoxFuture<'_, StoreResult<bool>> {
        bounded(claims::is_paused(&self.database))
    }

    fn ended_within(&self, time: Duration) -> BoxFuture<'_, StoreResult<u64>> {
        bounded(reading::ended_within(&self.database, time))
    }

    fn hint(&self) -> BoxFuture<'_, ()> {
        self.hints.next().boxed()
    }

    fn change<'a>(
        &'a self,
        reach: &'a Reach,
        id: JobId,
        happening: &'a Happening,
    ) -> BoxFuture<'a, StoreResult<Changed>> {
        bounded(transitions::change(
            &self.database,
            reach,
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

    fn delete<'a>(
        &'a self,
        reach: &'a Reach,
        id: JobId,
        reason: Reason,
    ) -> BoxFuture<'a, StoreResult<bool>> {
        bounded(transitions::delete(&self.database, reach, id, reason))
    }

    fn has_expired<'a>(&'a self, reach: &'a Reach, id: JobId) -> BoxFuture<'a, StoreResult<bool>> {
        bounded(reading::has_expired(&self.database, reach, id))
    }

    fn ended_before(&self, kept: Duration) -> BoxFuture<'_, StoreResult<Vec<JobId>>> {
        let kept_ms = kept.as_millis() as i64;
        bounded(async move {
            let ended = "SELECT id FROM job WHERE finished < {now} - $1
                         OR (ephemeral = 1 AND finished < {now} - $2) LIMIT 1000";
            reading::ids(&self.database, ended, &[kept_ms, EPHEMERAL_MS]).await
        })
    }

    fn forget_keys(&self) -> BoxFuture<'_, StoreResult<()>> {
        bounded(idempotency::forget(&self.database))
    }

    fn ephemeral(&self) -> BoxFuture<'_, StoreResult<Vec<JobId>>> {
        bounded(reading::ids(
            &self.database,
            "SELECT id FROM job WHERE ephemeral = 1",
            &[],
        ))
    }

    fn queue(&self) -> BoxFuture<'_, StoreResult<Queue>> {
        bounded(reading::queue(&self.database))
    }

    fn stored_bytes(&self) -> BoxFuture<'_, StoreResult<u64>> {
        bounded(async move {
            let mut connection = self.database.readers.acquire().await?;
            reading::stored_bytes(&mut connection).await
        })
    }

    fn now(&self) -> BoxFuture<'_, StoreResult<Timestamp>> {
        bounded(upkeep::now(&self.database))
    }

    fn identity(&self) -> BoxFuture<'_, StoreResult<Option<StoreId>>> {
        bounded(upkeep::identity(&self.database))
    }

    fn identify(&self, identity: StoreId) -> BoxFuture<'_, StoreResult<StoreId>> {
        bounded(upkeep::identify(&self.database, identity))
    }

    fn census(&self) -> BoxFuture<'_, StoreResult<Census>> {
        bounded(upkeep::census(&self.database))
    }

    fn quarantine<'a>(&'a self, files: &'a [(JobId, u64)]) -> BoxFuture<'a, StoreResult<()>> {
        bounded(upkeep::quarantine(&self.database, files))
    }

    fn quarantined(&self) -> BoxFuture<'_, StoreResult<Vec<Quarantined>>> {
        bounded(upkeep::quarantined(&self.database))
    }

    fn release<'a>(&'a self, jobs: &'a [JobId]) -> BoxFuture<'a, StoreResult<()>> {
        bounded(upkeep::release(&self.database, jobs))
    }

    fn spoil(&self, id: JobId) -> BoxFuture<'_, StoreResult<()>> {
        bounded(upkeep::spoil(&self.database, id))
    }

    fn check(&self) -> BoxFuture<'_, StoreResult<()>> {
        bounded(async move {
            // Whether records can be written cannot be told otherwise.
            let written = sqlx::query(self.database.sql("UPDATE pulse SET at = {now}"))
                .execute(&self.database.writers)
                .await;
            if let Err(error) = written {
                return Err(self.database.explained(error.into()).await);
            }
            reserve::keep(&self.database).await
        })
    }
}
