//! Storage of job records, job files and keys.
//!
//! Records are in SQLite or in PostgreSQL, with shared code: `database.rs` has the few differences. Files are in a
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

mod database;
mod enqueue;
mod files;
mod keys;
mod objects;
mod outbox;
mod reading;
mod records;
mod rows;
mod transitions;

use std::path::Path;

use percent_encoding::percent_decode_str;

use crate::jobs::{Blobs, StoreError, StoreResult};

pub use files::FileBlobs;
pub use objects::ObjectBlobs;
pub use records::RecordStore;

/// Opens the file storage at a URL: `file:///FOLDER`, `s3://BUCKET` or `s3://BUCKET/PREFIX`. Environment variables
/// tell how to connect to a bucket.
pub fn blobs_at(url: &str) -> StoreResult<Box<dyn Blobs>> {
    match url.split_once("://") {
        Some(("file", path)) => {
            let path = percent_decode_str(path).decode_utf8_lossy();
            Ok(Box::new(FileBlobs::open(Path::new(path.as_ref()))?))
        }
        Some(("s3", _)) => Ok(Box::new(ObjectBlobs::open(url, std::env::vars())?)),
        _ => {
            let detail = "its URL begins with file:/// or s3://".to_owned();
            Err(StoreError::Other(detail))
        }
    }
}
