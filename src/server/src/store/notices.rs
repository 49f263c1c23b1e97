//! Recording of notices in the database when jobs end.

use sqlx::{Any, Transaction};

use crate::jobs::{Job, Notice, StoreResult, Timestamp};

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
