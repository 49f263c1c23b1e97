//! The files, options and kind of one upload, as they come in.

use std::path::PathBuf;

use axum::body::Body;
use axum::extract::multipart::{Field, Multipart, MultipartError};
use futures_util::{Stream, StreamExt};
use serde_json::{Map, Value};
use sha2::{Digest as _, Sha256};
use tokio::io::AsyncWriteExt;

use super::framing;
use super::options::{self, UploadQuery};
use super::problem::{Code, Problem};
use super::wishes::Wishes;
use crate::deform::from_json;
use crate::jobs::{Digest, InputFile, Kind, Submission};

/// Names of the part that holds the input.
const INPUT_PARTS: [&str; 3] = ["mesh", "image", "problem"];
/// Bytes of a text part: options with some thousand handles.
const MAX_TEXT_BYTES: u64 = 256 << 10;
/// Files of an upload.
const MAX_FILES: usize = 4096;
/// Characters of a file name.
const MAX_NAME: usize = 1024;

/// A received upload. Its folder goes when it is dropped.
pub(super) struct Received {
    folder: Folder,
    kind: Kind,
    options: Value,
    files: Vec<(InputFile, PathBuf)>,
    priority: i32,
    digest: String,
}

impl Received {
    /// The options, complete.
    pub fn options(&self) -> &Value {
        &self.options
    }

    /// What is to be submitted; the folder has to be kept until that is done.
    pub fn into_submission(self, wishes: Wishes, ephemeral: bool) -> (Submission, Folder) {
        let submission = Submission {
            kind: self.kind,
            options: self.options,
            files: self.files,
            digest: self.digest,
            priority: self.priority,
            reuse: wishes.reuse,
            key: wishes.key,
            ephemeral,
        };
        (submission, self.folder)
    }
}

/// A folder for one upload, removed when dropped.
pub(super) struct Folder(PathBuf);

impl Drop for Folder {
    fn drop(&mut self) {
        if let Err(error) = std::fs::remove_dir_all(&self.0) {
            tracing::warn!(%error, "folder of an upload not removed");
        }
    }
}

/// Takes in the parts of one upload.
pub(super) struct Receiver {
    folder: Folder,
    left: u64,
    limit: u64,
    input: Option<(InputFile, PathBuf)>,
    resources: Vec<(InputFile, PathBuf)>,
    kind: Option<Kind>,
    options: Map<String, Value>,
}

impl Receiver {
    /// An upload into a fresh folder, of at most `limit` bytes.
    pub fn new(folder: PathBuf, limit: u64) -> Result<Self, Problem> {
        std::fs::create_dir(&folder)?;
        Ok(Self {
            folder: Folder(folder),
            left: limit,
            limit,
            input: None,
            resources: Vec::new(),
            kind: None,
            options: Map::new(),
        })
    }

    /// Takes a body that is the input.
    pub async fn body(&mut self, name: String, body: Body) -> Result<(), Problem> {
        let stream = body.into_data_stream();
        self.input = Some(self.store(name, stream, |e| broken(&e)).await?);
        Ok(())
    }

    /// Takes a form.
    pub async fn form(&mut self, mut form: Multipart) -> Result<(), Problem> {
        while let Some(field) = form.next_field().await.map_err(|e| malformed(&e))? {
            match field.name().unwrap_or_default() {
                part if INPUT_PARTS.contains(&part) => {
                    if self.input.is_some() {
                        let detail = "there is more than one input: send one part named mesh, image or problem";
                        return Err(Problem::new(Code::InvalidRequest, detail));
                    }
                    let name = field.file_name().unwrap_or_default().to_owned();
                    self.input = Some(self.store(name, field, |e| malformed(&e)).await?);
                }
                "kind" => self.kind = Some(options::kind(&text(field).await?)?),
                "options" => {
                    let text = text(field).await?;
                    self.options = from_json(text.as_bytes()).map_err(|error| {
                        let detail = format!("options are not a JSON object: {error}");
                        Problem::new(Code::InvalidOptions, detail)
                    })?;
                }
                _ => self.resource(field).await?,
            }
        }
        Ok(())
    }

    async fn resource(&mut self, field: Field<'_>) -> Result<(), Problem> {
        let Some(name) = field.file_name().map(str::to_owned) else {
            let part = field.name().unwrap_or_default();
            let detail =
                format!("unexpected part {part:?}: it is not an input, options, kind or a file");
            return Err(Problem::new(Code::InvalidRequest, detail));
        };
        if MAX_FILES <= self.resources.len() {
            let detail = format!("an upload can have at most {MAX_FILES} files");
            return Err(Problem::new(Code::UploadTooLarge, detail).with_limit(MAX_FILES as u64));
        }
        let file = self.store(name, field, |e| malformed(&e)).await?;
        self.resources.push(file);
        Ok(())
    }

    /// Writes a stream to a fresh file, counting and hashing its bytes.
    async fn store<B: AsRef<[u8]>, E>(
        &mut self,
        name: String,
        stream: impl Stream<Item = Result<B, E>> + Unpin,
        problem: impl Fn(E) -> Problem,
    ) -> Result<(InputFile, PathBuf), Problem> {
        if MAX_NAME < name.len() {
            let detail = format!("a file name can have at most {MAX_NAME} bytes");
            return Err(Problem::new(Code::InvalidRequest, detail));
        }
        let path = self.folder.0.join(format!(
            "file-{}",
            self.resources.len() + usize::from(self.input.is_some())
        ));
        let mut file = tokio::fs::File::create(&path).await?;
        let (mut hash, mut bytes) = (Sha256::new(), 0);
        let mut stream = stream;
        while let Some(chunk) = stream.next().await {
            let chunk = chunk.map_err(&problem)?;
            let chunk = chunk.as_ref();
            self.left = self.left.checked_sub(chunk.len() as u64).ok_or_else(|| {
                let detail = format!("an upload can have at most {} bytes", self.limit);
                Problem::new(Code::UploadTooLarge, detail).with_limit(self.limit)
            })?;
            bytes += chunk.len() as u64;
            hash.update(chunk);
            file.write_all(chunk).await?;
        }
        file.flush().await?;
        let file = InputFile {
            name,
            bytes,
            sha256: Some(format!("{:x}", hash.finalize())),
        };
        Ok((file, path))
    }

    /// Checks what came. The query wins over the form, and `kind` over both.
    pub async fn finish(self, kind: Option<Kind>, query: UploadQuery) -> Result<Received, Problem> {
        let Some((mut input, path)) = self.input else {
            let detail = "send it as part `mesh`, `image` or `problem`";
            return Err(Problem::new(Code::MissingMesh, detail));
        };
        let kind = kind.or(query.kind).or(self.kind).unwrap_or_default();
        let mut given = self.options;
        given.extend(query.options);
        let options = options::complete(kind, given)?;

        let checked = path.clone();
        let format = tokio::task::spawn_blocking(move || framing::format(&checked, kind))
            .await
            .map_err(|error| Problem::internal(&error))??;
        let name = query.filename.as_deref().unwrap_or(&input.name);
        input.name = file_name(name, kind, format.extension());

        let mut files = vec![(input, path)];
        files.extend(self.resources);
        let mut digest = Digest::default();
        digest.add(kind.word().as_bytes());
        digest.add(options.to_string().as_bytes());
        for (file, _) in &files {
            digest.add(file.name.as_bytes());
            digest.add(file.sha256.as_deref().unwrap_or_default().as_bytes());
        }
        Ok(Received {
            folder: self.folder,
            kind,
            options,
            files,
            priority: query.priority.unwrap_or_default(),
            digest: digest.finish(),
        })
    }
}

/// A name for the input: what the client calls it, without folders and control characters, with an extension that is one of
/// the kind's.
fn file_name(given: &str, kind: Kind, extension: &str) -> String {
    let name = given.rsplit(['/', '\\']).next().unwrap_or_default();
    let name: String = name.chars().filter(|c| !c.is_control()).collect();
    if name.is_empty() {
        format!("input.{extension}")
    } else if framing::is_named(&name, kind) {
        name
    } else {
        format!("{name}.{extension}")
    }
}

async fn text(mut field: Field<'_>) -> Result<String, Problem> {
    let mut bytes = Vec::new();
    while let Some(chunk) = field.chunk().await.map_err(|e| malformed(&e))? {
        bytes.extend_from_slice(&chunk);
        if MAX_TEXT_BYTES < bytes.len() as u64 {
            let detail = format!("a text part can have at most {MAX_TEXT_BYTES} bytes");
            return Err(Problem::new(Code::UploadTooLarge, detail).with_limit(MAX_TEXT_BYTES));
        }
    }
    String::from_utf8(bytes)
        .map_err(|_| Problem::new(Code::InvalidRequest, "a text part is not UTF-8"))
}

fn malformed(error: &MultipartError) -> Problem {
    Problem::new(Code::InvalidRequest, error.body_text())
}

fn broken(error: &axum::Error) -> Problem {
    Problem::new(
        Code::InvalidRequest,
        format!("the body is incomplete: {error}"),
    )
}
