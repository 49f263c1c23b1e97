//! Differences between SQLite and PostgreSQL.

use super::rows::COLUMNS;

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
