//! Job files in a folder, local or on a network.

use std::fs::File;
use std::io::{ErrorKind, SeekFrom};
use std::ops::Range;
use std::path::{Path, PathBuf};

use futures_util::future::{BoxFuture, try_join_all};
use futures_util::{FutureExt, StreamExt};
use tokio::fs;
use tokio::io::{AsyncReadExt, AsyncSeekExt};
use tokio_util::io::ReaderStream;

use uuid::Uuid;

use crate::jobs::{Blobs, Content, JobId, StoreError, StoreId, StoreResult, free_bytes};

/// Name of the file with the id of the store. It is not a job id.
const IDENTITY: &str = "store-id";

/// Number of further attempts to remove a folder into which a picture was stored meanwhile: one for each of the three
/// pictures of a job.
const REMOVALS: usize = 3;

/// A folder with one subfolder per job. Files are moved rather than copied if they are on the same file system.
pub struct FileBlobs {
    root: PathBuf,
}

impl FileBlobs {
    /// Opens this folder, and creates it if needed.
    pub fn open(root: &Path) -> StoreResult<Self> {
        std::fs::create_dir_all(root).map_err(StoreError::at(root))?;
        Ok(Self {
            root: root.to_owned(),
        })
    }

    /// Syncs all folders on the path of a file, so that its name is durable. They are synced concurrently, which the
    /// file system can combine.
    async fn sync_folders_of(&self, path: &Path) -> StoreResult<()> {
        let folders = path.ancestors().skip(1);
        let folders = folders.take_while(|folder| folder.starts_with(&self.root));
        let synced = folders.map(|folder| {
            let folder = folder.to_owned();
            blocking(move || File::open(folder)?.sync_all().map_err(StoreError::from))
        });
        try_join_all(synced).await?;
        Ok(())
    }
}

/// Runs blocking work on a thread for it, as one step.
async fn blocking<T: Send + 'static>(
    work: impl FnOnce() -> StoreResult<T> + Send + 'static,
) -> StoreResult<T> {
    let done = tokio::task::spawn_blocking(work).await;
    done.map_err(std::io::Error::from)?
}

/// Returns whether an error means that there is no file at the path.
fn is_absent(error: &std::io::Error, path: &Path) -> bool {
    error.kind() == ErrorKind::NotFound && !path.exists()
}

/// Lists the files below a folder by their paths from the root, with sizes in bytes. Skips files that disappear
/// meanwhile.
fn listed(root: &Path, folder: &Path) -> std::io::Result<Vec<(String, u64)>> {
    let mut files = Vec::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(folder) = folders.pop() {
        let entries = match std::fs::read_dir(&folder) {
            Err(error) if error.kind() == ErrorKind::NotFound => continue,
            entries => entries?,
        };
        for entry in entries {
            let entry = entry?;
            let path = entry.path();
            match entry.metadata() {
                Ok(data) if data.is_dir() => folders.push(path),
                Ok(data) => {
                    let key = path.strip_prefix(root).unwrap_or(&path);
                    files.push((key.to_string_lossy().into_owned(), data.len()));
                }
                Err(error) if error.kind() == ErrorKind::NotFound => {}
                Err(error) => return Err(error),
            }
        }
    }
    files.sort();
    Ok(files)
}

/// Moves a file to its place after syncing its content.
fn moved(from: &Path, to: &Path) -> StoreResult<()> {
    if let Some(folder) = to.parent() {
        std::fs::create_dir_all(folder).map_err(StoreError::at(folder))?;
    }
    File::open(from)?.sync_all()?;
    match std::fs::rename(from, to) {
        Err(error) if error.kind() == ErrorKind::CrossesDevices => {
            let partial = to.with_extension("partial");
            std::fs::copy(from, &partial)?;
            File::open(&partial)?.sync_all()?;
            std::fs::rename(partial, to)?;
        }
        renamed => renamed?,
    }
    Ok(())
}

impl Blobs for FileBlobs {
    /// Syncs the content before the name, and the name with all folders on its path before returning.
    fn put<'a>(&'a self, key: &'a str, from: &'a Path) -> BoxFuture<'a, StoreResult<()>> {
        async move {
            let (from, to) = (from.to_owned(), self.root.join(key));
            let place = to.clone();
            blocking(move || moved(&from, &place)).await?;
            self.sync_folders_of(&to).await
        }
        .boxed()
    }

    fn copy<'a>(&'a self, from: &'a str, to: &'a str) -> BoxFuture<'a, StoreResult<()>> {
        async move {
            let path = self.root.join(to);
            fs::create_dir_all(path.parent().unwrap_or(&self.root)).await?;
            self.fetch(from, &path).await?;
            self.sync_folders_of(&path).await
        }
        .boxed()
    }

    /// Creates a hard link where possible: stored files are never modified.
    fn fetch<'a>(&'a self, key: &'a str, to: &'a Path) -> BoxFuture<'a, StoreResult<()>> {
        async move {
            let from = self.root.join(key);
            match fs::hard_link(&from, to).await {
                Err(error) if error.kind() == ErrorKind::CrossesDevices => {
                    fs::copy(from, to).await?;
                }
                Err(error) if is_absent(&error, &from) => return Err(StoreError::missing()),
                linked => linked.map_err(StoreError::at(&from))?,
            }
            Ok(())
        }
        .boxed()
    }

    fn read<'a>(&'a self, key: &'a str, range: Range<u64>) -> BoxFuture<'a, StoreResult<Content>> {
        async move {
            let path = self.root.join(key);
            let mut file = match fs::File::open(&path).await {
                Err(error) if is_absent(&error, &path) => return Err(StoreError::missing()),
                opened => opened.map_err(StoreError::at(&path))?,
            };
            file.seek(SeekFrom::Start(range.start)).await?;
            let blocks = ReaderStream::new(file.take(range.end - range.start));
            let content = blocks.map(|block| Ok(block.map(Vec::from)?));
            Ok(content.boxed())
        }
        .boxed()
    }

    fn owners(&self) -> BoxFuture<'_, StoreResult<Vec<JobId>>> {
        async move {
            let mut folders = fs::read_dir(&self.root).await?;
            let mut owners = Vec::new();
            while let Some(folder) = folders.next_entry().await? {
                // Skip files and folders that this program did not create.
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

    fn list<'a>(&'a self, folder: &'a str) -> BoxFuture<'a, StoreResult<Vec<(String, u64)>>> {
        async move {
            let (root, folder) = (self.root.clone(), self.root.join(folder));
            blocking(move || Ok(listed(&root, &folder)?)).await
        }
        .boxed()
    }

    fn identity(&self) -> BoxFuture<'_, StoreResult<Option<StoreId>>> {
        async move {
            let path = self.root.join(IDENTITY);
            let text = match fs::read_to_string(&path).await {
                Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
                read => read.map_err(StoreError::at(&path))?,
            };
            let parsed = text.parse();
            parsed
                .map(Some)
                .map_err(|_| StoreError::Other(format!("{} has no identity in it", path.display())))
        }
        .boxed()
    }

    fn identify(&self, identity: StoreId) -> BoxFuture<'_, StoreResult<()>> {
        async move {
            let partial = self.root.join(format!("probe-{}", Uuid::now_v7()));
            let written = fs::write(&partial, format!("{identity}\n")).await;
            written.map_err(StoreError::at(&partial))?;
            let to = self.root.join(IDENTITY);
            blocking(move || moved(&partial, &to)).await?;
            self.sync_folders_of(&self.root.join(IDENTITY)).await
        }
        .boxed()
    }

    fn free_bytes(&self) -> StoreResult<Option<u64>> {
        free_bytes(&self.root).map(Some)
    }

    fn check(&self) -> BoxFuture<'_, StoreResult<()>> {
        async move {
            let probe = self.root.join(format!("probe-{}", Uuid::now_v7()));
            let written = fs::write(&probe, "probe").await;
            written.map_err(StoreError::at(&probe))?;
            Ok(fs::remove_file(&probe).await?)
        }
        .boxed()
    }

    fn remove<'a>(&'a self, folder: &'a str) -> BoxFuture<'a, StoreResult<()>> {
        async move {
            let folder = self.root.join(folder);
            let mut removed = fs::remove_dir_all(&folder).await;
            for _ in 0..REMOVALS {
                match removed {
                    Err(error) if error.kind() == ErrorKind::DirectoryNotEmpty => {
                        removed = fs::remove_dir_all(&folder).await;
                    }
                    _ => break,
                }
            }
            match removed {
                Err(error) if error.kind() != ErrorKind::NotFound => Err(StoreError::from(error)),
                _ => Ok(()),
            }
        }
        .boxed()
    }
}
