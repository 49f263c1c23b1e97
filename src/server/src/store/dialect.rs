//! What SQLite and PostgreSQL say differently.

use super::rows::COLUMNS;

/// The database engine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Dialect {
    Sqlite,
    Postgres,
}

impl Dialect {
    /// That of a database's URL.
    pub fn of(url: &str) -> Option<Self> {
        match url.split(':').next()? {
            "sqlite" => Some(Self::Sqlite),
            "postgres" | "postgresql" => Some(Self::Postgres),
            _ => None,
        }
    }

    /// Begins a transaction that writes. SQLite has one lock for all: a transaction that reads
    /// first could not get it later.
    pub fn begin(self) -> &'static str {
        match self {
            Self::Sqlite => "BEGIN IMMEDIATE",
            Self::Postgres => "BEGIN",
        }
    }

    /// Lets one submission at a time count the waiting jobs and look for its key. SQLite has one
    /// writer anyway.
    pub fn lock_submissions(self) -> Option<&'static str> {
        match self {
            Self::Sqlite => None,
            Self::Postgres => Some("SELECT pg_advisory_xact_lock(7521198)"),
        }
    }

    /// Lets one claim at a time count the running jobs of an owner.
    pub fn lock_claims(self) -> Option<&'static str> {
        match self {
            Self::Sqlite => None,
            Self::Postgres => Some("SELECT pg_advisory_xact_lock(7521199)"),
        }
    }

    /// A statement with `{columns}` of a job, and with what differs filled in: `{now}`, the clock; `{locked}`, keeping rows after
    /// waiting for others; `{free}`, keeping the rows of jobs that no other transaction keeps.
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

    /// Milliseconds since 1970 by the clock of the database, as it goes on within a transaction.
    fn now(self) -> &'static str {
        match self {
            Self::Sqlite => "CAST(unixepoch('now', 'subsec') * 1000 AS INTEGER)",
            Self::Postgres => "CAST(extract(epoch FROM clock_timestamp()) * 1000 AS BIGINT)",
        }
    }
}
