//! The program of which compute children are instances.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

/// Where the dynamic linker looks for libraries first.
const LIBRARY_PATH: &str = "LD_LIBRARY_PATH";

/// What is started as a child: this program once more, wherever its code is.
#[derive(Clone, Debug)]
pub struct Program {
    /// The file that is executed.
    pub file: PathBuf,
    /// What it is given before the words for the child.
    pub arguments: Vec<OsString>,
    /// The file whose checksum says which build computes.
    pub engine: PathBuf,
}

impl Program {
    /// The executable that runs now.
    pub fn current() -> std::io::Result<Self> {
        std::env::current_exe().map(Self::from)
    }

    /// A child with these words and an empty environment. Only an interpreter is told where libraries are: it may find its own
    /// there alone.
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
