//! What a job may use.

use std::path::PathBuf;
use std::time::Duration;

/// Limits of the queue and of each job.
#[derive(Clone, Debug)]
pub struct Settings {
    /// Folder for what is in the making: uploads being received and the folders of attempts. Emptied at the start.
    pub scratch: PathBuf,
    /// The binary that is started as compute child.
    pub program: PathBuf,
    /// Jobs computed at the same time.
    pub concurrency: usize,
    /// Threads of each job.
    pub threads: usize,
    /// Jobs that may wait.
    pub queue_depth: u32,
    /// Wall-clock time after which an attempt ends with the map it has.
    pub time: Duration,
    /// Memory of a job, in bytes.
    pub memory: u64,
    /// Triangles of a mesh.
    pub triangles: u64,
    /// Bytes that the files of all jobs may take together.
    pub quota: Option<u64>,
    /// Bytes that must be free for a job to be accepted or started.
    pub min_free: u64,
    /// How long a job is kept after its end, with its files.
    pub retention: Duration,
}
