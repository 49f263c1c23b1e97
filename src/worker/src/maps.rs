//! Maps under way in the compute child, kept and sent only while a client watches.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use crate::map_frame::{self, ChartKey};
use unwrapd_api::{MAPS, Message, frame_header};
use unwrapd_layout::charts::MapUnderway;

/// Minimum time between frames. Ten frames per second look continuous; more would only cost encoding and bandwidth.
const INTERVAL: Duration = Duration::from_millis(100);
/// Average rate limit of frames in bytes per second, 64 Mbit/s. A higher rate shows large maps more often, but takes
/// more of the client's network.
const RATE: f64 = 8e6;
/// Maximum size of a frame in bytes; further maps are left out. At the rate limit, a pause of four seconds follows it.
const MOST_BYTES: usize = 32 << 20;
/// Time after a request for which a client is assumed to be watching, because its next request is on the way. A longer
/// time encodes maps for clients that are gone; a shorter one loses maps of clients on slow networks.
const WATCHED: Duration = Duration::from_secs(3);

/// The newest maps not yet sent.
pub(crate) struct Maps {
    folder: PathBuf,
    start: Instant,
    /// Set while a client waits for a frame.
    is_asked: AtomicBool,
    /// End of watching, in milliseconds since the start.
    watched: AtomicU64,
    pending: Mutex<PendingMaps>,
}

#[derive(Default)]
struct PendingMaps {
    maps: BTreeMap<ChartKey, Vec<u8>>,
    bytes: usize,
    /// Earliest time of the next frame.
    next: Duration,
}

impl Maps {
    /// Starts without watchers.
    pub fn new(folder: &Path) -> Self {
        Self {
            folder: folder.to_path_buf(),
            start: Instant::now(),
            is_asked: AtomicBool::new(false),
            watched: AtomicU64::new(0),
            pending: Mutex::default(),
        }
    }

    /// Requests the next frame.
    pub fn ask(&self) {
        let until = (self.start.elapsed() + WATCHED).as_millis() as u64;
        self.watched.store(until, Ordering::Relaxed);
        self.is_asked.store(true, Ordering::Release);
    }

    /// Keeps a map if a client watches, and sends a frame if one is due. Without watchers this costs two loads.
    pub fn take(&self, surface: usize, map: &MapUnderway) {
        let until = self.watched.load(Ordering::Relaxed);
        let is_watched = || (self.start.elapsed().as_millis() as u64) < until;
        if until == 0 || !self.is_asked.load(Ordering::Relaxed) && !is_watched() {
            return;
        }
        let key = map_frame::key(surface, map);
        let encoded = map_frame::encoded(key, map);
        let mut pending = self.pending();
        pending.replace(key, encoded);
        self.tell(&mut pending);
    }

    /// Sends the kept maps if a frame is requested and due.
    pub fn flush(&self) {
        self.tell(&mut self.pending());
    }

    fn pending(&self) -> MutexGuard<'_, PendingMaps> {
        self.pending.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn tell(&self, pending: &mut PendingMaps) {
        let now = self.start.elapsed();
        if pending.maps.is_empty() || now < pending.next || !self.is_asked.load(Ordering::Acquire) {
            return;
        }
        let mut frame = frame_header();
        frame.extend(std::mem::take(&mut pending.maps).into_values().flatten());
        pending.bytes = 0;
        pending.next = now + INTERVAL.max(Duration::from_secs_f64(frame.len() as f64 / RATE));
        self.is_asked.store(false, Ordering::Release);
        // Skip a frame that cannot be written, as slow watchers do.
        let partial = self.folder.join("maps.partial");
        let written = std::fs::write(&partial, frame);
        if written
            .and_then(|()| std::fs::rename(&partial, self.folder.join(MAPS)))
            .is_ok()
        {
            Message::Maps.tell();
        }
    }
}

impl PendingMaps {
    /// Replaces the map of a chart.
    fn replace(&mut self, key: ChartKey, map: Vec<u8>) {
        self.bytes -= self.maps.remove(&key).map_or(0, |former| former.len());
        if self.bytes + map.len() <= MOST_BYTES {
            self.bytes += map.len();
            self.maps.insert(key, map);
        }
    }
}
