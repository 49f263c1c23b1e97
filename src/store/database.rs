//! The SQLite database: how it is opened, and what is in it.

use std::path::Path;
use std::time::Duration;

use sqlx::sqlite::{
    SqliteConnectOptions, SqliteJournalMode, SqlitePool, SqlitePoolOptions, SqliteSynchronous,
};
use sqlx::{Row, Sqlite, Transaction};

use crate::jobs::{StoreError, StoreResult};

const SCHEMA: &str = include_str!("schema.sql");
const SCHEMA_VERSION: i64 = 1;
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
    /// Opens the file, and makes it if need be.
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
        let version: i64 = sqlx::query("PRAGMA user_version")
            .fetch_one(&database.pool)
            .await?
            .try_get(0)?;
        match version {
            0 => {
                let mut transaction = database.begin().await?;
                sqlx::raw_sql(SCHEMA).execute(&mut *transaction).await?;
                transaction.commit().await?;
            }
            SCHEMA_VERSION => {}
            newer => {
                let file = file.display();
                return Err(StoreError(format!(
                    "{file} has schema version {newer}; this program knows {SCHEMA_VERSION}"
                )));
            }
        }
        Ok(database)
    }

    /// Takes the write lock at once: a transaction that reads first could not get it later.
    pub async fn begin(&self) -> sqlx::Result<Transaction<'_, Sqlite>> {
        self.pool.begin_with("BEGIN IMMEDIATE").await
    }
}
