//! Maps of single iterations, written as files while the solver runs.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use unwrapd_api::{OutputFile, output_file, sha256};

/// Maximum bytes of a job's frames. No frame is written once this is reached. It equals the default limit of an
/// upload, and like that it bounds the disk space of a job.
const MOST_BYTES: u64 = 256 << 20;

/// Frames of an attempt.
pub(crate) struct Frames {
    folder: PathBuf,
    /// Iteration, size in bytes and checksum of each frame.
    written: Vec<(usize, u64, String)>,
    failure: Option<io::Error>,
}

impl Frames {
    /// Starts without frames.
    pub fn new(folder: &Path) -> Self {
        Self {
            folder: folder.to_path_buf(),
            written: Vec::new(),
            failure: None,
        }
    }

    /// Writes a frame unless the limit is reached.
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

    /// Appends the frames to the output files, the first of them being the result.
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
