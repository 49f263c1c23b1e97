//! Quotas of owners and their use.

use sqlx::{Any, Row, Transaction};

use crate::jobs::access::Owner;
use crate::jobs::{Job, OwnerQuota, OwnerQuotas, State, StoreResult, Timestamp};

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
    // All statements bind the owner and the day, so those that do not need the day mention it as `$2 = $2`.
    let mut number = async |statement: &'static str, day: i64| {
        let query = sqlx::query(statement).bind(owner).bind(day);
        let row = query.fetch_optional(&mut **transaction).await?;
        let number = row.map(|row| row.try_get::<i64, _>(0)).transpose()?;
        StoreResult::Ok(number.unwrap_or_default() as u64)
    };
    // Check the live jobs, the stored bytes, and the processor time of the day.
    if let Some(most) = quotas.jobs.filter(|_| job.state == State::Queued) {
        let live = "SELECT count(*) FROM job
             WHERE owner = $1 AND $2 = $2 AND state IN ('queued', 'running')";
        if u64::from(most) <= number(live, 0).await? {
            return Ok(Some(OwnerQuota::Jobs));
        }
    }
    if let Some(most) = quotas.bytes {
        let stored = "SELECT CAST(coalesce(sum(bytes), 0) AS BIGINT) FROM job
             WHERE owner = $1 AND $2 = $2";
        if most < number(stored, 0).await? + job.stored_bytes() {
            return Ok(Some(OwnerQuota::Bytes));
        }
    }
    if let Some(most) = quotas.cpu_of_day {
        let spent = "SELECT cpu_ms FROM spent WHERE owner = $1 AND day = $2";
        if most.as_millis() as u64 <= number(spent, day(now)).await? {
            return Ok(Some(OwnerQuota::Cpu));
        }
    }
    Ok(None)
}

/// Adds processor time to the use of an owner on this day. Deletes the use before yesterday.
pub(super) async fn spend(
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
