//! Files of jobs in an object store that speaks the protocol of S3.

use std::ops::Range;
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

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

use crate::jobs::{Blobs, Content, JobId, StoreError, StoreResult};

/// For one request; files are sent and fetched in parts.
const REQUEST_TIME: Duration = Duration::from_mins(5);
const CONNECT_TIME: Duration = Duration::from_secs(5);
/// For the next bytes of an answer. A connection may be cut without anybody noticing.
const SILENCE: Duration = Duration::from_secs(30);
/// How long a request that fails is tried again; whoever asked tries later.
const RETRY_TIME: Duration = Duration::from_secs(10);
const RETRIES: usize = 4;

/// A bucket, or what of it has a prefix. An object is there completely or not at all.
pub struct ObjectBlobs {
    store: Arc<dyn ObjectStore>,
}

impl ObjectBlobs {
    /// The bucket and prefix of `s3://BUCKET/PREFIX`. Endpoint, region, keys and the like are set
    /// by variables with their usual names, such as `AWS_ENDPOINT_URL`; others are ignored.
    pub fn open(url: &str, variables: impl Iterator<Item = (String, String)>) -> StoreResult<Self> {
        // Another user of TLS in this process may have chosen first.
        let _ = rustls::crypto::ring::default_provider().install_default();
        let client = ClientOptions::new()
            .with_connect_timeout(CONNECT_TIME)
            .with_read_timeout(SILENCE)
            .with_timeout(REQUEST_TIME);
        let retry = RetryConfig {
            max_retries: RETRIES,
            retry_timeout: RETRY_TIME,
            ..RetryConfig::default()
        };
        let builder = AmazonS3Builder::new()
            .with_url(url)
            .with_client_options(client)
            .with_retry(retry);
        let set = |builder: AmazonS3Builder, (name, value): (String, String)| match name
            .to_ascii_lowercase()
            .parse::<AmazonS3ConfigKey>()
        {
            Ok(key) if name.starts_with("AWS_") => builder.with_config(key, value),
            _ => builder,
        };
        let bucket = variables.fold(builder, set).build()?;
        let (_, path) = url
            .trim_start_matches("s3://")
            .split_once('/')
            .unwrap_or_default();
        let prefix = Key::parse(path).map_err(Error::from)?;
        Ok(Self {
            store: Arc::new(PrefixStore::new(bucket, prefix)),
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
        let options = GetOptions {
            range: Some(GetRange::Bounded(range)),
            ..GetOptions::default()
        };
        let content = self.store.get_opts(&Key::from(key), options).await?;
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
            // Whatever it is, it is not this machine that cannot write.
            let failed = |error: std::io::Error| StoreError::Unavailable(error.to_string());
            sent.await.map_err(failed)
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
            // What has another name was not put here by this program.
            Ok(names
                .filter_map(|name| name.as_ref().parse().ok())
                .collect())
        }
        .boxed()
    }

    fn free_bytes(&self) -> StoreResult<Option<u64>> {
        Ok(None)
    }

    fn check(&self) -> BoxFuture<'_, StoreResult<()>> {
        async move {
            match self.store.head(&Key::from("check")).await {
                Ok(_) | Err(Error::NotFound { .. }) => Ok(()),
                Err(error) => Err(error.into()),
            }
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

impl From<Error> for StoreError {
    fn from(error: Error) -> Self {
        let text = error.to_string();
        match error {
            Error::Generic { .. } | Error::JoinError { .. } => Self::Unavailable(text),
            // A key that expired, or a clock too far from that of the server: no fault of a job, and
            // another process may have access.
            Error::PermissionDenied { .. } | Error::Unauthenticated { .. } => {
                Self::Unavailable(text)
            }
            _ => Self::Other(text),
        }
    }
}
