//! The files of a job, as its record lists them.

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

/// One file of the input: the name it is referenced by and its size.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct InputFile {
    /// File name of the mesh, or the relative path by which the mesh names a buffer or an image.
    pub name: String,
    /// Size in bytes.
    pub bytes: u64,
    /// SHA-256 in hexadecimal digits, checked whenever the whole file is read. Files of earlier
    /// versions of the program have none.
    #[serde(default)]
    pub sha256: Option<String>,
}

/// One file that a job made.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct OutputFile {
    /// Where it is found: `result`, `report`, `uvs.bin`, `files/NAME` for what belongs to the result, or the role of a
    /// [`Picture`](crate::Picture).
    pub role: String,
    /// Name under which it should be saved.
    pub name: String,
    /// Size in bytes.
    pub bytes: u64,
    /// SHA-256 in hexadecimal digits, checked whenever the whole file is read. Files of earlier
    /// versions of the program have none.
    #[serde(default)]
    pub sha256: Option<String>,
}

/// Returns the checksum of some bytes, as records have it: SHA-256 in hexadecimal digits.
pub fn sha256(bytes: &[u8]) -> String {
    format!("{:x}", Sha256::digest(bytes))
}
