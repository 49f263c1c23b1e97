//! Changes of job records: heartbeat, sweep, end, client command, deletion.
//!
//! Each is one transaction: it locks and reads a row, [`after`] computes the next record, and the row is written with
//! its former token in the WHERE clause.

use sqlx::any::AnyRow;
use sqlx::{Any, Row, Transaction};

use super::database::Database;
use super::reading::within;
use super::rows;
use crate::jobs::access::{Owner, Visibility};
use crate::jobs::{
    Changed, Heartbeat, Job, JobId, Notice, OwnerQuota, OwnerQuotas, Reason, Rules, SUSPECT, Share,
    State, StoreError, StoreResult, Sweep, Timestamp, Transition, WorkerId, after,
};

/// Jobs per transaction of a sweep. Larger transactions lock rows for longer, smaller ones take more commits.
const SWEPT: i64 = 100;
/// Time for which an expired job is remembered: a year. Until then requests for it get 410 rather than 404; each takes
/// a row.
const REMEMBERED_MS: i64 = 365 * 86_400_000;

/// Condition for running jobs whose leases are over, or longer than any that is given.
const OVERDUE: &str =
    "state = 'running' AND (lease IS NULL OR lease < {now} OR {now} + $1 < lease)";
/// Condition for all running jobs. It mentions the lease only because every sweep binds it.
const ANY_RUNNING: &str = "state = 'running' AND $1 = $1";

pub(super) async fn change(
    database: &Database,
    visibility: &Visibility,
    id: JobId,
    transition: &Transition,
    rules: &Rules,
) -> StoreResult<Changed> {
    let mut transaction = database.begin().await?;
    let changed = changed(
        database,
        visibility,
        id,
        transition,
        rules,
        &mut transaction,
    )
    .await?;
    if let Changed::Yes(_) = changed {
        transaction.commit().await?;
    }
    Ok(changed)
}

pub(super) async fn heartbeat(
    database: &Database,
    heartbeats: &[Heartbeat],
    rules: &Rules,
) -> StoreResult<Vec<Changed>> {
    let mut transaction = database.begin().await?;
    let mut answers: Vec<Option<Changed>> = vec![None; heartbeats.len()];
    // Lock the rows in one order, so that no two transactions wait for each other.
    let mut order: Vec<usize> = (0..heartbeats.len()).collect();
    order.sort_by_key(|&index| heartbeats[index].0);
    for index in order {
        let (id, token, report) = heartbeats[index];
        let transition = Transition::Heartbeat(token, report);
        let all = &Visibility::All;
        let changed = changed(database, all, id, &transition, rules, &mut transaction).await?;
        answers[index] = Some(changed);
    }
    transaction.commit().await?;
    Ok(answers.into_iter().flatten().collect())
}

pub(super) async fn sweep(
    database: &Database,
    sweep: Sweep,
    rules: &Rules,
) -> StoreResult<Vec<Job>> {
    // Choose the condition and the event.
    let (meant, transition) = match sweep {
        Sweep::Overdue => (OVERDUE, Transition::Swept),
        Sweep::Abandoned => (ANY_RUNNING, Transition::Abandoned),
    };
    let lease = rules.lease.as_millis() as i64;
    let mut all = Vec::new();
    loop {
        // Check without a lock first.
        let is_any = database.sql(&format!("SELECT id FROM job WHERE {meant} LIMIT 1"));
        let query = sqlx::query(is_any).bind(lease);
        if query.fetch_optional(&database.readers).await?.is_none() {
            return Ok(all);
        }
        // Apply the event to the next jobs that no other process has locked.
        let found = database.sql(&format!(
            "SELECT {{columns}}, {{now}} AS now FROM job WHERE {meant} ORDER BY id LIMIT $2 {{free}}"
        ));
        let mut transaction = database.begin().await?;
        let rows = sqlx::query(found)
            .bind(lease)
            .bind(SWEPT)
            .fetch_all(&mut *transaction)
            .await?;
        let mut swept = Vec::new();
        for row in &rows {
            if let Changed::Yes(job) = written(row, &transition, rules, &mut transaction).await? {
                swept.push(*job);
            }
        }
        transaction.commit().await?;
        // Stop if nothing changed: another process may sweep the same jobs, or their leases end only now.
        if swept.is_empty() {
            return Ok(all);
        }
        all.extend(swept);
    }
}

pub(super) async fn delete(
    database: &Database,
    visibility: &Visibility,
    id: JobId,
    reason: Reason,
) -> StoreResult<bool> {
    let (within, owner) = within(visibility, 2);
    let mut transaction = database.begin().await?;
    // Delete the record. Its idempotency key and its labels go with it.
    let delete = format!(
        "DELETE FROM job WHERE id = $1 AND {within}
         AND state IN ('succeeded', 'failed', 'cancelled') RETURNING owner"
    );
    let deleted = sqlx::query(database.sql(&delete))
        .bind(id.to_string())
        .bind(owner)
        .fetch_optional(&mut *transaction)
        .await?;
    let Some(deleted) = deleted else {
        return Ok(false);
    };
    // Remember an expired job for a year.
    if reason == Reason::Expired {
        let insert = "INSERT INTO expired (id, at, owner) VALUES ($1, {now}, $2)";
        sqlx::query(database.sql(insert))
            .bind(id.to_string())
            .bind(deleted.try_get::<String, _>("owner")?)
            .execute(&mut *transaction)
            .await?;
        sqlx::query(database.sql("DELETE FROM expired WHERE at < {now} - $1"))
            .bind(REMEMBERED_MS)
            .execute(&mut *transaction)
            .await?;
    }
    transaction.commit().await?;
    Ok(true)
}

async fn changed(
    database: &Database,
    visibility: &Visibility,
    id: JobId,
    transition: &Transition,
    rules: &Rules,
    transaction: &mut Transaction<'_, Any>,
) -> StoreResult<Changed> {
    let (within, owner) = within(visibility, 2);
    let row = format!(
        "SELECT {{columns}}, {{now}} AS now FROM job WHERE id = $1 AND {within} {{locked}}"
    );
    let row = sqlx::query(database.sql(&row))
        .bind(id.to_string())
        .bind(owner)
        .fetch_optional(&mut **transaction)
        .await?;
    match row {
        Some(row) => written(&row, transition, rules, transaction).await,
        None => Ok(Changed::Missing),
    }
}

/// Applies an event to a row locked by this transaction, and writes the result.
pub(super) async fn written(
    row: &AnyRow,
    transition: &Transition,
    rules: &Rules,
    transaction: &mut Transaction<'_, Any>,
) -> StoreResult<Changed> {
    let (job, now) = (rows::job(row)?, rows::now(row)?);
    match after(&job, transition, rules, now) {
        Ok(next) => {
            if let Transition::Ended(_, report, _) = transition
                && job.state == State::Running
            {
                spend(&job.owner, report.cpu_ms, now, transaction).await?;
            }
            if !rows::update(&next, job.token, transaction).await? {
                return Err(StoreError::Conflict(format!("job {}", job.id)));
            }
            if next.metadata != job.metadata {
                rows::note(&next, transaction).await?;
            }
            if !job.state.is_final() {
                tell(&next, now, transaction).await?;
            }
            Ok(Changed::Yes(Box::new(next)))
        }
        Err(refusal) => Ok(Changed::No(Box::new(job), refusal)),
    }
}

// Assignment of jobs to workers: owners take turns.
//
// The next job belongs to the owner with the fewest running jobs, and among those to the one whose last start was
// longest ago. Priorities order the jobs of one owner, never those of different owners. So an owner who submits a
// thousand jobs delays nobody else.

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

// Recording of notices in the database when jobs end.

/// Records a notice if a job has ended and has a webhook.
pub(super) async fn tell(
    job: &Job,
    now: Timestamp,
    transaction: &mut Transaction<'_, Any>,
) -> StoreResult<()> {
    let Some(notice) = Notice::of_end(job) else {
        return Ok(());
    };
    sqlx::query(
        "INSERT INTO outbox (id, owner, url, body, attempt, due) VALUES ($1, $2, $3, $4, 0, $5)",
    )
    .bind(notice.id)
    .bind(notice.owner.as_str())
    .bind(notice.webhook.to_string())
    .bind(notice.body)
    .bind(now.0)
    .execute(&mut **transaction)
    .await?;
    Ok(())
}

// Quotas of owners and their use.

/// Milliseconds per day.
const DAY_MS: i64 = 86_400_000;

/// Returns the quota of its owner that a new job would exceed; `None` if it exceeds none.
pub(super) async fn exceeded(
    job: &Job,
    quotas: OwnerQuotas,
    now: Timestamp,
    transaction: &mut Transaction<'_, Any>,
) -> StoreResult<Option<OwnerQuota>> {
    let owner = job.owner.as_str();
    // Check the live jobs, the stored bytes, and the processor time of the day.
    if let Some(most) = quotas.jobs.filter(|_| job.state == State::Queued) {
        let live = "SELECT count(*) FROM job
             WHERE owner = $1 AND $2 = $2 AND state IN ('queued', 'running')";
        if u64::from(most) <= number_of(owner, live, 0, transaction).await? {
            return Ok(Some(OwnerQuota::Jobs));
        }
    }
    if let Some(most) = quotas.bytes {
        let stored = "SELECT CAST(coalesce(sum(bytes), 0) AS BIGINT) FROM job
             WHERE owner = $1 AND $2 = $2";
        if most < number_of(owner, stored, 0, transaction).await? + job.stored_bytes() {
            return Ok(Some(OwnerQuota::Bytes));
        }
    }
    if let Some(most) = quotas.cpu_of_day {
        let spent = "SELECT cpu_ms FROM spent WHERE owner = $1 AND day = $2";
        if most.as_millis() as u64 <= number_of(owner, spent, day(now), transaction).await? {
            return Ok(Some(OwnerQuota::Cpu));
        }
    }
    Ok(None)
}

/// Returns the number that a statement selects for an owner and a day; 0 if there is no row. A statement that does not
/// need the day mentions it as `$2 = $2`.
async fn number_of(
    owner: &str,
    statement: &'static str,
    day: i64,
    transaction: &mut Transaction<'_, Any>,
) -> StoreResult<u64> {
    let query = sqlx::query(statement).bind(owner).bind(day);
    let row = query.fetch_optional(&mut **transaction).await?;
    let number = row.map(|row| row.try_get::<i64, _>(0)).transpose()?;
    Ok(number.unwrap_or_default() as u64)
}

/// Adds processor time to the use of an owner on this day. Deletes the use before yesterday.
async fn spend(
    owner: &Owner,
    cpu_ms: u64,
    now: Timestamp,
    transaction: &mut Transaction<'_, Any>,
) -> StoreResult<()> {
    let add = "INSERT INTO spent (owner, day, cpu_ms) VALUES ($1, $2, $3)
         ON CONFLICT (owner, day) DO UPDATE SET cpu_ms = spent.cpu_ms + excluded.cpu_ms";
    sqlx::query(add)
        .bind(owner.as_str())
        .bind(day(now))
        .bind(cpu_ms as i64)
        .execute(&mut **transaction)
        .await?;
    sqlx::query("DELETE FROM spent WHERE owner = $1 AND day < $2 - 1")
        .bind(owner.as_str())
        .bind(day(now))
        .execute(&mut **transaction)
        .await?;
    Ok(())
}

fn day(now: Timestamp) -> i64 {
    now.0.div_euclid(DAY_MS)
}
