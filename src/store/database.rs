//! The SQLite database: how it is opened, and what is in it.

use std::path::Path;
use std::time::Duration;

use sqlx::sqlite::{
    SqliteConnectOptions, SqliteJournalMode, SqlitePool, SqlitePoolOptions, SqliteSynchronous,
};
use sqlx::{Connection, Row, Sqlite, SqliteConnection, Transaction};

use super::reserve;
use crate::jobs::{StoreError, StoreResult};

/// The n-th leads from version n to the next; each sets `user_version`.
const STEPS: [&str; 3] = [
    include_str!("schema/1.sql"),
    include_str!("schema/2.sql"),
    include_str!("schema/3.sql"),
];
/// Pages of the log after which it is copied into the database: a quarter of what is set aside for it.
const CHECKPOINT_PAGES: &str = "256";
/// How long a statement waits for another one's lock.
const BUSY: Duration = Duration::from_secs(5);

/// An open database file. What is committed is durable.
pub(super) struct Database {
    pub pool: SqlitePool,
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
            .pragma("wal_autocheckpoint", CHECKPOINT_PAGES)
            .busy_timeout(BUSY);
        let pool = SqlitePoolOptions::new()
            .max_connections(4)
            .after_release(|connection, _| Box::pin(is_usable(connection)))
            .connect_with(options)
            .await?;
        let database = Self { pool };
        database.migrate(file).await?;
        reserve::keep(&database.pool).await?;
        Ok(database)
    }

    async fn migrate(&self, file: &Path) -> StoreResult<()> {
        let mut transaction = self.begin().await?;
        let version: i64 = sqlx::query("PRAGMA user_version")
            .fetch_one(&mut *transaction)
            .await?
            .try_get(0)?;
        let missing = usize::try_from(version).map(|done| STEPS.get(done..));
        let Ok(Some(missing)) = missing else {
            let (file, known) = (file.display(), STEPS.len());
            return Err(StoreError::Other(format!(
                "{file} has schema version {version}; this program supports {known}"
            )));
        };
        for step in missing {
            sqlx::raw_sql(*step).execute(&mut *transaction).await?;
        }
        transaction.commit().await?;
        Ok(())
    }

    /// Takes the write lock at once: a transaction that reads first could not get it later.
    pub async fn begin(&self) -> sqlx::Result<Transaction<'_, Sqlite>> {
        self.pool.begin_with("BEGIN IMMEDIATE").await
    }
}

/// Whether a connection may be used again. SQLite ends a transaction by itself when a disk is full; sqlx then fails to roll
/// it back, counts it as open for ever, and refuses every further one.
async fn is_usable(connection: &mut SqliteConnection) -> sqlx::Result<bool> {
    // After this, a rollback that a dropped transaction asked for is done.
    connection.ping().await?;
    Ok(!connection.is_in_transaction())
}
