//! Idempotency keys: which submission used one first.

use sqlx::{Any, Row, Transaction};

use super::database::Database;
use super::rows;
use crate::jobs::access::Owner;
use crate::jobs::{Enqueued, IdempotencyKey, Job, StoreResult, Timestamp};

/// How long a key is remembered: one day.
const LIFE_MS: i64 = 86_400_000;

/// What a key was used for before, if it was. Forgets the keys that are too old by now.
pub(super) async fn earlier_use(
    database: &Database,
    key: &IdempotencyKey,
    owner: &Owner,
    now: Timestamp,
    transaction: &mut Transaction<'_, Any>,
) -> StoreResult<Option<Enqueued>> {
    sqlx::query("DELETE FROM idempotency WHERE created < $1")
        .bind(now.0 - LIFE_MS)
        .execute(&mut **transaction)
        .await?;
    let used = "SELECT {columns}, fingerprint FROM job
         JOIN (SELECT job AS of_key, fingerprint FROM idempotency WHERE key = $1) AS used
         ON id = of_key";
    let row = sqlx::query(database.sql(used))
        .bind(of_owner(key, owner))
        .fetch_optional(&mut **transaction)
        .await?;
    let Some(row) = row else {
        return Ok(None);
    };
    if row.try_get::<String, _>("fingerprint")? != key.fingerprint {
        return Ok(Some(Enqueued::KeyReused));
    }
    Ok(Some(Enqueued::Replay(Box::new(rows::job(&row)?))))
}

/// A key with its owner. Neither has a line break in it.
fn of_owner(IdempotencyKey { key, .. }: &IdempotencyKey, owner: &Owner) -> String {
    let owner = owner.name().map(|name| format!("{name}\n"));
    owner.unwrap_or_default() + key
}

/// Remembers what a key was used for.
pub(super) async fn remember(
    key: &IdempotencyKey,
    job: &Job,
    transaction: &mut Transaction<'_, Any>,
) -> StoreResult<()> {
    let insert = "INSERT INTO idempotency (key, fingerprint, job, created) VALUES ($1, $2, $3, $4)";
    sqlx::query(insert)
        .bind(of_owner(key, &job.owner))
        .bind(&key.fingerprint)
        .bind(job.id.to_string())
        .bind(job.created.0)
        .execute(&mut **transaction)
        .await?;
    Ok(())
}
