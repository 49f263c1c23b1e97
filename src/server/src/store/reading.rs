//! Read-only queries of job records.

use std::time::Duration;

use sqlx::any::AnyRow;
use sqlx::{AnyConnection, AssertSqlSafe, Row};

use super::database::Database;
use super::rows;
use crate::jobs::access::Visibility;
use crate::jobs::{Event, Job, JobId, Queue, State, StoreResult};

/// Number of jobs per query. The statement has a placeholder for each, so a larger number wastes bindings on small
/// batches, and a smaller one needs more queries.
const BATCH: usize = 64;

/// Returns the job with this id if it is visible.
pub(super) async fn one(
    database: &Database,
    visibility: &Visibility,
    id: JobId,
) -> StoreResult<Option<Job>> {
    let (within, owner) = within(visibility, 2);
    let one = format!("SELECT {{columns}} FROM job WHERE id = $1 AND {within}");
    let row = sqlx::query(database.sql(&one))
        .bind(id.to_string())
        .bind(owner)
        .fetch_optional(&database.readers)
        .await?;
    row.as_ref().map(rows::job).transpose()
}

/// Returns whether there was a job with this id until it expired.
pub(super) async fn has_expired(
    database: &Database,
    visibility: &Visibility,
    id: JobId,
) -> StoreResult<bool> {
    let (within, owner) = within(visibility, 2);
    let one = format!("SELECT id FROM expired WHERE id = $1 AND {within}");
    let row = sqlx::query(database.sql(&one))
        .bind(id.to_string())
        .bind(owner)
        .fetch_optional(&database.readers)
        .await?;
    Ok(row.is_some())
}

/// Returns the latest succeeded jobs with the same digest and owner, at most four.
pub(super) async fn equal(database: &Database, job: &Job) -> StoreResult<Vec<Job>> {
    let equal = "SELECT {columns} FROM job
         WHERE digest = $1 AND owner = $2 AND state = 'succeeded' AND ephemeral = 0
         ORDER BY id DESC LIMIT 4";
    let found = sqlx::query(database.sql(equal))
        .bind(&job.digest)
        .bind(job.owner.as_str())
        .fetch_all(&database.readers)
        .await?;
    jobs(&found)
}

/// Returns the current events of those of these jobs that exist.
pub(super) async fn events(database: &Database, ids: &[JobId]) -> StoreResult<Vec<(JobId, Event)>> {
    let places: Vec<String> = (1..=BATCH).map(|place| format!("${place}")).collect();
    let statement = database.sql(&format!(
        "SELECT id, state, seq, progress, started, finished, {{now}} AS now
         FROM job WHERE id IN ({})",
        places.join(", ")
    ));
    let mut events = Vec::new();
    for batch in ids.chunks(BATCH) {
        let mut query = sqlx::query(AssertSqlSafe(statement.0.clone()));
        // Use one statement for all batches: fill up the last one with its own last id.
        for place in 0..BATCH {
            query = query.bind(batch[place.min(batch.len() - 1)].to_string());
        }
        for row in query.fetch_all(&database.readers).await? {
            events.push(rows::event(&row)?);
        }
    }
    Ok(events)
}

/// Returns the number of jobs in each state, and the wait of the oldest queued job.
pub(super) async fn queue(database: &Database) -> StoreResult<Queue> {
    let oldest = "SELECT coalesce({now} - min(created), 0) AS waits
         FROM job WHERE state = 'queued'";
    let row = sqlx::query(database.sql(oldest))
        .fetch_one(&database.readers)
        .await?;
    let waits: i64 = row.try_get("waits")?;
    Ok(Queue {
        counts: counts(database).await?,
        oldest_wait: Duration::from_millis(waits.max(0) as u64),
    })
}

/// Returns the number of jobs that were computed and ended within this time before now.
pub(super) async fn ended_within(database: &Database, time: Duration) -> StoreResult<u64> {
    let ended = "SELECT count(*) AS jobs FROM job
         WHERE {now} - $1 < finished AND started IS NOT NULL";
    let row = sqlx::query(database.sql(ended))
        .bind(time.as_millis() as i64)
        .fetch_one(&database.readers)
        .await?;
    Ok(row.try_get::<i64, _>("jobs")? as u64)
}

async fn counts(database: &Database) -> StoreResult<Vec<(State, u64)>> {
    let found = sqlx::query("SELECT state, count(*) AS jobs FROM job GROUP BY state")
        .fetch_all(&database.readers)
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

/// Returns the ids found by a statement with these bound numbers.
pub(super) async fn ids(
    database: &Database,
    statement: &str,
    numbers: &[i64],
) -> StoreResult<Vec<JobId>> {
    let mut query = sqlx::query(database.sql(statement));
    for number in numbers {
        query = query.bind(*number);
    }
    let found = query.fetch_all(&database.readers).await?;
    found.iter().map(rows::id).collect()
}

/// Returns the bytes of the files of all jobs, including quarantined files.
pub(super) async fn stored_bytes(connection: &mut AnyConnection) -> StoreResult<u64> {
    let sum = "SELECT CAST(coalesce((SELECT sum(bytes) FROM job), 0)
         + coalesce((SELECT sum(bytes) FROM quarantine), 0) AS BIGINT) AS bytes";
    let row = sqlx::query(sum).fetch_one(connection).await?;
    Ok(row.try_get::<i64, _>("bytes")? as u64)
}

/// Reads jobs from rows.
fn jobs(found: &[AnyRow]) -> StoreResult<Vec<Job>> {
    found.iter().map(rows::job).collect()
}

// Visibility of a request in SQL.

/// Returns the condition that a row is visible, and the value to bind to its placeholder.
pub(super) fn within(visibility: &Visibility, place: u8) -> (String, &str) {
    match visibility {
        Visibility::Own(owner) => (format!("owner = ${place}"), owner.as_str()),
        // Names of owners cannot contain this character. The placeholder must be used, since every caller binds it.
        Visibility::All => (format!("${place} = '*'"), "*"),
    }
}
