//! The SQLite database: how it is opened, and what is in it.

use std::path::Path;
use std::time::Duration;

use sqlx::sqlite::{
    SqliteConnectOptions, SqliteJournalMode, SqlitePool, SqlitePoolOptions, SqliteSynchronous,
};
use sqlx::{Row, Sqlite, Transaction};

use crate::jobs::{StoreError, StoreResult};

/// The n-th leads from version n to the next; each sets `user_version`.
const STEPS: [&str; 2] = [include_str!("schema/1.sql"), include_str!("schema/2.sql")];
/// How long a statement waits for another one's lock.
const BUSY: Duration = Duration::from_secs(5);

/// An open database file. What is committed is durable.
pub(super) struct Database {
    pub pool: SqlitePool,
}

impl From<sqlx::Error> for StoreError {
    fn from(error: sqlx::Error) -> Self {
        Self(error.to_string())
    }
}

impl Database {
    /// Opens the file, makes it if need be, and brings what an earlier version of the program made up to date.
    pub async fn open(file: &Path) -> StoreResult<Self> {
        let options = SqliteConnectOptions::new()
            .filename(file)
            .create_if_missing(true)
            .journal_mode(SqliteJournalMode::Wal)
            .synchronous(SqliteSynchronous::Full)
            .foreign_keys(true)
            .busy_timeout(BUSY);
        let pool = SqlitePoolOptions::new()
            .max_connections(4)
            .connect_with(options)
            .await?;
        let database = Self { pool };
        let mut transaction = database.begin().await?;
        let version: i64 = sqlx::query("PRAGMA user_version")
            .fetch_one(&mut *transaction)
            .await?
            .try_get(0)?;
        let missing = usize::try_from(version).map(|done| STEPS.get(done..));
        let Ok(Some(missing)) = missing else {
            let (file, known) = (file.display(), STEPS.len());
            return Err(StoreError(format!(
                "{file} has schema version {version}; this program supports {known}"
            )));
        };
        for step in missing {
            sqlx::raw_sql(*step).execute(&mut *transaction).await?;
        }
        transaction.commit().await?;
        Ok(database)
    }

    /// Takes the write lock at once: a transaction that reads first could not get it later.
    pub async fn begin(&self) -> sqlx::Result<Transaction<'_, Sqlite>> {
        self.pool.begin_with("BEGIN IMMEDIATE").await
    }
}
