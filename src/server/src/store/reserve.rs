//! Reserved disk space for records, so that jobs can end and be deleted on a full disk.
//!
//! This concerns SQLite, which shares its disk with the files of jobs. A transaction writes its pages to the
//! write-ahead log first, and a checkpoint copies them into the database. Neither file shrinks while the database is
//! open: a log that was once large, and a database with free pages, take more records without more space.

use sqlx::Row;

use super::database::Database;
use super::dialect::Dialect;
use crate::jobs::StoreResult;

/// Bytes of free pages, and of the log. A record takes about two thousand.
const RESERVE: i64 = 4 << 20;
/// Number of free bytes below which the reserve is refilled.
const LEAST: i64 = RESERVE / 4;

/// Refills the reserve of SQLite if it is low. One transaction of that size makes the log as long.
pub(super) async fn keep(database: &Database) -> StoreResult<()> {
    if database.dialect != Dialect::Sqlite {
        return Ok(());
    }
    let free = "SELECT freelist_count * page_size FROM pragma_freelist_count, pragma_page_size";
    let row = sqlx::query(free).fetch_one(&database.readers).await?;
    if LEAST <= row.try_get::<i64, _>(0)? {
        return Ok(());
    }
    let mut transaction = database.begin().await?;
    sqlx::raw_sql("CREATE TABLE reserve (bytes BLOB)")
        .execute(&mut *transaction)
        .await?;
    sqlx::query("INSERT INTO reserve VALUES (zeroblob($1))")
        .bind(RESERVE)
        .execute(&mut *transaction)
        .await?;
    sqlx::raw_sql("DROP TABLE reserve")
        .execute(&mut *transaction)
        .await?;
    transaction.commit().await?;
    Ok(())
}
