//! Idempotency keys and the submissions that used them first.

use sqlx::{Any, Row, Transaction};

use super::database::Database;
use super::rows;
use crate::jobs::access::Owner;
use crate::jobs::{Enqueued, IdempotencyKey, Job, StoreResult};

/// Minimum lifetime of a key: one day, as the OpenAPI document promises.
const LIFE_MS: i64 = 86_400_000;

/// Returns the outcome for a key that was used before; `None` for a new key.
pub(super) async fn earlier_use(
    database: &Database,
    key: &IdempotencyKey,
    owner: &Owner,
    transaction: &mut Transaction<'_, Any>,
) -> StoreResult<Option<Enqueued>> {
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

/// Deletes expired keys.
pub(super) async fn forget(database: &Database) -> StoreResult<()> {
    let mut transaction = database.begin().await?;
    sqlx::query(database.sql("DELETE FROM idempotency WHERE created < {now} - $1"))
        .bind(LIFE_MS)
        .execute(&mut *transaction)
        .await?;
    transaction.commit().await?;
    Ok(())
}

/// Returns the key with its owner. Neither contains a line break.
fn of_owner(IdempotencyKey { key, .. }: &IdempotencyKey, owner: &Owner) -> String {
    let owner = owner.name().map(|name| format!("{name}\n"));
    owner.unwrap_or_default() + key
}

/// Records the submission that used a key.
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
