//! Failures of computations that run out of memory.

use std::path::PathBuf;
use unwrapd_api::Failure;

/// Returns the failure of a job that exceeds its memory limit of `limit` bytes.
pub(super) fn out_of_memory(limit: u64) -> Failure {
    let detail = format!(
        "needs more than {} MiB, the memory limit of a job",
        limit >> 20
    );
    Failure::new("out_of_memory", detail)
}

/// Returns the failure of a job that the system killed because the container or machine ran out of memory.
pub(super) fn killed_for_memory() -> Failure {
    let detail = "the system ended it because the memory of the container or machine was used up";
    Failure::new("out_of_memory", detail)
}

// Detection of out-of-memory kills in this container.

/// Counter of each cgroup version: marker in `/proc/self/cgroup`, mount point, file name.
const COUNTERS: [(&str, &str, &str); 2] = [
    ("0::", "/sys/fs/cgroup", "memory.events"),
    ("memory", "/sys/fs/cgroup/memory", "memory.oom_control"),
];

/// Number of processes that the system killed for lack of memory in the cgroups of this process, which include its
/// compute children.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Kills(u64);

impl Kills {
    /// Returns the count so far; 0 if the system does not count.
    pub fn so_far() -> Self {
        let groups = std::fs::read_to_string("/proc/self/cgroup").unwrap_or_default();
        let counters = counters(&groups).into_iter();
        let texts = counters.filter_map(|path| std::fs::read_to_string(path).ok());
        Self(texts.filter_map(|text| count(&text)).sum())
    }

    /// Returns whether the count has grown since.
    pub fn is_one_more(&self) -> bool {
        self.0 < Self::so_far().0
    }
}

/// Returns the counter files listed by the text of `/proc/self/cgroup`: version 2 has one line `0::PATH`, version 1
/// one line `N:CONTROLLERS:PATH` per controller. Within a container, the path may be that of the host, and the files
/// lie at the top.
fn counters(groups: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for line in groups.lines() {
        for (mark, root, file) in COUNTERS {
            let mut fields = line.splitn(3, ':').skip(1);
            let (Some(controllers), Some(path)) = (fields.next(), fields.next()) else {
                continue;
            };
            let is_meant = line.starts_with(mark) || controllers.split(',').any(|it| it == mark);
            if is_meant {
                let own = PathBuf::from(format!("{root}{path}")).join(file);
                let top = PathBuf::from(root).join(file);
                found.push(if own.exists() { own } else { top });
            }
        }
    }
    found
}

/// Returns the count in the line `oom_kill N`, which both versions have.
fn count(text: &str) -> Option<u64> {
    let mut lines = text.lines();
    lines.find_map(|line| line.strip_prefix("oom_kill ")?.trim().parse().ok())
}
