//! Frames of maps under way, passed from the compute child to its listeners.

use std::path::Path;
use std::sync::Arc;

use tokio::sync::{Notify, watch};
use tokio_util::bytes::Bytes;

use unwrapd_api::{MAPS, number_frame};

/// The latest frame of an attempt. Slow listeners skip frames.
pub(super) struct MapFeed {
    /// Notified when a listener waits for the next frame.
    pub asked: Arc<Notify>,
    latest: watch::Sender<MapFrame>,
}

/// A numbered frame; number 0 means that there is none.
#[derive(Clone, Default)]
struct MapFrame {
    number: u64,
    bytes: Bytes,
}

/// A listener for the next frame of an attempt. It does not keep the attempt alive.
pub(super) struct MapListener {
    asked: Arc<Notify>,
    latest: watch::Receiver<MapFrame>,
}

impl MapFeed {
    /// Creates a feed whose frames have numbers above `before`.
    pub fn new(before: u64) -> Self {
        let none = MapFrame {
            number: before,
            ..MapFrame::default()
        };
        Self {
            asked: Arc::default(),
            latest: watch::Sender::new(none),
        }
    }

    /// Creates a listener.
    pub fn listener(&self) -> MapListener {
        MapListener {
            asked: Arc::clone(&self.asked),
            latest: self.latest.subscribe(),
        }
    }

    /// Publishes the frame in the folder of the attempt; does nothing if it cannot be read.
    pub async fn take(&self, folder: &Path) {
        let Ok(mut bytes) = tokio::fs::read(folder.join(MAPS)).await else {
            return;
        };
        let next = self.latest.borrow().number + 1;
        if number_frame(&mut bytes, next) {
            self.latest.send_replace(MapFrame {
                number: next,
                bytes: bytes.into(),
            });
        }
    }
}

impl MapListener {
    /// Waits for the first frame with a number above `after`, requesting one if needed. Returns `None` when the
    /// attempt has ended.
    pub async fn next(mut self, after: u64) -> Option<Bytes> {
        self.asked.notify_one();
        loop {
            let MapFrame { number, bytes } = self.latest.borrow_and_update().clone();
            if after < number && !bytes.is_empty() {
                return Some(bytes);
            }
            self.latest.changed().await.ok()?;
        }
    }
}
