//! Storage of job records, job files and keys.
//!
//! Records are in SQLite or in PostgreSQL, with shared code: `dialect.rs` has the few differences. Files are in a
//! folder or in an object store.
//!
//! An embedded service keeps both in one data folder, which one process at a time may use; only `unwrapd keys` opens
//! the records alongside it:
//!
//! ```text
//! DATA/lock             held by the process that uses the folder
//! DATA/unwrapd.sqlite   records (write-ahead log beside it)
//! DATA/blobs/ID/…       input and output files
//! DATA/scratch/…        temporary files; emptied at every start
//! ```

mod address;
mod claims;
mod database;
mod dialect;
mod errors;
mod files;
mod hints;
mod idempotency;
mod keys;
mod notices;
mod objects;
mod outbox;
mod quotas;
mod reading;
mod records;
mod rows;
mod transitions;
mod upkeep;
mod within;

pub use address::blobs_at;
pub use files::FileBlobs;
pub use objects::ObjectBlobs;
pub use records::RecordStore;
