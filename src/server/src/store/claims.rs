//! Assignment of jobs to workers: owners take turns.
//!
//! The next job belongs to the owner with the fewest running jobs, and among those to the one whose last start was
//! longest ago. Priorities order the jobs of one owner, never those of different owners. So an owner who submits a
//! thousand jobs delays nobody else.

use sqlx::{Any, Row, Transaction};

use super::database::Database;
use super::transitions::written;
use crate::jobs::{Changed, Job, Rules, SUSPECT, Share, StoreResult, Transition, WorkerId};

/// Condition for queued jobs of at most `$2` bytes that may start. A job whose pause exceeds the longest one (`$1`)
/// is due, because the clock was set back since. A busy worker (`$3 = 1`) gets no job that was lost with `$4`
/// workers, and no job at all while such a job has been due for five minutes.
const DUE: &str = "job.state = 'queued' AND (job.due <= {now} OR {now} + $1 < job.due)
     AND job.bytes <= $2 AND NOT EXISTS (SELECT id FROM pause)
     AND ($3 = 0 OR (job.interrupted < $4 AND NOT EXISTS (
         SELECT suspect.id FROM job AS suspect WHERE suspect.state = 'queued'
         AND $4 <= suspect.interrupted AND suspect.due <= {now} - 300000)))";

/// Assigns the next job of its share to a worker.
pub(super) async fn claim(
    database: &Database,
    worker: WorkerId,
    share: Share,
    rules: &Rules,
) -> StoreResult<Option<Job>> {
    let longest_pause = rules.longest_pause().as_millis() as i64;
    let largest = share.largest.map_or(i64::MAX, |bytes| bytes as i64);
    // Check without a lock first: most of the time there is no job.
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
    // With a limit per owner, only one process at a time may count running jobs.
    if share.of_owner.is_some()
        && let Some(lock) = database.dialect.lock_claims()
    {
        sqlx::query(lock).execute(&mut *transaction).await?;
    }
    // Choose the owner whose turn it is, then the job.
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
    // Read the whole record and mark it as running.
    let row = database.sql("SELECT {columns}, {now} AS now FROM job WHERE id = $1");
    let row = sqlx::query(row)
        .bind(next.try_get::<String, _>("id")?)
        .fetch_one(&mut *transaction)
        .await?;
    let transition = Transition::Claimed(worker);
    let Changed::Yes(job) = written(&row, &transition, rules, &mut transaction).await? else {
        return Ok(None);
    };
    take_turn(&job, &mut transaction).await?;
    transaction.commit().await?;
    Ok(Some(*job))
}

/// Moves the owner of a started job to the end of the line.
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

/// Pauses or resumes the queue.
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

/// Returns whether the queue is paused.
pub(super) async fn is_paused(database: &Database) -> StoreResult<bool> {
    let row = sqlx::query("SELECT id FROM pause")
        .fetch_optional(&database.readers)
        .await?;
    Ok(row.is_some())
}
