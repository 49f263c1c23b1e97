//! Conversion of sessions to jobs.

use serde_json::Value;

use super::session::Session;
use crate::jobs::{Digest, Handling, JobId, Scratch, Submission};
use unwrapd_api::{Failure, InputFile, Kind, START, input_file, sha256};

/// Job made from a session, and the folder with its files, which must be kept until they are moved.
pub struct Baked {
    /// Submission of the job.
    pub submission: Submission,
    /// Folder with its files.
    pub folder: Scratch,
}

impl Session {
    /// Turns the present state of the session into a job: the same input and options, with the current handles, and
    /// the current map as its [start](START). The session goes on.
    ///
    /// # Errors
    /// Fails if there is no handle, or a file cannot be written.
    pub async fn bake(&self) -> Result<Baked, Failure> {
        // Ask the child for its map and its handles, one request at a time: each writes the same file.
        let mut bakes = self.bakes.lock().await;
        self.ask_to_bake().await?;
        let said = tokio::select! {
            said = bakes.recv() => said,
            _ = self.ended() => None,
        };
        let gone = || Failure::new("session_not_found", "it has ended");
        let handles = said.ok_or_else(gone)??;
        if handles.is_empty() {
            return Err(Failure::new("no_handle", "nothing is pulled"));
        }
        // Link the input files into a folder of their own.
        let path = self
            .folder
            .path()
            .with_file_name(format!("baked-{}", JobId::fresh()));
        let folder = Scratch::make(path)?;
        let mut files = Vec::new();
        for (index, file) in self
            .input
            .iter()
            .filter(|file| file.name != START)
            .enumerate()
        {
            let place = folder.path().join(input_file(index));
            tokio::fs::hard_link(self.folder.path().join(input_file(index)), &place).await?;
            files.push((file.clone(), place));
        }
        // Add the current map, which the child has just written.
        let start = tokio::fs::read(self.folder.path().join(START)).await?;
        let place = folder.path().join(START);
        tokio::fs::write(&place, &start).await?;
        let file = InputFile {
            name: START.to_owned(),
            bytes: start.len() as u64,
            sha256: Some(sha256(&start)),
        };
        files.push((file, place));
        // Describe the job.
        let options = with_handles(self.kind, self.options.clone(), handles);
        let submission = Submission {
            owner: self.owner.clone(),
            digest: Digest::of_job(self.kind, &options, files.iter().map(|(file, _)| file)),
            kind: self.kind,
            options,
            files,
            handling: Handling::default(),
            trace: None,
            reuse: false,
            key: None,
            ephemeral: false,
        };
        Ok(Baked { submission, folder })
    }
}

/// Returns the options of a job with these handles.
fn with_handles(kind: Kind, mut options: Value, handles: Vec<Value>) -> Value {
    let name = match kind {
        Kind::EditUv | Kind::TextureMap => "anchors",
        _ => "handles",
    };
    options[name] = Value::Array(handles);
    options
}
