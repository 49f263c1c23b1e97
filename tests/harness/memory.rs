//! Control groups whose memory is limited.

use std::fs;
use std::path::{Path, PathBuf};

/// Where the two versions of control groups are, with the files of a limit.
const VERSIONS: [(&str, &str); 2] = [
    ("/sys/fs/cgroup/memory", "memory.limit_in_bytes"),
    ("/sys/fs/cgroup", "memory.max"),
];

/// A control group of its own, where this process may make one.
pub struct Memory {
    folder: PathBuf,
}

impl Memory {
    /// A group of so many bytes at most.
    pub fn limited_to(bytes: u64) -> Option<Self> {
        let name = format!("unwrapd-test-{}", std::process::id());
        let made = VERSIONS.iter().find_map(|(root, limit)| {
            let folder = Path::new(root).join(&name);
            fs::create_dir(&folder).ok()?;
            let group = Self { folder };
            fs::write(group.folder.join(limit), bytes.to_string()).ok()?;
            Some(group)
        });
        if made.is_none() {
            eprintln!("left out: no control group can be made here");
        }
        made
    }

    /// Moves a process here; the children that it starts from now on are here too.
    pub fn take(&self, process: u32) {
        fs::write(self.folder.join("cgroup.procs"), process.to_string()).expect("a process");
    }
}

impl Drop for Memory {
    fn drop(&mut self) {
        // Processes leave a group a moment after they have ended.
        while fs::remove_dir(&self.folder).is_err() && self.folder.exists() {
            std::thread::yield_now();
        }
    }
}
