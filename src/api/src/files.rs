//! The files of a job, as its record lists them.

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

/// An input file: its name in the references of the mesh, its size and its checksum.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct InputFile {
    /// File name of the mesh, or the relative path by which the mesh refers to a buffer or an image.
    pub name: String,
    /// Size in bytes.
    pub bytes: u64,
    /// SHA-256 in hexadecimal digits, checked whenever the whole file is read; `None` for files of earlier versions
    /// of the program.
    #[serde(default)]
    pub sha256: Option<String>,
}

/// An output file of a job.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct OutputFile {
    /// Role, which is also its path: `result`, `report`, `uvs.bin`, `files/NAME` for files that belong to the result,
    /// or the role of a [`Picture`](crate::Picture).
    pub role: String,
    /// File name for saving it.
    pub name: String,
    /// Size in bytes.
    pub bytes: u64,
    /// SHA-256 in hexadecimal digits, checked whenever the whole file is read; `None` for files of earlier versions
    /// of the program.
    #[serde(default)]
    pub sha256: Option<String>,
}

/// Returns the SHA-256 of some bytes in hexadecimal digits, as records store it.
pub fn sha256(bytes: &[u8]) -> String {
    format!("{:x}", Sha256::digest(bytes))
}
