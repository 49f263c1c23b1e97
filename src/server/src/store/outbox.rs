//! The outbox of notices in the database.

use std::time::Duration;

use futures_util::future::BoxFuture;
use sqlx::Row;
use sqlx::any::AnyRow;

use super::database::Database;
use super::records::{RecordStore, bounded};
use super::rows::{damaged, text};
use crate::jobs::access::Owner;
use crate::jobs::{Notice, Outbox, StoreResult};

/// Condition for notices that are due. No pause exceeds a day: a longer one means that the clock was set back.
const DUE: &str = "(due <= {now} OR {now} + 86400000 < due)";

impl Outbox for RecordStore {
    fn take(&self, most: u32, lease: Duration) -> BoxFuture<'_, StoreResult<Vec<Notice>>> {
        bounded(take(&self.database, most, lease))
    }

    fn settle<'a>(&'a self, id: &'a str) -> BoxFuture<'a, StoreResult<()>> {
        bounded(async move {
            sqlx::query("DELETE FROM outbox WHERE id = $1")
                .bind(id)
                .execute(&self.database.writers)
                .await?;
            Ok(())
        })
    }

    fn defer<'a>(&'a self, id: &'a str, pause: Duration) -> BoxFuture<'a, StoreResult<()>> {
        bounded(async move {
            let defer = "UPDATE outbox SET due = {now} + $2 WHERE id = $1";
            sqlx::query(self.database.sql(defer))
                .bind(id)
                .bind(pause.as_millis() as i64)
                .execute(&self.database.writers)
                .await?;
            Ok(())
        })
    }
}

async fn take(database: &Database, most: u32, lease: Duration) -> StoreResult<Vec<Notice>> {
    // Check without a lock first: most of the time there is no notice.
    let is_any = database.sql(&format!("SELECT id FROM outbox WHERE {DUE} LIMIT 1"));
    let any = sqlx::query(is_any).fetch_optional(&database.readers);
    if any.await?.is_none() {
        return Ok(Vec::new());
    }
    let take = format!(
        "UPDATE outbox SET attempt = attempt + 1, due = {{now}} + $1
         WHERE id IN (SELECT id FROM outbox AS job WHERE {DUE} ORDER BY due LIMIT $2 {{free}})
         RETURNING id, owner, url, body, attempt"
    );
    let mut transaction = database.begin().await?;
    let taken = sqlx::query(database.sql(&take))
        .bind(lease.as_millis() as i64)
        .bind(i64::from(most))
        .fetch_all(&mut *transaction)
        .await?;
    transaction.commit().await?;
    taken.iter().map(notice).collect()
}

fn notice(row: &AnyRow) -> StoreResult<Notice> {
    let attempt: i64 = row.try_get("attempt").map_err(damaged)?;
    Ok(Notice {
        id: text(row, "id")?,
        owner: Owner::recorded(text(row, "owner")?),
        webhook: text(row, "url")?.parse().map_err(damaged)?,
        body: text(row, "body")?,
        attempt: attempt as u32,
    })
}
