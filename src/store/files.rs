//! Files of jobs in a local folder.

use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use futures_util::FutureExt;
use futures_util::future::BoxFuture;
use tokio::fs;

use crate::jobs::{Blobs, JobId, StoreError, StoreResult, free_bytes};

/// A folder with one subfolder per job. It must be on one file system with the folder files come from.
pub struct FileBlobs {
    root: PathBuf,
}

impl FileBlobs {
    /// Uses this folder, and makes it if need be.
    pub fn open(root: &Path) -> StoreResult<Self> {
        std::fs::create_dir_all(root)?;
        Ok(Self {
            root: root.to_owned(),
        })
    }
}

impl Blobs for FileBlobs {
    /// The content reaches the disk before the name does, and the name with all folders on its way before this returns.
    fn put<'a>(&'a self, key: &'a str, from: &'a Path) -> BoxFuture<'a, StoreResult<()>> {
        async move {
            let to = self.root.join(key);
            let folder = to.parent().unwrap_or(&self.root);
            fs::create_dir_all(folder).await?;
            fs::File::open(from).await?.sync_all().await?;
            fs::rename(from, &to).await?;
            for folder in to
                .ancestors()
                .skip(1)
                .take_while(|f| f.starts_with(&self.root))
            {
                fs::File::open(folder).await?.sync_all().await?;
            }
            Ok(())
        }
        .boxed()
    }

    /// A second name for the same content: nobody writes into a stored file.
    fn fetch<'a>(&'a self, key: &'a str, to: &'a Path) -> BoxFuture<'a, StoreResult<()>> {
        async move { Ok(fs::hard_link(self.root.join(key), to).await?) }.boxed()
    }

    fn open<'a>(&'a self, key: &'a str) -> BoxFuture<'a, StoreResult<fs::File>> {
        async move { Ok(fs::File::open(self.root.join(key)).await?) }.boxed()
    }

    fn owners(&self) -> BoxFuture<'_, StoreResult<Vec<JobId>>> {
        async move {
            let mut folders = fs::read_dir(&self.root).await?;
            let mut owners = Vec::new();
            while let Some(folder) = folders.next_entry().await? {
                // What has another name was not put here by this program.
                owners.extend(
                    folder
                        .file_name()
                        .to_str()
                        .and_then(|name| name.parse::<JobId>().ok()),
                );
            }
            Ok(owners)
        }
        .boxed()
    }

    fn free_bytes(&self) -> StoreResult<Option<u64>> {
        free_bytes(&self.root).map(Some)
    }

    fn remove(&self, id: JobId) -> BoxFuture<'_, StoreResult<()>> {
        async move {
            match fs::remove_dir_all(self.root.join(id.to_string())).await {
                Err(error) if error.kind() != ErrorKind::NotFound => Err(StoreError::from(error)),
                _ => Ok(()),
            }
        }
        .boxed()
    }
}
