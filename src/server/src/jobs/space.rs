//! Free space of file systems.

use std::path::Path;

use nix::sys::statvfs::statvfs;

use super::store_error::StoreResult;

/// Returns the number of bytes free for writing on the file system of a path.
pub fn free_bytes(path: &Path) -> StoreResult<u64> {
    let system = statvfs(path).map_err(std::io::Error::from)?;
    Ok(system.blocks_available() * system.fragment_size())
}
