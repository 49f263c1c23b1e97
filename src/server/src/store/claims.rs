//! Who gets which job: owners take turns.
//!
//! The next job is one of the owner who has the fewest running, and among those of the one whose
//! last start was longest ago. Priorities order the jobs of one owner, never those of two. So
//! whoever submits a thousand jobs waits for them, and nobody else does.

use sqlx::{Any, Row, Transaction};

use super::database::Database;
use super::transitions::written;
use crate::jobs::{Changed, Happening, Job, Rules, SUSPECT, Share, StoreResult, WorkerId};

/// Which queued jobs may be started, of at most so many bytes. No pause is longer than the longest:
/// one that is was made before the clock was set back. A busy worker ($3 = 1) gets no job that was
/// lost with so many workers ($4), and none at all while such a one has waited for five minutes.
const DUE: &str = "job.state = 'queued' AND (job.due <= {now} OR {now} + $1 < job.due)
     AND job.bytes <= $2 AND NOT EXISTS (SELECT id FROM pause)
     AND ($3 = 0 OR (job.interrupted < $4 AND NOT EXISTS (
         SELECT suspect.id FROM job AS suspect WHERE suspect.state = 'queued'
         AND $4 <= suspect.interrupted AND suspect.due <= {now} - 300000)))";

/// Gives the next job of its share to a worker.
pub(super) async fn claim(
    database: &Database,
    worker: WorkerId,
    share: Share,
    rules: &Rules,
) -> StoreResult<Option<Job>> {
    let longest_pause = rules.longest_pause().as_millis() as i64;
    let largest = share.largest.map_or(i64::MAX, |bytes| bytes as i64);
    // Most of the time there is none, and nothing has to be locked to know that.
    let is_any = database.sql(&format!("SELECT id FROM job WHERE {DUE} LIMIT 1"));
    let is_busy = i64::from(share.is_busy);
    let query = sqlx::query(is_any)
        .bind(longest_pause)
        .bind(largest)
        .bind(is_busy)
        .bind(i64::from(SUSPECT));
    if query.fetch_optional(&database.readers).await?.is_none() {
        return Ok(None);
    }
    let mut transaction = database.begin().await?;
    if share.of_owner.is_some()
        && let Some(lock) = database.dialect.lock_claims()
    {
        sqlx::query(lock).execute(&mut *transaction).await?;
    }
    let next = database.sql(&format!(
        "SELECT job.id FROM job
         LEFT JOIN turn ON turn.owner = job.owner
         LEFT JOIN (SELECT owner, count(*) AS jobs FROM job WHERE state = 'running'
                    GROUP BY owner) AS busy ON busy.owner = job.owner
         WHERE {DUE} AND coalesce(busy.jobs, 0) < $5
         ORDER BY coalesce(busy.jobs, 0), coalesce(turn.at, 0), job.owner,
                  job.priority DESC, job.id
         LIMIT 1 {{free}}"
    ));
    let next = sqlx::query(next)
        .bind(longest_pause)
        .bind(largest)
        .bind(is_busy)
        .bind(i64::from(SUSPECT))
        .bind(share.of_owner.map_or(i64::MAX, i64::from))
        .fetch_optional(&mut *transaction)
        .await?;
    let Some(next) = next else {
        return Ok(None);
    };
    let row = database.sql("SELECT {columns}, {now} AS now FROM job WHERE id = $1");
    let row = sqlx::query(row)
        .bind(next.try_get::<String, _>("id")?)
        .fetch_one(&mut *transaction)
        .await?;
    let happening = Happening::Claimed(worker);
    let Changed::Yes(job) = written(&row, &happening, rules, &mut transaction).await? else {
        return Ok(None);
    };
    take_turn(&job, &mut transaction).await?;
    transaction.commit().await?;
    Ok(Some(*job))
}

/// The owner of a job that is started goes to the end of the line.
async fn take_turn(job: &Job, transaction: &mut Transaction<'_, Any>) -> StoreResult<()> {
    let last = "INSERT INTO turn (owner, at)
         VALUES ($1, (SELECT coalesce(max(at), 0) + 1 FROM turn))
         ON CONFLICT (owner) DO UPDATE SET at = excluded.at";
    sqlx::query(last)
        .bind(job.owner.as_str())
        .execute(&mut **transaction)
        .await?;
    Ok(())
}

/// Has no job started from now on, or again.
pub(super) async fn set_paused(database: &Database, paused: bool) -> StoreResult<()> {
    let statement = if paused {
        "INSERT INTO pause (id, since) VALUES (1, {now}) ON CONFLICT (id) DO NOTHING"
    } else {
        "DELETE FROM pause"
    };
    sqlx::query(database.sql(statement))
        .execute(&database.writers)
        .await?;
    Ok(())
}

/// Whether no job is started.
pub(super) async fn is_paused(database: &Database) -> StoreResult<bool> {
    let row = sqlx::query("SELECT id FROM pause")
        .fetch_optional(&database.readers)
        .await?;
    Ok(row.is_some())
}
