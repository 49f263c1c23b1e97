//! A job as a row of the table `job`.

use serde::Serialize;
use serde::de::DeserializeOwned;
use sqlx::sqlite::SqliteRow;
use sqlx::{Row, Sqlite, Transaction};

use crate::jobs::{Job, JobId, StoreError, StoreResult, Timestamp};

/// Adds a job that has not been started.
pub(super) async fn insert(
    job: &Job,
    transaction: &mut Transaction<'_, Sqlite>,
) -> StoreResult<()> {
    sqlx::query(
        "INSERT INTO job (id, kind, state, options, input, output, attempt, lost, finish_early,
                          ephemeral, seq, progress, failure, created, started, finished, bytes)
         VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, NULL, ?, NULL, NULL, ?)",
    )
    .bind(job.id.to_string())
    .bind(job.kind.word())
    .bind(job.state.word())
    .bind(json(&job.options)?)
    .bind(json(&job.input)?)
    .bind(json(&job.output)?)
    .bind(i64::from(job.attempt))
    .bind(i64::from(job.lost))
    .bind(job.finish_early)
    .bind(job.ephemeral)
    .bind(job.seq as i64)
    .bind(json(&job.progress)?)
    .bind(job.created.0)
    .bind(job.stored_bytes() as i64)
    .execute(&mut **transaction)
    .await?;
    Ok(())
}

/// JSON text of a value, for a column.
pub(super) fn json<T: Serialize>(value: &T) -> StoreResult<String> {
    serde_json::to_string(value).map_err(damaged)
}

/// A record that cannot be read is reported, never guessed at.
fn damaged(error: impl std::fmt::Display) -> StoreError {
    StoreError::Other(format!("a record is damaged: {error}"))
}

/// The id that a row holds.
pub(super) fn id(row: &SqliteRow) -> StoreResult<JobId> {
    let text: String = row.try_get("id").map_err(damaged)?;
    text.parse().map_err(damaged)
}

/// The job that a row of `SELECT * FROM job` holds.
pub(super) fn job(row: &SqliteRow) -> StoreResult<Job> {
    let text = |column| row.try_get::<String, _>(column).map_err(damaged);
    let number = |column| row.try_get::<i64, _>(column).map_err(damaged);
    let time = |column| {
        let ms = row.try_get::<Option<i64>, _>(column).map_err(damaged)?;
        Ok::<_, StoreError>(ms.map(Timestamp))
    };
    Ok(Job {
        id: id(row)?,
        kind: word(&text("kind")?)?,
        state: word(&text("state")?)?,
        options: parsed(&text("options")?)?,
        input: parsed(&text("input")?)?,
        output: parsed(&text("output")?)?,
        verdict: parsed(&text("verdict")?)?,
        attempt: number("attempt")? as u32,
        lost: number("lost")? as u32,
        finish_early: number("finish_early")? != 0,
        ephemeral: number("ephemeral")? != 0,
        seq: number("seq")? as u64,
        progress: parsed(&text("progress")?)?,
        failure: row
            .try_get::<Option<String>, _>("failure")
            .map_err(damaged)?
            .map(|json| parsed(&json))
            .transpose()?,
        created: Timestamp(number("created")?),
        started: time("started")?,
        finished: time("finished")?,
    })
}

/// The value that a column holds as JSON text.
fn parsed<T: DeserializeOwned>(text: &str) -> StoreResult<T> {
    serde_json::from_str(text).map_err(damaged)
}

/// The enum value that a column holds as a bare word.
pub(super) fn word<T: DeserializeOwned>(text: &str) -> StoreResult<T> {
    serde_json::from_value(text.into()).map_err(damaged)
}
