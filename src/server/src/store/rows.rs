//! Jobs as rows of the table `job`.

use serde::Serialize;
use serde::de::DeserializeOwned;
use sqlx::any::AnyRow;
use sqlx::{Any, Row, Transaction};

use crate::jobs::access::Owner;
use crate::jobs::{Event, Job, JobId, StoreError, StoreResult, Timestamp, Token};

/// Columns of a job, each by name: a statement for all columns would fail in processes that are still running when a
/// newer program adds one.
pub(super) const COLUMNS: &str =
    "id, owner, kind, state, options, input, output, verdict, attempt, digest,
    priority, token, worker, lease, due, lost, cancel, finish_early, ephemeral, seq, progress,
    failure, created, started, finished, trace, metadata, accept, webhook, interrupted, drawn";

/// Inserts a job that no worker holds.
pub(super) async fn insert(job: &Job, transaction: &mut Transaction<'_, Any>) -> StoreResult<()> {
    sqlx::query(
        "INSERT INTO job (id, kind, state, options, input, output, verdict, attempt, token, due,
                          lost, cancel, finish_early, ephemeral, seq, progress, created, bytes,
                          digest, priority, finished, owner, trace, metadata, accept, webhook)
         VALUES ($1, $2, $3, $4, $5, $6, $7, $8, $9, $10, $11, $12, $13, $14, $15, $16, $17, $18,
                 $19, $20, $21, $22, $23, $24, $25, $26)",
    )
    .bind(job.id.to_string())
    .bind(job.kind.word())
    .bind(job.state.word())
    .bind(json(&job.options)?)
    .bind(json(&job.input)?)
    .bind(json(&job.output)?)
    .bind(json(&job.verdict)?)
    .bind(i64::from(job.attempt))
    .bind(job.token as i64)
    .bind(job.due.0)
    .bind(i64::from(job.lost))
    .bind(i64::from(job.cancel))
    .bind(i64::from(job.finish_early))
    .bind(i64::from(job.ephemeral))
    .bind(job.seq as i64)
    .bind(json(&job.progress)?)
    .bind(job.created.0)
    .bind(job.stored_bytes() as i64)
    .bind(&job.digest)
    .bind(i64::from(job.priority))
    .bind(job.finished.map(|time| time.0))
    .bind(job.owner.as_str())
    .bind(&job.trace)
    .bind(json(&job.metadata)?)
    .bind(job.accept.as_ref().map(ToString::to_string))
    .bind(job.webhook.as_ref().map(ToString::to_string))
    .execute(&mut **transaction)
    .await?;
    label(job, transaction).await
}

/// Adds the labels by which a job is found.
async fn label(job: &Job, transaction: &mut Transaction<'_, Any>) -> StoreResult<()> {
    for label in job.metadata.labels() {
        sqlx::query("INSERT INTO label (digest, job) VALUES ($1, $2) ON CONFLICT DO NOTHING")
            .bind(label)
            .bind(job.id.to_string())
            .execute(&mut **transaction)
            .await?;
    }
    Ok(())
}

/// Writes the metadata of a job, and replaces the labels by which it is found.
pub(super) async fn note(job: &Job, transaction: &mut Transaction<'_, Any>) -> StoreResult<()> {
    sqlx::query("UPDATE job SET metadata = $1 WHERE id = $2")
        .bind(json(&job.metadata)?)
        .bind(job.id.to_string())
        .execute(&mut **transaction)
        .await?;
    sqlx::query("DELETE FROM label WHERE job = $1")
        .bind(job.id.to_string())
        .execute(&mut **transaction)
        .await?;
    label(job, transaction).await
}

/// Updates the mutable columns of a job if its record has this token. Returns `false` if it has a different one.
pub(super) async fn update(
    job: &Job,
    token: Token,
    transaction: &mut Transaction<'_, Any>,
) -> StoreResult<bool> {
    let failure = job.failure.as_ref().map(json).transpose()?;
    let changed = sqlx::query(
        "UPDATE job SET state = $1, output = $2, verdict = $3, attempt = $4, token = $5,
                        worker = $6, lease = $7, due = $8, lost = $9, cancel = $10,
                        finish_early = $11, seq = $12, progress = $13, failure = $14,
                        started = $15, finished = $16, bytes = $17, interrupted = $18, drawn = $19
         WHERE id = $20 AND token = $21",
    )
    .bind(job.state.word())
    .bind(json(&job.output)?)
    .bind(json(&job.verdict)?)
    .bind(i64::from(job.attempt))
    .bind(job.token as i64)
    .bind(job.worker.map(|worker| worker.to_string()))
    .bind(job.lease.map(|time| time.0))
    .bind(job.due.0)
    .bind(i64::from(job.lost))
    .bind(i64::from(job.cancel))
    .bind(i64::from(job.finish_early))
    .bind(job.seq as i64)
    .bind(json(&job.progress)?)
    .bind(failure)
    .bind(job.started.map(|time| time.0))
    .bind(job.finished.map(|time| time.0))
    .bind(job.stored_bytes() as i64)
    .bind(i64::from(job.interrupted))
    .bind(json(&job.drawn)?)
    .bind(job.id.to_string())
    .bind(token as i64)
    .execute(&mut **transaction)
    .await?;
    Ok(changed.rows_affected() == 1)
}

/// Serializes a value to JSON text for a column.
fn json<T: Serialize>(value: &T) -> StoreResult<String> {
    serde_json::to_string(value).map_err(damaged)
}

/// Returns the error for a record that cannot be read. It is reported, never guessed at.
pub(super) fn damaged(error: impl std::fmt::Display) -> StoreError {
    StoreError::Other(format!("a record is damaged: {error}"))
}

/// Reads the id from a row.
pub(super) fn id(row: &AnyRow) -> StoreResult<JobId> {
    let text: String = row.try_get("id").map_err(damaged)?;
    text.parse().map_err(damaged)
}

/// Reads the time by the clock of the database from a row.
pub(super) fn now(row: &AnyRow) -> StoreResult<Timestamp> {
    row.try_get("now").map(Timestamp).map_err(damaged)
}

/// Reads an event from a row of `SELECT id, state, seq, progress, started, finished, {now} AS now`.
pub(super) fn event(row: &AnyRow) -> StoreResult<(JobId, Event)> {
    let until = time(row, "finished")?.map_or_else(|| now(row), Ok)?;
    let event = Event {
        seq: number(row, "seq")? as u64,
        state: word(&text(row, "state")?)?,
        progress: parsed(&text(row, "progress")?)?,
        elapsed_ms: time(row, "started")?.map_or(0, |started| until.since(started)),
    };
    Ok((id(row)?, event))
}

/// Reads a text from a column of a row.
pub(super) fn text(row: &AnyRow, column: &str) -> StoreResult<String> {
    row.try_get(column).map_err(damaged)
}

/// Reads a text from a column of a row; `None` if it is null.
fn maybe_text(row: &AnyRow, column: &str) -> StoreResult<Option<String>> {
    row.try_get(column).map_err(damaged)
}

/// Reads a number from a column of a row.
fn number(row: &AnyRow, column: &str) -> StoreResult<i64> {
    row.try_get(column).map_err(damaged)
}

/// Reads a time from a column of a row; `None` if it is null.
pub(super) fn time(row: &AnyRow, column: &str) -> StoreResult<Option<Timestamp>> {
    let ms = row.try_get::<Option<i64>, _>(column).map_err(damaged)?;
    Ok(ms.map(Timestamp))
}

/// Reads a job from a row with [`COLUMNS`].
pub(super) fn job(row: &AnyRow) -> StoreResult<Job> {
    Ok(Job {
        id: id(row)?,
        owner: Owner::recorded(text(row, "owner")?),
        kind: word(&text(row, "kind")?)?,
        state: word(&text(row, "state")?)?,
        options: parsed(&text(row, "options")?)?,
        input: parsed(&text(row, "input")?)?,
        output: parsed(&text(row, "output")?)?,
        drawn: parsed(&text(row, "drawn")?)?,
        verdict: parsed(&text(row, "verdict")?)?,
        attempt: number(row, "attempt")? as u32,
        digest: text(row, "digest")?,
        priority: number(row, "priority")? as i32,
        trace: maybe_text(row, "trace")?,
        metadata: (maybe_text(row, "metadata")?
            .map(|json| parsed(&json))
            .transpose()?)
        .unwrap_or_default(),
        accept: (maybe_text(row, "accept")?)
            .map(|gates| gates.parse().map_err(damaged))
            .transpose()?,
        webhook: (maybe_text(row, "webhook")?)
            .map(|url| url.parse().map_err(damaged))
            .transpose()?,
        token: number(row, "token")? as Token,
        worker: maybe_text(row, "worker")?
            .map(|worker| worker.parse().map_err(damaged))
            .transpose()?,
        lease: time(row, "lease")?,
        due: Timestamp(number(row, "due")?),
        lost: number(row, "lost")? as u32,
        interrupted: number(row, "interrupted")? as u32,
        cancel: number(row, "cancel")? != 0,
        finish_early: number(row, "finish_early")? != 0,
        ephemeral: number(row, "ephemeral")? != 0,
        seq: number(row, "seq")? as u64,
        progress: parsed(&text(row, "progress")?)?,
        failure: maybe_text(row, "failure")?
            .map(|json| parsed(&json))
            .transpose()?,
        created: Timestamp(number(row, "created")?),
        started: time(row, "started")?,
        finished: time(row, "finished")?,
    })
}

/// Parses the JSON text of a column.
fn parsed<T: DeserializeOwned>(text: &str) -> StoreResult<T> {
    serde_json::from_str(text).map_err(damaged)
}

/// Parses a column that holds an enum value as a bare word.
pub(super) fn word<T: DeserializeOwned>(text: &str) -> StoreResult<T> {
    serde_json::from_value(text.into()).map_err(damaged)
}
