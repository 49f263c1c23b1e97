//! Where the records and files of jobs lie: an SQLite database and a folder.
//!
//! Both are below one data folder, which one server at a time may use:
//!
//! ```text
//! DATA/lock             held by the server that uses the folder
//! DATA/unwrapd.sqlite   records (write-ahead log beside it)
//! DATA/blobs/ID/…       input and output files
//! DATA/scratch/…        what is in the making; emptied at every start
//! ```

mod database;
mod errors;
mod files;
mod idempotency;
mod reserve;
mod rows;
mod sqlite;

pub use files::FileBlobs;
pub use sqlite::SqliteStore;
