//! The program that compute children run.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

/// Environment variable with the search path of the dynamic linker.
const LIBRARY_PATH: &str = "LD_LIBRARY_PATH";

/// Command line that starts this program as a child.
#[derive(Clone, Debug)]
pub struct Program {
    /// File to execute.
    pub file: PathBuf,
    /// Arguments before those of the child.
    pub arguments: Vec<OsString>,
    /// File whose checksum identifies the build that computes.
    pub engine: PathBuf,
}

impl Program {
    /// Returns the running executable.
    pub fn current() -> std::io::Result<Self> {
        std::env::current_exe().map(Self::from)
    }

    /// Returns a command with these arguments and an empty environment. Only an interpreter keeps the library search
    /// path, where it may find its own libraries.
    pub(super) fn command(&self, word: &str, folder: &Path) -> tokio::process::Command {
        let mut command = tokio::process::Command::new(&self.file);
        command.args(&self.arguments).arg(word).arg(folder);
        command.env_clear();
        if self.file != self.engine
            && let Some(path) = std::env::var_os(LIBRARY_PATH)
        {
            command.env(LIBRARY_PATH, path);
        }
        command
    }
}

impl From<PathBuf> for Program {
    fn from(file: PathBuf) -> Self {
        Self {
            engine: file.clone(),
            file,
            arguments: Vec::new(),
        }
    }
}
