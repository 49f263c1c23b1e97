//! The job store in a database: the store itself, pages of jobs, reserved space, identity, clock and quarantine.

use std::time::Duration;

use futures_util::FutureExt;
use futures_util::future::BoxFuture;
use sqlx::any::AnyRow;
use sqlx::query::Query;
use sqlx::{Any, AssertSqlSafe, Row};

use super::database::{Database, Dialect};
use super::enqueue::{self, Hints, enqueue};
use super::reading::{self, stored_bytes, within};
use super::{rows, transitions};
use crate::jobs::access::{Owner, Visibility};
use crate::jobs::{
    Capacity, Census, Changed, Enqueued, Event, Heartbeat, IdempotencyKey, Job, JobId, JobStore,
    Listing, Order, Quarantined, Queue, Reason, Rules, Share, State, StoreError, StoreId,
    StoreResult, Sweep, Timestamp, Transition, WorkerId,
};
use unwrapd_api::Kind;

/// Time limit of a call, including a lost connection. A longer limit delays the answers of an unreachable store; a
/// shorter one would end before the time limit for connecting can tell the cause.
const PATIENCE: Duration = Duration::from_secs(15);
/// Time for which the job of a synchronous request is kept after its end, if the request does not remove it. It is
/// longer than the time that a dismissal waits for the end.
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
        keep(&database).await?;
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
        bounded(enqueue(&self.database, &self.hints, job, key, capacity))
    }

    fn get<'a>(
        &'a self,
        visibility: &'a Visibility,
        id: JobId,
    ) -> BoxFuture<'a, StoreResult<Option<Job>>> {
        bounded(reading::one(&self.database, visibility, id))
    }

    fn list<'a>(
        &'a self,
        visibility: &'a Visibility,
        listing: &'a Listing,
    ) -> BoxFuture<'a, StoreResult<Vec<Job>>> {
        bounded(page(&self.database, visibility, listing))
    }

    fn events<'a>(&'a self, ids: &'a [JobId]) -> BoxFuture<'a, StoreResult<Vec<(JobId, Event)>>> {
        bounded(reading::events(&self.database, ids))
    }

    fn equal<'a>(&'a self, job: &'a Job) -> BoxFuture<'a, StoreResult<Vec<Job>>> {
        bounded(reading::equal(&self.database, job))
    }

    fn claim(&self, worker: WorkerId, share: Share) -> BoxFuture<'_, StoreResult<Option<Job>>> {
        let claim = transitions::claim(&self.database, worker, share, &self.rules);
        bounded(claim)
    }

    fn set_paused(&self, paused: bool) -> BoxFuture<'_, StoreResult<()>> {
        bounded(transitions::set_paused(&self.database, paused))
    }

    fn is_paused(&self) -> BoxFuture<'_, StoreResult<bool>> {
        bounded(transitions::is_paused(&self.database))
    }

    fn ended_within(&self, time: Duration) -> BoxFuture<'_, StoreResult<u64>> {
        bounded(reading::ended_within(&self.database, time))
    }

    fn hint(&self) -> BoxFuture<'_, ()> {
        self.hints.next().boxed()
    }

    fn change<'a>(
        &'a self,
        visibility: &'a Visibility,
        id: JobId,
        transition: &'a Transition,
    ) -> BoxFuture<'a, StoreResult<Changed>> {
        bounded(transitions::change(
            &self.database,
            visibility,
            id,
            transition,
            &self.rules,
        ))
    }

    fn heartbeat<'a>(
        &'a self,
        heartbeats: &'a [Heartbeat],
    ) -> BoxFuture<'a, StoreResult<Vec<Changed>>> {
        bounded(transitions::heartbeat(
            &self.database,
            heartbeats,
            &self.rules,
        ))
    }

    fn sweep(&self, sweep: Sweep) -> BoxFuture<'_, StoreResult<Vec<Job>>> {
        bounded(transitions::sweep(&self.database, sweep, &self.rules))
    }

    fn delete<'a>(
        &'a self,
        visibility: &'a Visibility,
        id: JobId,
        reason: Reason,
    ) -> BoxFuture<'a, StoreResult<bool>> {
        bounded(transitions::delete(&self.database, visibility, id, reason))
    }

    fn has_expired<'a>(
        &'a self,
        visibility: &'a Visibility,
        id: JobId,
    ) -> BoxFuture<'a, StoreResult<bool>> {
        bounded(reading::has_expired(&self.database, visibility, id))
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
        bounded(enqueue::forget(&self.database))
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
            stored_bytes(&mut connection).await
        })
    }

    fn now(&self) -> BoxFuture<'_, StoreResult<Timestamp>> {
        bounded(now(&self.database))
    }

    fn identity(&self) -> BoxFuture<'_, StoreResult<Option<StoreId>>> {
        bounded(identity(&self.database))
    }

    fn identify(&self, identity: StoreId) -> BoxFuture<'_, StoreResult<StoreId>> {
        bounded(identify(&self.database, identity))
    }

    fn census(&self) -> BoxFuture<'_, StoreResult<Census>> {
        bounded(census(&self.database))
    }

    fn quarantine<'a>(&'a self, files: &'a [(JobId, u64)]) -> BoxFuture<'a, StoreResult<()>> {
        bounded(quarantine(&self.database, files))
    }

    fn quarantined(&self) -> BoxFuture<'_, StoreResult<Vec<Quarantined>>> {
        bounded(quarantined(&self.database))
    }

    fn release<'a>(&'a self, jobs: &'a [JobId]) -> BoxFuture<'a, StoreResult<()>> {
        bounded(release(&self.database, jobs))
    }

    fn spoil(&self, id: JobId) -> BoxFuture<'_, StoreResult<()>> {
        bounded(spoil(&self.database, id))
    }

    fn check(&self) -> BoxFuture<'_, StoreResult<()>> {
        bounded(async move {
            // Only writing shows whether records can be written.
            let written = sqlx::query(self.database.sql("UPDATE pulse SET at = {now}"))
                .execute(&self.database.writers)
                .await;
            if let Err(error) = written {
                return Err(self.database.explained(error.into()).await);
            }
            keep(&self.database).await
        })
    }
}

// Pages of the job list.

/// A bound value of a statement.
enum BoundValue {
    Text(String),
    Number(i64),
}

/// Conditions joined by AND, with the values of their placeholders in order.
#[derive(Default)]
struct Conditions {
    texts: Vec<String>,
    values: Vec<BoundValue>,
}

impl Conditions {
    /// Adds a condition, in which `?` is the placeholder of its value.
    fn add(&mut self, condition: &str, value: BoundValue) {
        self.values.push(value);
        let place = format!("${}", self.values.len());
        self.texts.push(condition.replace('?', &place));
    }

    fn words(&mut self, condition: &str, word: Option<&str>) {
        if let Some(word) = word {
            self.add(condition, BoundValue::Text(word.to_owned()));
        }
    }

    fn numbers(&mut self, condition: &str, number: Option<i64>) {
        if let Some(number) = number {
            self.add(condition, BoundValue::Number(number));
        }
    }
}

/// Jobs that are read at once while words are searched. Fewer make more queries, more make a page wait for longer.
const SEARCHED: u32 = 500;

/// Returns a page of jobs, without those of synchronous requests.
async fn page(
    database: &Database,
    visibility: &Visibility,
    listing: &Listing,
) -> StoreResult<Vec<Job>> {
    let limit = match listing.words[..] {
        [] => listing.limit,
        _ => listing.limit.max(SEARCHED),
    };
    let mut found = Vec::new();
    let mut after = listing.after;
    loop {
        let jobs = candidates(database, visibility, listing, after, limit).await?;
        let is_last = jobs.len() < limit as usize;
        after = jobs.last().map(|job| job.id);
        found.extend(jobs.into_iter().filter(|it| it.is_found_by(&listing.words)));
        if is_last || listing.limit as usize <= found.len() {
            found.truncate(listing.limit as usize);
            return Ok(found);
        }
    }
}

/// Returns up to `limit` jobs after a cursor that meet all filters but perhaps the words.
async fn candidates(
    database: &Database,
    visibility: &Visibility,
    listing: &Listing,
    after: Option<JobId>,
    limit: u32,
) -> StoreResult<Vec<Job>> {
    // Collect the conditions: scope, filters and metadata.
    let (within, owner) = within(visibility, 1);
    let mut met = Conditions::default();
    met.texts.push(format!("ephemeral = 0 AND {within}"));
    met.values.push(BoundValue::Text(owner.to_owned()));
    met.words("state = ?", listing.state.map(State::word));
    met.words("kind = ?", listing.kind.map(Kind::word));
    met.words("owner = ?", listing.owner.as_ref().map(Owner::as_str));
    met.numbers("? <= created", listing.since.map(|time| time.0));
    met.numbers("created < ?", listing.until.map(|time| time.0));
    let labelled = "id IN (SELECT job FROM label WHERE digest = ?)";
    for label in listing.metadata.labels() {
        met.add(labelled, BoundValue::Text(label));
    }
    // Leave out most jobs that do not have the words. Databases differ in the case of other letters, and JSON escapes signs.
    let is_plain = |word: &&String| word.bytes().all(|byte| byte.is_ascii_alphanumeric());
    for word in listing.words.iter().filter(is_plain) {
        let pattern = BoundValue::Text(format!("%{word}%"));
        met.add("lower(input || coalesce(metadata, '')) LIKE ?", pattern);
    }
    // Continue after the cursor, in the order of ids.
    let (beyond, direction) = match listing.order {
        Order::NewestFirst => ("id < ?", "DESC"),
        Order::OldestFirst => ("? < id", "ASC"),
    };
    let after = after.map(|id| id.to_string());
    met.words(beyond, after.as_deref());
    met.values.push(BoundValue::Number(i64::from(limit)));
    // Read the jobs.
    let page = format!(
        "SELECT {{columns}} FROM job WHERE {} ORDER BY id {direction} LIMIT ${}",
        met.texts.join(" AND "),
        met.values.len()
    );
    let found = bound(database.sql(&page), met.values)
        .fetch_all(&database.readers)
        .await?;
    found.iter().map(rows::job).collect()
}

fn bound(
    statement: AssertSqlSafe<String>,
    values: Vec<BoundValue>,
) -> Query<'static, Any, <Any as sqlx::Database>::Arguments> {
    let statement = sqlx::query(statement);
    values
        .into_iter()
        .fold(statement, |query, value| match value {
            BoundValue::Text(text) => query.bind(text),
            BoundValue::Number(number) => query.bind(number),
        })
}

// Reserved disk space for records, so that jobs can end and be deleted on a full disk.

/// Bytes of free pages, and of the log. A record takes about two thousand bytes, so two thousand records fit.
const RESERVE: i64 = 4 << 20;
/// Number of free bytes below which the reserve is refilled. A higher value refills more often, a lower one leaves
/// less for a disk that fills up just before.
const LEAST: i64 = RESERVE / 4;

/// Refills the reserve of SQLite if it is low. One transaction of that size makes the log as long.
async fn keep(database: &Database) -> StoreResult<()> {
    if database.dialect != Dialect::Sqlite {
        return Ok(());
    }
    // Check whether enough free pages are left.
    let free = "SELECT freelist_count * page_size FROM pragma_freelist_count, pragma_page_size";
    let row = sqlx::query(free).fetch_one(&database.readers).await?;
    if LEAST <= row.try_get::<i64, _>(0)? {
        return Ok(());
    }
    let mut transaction = database.begin().await?;
    // Write a table of that size and drop it, which leaves its pages free.
    sqlx::raw_sql("CREATE TABLE reserve (bytes BLOB)")
        .execute(&mut *transaction)
        .await?;
    sqlx::query("INSERT INTO reserve VALUES (zeroblob($1))")
        .bind(RESERVE)
        .execute(&mut *transaction)
        .await?;
    sqlx::raw_sql("DROP TABLE reserve")
        .execute(&mut *transaction)
        .await?;
    transaction.commit().await?;
    Ok(())
}

// Facts about the store as a whole: identity, clock, files without a job.

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
async fn census(database: &Database) -> StoreResult<Census> {
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
async fn release(database: &Database, jobs: &[JobId]) -> StoreResult<()> {
    for job in jobs {
        sqlx::query("DELETE FROM quarantine WHERE job = $1")
            .bind(job.to_string())
            .execute(&database.writers)
            .await?;
    }
    Ok(())
}

/// Excludes a job with damaged files from being copied, by clearing its digest.
async fn spoil(database: &Database, id: JobId) -> StoreResult<()> {
    sqlx::query("UPDATE job SET digest = '' WHERE id = $1")
        .bind(id.to_string())
        .execute(&database.writers)
        .await?;
    Ok(())
}
