//! Changes of job records: heartbeat, sweep, end, client command, deletion.
//!
//! Each is one transaction: it locks and reads a row, [`after`] computes the next record, and the row is written with
//! its former token in the WHERE clause.

use sqlx::any::AnyRow;
use sqlx::{Any, Row, Transaction};

use super::database::Database;
use super::within::within;
use super::{notices, quotas, rows};
use crate::jobs::access::Visibility;
use crate::jobs::{
    Changed, Heartbeat, Job, JobId, Reason, Rules, State, StoreError, StoreResult, Sweep,
    Transition, after,
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
                quotas::spend(&job.owner, report.cpu_ms, now, transaction).await?;
            }
            if !rows::update(&next, job.token, transaction).await? {
                return Err(StoreError::Conflict(format!("job {}", job.id)));
            }
            if !job.state.is_final() {
                notices::tell(&next, now, transaction).await?;
            }
            Ok(Changed::Yes(Box::new(next)))
        }
        Err(refusal) => Ok(Changed::No(Box::new(job), refusal)),
    }
}
