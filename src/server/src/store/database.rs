//! The database: opening, migration and connections.

use std::io::ErrorKind;
use std::time::{Duration, Instant};

use sqlx::any::AnyPoolOptions;
use sqlx::migrate::{Migration, MigrationType, Migrator};
use sqlx::{Any, AnyConnection, AnyPool, AssertSqlSafe, Connection, Row, SqlSafeStr, Transaction};

use super::dialect::Dialect;
use crate::jobs::{StoreError, StoreResult};

/// Migrations: the n-th one leads from version n to the next. Programs of the previous version must keep working
/// after it: columns are added, never removed.
const SQLITE: [&str; 14] = [
    include_str!("schema/sqlite/1.sql"),
    include_str!("schema/sqlite/2.sql"),
    include_str!("schema/sqlite/3.sql"),
    include_str!("schema/sqlite/4.sql"),
    include_str!("schema/sqlite/5.sql"),
    include_str!("schema/sqlite/6.sql"),
    include_str!("schema/sqlite/7.sql"),
    include_str!("schema/sqlite/8.sql"),
    include_str!("schema/sqlite/9.sql"),
    include_str!("schema/sqlite/10.sql"),
    include_str!("schema/sqlite/11.sql"),
    include_str!("schema/sqlite/12.sql"),
    include_str!("schema/sqlite/13.sql"),
    include_str!("schema/sqlite/14.sql"),
];
const POSTGRES: [&str; 11] = [
    include_str!("schema/postgres/1.sql"),
    include_str!("schema/postgres/2.sql"),
    include_str!("schema/postgres/3.sql"),
    include_str!("schema/postgres/4.sql"),
    include_str!("schema/postgres/5.sql"),
    include_str!("schema/postgres/6.sql"),
    include_str!("schema/postgres/7.sql"),
    include_str!("schema/postgres/8.sql"),
    include_str!("schema/postgres/9.sql"),
    include_str!("schema/postgres/10.sql"),
    include_str!("schema/postgres/11.sql"),
];

/// Settings of every connection to SQLite. Commits are durable. The log is copied into the database after 256 pages, a
/// quarter of SQLite's default, so it stays short. Sorting stays in memory, because an image has no folder for
/// temporary files.
const PRAGMAS: &str = "PRAGMA journal_mode = WAL; PRAGMA synchronous = FULL;
    PRAGMA wal_autocheckpoint = 256; PRAGMA foreign_keys = ON; PRAGMA busy_timeout = 5000;
    PRAGMA temp_store = MEMORY;";
/// Number of connections per process to PostgreSQL, and of reading connections to SQLite. With the one that listens
/// for hints, eleven processes fit into the 100 connections that PostgreSQL allows by default.
const POSTGRES_CONNECTIONS: u32 = 8;
const SQLITE_READERS: u32 = 4;
/// Time limit for a free connection, for connecting, and for the check that a connection is alive. It is a third of
/// the time limit of a call, so that its error, which names the cause, comes first.
const PATIENCE: Duration = Duration::from_secs(5);
/// Delay between attempts to connect at startup. Shorter delays only add load to a server that is starting.
const PROBE_PAUSE: Duration = Duration::from_millis(200);

/// An open database. Commits are durable.
pub(super) struct Database {
    /// Connections for reading.
    pub readers: AnyPool,
    /// Connections for writing. SQLite allows one writer at a time and makes others poll, so there is only one
    /// connection here, for which writers queue.
    pub writers: AnyPool,
    pub dialect: Dialect,
    url: String,
}

impl Database {
    /// Opens a database, creates the file if needed, and migrates a database of an earlier version.
    pub async fn open(url: &str) -> StoreResult<Self> {
        sqlx::any::install_default_drivers();
        let dialect = Dialect::of(url).ok_or_else(|| {
            StoreError::Other("the URL of a database begins with postgres:".to_owned())
        })?;
        probe(url, PATIENCE).await?;
        let pool = async |connections| pool(dialect, connections).connect(url).await;
        let database = match dialect {
            Dialect::Sqlite => Self {
                writers: pool(1).await?,
                readers: pool(SQLITE_READERS).await?,
                dialect,
                url: url.to_owned(),
            },
            Dialect::Postgres => {
                let pool = pool(POSTGRES_CONNECTIONS).await?;
                Self {
                    readers: pool.clone(),
                    writers: pool,
                    dialect,
                    url: url.to_owned(),
                }
            }
        };
        database.migrate().await?;
        Ok(database)
    }

    async fn migrate(&self) -> StoreResult<()> {
        let steps = match self.dialect {
            Dialect::Sqlite => &SQLITE[..],
            Dialect::Postgres => &POSTGRES[..],
        };
        let migration = |(index, sql): (usize, &&'static str)| {
            let (version, sql) = (index as i64 + 1, sql.into_sql_str());
            Migration::new(version, "".into(), MigrationType::Simple, sql, false)
        };
        let migrations = steps.iter().enumerate().map(migration).collect();
        let mut migrator = Migrator::with_migrations(migrations);
        // Accept versions of a newer program: it may have migrated the database during a rolling update.
        migrator.set_ignore_missing(true);
        let mut connection = self.writers.acquire().await?;
        if self.dialect == Dialect::Sqlite {
            let version: i64 = sqlx::query("PRAGMA user_version")
                .fetch_one(&mut *connection)
                .await?
                .try_get(0)?;
            if 0 < version {
                migrator.skip(&mut *connection, Some(version)).await?;
            }
        }
        migrator.run(&mut *connection).await?;
        Ok(())
    }

    /// Replaces the error that no connection became free by the cause, if the database cannot be reached.
    pub async fn explained(&self, error: StoreError) -> StoreError {
        match error {
            StoreError::Unavailable(_) => match probe(&self.url, Duration::ZERO).await {
                Err(cause) => cause,
                Ok(()) => error,
            },
            error => error,
        }
    }

    /// Begins a writing transaction.
    pub async fn begin(&self) -> sqlx::Result<Transaction<'_, Any>> {
        self.writers.begin_with(self.dialect.begin()).await
    }

    /// Returns a statement in the dialect of this database; see [`Dialect::sql`].
    pub fn sql(&self, text: &str) -> AssertSqlSafe<String> {
        AssertSqlSafe(self.dialect.sql(text))
    }
}

/// Connects once to learn the cause of a failure, since a pool only reports a timeout. Retries for the time
/// `patience` while a server is starting.
async fn probe(url: &str, patience: Duration) -> StoreResult<()> {
    let begin = Instant::now();
    loop {
        let answer = tokio::time::timeout(PATIENCE, AnyConnection::connect(url)).await;
        let error = match answer {
            Ok(Ok(connection)) => {
                // The connection works, so its end does not matter.
                let _ = connection.close().await;
                return Ok(());
            }
            Ok(Err(error)) => StoreError::from(error),
            Err(_) => StoreError::Unavailable(format!("no answer within {PATIENCE:?}")),
        };
        if !error.is_passing() || patience <= begin.elapsed() {
            return Err(error);
        }
        tokio::time::sleep(PROBE_PAUSE).await;
    }
}

fn pool(dialect: Dialect, connections: u32) -> AnyPoolOptions {
    let options = AnyPoolOptions::new()
        .max_connections(connections)
        .acquire_timeout(PATIENCE)
        .after_release(|connection, _| Box::pin(is_usable(connection)));
    match dialect {
        Dialect::Sqlite => {
            options
                .idle_timeout(None)
                .max_lifetime(None)
                .after_connect(|connection, _| {
                    Box::pin(async move {
                        sqlx::raw_sql(PRAGMAS).execute(connection).await?;
                        Ok(())
                    })
                })
        }
        Dialect::Postgres => options,
    }
}

/// Returns whether a connection may be reused. SQLite ends a transaction by itself when a disk is full; sqlx then
/// fails to roll it back, considers it open forever, and refuses every further one. A connection that was silently
/// cut does not answer, and must not keep its place.
async fn is_usable(connection: &mut AnyConnection) -> sqlx::Result<bool> {
    // The ping also waits for the rollback of a dropped transaction.
    let answer = tokio::time::timeout(PATIENCE, connection.ping()).await;
    answer.unwrap_or_else(|_| Err(sqlx::Error::Io(ErrorKind::TimedOut.into())))?;
    Ok(!connection.is_in_transaction())
}
