//! Pictures of results, drawn on first request and then kept, and textures as PNG.
//!
//! Drawing a small mesh costs more than unwrapping it, and most pictures are never viewed. So a job keeps only the
//! sources of its pictures: its result and its report. The first request for a picture starts a child (`unwrapd draw
//! FOLDER`) in the process that answers it, whether or not that process computes jobs. The child draws exactly what
//! the computation would have drawn. The picture is stored beside the result and recorded.
//!
//! The record decides. A picture that it does not list does not exist; one of a job that was removed meanwhile is
//! removed again; and one that is missing or damaged is redrawn. The key contains the checksum of the content, so two
//! processes that draw the same picture do not overwrite each other.

use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use futures_util::TryStreamExt;

use super::access::Visibility;
use super::child::{Child, finished};
use super::files::{self, Scratch, input_key, output_key, picture_key};
use super::job::{Job, JobId};
use super::queue::Jobs;
use super::storage::Changed;
use super::store_error::{StoreError, StoreResult};
use super::transition::Transition;
use unwrapd_api::{
    DRAWING, Drawing, Failure, Format, Kind, OutputFile, PICTURE, Picture, Subject, input_file,
    output_file, sha256, write_json,
};

/// Time limit of drawing while a client waits: the default limit of synchronous requests.
const PATIENCE: Duration = Duration::from_mins(1);

/// Reason why there is no picture.
#[derive(Debug, thiserror::Error)]
pub enum Undrawn {
    /// The job was removed meanwhile.
    #[error("the job was removed")]
    Removed,
    /// Drawing failed.
    #[error("{}", .0.detail)]
    Failed(Failure),
    /// Records or files cannot be used.
    #[error(transparent)]
    Store(#[from] StoreError),
}

impl Job {
    /// Returns the pictures that its result can have.
    pub fn pictures(&self) -> &'static [Picture] {
        match self.output.first() {
            Some(_) if self.is_atlas() => &Picture::ALL,
            Some(result) if Format::of_name(&result.name) == Some(Format::Png) => {
                &[Picture::Thumbnail]
            }
            _ => &[],
        }
    }

    /// Returns the output files without pictures.
    pub fn results(&self) -> impl Iterator<Item = &OutputFile> {
        (self.output.iter()).filter(|file| Picture::ALL.iter().all(|it| it.role() != file.role))
    }

    /// Returns a picture that exists: drawn on request, or by a version of the program that drew all pictures at the
    /// end of a job.
    pub fn drawn(&self, picture: Picture) -> Option<&OutputFile> {
        let drawn = self.drawn.iter().chain(&self.output);
        drawn.into_iter().find(|file| file.role == picture.role())
    }

    /// Returns the key and the file of a picture that exists.
    fn key_of_drawn(&self, picture: Picture) -> Option<(String, &OutputFile)> {
        let file = self.drawn(picture)?;
        let key = match self
            .output
            .iter()
            .position(|other| std::ptr::eq(other, file))
        {
            Some(index) => output_key(self.id, self.token, index),
            None => picture_key(self.id, self.token, file),
        };
        Some((key, file))
    }

    fn is_atlas(&self) -> bool {
        matches!(self.kind, Kind::Unwrap | Kind::Repack)
    }

    /// Returns whether a picture shows texel densities, which only the input contains.
    fn needs_input(&self, picture: Picture) -> bool {
        let is_given = |name: &&str| {
            let list = self.options.get(*name).and_then(|list| list.as_array());
            list.is_some_and(|list| !list.is_empty())
        };
        let is_weighed = ["texel_weight", "control"].iter().any(is_given);
        picture == Picture::Heatmap && is_weighed
    }
}

impl Jobs {
    /// Returns a picture that the job can have: the stored one, or one that is drawn now and stored.
    ///
    /// # Errors
    /// Fails if the job was removed meanwhile, the picture cannot be drawn, or the stores cannot be used.
    pub async fn picture(
        self: &Arc<Self>,
        job: &Job,
        picture: Picture,
    ) -> Result<Vec<u8>, Undrawn> {
        if let Some(kept) = self.kept(job, picture).await? {
            return Ok(kept);
        }
        // Wait for the turn of this job, then look again at what the turn before has left.
        let turn = self.drawing.turn(job.id).await;
        let now = self.store.get(&Visibility::All, job.id).await?;
        let job = now.ok_or(Undrawn::Removed)?;
        // Another request may have drawn it in the turn before.
        if let Some(kept) = self.kept(&job, picture).await? {
            return Ok(kept);
        }
        // Draw in a task of its own.
        let place = self.drawing.place().await;
        let jobs = Arc::clone(self);
        // A client that disconnects must not stop it between storing and recording.
        let drawn = self.tasks.spawn(async move {
            let drawn = jobs.draw(&job, picture).await;
            drop((turn, place));
            match drawn {
                Err(Undrawn::Store(error)) if error.is_loss() => {
                    // A removal deletes the record first, so a missing file may mean a removed job.
                    let now = jobs.store.get(&Visibility::All, job.id).await?;
                    Err(now.map_or(Undrawn::Removed, |_| error.into()))
                }
                drawn => drawn,
            }
        });
        drawn
            .await
            .map_err(|error| Undrawn::Failed(Failure::new("internal_error", error.to_string())))?
    }

    /// Returns the stored picture; `None` if there is none or it is damaged.
    async fn kept(&self, job: &Job, picture: Picture) -> StoreResult<Option<Vec<u8>>> {
        let Some((key, file)) = job.key_of_drawn(picture) else {
            return Ok(None);
        };
        match self.whole(&key, file).await {
            Ok(content) => Ok(Some(content)),
            Err(error) => match self.lost_file(error).await {
                error if error.is_loss() => {
                    tracing::warn!(key, %error, "a picture is drawn again");
                    Ok(None)
                }
                error => Err(error),
            },
        }
    }

    async fn whole(&self, key: &str, file: &OutputFile) -> StoreResult<Vec<u8>> {
        let mut content = self.blobs.read(key, 0..file.bytes).await?;
        if let Some(expected) = &file.sha256 {
            content = files::checked(content, expected.clone());
        }
        let mut whole = Vec::new();
        while let Some(block) = content.try_next().await? {
            whole.extend(block);
        }
        Ok(whole)
    }

    /// Draws a picture, stores it and records it.
    async fn draw(&self, job: &Job, picture: Picture) -> Result<Vec<u8>, Undrawn> {
        // Draw in a child.
        self.has_room()?;
        let path = self
            .settings
            .scratch
            .join(format!("draw-{}", JobId::fresh()));
        let scratch = Scratch::make(path).map_err(StoreError::from)?;
        let folder = scratch.path();
        self.bring(job, picture, folder).await?;
        let content = self.drawn_in(folder).await?;

        // Store the picture, then record it.
        let path = folder.join(PICTURE);
        let file = OutputFile {
            role: picture.role().to_owned(),
            name: picture.role().to_owned(),
            bytes: content.len() as u64,
            sha256: Some(sha256(&content)),
        };
        let key = picture_key(job.id, job.token, &file);
        self.blobs.put(&key, &path).await?;
        let drawn = Transition::Drawn(job.token, file);
        if let Changed::Missing = self.store.change(&Visibility::All, job.id, &drawn).await? {
            // The job was removed meanwhile, perhaps before this file was stored: remove its files again.
            self.blobs.remove(&job.id.to_string()).await?;
            return Err(Undrawn::Removed);
        }
        Ok(content)
    }

    /// Decodes the texture that is file 0 of the input in a folder. Returns the PNG file; nothing is kept. Dropping the
    /// future ends the child.
    ///
    /// # Errors
    /// Fails if the texture cannot be decoded, or the folder cannot be used.
    pub async fn decoded(&self, folder: &Path) -> Result<Vec<u8>, Undrawn> {
        let _place = self.drawing.place().await;
        self.write_drawing(Subject::Texture, folder)?;
        self.drawn_in(folder).await
    }

    /// Draws in a child the picture that the task in its folder describes.
    async fn drawn_in(&self, folder: &Path) -> Result<Vec<u8>, Undrawn> {
        let child = Child::start(&self.settings.program, "draw", folder)?;
        let detail = format!("the picture was not drawn within {} s", PATIENCE.as_secs());
        let late = Failure::new("timed_out", detail);
        finished(child, folder, PATIENCE, late).await?;
        Ok(tokio::fs::read(folder.join(PICTURE)).await?)
    }

    fn write_drawing(&self, subject: Subject, folder: &Path) -> StoreResult<()> {
        let memory = self.settings.memory;
        Ok(write_json(folder, DRAWING, &Drawing { subject, memory })?)
    }

    /// Copies the sources of a picture to the folder of a child.
    async fn bring(&self, job: &Job, picture: Picture, folder: &Path) -> StoreResult<()> {
        // Bring the result, and for an atlas the report and the files that belong to the mesh.
        let mut output = Vec::new();
        for (index, file) in job.output.iter().enumerate() {
            if !is_drawn_from(file, job.is_atlas()) {
                continue;
            }
            let to = folder.join(output_file(output.len()));
            let key = output_key(job.id, job.token, index);
            let fetched = self.fetch_verified(&key, file.sha256.as_deref(), &to).await;
            if fetched.as_ref().is_err_and(StoreError::is_loss) {
                self.spoil(job).await;
            }
            fetched?;
            output.push(file.clone());
        }
        // Bring the input only if the picture shows texel weights.
        let mut input = Vec::new();
        if job.needs_input(picture) {
            for (index, file) in job.input.iter().enumerate() {
                let to = folder.join(input_file(index));
                let key = input_key(job.id, index);
                self.fetch_verified(&key, file.sha256.as_deref(), &to)
                    .await?;
                input.push(file.name.clone());
            }
        }
        // Write the task last.
        let subject = Subject::Result {
            picture,
            input,
            output,
        };
        self.write_drawing(subject, folder)
    }
}

/// Returns whether a picture is drawn from this output file. A mesh needs all of its files.
fn is_drawn_from(file: &OutputFile, is_atlas: bool) -> bool {
    file.role == "result"
        || (is_atlas && (file.role == "report" || file.role.starts_with("files/")))
}

/// Converts the error of a folder, of a file in it, or of the child.
impl From<std::io::Error> for Undrawn {
    fn from(error: std::io::Error) -> Self {
        Self::Store(error.into())
    }
}

impl From<Failure> for Undrawn {
    fn from(failure: Failure) -> Self {
        Self::Failed(failure)
    }
}
