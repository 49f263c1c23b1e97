//! API keys in the database.

use std::time::Duration;

use futures_util::future::BoxFuture;
use sqlx::Row;
use sqlx::any::AnyRow;

use super::database::Database;
use super::records::{RecordStore, bounded};
use super::rows::{self, damaged, text, time};
use crate::jobs::access::{Key, KeyId, KeyStore, NewKey, Owner};
use crate::jobs::{StoreResult, Timestamp};

/// Columns of a key, for statements with the alias `key`.
const COLUMNS: &str = "key.id, key.digest, key.owner, key.scopes, key.name, key.parent,
    key.created, key.expires, key.revoked, key.used";

impl KeyStore for RecordStore {
    fn add_key<'a>(&'a self, new: &'a NewKey) -> BoxFuture<'a, StoreResult<Key>> {
        bounded(add(&self.database, new))
    }

    fn has_keys(&self) -> BoxFuture<'_, StoreResult<bool>> {
        bounded(async move {
            let row = sqlx::query("SELECT id FROM api_key LIMIT 1")
                .fetch_optional(&self.database.readers)
                .await?;
            Ok(row.is_some())
        })
    }

    fn keys(&self) -> BoxFuture<'_, StoreResult<Vec<Key>>> {
        bounded(async move {
            let all = format!(
                "SELECT {COLUMNS} FROM api_key AS key WHERE key.parent IS NULL
                 ORDER BY key.created, key.id"
            );
            let found = sqlx::query(self.database.sql(&all))
                .fetch_all(&self.database.readers)
                .await?;
            found.iter().map(key).collect()
        })
    }

    fn good_key<'a>(&'a self, id: &'a KeyId) -> BoxFuture<'a, StoreResult<Option<Key>>> {
        bounded(async move {
            let good = format!(
                "SELECT {COLUMNS} FROM api_key AS key
                 LEFT JOIN api_key AS parent ON parent.id = key.parent
                 WHERE key.id = $1 AND key.revoked IS NULL AND parent.revoked IS NULL
                   AND (key.expires IS NULL OR {{now}} < key.expires)"
            );
            let row = sqlx::query(self.database.sql(&good))
                .bind(id.as_str())
                .fetch_optional(&self.database.readers)
                .await?;
            row.as_ref().map(key).transpose()
        })
    }

    fn note_use<'a>(&'a self, id: &'a KeyId, every: Duration) -> BoxFuture<'a, StoreResult<()>> {
        bounded(async move {
            let note = "UPDATE api_key SET used = {now}
                 WHERE (id = $1 OR id = (SELECT parent FROM api_key WHERE id = $1))
                   AND (used IS NULL OR used < {now} - $2)";
            sqlx::query(self.database.sql(note))
                .bind(id.as_str())
                .bind(every.as_millis() as i64)
                .execute(&self.database.writers)
                .await?;
            Ok(())
        })
    }

    fn revoke<'a>(&'a self, id: &'a KeyId) -> BoxFuture<'a, StoreResult<bool>> {
        bounded(async move {
            let revoke = "UPDATE api_key SET revoked = {now} WHERE id = $1 AND revoked IS NULL";
            let revoked = sqlx::query(self.database.sql(revoke))
                .bind(id.as_str())
                .execute(&self.database.writers)
                .await?;
            Ok(revoked.rows_affected() == 1)
        })
    }
}

/// Adds a key, timed by the database. Deletes the expired and revoked keys of pages.
async fn add(database: &Database, new: &NewKey) -> StoreResult<Key> {
    // Read the clock of the database, by which keys expire.
    let mut transaction = database.begin().await?;
    let row = sqlx::query(database.sql("SELECT {now} AS now"))
        .fetch_one(&mut *transaction)
        .await?;
    let now = rows::now(&row)?;
    let key = new.recorded(now);
    // Delete useless keys of pages.
    let useless = "DELETE FROM api_key
         WHERE parent IS NOT NULL AND (expires <= $1 OR revoked IS NOT NULL)";
    sqlx::query(useless)
        .bind(now.0)
        .execute(&mut *transaction)
        .await?;
    // Add the key.
    sqlx::query(
        "INSERT INTO api_key (id, digest, owner, scopes, name, parent, created, expires)
         VALUES ($1, $2, $3, $4, $5, $6, $7, $8)",
    )
    .bind(key.id.as_str())
    .bind(&key.digest)
    .bind(key.owner.as_str())
    .bind(key.scopes.to_string())
    .bind(&key.name)
    .bind(key.parent.as_ref().map(KeyId::as_str))
    .bind(key.created.0)
    .bind(key.expires.map(|Timestamp(ms)| ms))
    .execute(&mut *transaction)
    .await?;
    transaction.commit().await?;
    Ok(key)
}

/// Reads a key from a row with [`COLUMNS`].
fn key(row: &AnyRow) -> StoreResult<Key> {
    let parent: Option<String> = row.try_get("parent").map_err(damaged)?;
    Ok(Key {
        id: KeyId::recorded(text(row, "id")?),
        digest: text(row, "digest")?,
        owner: Owner::recorded(text(row, "owner")?),
        scopes: text(row, "scopes")?.parse().map_err(damaged)?,
        name: text(row, "name")?,
        parent: parent.map(KeyId::recorded),
        created: Timestamp(row.try_get("created").map_err(damaged)?),
        expires: time(row, "expires")?,
        revoked: time(row, "revoked")?,
        used: time(row, "used")?,
    })
}
