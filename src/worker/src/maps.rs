//! Maps under way in the compute child: kept and sent while a client watches, or written as files.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};
use std::{fs, io};

use unwrapd_api::{MAPS, Message, OutputFile, frame_header, output_file, sha256};
use unwrapd_layout::charts::MapUnderway;
use unwrapd_method::numerics::predicates::orient2d_sign;

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
        if until == 0 {
            return;
        }
        // The clock is read only if no client waits for a frame.
        if !self.is_asked.load(Ordering::Relaxed)
            && until <= self.start.elapsed().as_millis() as u64
        {
            return;
        }
        let key = key(surface, map);
        let encoded = encoded(key, map);
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
        let written = fs::write(&partial, frame);
        if written
            .and_then(|()| fs::rename(&partial, self.folder.join(MAPS)))
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

// Binary format of maps under way, as watchers of a job receive them; little-endian.
//
// ```text
// frame   0  u8   3                          map   0  u32  surface          28  u32  0; 1 for a plan
//         1  7 zeros                               4  u32  first face       32  f64  unit
//         8  u64  number                           8  u32  iteration        40  f64  energy
//        16  maps                                 12  u32  faces            48  f64  smallest face
//                                                 16  u32  faces that follow
//                                                 20  u32  flips
//                                                 24  u32  bytes of a coordinate: 4, 8
//                                                 56  faces u32; u and v of three corners each, f32 or f64
// ```
//
// Faces are those of the welded surface in cutting order. If there are too many to draw, only every 2ⁿ-th one
// follows. Seams of large charts are planned on a simplified mesh, and each face of a plan stands for one near it.

/// Maximum number of faces drawn of a map. In f32 they take 2.8 MB, a third of a second at the rate limit of frames.
const MOST_FACES: usize = 100_000;

/// Identity of a chart: its surface and its first face. Later maps of the chart have the same key.
pub(crate) type ChartKey = [u32; 2];

/// Returns the key of the chart that a map belongs to.
fn key(surface: usize, map: &MapUnderway) -> ChartKey {
    [surface as u32, map.faces().next().unwrap_or(0)]
}

/// Encodes a map. Rounds coordinates to f32 unless that would flip a face; `flips` counts the encoded numbers.
pub(crate) fn encoded([surface, first]: ChartKey, map: &MapUnderway) -> Vec<u8> {
    // Choose the precision.
    let points: &[[f64; 2]] = map.x.as_chunks().0;
    let rounded: Vec<[f64; 2]> = points
        .iter()
        .map(|p| p.map(|x| f64::from(x as f32)))
        .collect();
    let triangles = &map.chart.disk.triangles;
    let is_exact = flips(triangles, &rounded) > 0;
    let (points, width) = if is_exact {
        (points, 8)
    } else {
        (&*rounded, 4)
    };
    // Choose the faces to draw.
    let step = triangles.len().div_ceil(MOST_FACES).next_power_of_two() as u32;
    let drawn: Vec<(u32, &[u32; 3])> = (map.faces().zip(triangles))
        .filter(|(face, _)| face % step == 0)
        .collect();

    // Write the header, then faces and coordinates.
    let mut bytes = Vec::with_capacity(56 + drawn.len() * (4 + 6 * width));
    let counts = [
        surface,
        first,
        map.iterate.iteration as u32,
        triangles.len() as u32,
        drawn.len() as u32,
        flips(triangles, points),
        width as u32,
        u32::from(map.planned_for.is_some()),
    ];
    bytes.extend(counts.iter().flat_map(|x| x.to_le_bytes()));
    let numbers = [map.unit(), map.iterate.energy, map.iterate.smallest];
    bytes.extend(numbers.iter().flat_map(|x| x.to_le_bytes()));
    bytes.extend(drawn.iter().flat_map(|(face, _)| face.to_le_bytes()));
    let corners = drawn.iter().flat_map(|(_, triangle)| *triangle);
    let coordinates = corners.flat_map(|&v| points[v as usize]);
    if is_exact {
        bytes.extend(coordinates.flat_map(f64::to_le_bytes));
    } else {
        bytes.extend(coordinates.flat_map(|x| (x as f32).to_le_bytes()));
    }
    bytes
}

/// Counts the triangles that are not positively oriented, exactly.
fn flips(triangles: &[[u32; 3]], points: &[[f64; 2]]) -> u32 {
    let flipped = triangles.iter().filter(|t| {
        let [a, b, c] = t.map(|v| points[v as usize]);
        orient2d_sign(a, b, c) <= 0
    });
    flipped.count() as u32
}

// Maps of single iterations, written as files while the solver runs.

/// Maximum bytes of a job's frames. No frame is written once this is reached. It equals the default limit of an
/// upload, and like that it bounds the disk space of a job.
const MOST_FILE_BYTES: u64 = 256 << 20;

/// Frames of an attempt.
pub(crate) struct IterationFiles {
    folder: PathBuf,
    /// Iteration, size in bytes and checksum of each frame.
    written: Vec<(usize, u64, String)>,
    failure: Option<io::Error>,
}

impl IterationFiles {
    /// Starts without frames.
    pub fn new(folder: &Path) -> Self {
        Self {
            folder: folder.to_path_buf(),
            written: Vec::new(),
            failure: None,
        }
    }

    /// Writes a frame unless the limit is reached.
    pub fn add(&mut self, number: usize, file: &dyn Fn() -> Vec<u8>) {
        let bytes: u64 = self.written.iter().map(|(_, bytes, _)| bytes).sum();
        if self.failure.is_some() || MOST_FILE_BYTES <= bytes {
            return;
        }
        let file = file();
        match fs::write(self.path(number), &file) {
            Ok(()) => {
                let bytes = file.len() as u64;
                self.written.push((number, bytes, sha256(&file)));
            }
            Err(error) => self.failure = Some(error),
        }
    }

    /// Appends the frames to the output files, the first of them being the result.
    pub fn into_output(mut self, output: &mut Vec<OutputFile>) -> io::Result<()> {
        if let Some(error) = self.failure.take() {
            return Err(error);
        }
        let result = output.first().map_or("", |file| file.name.as_str());
        let extension = result.rsplit('.').next().unwrap_or_default().to_owned();
        for (number, bytes, sha256) in std::mem::take(&mut self.written) {
            fs::rename(
                self.path(number),
                self.folder.join(output_file(output.len())),
            )?;
            let name = format!("frame-{number:05}.{extension}");
            output.push(OutputFile {
                role: format!("files/{name}"),
                name,
                bytes,
                sha256: Some(sha256),
            });
        }
        Ok(())
    }

    fn path(&self, number: usize) -> PathBuf {
        self.folder.join(format!("frame-{number}"))
    }
}
