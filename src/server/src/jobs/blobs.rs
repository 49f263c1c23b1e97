//! The storage interface for job files.

use std::ops::Range;
use std::path::Path;

use futures_util::future::BoxFuture;
use futures_util::stream::BoxStream;

use super::job::JobId;
use super::store_error::StoreResult;
use super::store_id::StoreId;

/// Content of a file as a stream of blocks.
pub type Content = BoxStream<'static, StoreResult<Vec<u8>>>;

/// Files of jobs, under keys such as `ID/input/0`. A file exists completely or not at all, and is never modified.
pub trait Blobs: Send + Sync {
    /// Stores a local file under a key, durably. The local file may be moved away.
    fn put<'a>(&'a self, key: &'a str, from: &'a Path) -> BoxFuture<'a, StoreResult<()>>;

    /// Copies the content of one key to another, as durably as [`Blobs::put`].
    fn copy<'a>(&'a self, from: &'a str, to: &'a str) -> BoxFuture<'a, StoreResult<()>>;

    /// Copies a file to a local path.
    fn fetch<'a>(&'a self, key: &'a str, to: &'a Path) -> BoxFuture<'a, StoreResult<()>>;

    /// Reads this byte range of a file.
    fn read<'a>(&'a self, key: &'a str, range: Range<u64>) -> BoxFuture<'a, StoreResult<Content>>;

    /// Returns the ids of the jobs that have files.
    fn owners(&self) -> BoxFuture<'_, StoreResult<Vec<JobId>>>;

    /// Returns the keys in this folder, with file sizes in bytes.
    fn list<'a>(&'a self, folder: &'a str) -> BoxFuture<'a, StoreResult<Vec<(String, u64)>>>;

    /// Returns the id of the store that the files belong to; `None` for new storage and for that of version 0.1.0.
    fn identity(&self) -> BoxFuture<'_, StoreResult<Option<StoreId>>>;

    /// Records the id of the store that the files belong to.
    fn identify(&self, identity: StoreId) -> BoxFuture<'_, StoreResult<()>>;

    /// Returns the number of free bytes; `None` if the storage does not count them.
    fn free_bytes(&self) -> StoreResult<Option<u64>>;

    /// Checks that files can be stored now, by writing a probe from time to time.
    fn check(&self) -> BoxFuture<'_, StoreResult<()>>;

    /// Removes all files in this folder. Succeeds if there are none.
    fn remove<'a>(&'a self, folder: &'a str) -> BoxFuture<'a, StoreResult<()>>;
}
