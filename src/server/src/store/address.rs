//! File storage by URL.

use std::path::Path;

use percent_encoding::percent_decode_str;

use super::files::FileBlobs;
use super::objects::ObjectBlobs;
use crate::jobs::{Blobs, StoreError, StoreResult};

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
