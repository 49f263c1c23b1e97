//! Notifications from PostgreSQL that a job can be claimed, which save idle workers from polling.

use std::time::Duration;

use futures_util::future;
use sqlx::postgres::PgListener;
use sqlx::{Any, Transaction};
use tokio::sync::Mutex;

use super::dialect::Dialect;
use crate::jobs::{Job, State};

/// Notification channel.
const CHANNEL: &str = "unwrapd_queued";
const NOTIFY: &str = "SELECT pg_notify('unwrapd_queued', '')";
/// Delay before reconnecting after a failure. Without hints, workers still poll, so a longer delay costs little.
const PAUSE: Duration = Duration::from_secs(5);

/// A dedicated listening connection, opened when needed.
pub(super) struct Hints {
    url: String,
    dialect: Dialect,
    listener: Mutex<Option<PgListener>>,
}

impl Hints {
    /// Creates the hints of the database at a URL.
    pub fn of(url: &str, dialect: Dialect) -> Self {
        Self {
            url: url.to_owned(),
            dialect,
            listener: Mutex::new(None),
        }
    }

    /// Sends a hint when the transaction commits, if the job is queued. SQLite sends none.
    pub async fn give(
        &self,
        job: &Job,
        transaction: &mut Transaction<'_, Any>,
    ) -> sqlx::Result<()> {
        if self.dialect == Dialect::Postgres && job.state == State::Queued {
            sqlx::query(NOTIFY).execute(&mut **transaction).await?;
        }
        Ok(())
    }

    /// Waits for a hint. With SQLite there is none: its only process knows its jobs.
    pub async fn next(&self) {
        if self.dialect == Dialect::Sqlite {
            return future::pending().await;
        }
        let mut listener = self.listener.lock().await;
        while let Err(error) = self.received(&mut listener).await {
            tracing::debug!(%error, "no hints of the database");
            *listener = None;
            tokio::time::sleep(PAUSE).await;
        }
    }

    async fn received(&self, listener: &mut Option<PgListener>) -> sqlx::Result<()> {
        let listener = if let Some(listener) = listener {
            listener
        } else {
            let mut fresh = PgListener::connect(&self.url).await?;
            fresh.listen(CHANNEL).await?;
            listener.insert(fresh)
        };
        listener.recv().await.map(|_| ())
    }
}
