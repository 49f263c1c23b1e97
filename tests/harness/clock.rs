//! Clocks on the wall that jump, by libfaketime. Monotonic clocks go on.

use std::os::unix::fs::PermissionsExt;
use std::path::Path;

use tempfile::NamedTempFile;

const LIBRARY: &str = "/usr/lib/x86_64-linux-gnu/faketime/libfaketimeMT.so.1";

/// The clock of one process.
pub struct Clock {
    offset: NamedTempFile,
}

impl Clock {
    /// One that is this many seconds ahead.
    pub fn ahead(seconds: i64) -> Self {
        assert!(Path::new(LIBRARY).exists(), "libfaketime is not installed");
        let offset = NamedTempFile::new().expect("a file");
        let clock = Self { offset };
        clock.set(seconds);
        clock
    }

    /// From now on it is this many seconds ahead. Nobody reads half of that.
    pub fn set(&self, seconds: i64) {
        let fresh = self.offset.path().with_extension("fresh");
        std::fs::write(&fresh, format!("{seconds:+}s\n")).expect("a file");
        let all = std::fs::Permissions::from_mode(0o644);
        // PostgreSQL runs as another user.
        std::fs::set_permissions(&fresh, all).expect("our file");
        std::fs::rename(fresh, self.offset.path()).expect("our file");
    }

    /// What a process is told that goes by it.
    pub fn settings(&self) -> Vec<(String, String)> {
        let file = self.offset.path().to_string_lossy().into_owned();
        let settings = [
            ("LD_PRELOAD", LIBRARY.to_owned()),
            ("FAKETIME_TIMESTAMP_FILE", file),
            ("FAKETIME_NO_CACHE", "1".to_owned()),
            ("FAKETIME_DONT_FAKE_MONOTONIC", "1".to_owned()),
        ];
        settings
            .map(|(name, value)| (name.to_owned(), value))
            .into()
    }
}

/// Removes what libfaketime keeps in memory for a process, which one that was killed leaves: another
/// with the same id could not start.
pub fn forget(process: u32) {
    for name in ["sem.faketime_sem_", "faketime_shm_"] {
        let _ = std::fs::remove_file(format!("/dev/shm/{name}{process}"));
    }
}
