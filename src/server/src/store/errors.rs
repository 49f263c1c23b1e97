//! Conversion of database errors to store errors.

use sqlx::Error;
use sqlx::migrate::MigrateError;

use crate::jobs::StoreError;

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
