//! The database: opening, migration, connections, dialects and errors.

use std::io::ErrorKind;
use std::time::{Duration, Instant};

use sqlx::any::AnyPoolOptions;
use sqlx::migrate::{MigrateError, Migration, MigrationType, Migrator};
use sqlx::{
    Any, AnyConnection, AnyPool, AssertSqlSafe, Connection, Error, Row, SqlSafeStr, Transaction,
};

use super::rows::COLUMNS;
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
        let database = match dialect {
            Dialect::Sqlite => Self {
                writers: pool(dialect, 1).connect(url).await?,
                readers: pool(dialect, SQLITE_READERS).connect(url).await?,
                dialect,
                url: url.to_owned(),
            },
            Dialect::Postgres => {
                let pool = pool(dialect, POSTGRES_CONNECTIONS).connect(url).await?;
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
        let migrations = (1..).zip(steps).map(|(version, sql)| {
            let sql = sql.into_sql_str();
            Migration::new(version, "".into(), MigrationType::Simple, sql, false)
        });
        let mut migrator = Migrator::with_migrations(migrations.collect());
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
    answer.unwrap_or_else(|_| Err(Error::Io(ErrorKind::TimedOut.into())))?;
    Ok(!connection.is_in_transaction())
}

// Differences between SQLite and PostgreSQL.

/// The database engine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Dialect {
    Sqlite,
    Postgres,
}

impl Dialect {
    /// Returns the engine for a database URL; `None` for an unknown scheme.
    pub fn of(url: &str) -> Option<Self> {
        match url.split(':').next()? {
            "sqlite" => Some(Self::Sqlite),
            "postgres" | "postgresql" => Some(Self::Postgres),
            _ => None,
        }
    }

    /// Returns the statement that begins a writing transaction. SQLite has a single lock, which a transaction that
    /// reads first could not get later.
    pub fn begin(self) -> &'static str {
        match self {
            Self::Sqlite => "BEGIN IMMEDIATE",
            Self::Postgres => "BEGIN",
        }
    }

    /// Returns the statement that lets one submission at a time count the queued jobs and look for its key; `None`
    /// for SQLite, which has one writer anyway.
    pub fn lock_submissions(self) -> Option<&'static str> {
        match self {
            Self::Sqlite => None,
            Self::Postgres => Some("SELECT pg_advisory_xact_lock(7521198)"),
        }
    }

    /// Returns the statement that lets one claim at a time count the running jobs of an owner; `None` for SQLite.
    pub fn lock_claims(self) -> Option<&'static str> {
        match self {
            Self::Sqlite => None,
            Self::Postgres => Some("SELECT pg_advisory_xact_lock(7521199)"),
        }
    }

    /// Expands a statement: `{columns}` to the columns of a job, `{now}` to the clock, `{locked}` to a lock on the
    /// rows after waiting for others, `{free}` to a lock on the job rows that no other transaction has locked.
    pub fn sql(self, text: &str) -> String {
        let (locked, free) = match self {
            Self::Sqlite => ("", ""),
            Self::Postgres => ("FOR UPDATE", "FOR UPDATE OF job SKIP LOCKED"),
        };
        text.replace("{columns}", COLUMNS)
            .replace("{now}", self.now())
            .replace("{locked}", locked)
            .replace("{free}", free)
    }

    /// Returns the expression for milliseconds since 1970 by the clock of the database, which advances within a
    /// transaction.
    fn now(self) -> &'static str {
        match self {
            Self::Sqlite => "CAST(unixepoch('now', 'subsec') * 1000 AS INTEGER)",
            Self::Postgres => "CAST(extract(epoch FROM clock_timestamp()) * 1000 AS BIGINT)",
        }
    }
}

// Conversion of database errors to store errors.

/// SQLite's result codes `SQLITE_FULL`, `SQLITE_BUSY` and `SQLITE_LOCKED`. Extended codes have them in the low byte.
const SQLITE_FULL: i32 = 13;
const SQLITE_BUSY: [i32; 2] = [5, 6];
/// PostgreSQL's code for a full disk, and the classes of its temporary errors: connections, deadlocks, lack of
/// resources, interventions of an operator such as a restart, its disk.
const POSTGRES_FULL: &str = "53100";
const POSTGRES_PASSING: [&str; 5] = ["08", "40", "53", "57", "58"];

impl From<Error> for StoreError {
    fn from(error: Error) -> Self {
        let text = error.to_string();
        match error {
            Error::Io(error) => match Self::from(error) {
                Self::Full(text) => Self::Full(text),
                _ => Self::Unavailable(text),
            },
            Error::PoolTimedOut => {
                Self::Unavailable("no connection to the database became free in time".to_owned())
            }
            Error::Database(error) if error.is_unique_violation() => Self::Conflict(text),
            Error::Database(error) => {
                let code = error.code().unwrap_or_default();
                // PostgreSQL's codes have five characters, SQLite's fewer digits.
                match code.parse::<i32>().map(|code| code & 0xff) {
                    _ if code == POSTGRES_FULL => Self::Full(text),
                    _ if code.len() == 5 && POSTGRES_PASSING.contains(&&code[..2]) => {
                        Self::Unavailable(text)
                    }
                    Ok(SQLITE_FULL) if code.len() < 5 => Self::Full(text),
                    Ok(low) if code.len() < 5 && SQLITE_BUSY.contains(&low) => {
                        Self::Unavailable(text)
                    }
                    _ => Self::Other(text),
                }
            }
            Error::PoolClosed | Error::WorkerCrashed | Error::Tls(_) | Error::Protocol(_) => {
                Self::Unavailable(text)
            }
            _ => Self::Other(text),
        }
    }
}

impl From<MigrateError> for StoreError {
    fn from(error: MigrateError) -> Self {
        match error {
            MigrateError::Execute(error) => error.into(),
            error => Self::Other(format!(
                "the database cannot be brought up to date: {error}"
            )),
        }
    }
}
