//! Pictures of results, drawn in the child from the files of a job.

use std::path::Path;

use unwrapd_api::{
    DRAWING, Drawing, PICTURE, Picture, Upload, output_file, read_json, read_upload,
};
use unwrapd_files::picture::thumbnail_png;
use unwrapd_pipeline::{AtlasPicture, Pictures, PipelineError};

/// Threads of a drawing child, one of the cores set aside for drawing.
const THREADS: usize = 1;

/// Task of a drawing child, with a memory limit.
pub(crate) struct DrawingTask(Drawing);

impl DrawingTask {
    /// Reads the task in the folder of a child.
    pub fn read(folder: &Path) -> std::io::Result<Self> {
        read_json(folder, DRAWING).map(Self)
    }

    /// Returns the memory limit in bytes.
    pub fn memory(&self) -> u64 {
        self.0.memory
    }

    /// Draws the picture as PNG.
    pub fn png(&self, folder: &Path) -> Result<Vec<u8>, DrawingError> {
        match self.0.picture {
            Picture::Layout => self.atlas(folder, AtlasPicture::Layout),
            Picture::Heatmap => self.atlas(folder, AtlasPicture::Heatmap),
            Picture::Thumbnail => {
                let shown = match &self.0.output[..] {
                    [_] => std::fs::read(folder.join(output_file(0)))?,
                    _ => self.atlas(folder, AtlasPicture::Layout)?,
                };
                Ok(thumbnail_png(&shown).map_err(PipelineError::from)?)
            }
        }
    }

    /// Writes the picture to the file where the service expects it.
    pub fn write(folder: &Path, png: &[u8]) -> std::io::Result<()> {
        std::fs::write(folder.join(PICTURE), png)
    }

    fn atlas(&self, folder: &Path, picture: AtlasPicture) -> Result<Vec<u8>, DrawingError> {
        let mut report = Vec::new();
        let mut result = Upload::default();
        for (index, file) in self.0.output.iter().enumerate() {
            let content = std::fs::read(folder.join(output_file(index)))?;
            let (role, name) = (file.role.as_str(), file.name.clone());
            match role {
                "report" => report = content,
                "result" => (result.name, result.bytes) = (name, content),
                _ => drop(result.resources.insert(name, content)),
            }
        }
        let input = match &self.0.input[..] {
            [] => None,
            names => Some(read_upload(folder, names)?),
        };
        let report = serde_json::from_slice(&report).map_err(std::io::Error::from)?;
        let pictures = Pictures::of_result(&result, report, input.as_ref(), THREADS)?;
        Ok(pictures.draw(picture)?)
    }
}

/// Reason why nothing was drawn.
pub(crate) enum DrawingError {
    /// The result cannot be drawn.
    Pipeline(PipelineError),
    /// A file cannot be read.
    Io(std::io::Error),
}

impl From<PipelineError> for DrawingError {
    fn from(error: PipelineError) -> Self {
        Self::Pipeline(error)
    }
}

impl From<std::io::Error> for DrawingError {
    fn from(error: std::io::Error) -> Self {
        Self::Io(error)
    }
}
