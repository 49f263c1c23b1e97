//! Maps of charts under way, on their way from the compute child to those who watch.

use std::path::Path;
use std::sync::Arc;

use tokio::sync::{Notify, watch};
use tokio_util::bytes::Bytes;

use unwrapd_api::{MAPS, number_frame};

/// The latest frame of an attempt. Who is slow misses those between.
pub(super) struct MapFeed {
    /// Somebody waits for the next one.
    pub asked: Arc<Notify>,
    latest: watch::Sender<Frame>,
}

/// A frame with its number; 0 for none.
#[derive(Clone, Default)]
struct Frame {
    number: u64,
    bytes: Bytes,
}

/// Who waits for the next frame of an attempt. It does not keep the attempt.
pub(super) struct MapListener {
    asked: Arc<Notify>,
    latest: watch::Receiver<Frame>,
}

impl MapFeed {
    /// The frames of an attempt have numbers above this one.
    pub fn new(before: u64) -> Self {
        let none = Frame {
            number: before,
            ..Frame::default()
        };
        Self {
            asked: Arc::default(),
            latest: watch::Sender::new(none),
        }
    }

    /// Waits with others for frames.
    pub fn listener(&self) -> MapListener {
        MapListener {
            asked: Arc::clone(&self.asked),
            latest: self.latest.subscribe(),
        }
    }

    /// Passes on the frame in the folder of the attempt.
    pub async fn take(&self, folder: &Path) {
        let Ok(mut bytes) = tokio::fs::read(folder.join(MAPS)).await else {
            return;
        };
        let next = self.latest.borrow().number + 1;
        if number_frame(&mut bytes, next) {
            self.latest.send_replace(Frame {
                number: next,
                bytes: bytes.into(),
            });
        }
    }
}

impl MapListener {
    /// The bytes of the next frame after this one, asked for if need be; `None` when the attempt has ended.
    pub async fn next(mut self, after: u64) -> Option<Bytes> {
        self.asked.notify_one();
        loop {
            let Frame { number, bytes } = self.latest.borrow_and_update().clone();
            if after < number && !bytes.is_empty() {
                return Some(bytes);
            }
            self.latest.changed().await.ok()?;
        }
    }
}
