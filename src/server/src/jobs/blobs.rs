//! What the queue needs from a place for files.

use std::ops::Range;
use std::path::Path;

use futures_util::future::BoxFuture;
use futures_util::stream::BoxStream;

use super::job::JobId;
use super::store_error::StoreResult;
use super::store_id::StoreId;

/// The content of a file as it is read.
pub type Content = BoxStream<'static, StoreResult<Vec<u8>>>;

/// Files of jobs, under keys such as `ID/input/0`. A file is there completely or not at all, and
/// nobody writes to one.
pub trait Blobs: Send + Sync {
    /// Stores a local file under a key, durably. The file may be moved away.
    fn put<'a>(&'a self, key: &'a str, from: &'a Path) -> BoxFuture<'a, StoreResult<()>>;

    /// Stores the content of a key under another one as well, as durably as [`Blobs::put`].
    fn copy<'a>(&'a self, from: &'a str, to: &'a str) -> BoxFuture<'a, StoreResult<()>>;

    /// Brings a file to a local path.
    fn fetch<'a>(&'a self, key: &'a str, to: &'a Path) -> BoxFuture<'a, StoreResult<()>>;

    /// Reads these bytes of a file.
    fn read<'a>(&'a self, key: &'a str, range: Range<u64>) -> BoxFuture<'a, StoreResult<Content>>;

    /// The jobs that have files.
    fn owners(&self) -> BoxFuture<'_, StoreResult<Vec<JobId>>>;

    /// The files whose keys begin with this folder, with their sizes.
    fn list<'a>(&'a self, folder: &'a str) -> BoxFuture<'a, StoreResult<Vec<(String, u64)>>>;

    /// Which store the files are of; `None` in a new place, and in one of version 0.1.0.
    fn identity(&self) -> BoxFuture<'_, StoreResult<Option<StoreId>>>;

    /// Notes which store the files are of.
    fn identify(&self, identity: StoreId) -> BoxFuture<'_, StoreResult<()>>;

    /// Bytes that may still be written; `None` where nobody counts.
    fn free_bytes(&self) -> StoreResult<Option<u64>>;

    /// Whether files can be stored now. Writes something from time to time.
    fn check(&self) -> BoxFuture<'_, StoreResult<()>>;

    /// Removes all files whose keys begin with this folder. It is no error if there are none.
    fn remove<'a>(&'a self, folder: &'a str) -> BoxFuture<'a, StoreResult<()>>;
}
