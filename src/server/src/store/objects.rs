//! Job files in an object store with the S3 protocol.

use std::ops::Range;
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use futures_util::future::BoxFuture;
use futures_util::{FutureExt, StreamExt, TryStreamExt, stream};
use object_store::aws::{AmazonS3Builder, AmazonS3ConfigKey};
use object_store::buffered::BufWriter;
use object_store::path::Path as Key;
use object_store::prefix::PrefixStore;
use object_store::{
    ClientOptions, Error, GetOptions, GetRange, ObjectStore, ObjectStoreExt, RetryConfig,
};
use tokio::fs::File;
use tokio::io::AsyncWriteExt;

use crate::jobs::{Blobs, Content, JobId, StoreError, StoreId, StoreResult};

/// Timeouts of a request and of connecting. Files are sent in parts of 10 MiB, the default of `BufWriter`, and fetched
/// in one request each. A longer timeout lets a slow store occupy a slot; a shorter one fails large files on slow
/// links.
const REQUEST_TIME: Duration = Duration::from_mins(5);
const CONNECT_TIME: Duration = Duration::from_secs(5);
/// Timeout for the next bytes of a response, since a connection may be silently cut. Without it, only the timeout of
/// the whole request would notice.
const SILENCE: Duration = Duration::from_secs(30);
/// Total time, and number, of retries of a failed request. After that, the caller hands its job back or answers 503,
/// and retries later. More retries occupy the caller for longer.
const RETRY_TIME: Duration = Duration::from_secs(10);
const RETRIES: usize = 4;

/// Names of the object with the id of the store and of a probe written to check access. They are not job ids.
const IDENTITY: &str = "store-id";
const PROBE: &str = "probe";
/// Minimum time between two probes, since each costs a request. A longer time delays the report of a failure in
/// `/readyz` and in the metrics.
const PROBE_PAUSE: Duration = Duration::from_mins(1);

/// A bucket, or the part of it under a prefix. An object exists completely or not at all.
pub struct ObjectBlobs {
    store: Arc<dyn ObjectStore>,
    /// Time of the last probe.
    probed: Mutex<Option<Instant>>,
}

impl ObjectBlobs {
    /// Opens the bucket and prefix of `s3://BUCKET/PREFIX`. Endpoint, region, credentials and the like are set by
    /// their usual variables, such as `AWS_ENDPOINT_URL`; other variables are ignored.
    pub fn open(url: &str, variables: impl Iterator<Item = (String, String)>) -> StoreResult<Self> {
        // The call fails if another part of the process has chosen a provider already.
        let _ = rustls::crypto::ring::default_provider().install_default();
        // Set the timeouts and the retries.
        let client = ClientOptions::new()
            .with_connect_timeout(CONNECT_TIME)
            .with_read_timeout(SILENCE)
            .with_timeout(REQUEST_TIME);
        let retry = RetryConfig {
            max_retries: RETRIES,
            retry_timeout: RETRY_TIME,
            ..RetryConfig::default()
        };
        let mut builder = AmazonS3Builder::new()
            .with_url(url)
            .with_client_options(client)
            .with_retry(retry);
        // Apply the environment variables.
        for (name, value) in variables.filter(|(name, _)| name.starts_with("AWS_")) {
            if let Ok(key) = name.to_ascii_lowercase().parse::<AmazonS3ConfigKey>() {
                builder = builder.with_config(key, value);
            }
        }
        let bucket = builder.build()?;
        // Restrict the bucket to the prefix.
        let (_, path) = url
            .trim_start_matches("s3://")
            .split_once('/')
            .unwrap_or_default();
        let prefix = Key::parse(path).map_err(Error::from)?;
        Ok(Self {
            store: Arc::new(PrefixStore::new(bucket, prefix)),
            probed: Mutex::new(None),
        })
    }

    async fn fetch_to(&self, key: &str, to: &Path) -> StoreResult<()> {
        let mut content = self.store.get(&Key::from(key)).await?.into_stream();
        let mut file = File::create(to).await?;
        while let Some(block) = content.try_next().await? {
            file.write_all(&block).await?;
        }
        Ok(file.flush().await?)
    }

    async fn read_from(&self, key: &str, range: Range<u64>) -> StoreResult<Content> {
        if range.is_empty() {
            return Ok(stream::empty().boxed());
        }
        // Request the range.
        let options = GetOptions {
            range: Some(GetRange::Bounded(range)),
            ..GetOptions::default()
        };
        let end = options.range.as_ref().map_or(0, |range| match range {
            GetRange::Bounded(range) => range.end,
            _ => 0,
        });
        let key = Key::from(key);
        let content = match self.store.get_opts(&key, options).await {
            Err(error @ Error::Generic { .. }) => {
                // A server rejects a range beyond the end, so the object may have lost bytes: compare its size.
                let size = self.store.head(&key).await?.size;
                return Err(if size < end {
                    StoreError::Damaged("a stored file is shorter than it was".to_owned())
                } else {
                    error.into()
                });
            }
            content => content?,
        };
        let blocks = content.into_stream().map(|block| Ok(block?.into()));
        Ok(blocks.boxed())
    }
}

impl Blobs for ObjectBlobs {
    fn put<'a>(&'a self, key: &'a str, from: &'a Path) -> BoxFuture<'a, StoreResult<()>> {
        async move {
            let mut file = File::open(from).await?;
            let mut object = BufWriter::new(Arc::clone(&self.store), Key::from(key));
            let sent = async {
                tokio::io::copy(&mut file, &mut object).await?;
                object.shutdown().await
            };
            // The failure is on the side of the store, not of a local disk.
            sent.await
                .map_err(|error| StoreError::Unavailable(error.to_string()))
        }
        .boxed()
    }

    fn copy<'a>(&'a self, from: &'a str, to: &'a str) -> BoxFuture<'a, StoreResult<()>> {
        async move { Ok(self.store.copy(&Key::from(from), &Key::from(to)).await?) }.boxed()
    }

    fn fetch<'a>(&'a self, key: &'a str, to: &'a Path) -> BoxFuture<'a, StoreResult<()>> {
        self.fetch_to(key, to).boxed()
    }

    fn read<'a>(&'a self, key: &'a str, range: Range<u64>) -> BoxFuture<'a, StoreResult<Content>> {
        self.read_from(key, range).boxed()
    }

    fn owners(&self) -> BoxFuture<'_, StoreResult<Vec<JobId>>> {
        async move {
            let listed = self.store.list_with_delimiter(None).await?;
            let names = listed.common_prefixes.iter();
            // Skip objects that this program did not create.
            Ok(names
                .filter_map(|name| name.as_ref().parse().ok())
                .collect())
        }
        .boxed()
    }

    fn list<'a>(&'a self, folder: &'a str) -> BoxFuture<'a, StoreResult<Vec<(String, u64)>>> {
        async move {
            let folder = Key::from(folder);
            let objects = self.store.list(Some(&folder));
            let files = objects.map_ok(|object| (object.location.to_string(), object.size));
            Ok(files.try_collect().await?)
        }
        .boxed()
    }

    fn identity(&self) -> BoxFuture<'_, StoreResult<Option<StoreId>>> {
        async move {
            let object = match self.store.get(&Key::from(IDENTITY)).await {
                Ok(object) => object,
                // A bucket that does not exist has no objects either.
                Err(Error::NotFound { .. }) => {
                    let mut objects = self.store.list(None);
                    objects.try_next().await.map_err(|error| unusable(&error))?;
                    return Ok(None);
                }
                Err(error) => return Err(unusable(&error)),
            };
            let bytes = object.bytes().await?;
            let parsed = std::str::from_utf8(&bytes).ok().map(str::parse);
            match parsed {
                Some(Ok(identity)) => Ok(Some(identity)),
                _ => Err(StoreError::Other(format!(
                    "{IDENTITY} has no identity in it"
                ))),
            }
        }
        .boxed()
    }

    fn identify(&self, identity: StoreId) -> BoxFuture<'_, StoreResult<()>> {
        async move {
            let key = Key::from(IDENTITY);
            let put = self.store.put(&key, identity.to_string().into()).await;
            put.map_err(|error| unusable(&error))?;
            Ok(())
        }
        .boxed()
    }

    fn free_bytes(&self) -> StoreResult<Option<u64>> {
        Ok(None)
    }

    fn check(&self) -> BoxFuture<'_, StoreResult<()>> {
        async move {
            let last = *self.probed.lock().unwrap_or_else(PoisonError::into_inner);
            if last.is_some_and(|last| last.elapsed() < PROBE_PAUSE) {
                return Ok(());
            }
            let put = self.store.put(&Key::from(PROBE), "probe".into()).await;
            put.map_err(|error| unusable(&error))?;
            *self.probed.lock().unwrap_or_else(PoisonError::into_inner) = Some(Instant::now());
            Ok(())
        }
        .boxed()
    }

    fn remove<'a>(&'a self, folder: &'a str) -> BoxFuture<'a, StoreResult<()>> {
        async move {
            let folder = Key::from(folder);
            let objects = self.store.list(Some(&folder));
            let keys = objects.map_ok(|object| object.location).boxed();
            let removed = self.store.delete_stream(keys);
            removed.try_for_each(async |_| Ok(())).await?;
            Ok(())
        }
        .boxed()
    }
}

/// Returns the error of an unusable bucket, with a hint at the setting that may be missing.
fn unusable(error: &Error) -> StoreError {
    let text = error.to_string();
    let is_absent = matches!(error, Error::NotFound { .. });
    let is_plain = ["builder error", "URL scheme is not allowed"];
    let hint = if is_plain.iter().any(|it| text.contains(it)) {
        "; an http:// endpoint needs AWS_ALLOW_HTTP=true"
    } else if is_absent || text.contains("NoSuchBucket") {
        "; does the bucket exist? AWS_ENDPOINT_URL names the server"
    } else {
        ""
    };
    StoreError::Unavailable(format!("{text}{hint}"))
}

impl From<Error> for StoreError {
    fn from(error: Error) -> Self {
        let text = error.to_string();
        match error {
            Error::Generic { .. } | Error::JoinError { .. } => Self::Unavailable(text),
            // The credentials may have expired, or the clock may differ too much from the server's. The job is not at
            // fault, and another process may have access.
            Error::PermissionDenied { .. } | Error::Unauthenticated { .. } => {
                Self::Unavailable(text)
            }
            Error::NotFound { .. } => Self::missing(),
            _ => Self::Other(text),
        }
    }
}
