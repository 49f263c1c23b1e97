//! Maps of single iterations, written as they come.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use unwrapd_api::{OutputFile, output_file, sha256};

/// Bytes of all frames of a job together; there are as many as fit.
const MOST_BYTES: u64 = 256 << 20;

/// The frames of an attempt.
pub(crate) struct Frames {
    folder: PathBuf,
    /// Number, size and checksum of each.
    written: Vec<(usize, u64, String)>,
    failure: Option<io::Error>,
}

impl Frames {
    /// None yet.
    pub fn new(folder: &Path) -> Self {
        Self {
            folder: folder.to_path_buf(),
            written: Vec::new(),
            failure: None,
        }
    }

    /// Writes one, as long as there is room.
    pub fn add(&mut self, number: usize, file: &dyn Fn() -> Vec<u8>) {
        let bytes: u64 = self.written.iter().map(|(_, bytes, _)| bytes).sum();
        if self.failure.is_some() || MOST_BYTES <= bytes {
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

    /// Appends them to what a job made, the first of which is the result.
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
