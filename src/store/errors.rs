//! Errors of databases as errors of the store.

use sqlx::Error;

use crate::jobs::StoreError;

/// What SQLite calls a full disk, a database in use, and a table in use: the low byte of its codes.
const SQLITE_FULL: i32 = 13;
const SQLITE_BUSY: [i32; 2] = [5, 6];

impl From<Error> for StoreError {
    fn from(error: Error) -> Self {
        let text = error.to_string();
        match error {
            Error::Io(error) => match Self::from(error) {
                Self::Full(text) => Self::Full(text),
                _ => Self::Unavailable(text),
            },
            Error::PoolTimedOut | Error::PoolClosed | Error::WorkerCrashed => {
                Self::Unavailable(text)
            }
            Error::Database(error) if error.is_unique_violation() => Self::Conflict(text),
            Error::Database(error) => {
                let code = error.code().and_then(|code| code.parse::<i32>().ok());
                match code.map(|code| code & 0xff) {
                    Some(SQLITE_FULL) => Self::Full(text),
                    Some(code) if SQLITE_BUSY.contains(&code) => Self::Unavailable(text),
                    _ => Self::Other(text),
                }
            }
            _ => Self::Other(text),
        }
    }
}
