//! How long it took.

use std::time::Instant;

use nix::sys::resource::{UsageWho, getrusage};
use nix::sys::time::TimeVal;

/// Seconds on the wall, and of all processors.
#[derive(Clone, Copy)]
pub struct Seconds {
    pub wall: f64,
    pub processor: f64,
}

/// Since when.
pub struct Clock {
    wall: Instant,
    processor: f64,
}

impl Clock {
    pub fn start() -> Self {
        Self {
            wall: Instant::now(),
            processor: processor(),
        }
    }

    pub fn seconds(&self) -> Seconds {
        Seconds {
            wall: self.wall.elapsed().as_secs_f64(),
            processor: processor() - self.processor,
        }
    }
}

/// User and system time of this process.
fn processor() -> f64 {
    let usage = getrusage(UsageWho::RUSAGE_SELF).expect("every process may ask");
    let seconds = |time: TimeVal| time.tv_sec() as f64 + 1e-6 * time.tv_usec() as f64;
    seconds(usage.user_time()) + seconds(usage.system_time())
}

/// The most memory that this process has had.
pub fn peak_megabytes() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let kilobytes = line.and_then(|line| line.split_whitespace().next()?.parse::<u64>().ok());
    kilobytes.unwrap_or(0) / 1024
}
