//! Receiver of the files, options and kind of one upload, from a form or a raw body.

use std::path::{Path, PathBuf};

use axum::body::Body;
use axum::extract::multipart::{Field, Multipart, MultipartError};
use futures_util::{Stream, StreamExt};
use serde_json::{Map, Value};
use sha2::{Digest as _, Sha256};
use tokio::io::AsyncWriteExt;

use super::contents::{self, Files, MAX_FILES, at_most, at_most_name, referenced};
use super::problem::{Code, Problem};
use super::submission::{self, HandlingBuilder, Received, UploadQuery, once};
use crate::jobs::Scratch;
use unwrapd_api::{Catalog, InputFile, Kind, from_json};

/// Maximum length of the input's name in bytes: responses name their files after it in a header. Common file systems
/// have the same limit.
const MAX_INPUT_NAME: usize = 255;

/// Collects the parts of one upload.
pub(super) struct Receiver {
    catalog: &'static dyn Catalog,
    folder: Scratch,
    left: u64,
    limit: u64,
    input: Option<(InputFile, PathBuf)>,
    resources: Vec<(InputFile, PathBuf)>,
    kind: Option<Kind>,
    has_options: bool,
    options: Map<String, Value>,
    handling: HandlingBuilder,
}

impl Receiver {
    /// Starts an upload of at most `limit` bytes into a new folder; `handling` comes from the query.
    pub fn new(
        catalog: &'static dyn Catalog,
        folder: PathBuf,
        limit: u64,
        handling: HandlingBuilder,
    ) -> Result<Self, Problem> {
        Ok(Self {
            catalog,
            folder: Scratch::make(folder)?,
            left: limit,
            limit,
            input: None,
            resources: Vec::new(),
            kind: None,
            has_options: false,
            options: Map::new(),
            handling,
        })
    }

    /// Receives a body that is the input itself.
    pub async fn body(&mut self, name: String, body: Body) -> Result<(), Problem> {
        let stream = body.into_data_stream();
        self.input = Some(self.store(name, stream, |e| broken(&e)).await?);
        Ok(())
    }

    /// Receives a form.
    pub async fn form(&mut self, mut form: Multipart) -> Result<(), Problem> {
        while let Some(field) = form.next_field().await.map_err(|e| malformed(&e))? {
            match field.name().unwrap_or_default() {
                // Store files at once, and read settings into memory.
                part if INPUT_PARTS.contains(&part) => {
                    if self.input.is_some() {
                        let detail = "there is more than one input: send one part named mesh, image or problem";
                        return Err(Problem::new(Code::InvalidRequest, detail));
                    }
                    let name = field.file_name().unwrap_or_default().to_owned();
                    self.input = Some(self.store(name, field, |e| malformed(&e)).await?);
                }
                "kind" => {
                    let kind = submission::parse_kind(&text(field).await?)?;
                    once("kind", self.kind.replace(kind).is_none())?;
                }
                "options" => {
                    once("options", !std::mem::replace(&mut self.has_options, true))?;
                    let text = text(field).await?;
                    self.options = from_json(text.as_bytes()).map_err(|error| {
                        let detail = format!("options are not a JSON object: {error}");
                        Problem::new(Code::InvalidOptions, detail)
                    })?;
                }
                "resource" => self.resource(field).await?,
                part if HandlingBuilder::NAMES.contains(&part) => {
                    let part = part.to_owned();
                    self.handling.take(&part, &text(field).await?)?;
                }
                part => return Err(unexpected(part)),
            }
        }
        Ok(())
    }

    async fn resource(&mut self, field: Field<'_>) -> Result<(), Problem> {
        let Some(name) = field.file_name().map(str::to_owned) else {
            let detail = "a resource needs a file name: the path by which the input names it";
            return Err(Problem::new(Code::InvalidRequest, detail));
        };
        let is_new = self.resources.iter().all(|(known, _)| known.name != name);
        once(&format!("the resource {name:?}"), is_new)?;
        if MAX_FILES <= self.resources.len() {
            let detail = format!("an upload can have at most {MAX_FILES} files");
            return Err(Problem::new(Code::UploadTooLarge, detail).with_limit(MAX_FILES as u64));
        }
        let file = self.store(name, field, |e| malformed(&e)).await?;
        self.resources.push(file);
        Ok(())
    }

    /// Writes a stream to a new file of the upload.
    async fn store<B: AsRef<[u8]>, E>(
        &mut self,
        name: String,
        stream: impl Stream<Item = Result<B, E>> + Unpin,
        problem: impl Fn(E) -> Problem,
    ) -> Result<(InputFile, PathBuf), Problem> {
        // Choose a path of our own: the client's name is only data.
        at_most_name(&name)?;
        let path = self.folder.path().join(format!(
            "file-{}",
            self.resources.len() + usize::from(self.input.is_some())
        ));
        let (bytes, sha256) = write(&path, stream, &mut self.left, self.limit, problem).await?;
        let file = InputFile {
            name,
            bytes,
            sha256: Some(sha256),
        };
        Ok((file, path))
    }

    /// Validates what was received.
    pub async fn finish(self, kind: Option<Kind>, query: UploadQuery) -> Result<Received, Problem> {
        // Check that there is an input and one kind.
        let Some((input, path)) = self.input else {
            let detail = "send it as part `mesh`, `image` or `problem`";
            return Err(Problem::new(Code::MissingMesh, detail));
        };
        once("kind", query.kind.or(kind).is_none() || self.kind.is_none())?;
        if kind.is_some() {
            self.handling.check_unkept()?;
        }
        // Complete the options of form and query, which must not repeat each other.
        let kind = kind.or(query.kind).or(self.kind).unwrap_or_default();
        let mut given = self.options;
        for (name, value) in query.options {
            once(&name, given.insert(name.clone(), value).is_none())?;
        }
        let options = submission::complete_options(self.catalog, kind, given)?;

        // Unpack, filter and name the files on a thread for blocking work.
        let mut files = vec![(input, path)];
        files.extend(self.resources);
        let (catalog, limit) = (self.catalog, self.limit);
        let files = tokio::task::spawn_blocking(move || {
            prepared(catalog, files, kind, limit, query.filename)
        })
        .await
        .map_err(|error| Problem::internal(&error))??;
        Ok(Received {
            folder: self.folder,
            kind,
            options,
            files,
            handling: self.handling.into_handling(kind)?,
        })
    }
}

/// Writes a stream to a new file. Subtracts its bytes from those left of the `limit` of the whole upload. Returns their
/// number and their SHA-256.
pub(super) async fn write<B: AsRef<[u8]>, E>(
    path: &Path,
    mut stream: impl Stream<Item = Result<B, E>> + Unpin,
    left: &mut u64,
    limit: u64,
    problem: impl Fn(E) -> Problem,
) -> Result<(u64, String), Problem> {
    let mut file = tokio::fs::File::create(path).await?;
    let (mut hash, mut bytes) = (Sha256::new(), 0);
    while let Some(chunk) = stream.next().await {
        let chunk = chunk.map_err(&problem)?;
        let chunk = chunk.as_ref();
        *left = left.checked_sub(chunk.len() as u64).ok_or_else(|| {
            let detail = format!("an upload can have at most {limit} bytes");
            Problem::new(Code::UploadTooLarge, detail).with_limit(limit)
        })?;
        bytes += chunk.len() as u64;
        hash.update(chunk);
        file.write_all(chunk).await?;
    }
    file.flush().await?;
    Ok((bytes, format!("{:x}", hash.finalize())))
}

/// Prepares the files of an upload: unpacks an archive, drops unreferenced resources, detects the format of the input
/// and names it. The input comes first.
fn prepared(
    catalog: &dyn Catalog,
    mut files: Files,
    kind: Kind,
    limit: u64,
    filename: Option<String>,
) -> Result<Files, Problem> {
    let mut filename = filename;
    if contents::is_archive(&files[0].1)? {
        if 1 < files.len() {
            let detail = "an archive has all files in it: send no resource beside it";
            return Err(Problem::new(Code::InvalidRequest, detail));
        }
        files = contents::unpacked(catalog, &files[0].1, kind, limit)?;
        // The name in the query was that of the archive.
        filename = None;
    } else {
        retain_referenced(catalog, &mut files, kind)?;
    }
    let (input, path) = &mut files[0];
    let format = contents::detect_format(catalog, path, kind)?;
    let name = filename.as_deref().unwrap_or(&input.name);
    input.name = file_name(name, kind, format.extension());
    at_most(&input.name, MAX_INPUT_NAME)?;
    Ok(files)
}

/// Drops the resources of a form that its input does not reference.
fn retain_referenced(catalog: &dyn Catalog, files: &mut Files, kind: Kind) -> Result<(), Problem> {
    let resources = &files[1..];
    let known = resources.iter().map(|(file, _)| file.name.clone());
    let (input, path) = &files[0];
    let kept = referenced(
        catalog,
        kind,
        &input.name,
        &known.collect(),
        || Ok(std::fs::read(path)?),
        |name| match resources.iter().find(|(file, _)| file.name == name) {
            Some((_, path)) => Ok(std::fs::read(path)?),
            None => Ok(Vec::new()),
        },
    )?;
    let mut is_input = true;
    files.retain(|(file, _)| std::mem::take(&mut is_input) || kept.contains(&file.name));
    Ok(())
}

/// Returns a name for the input: the client's name without folders and control characters, with an extension of the
/// kind's formats.
fn file_name(given: &str, kind: Kind, extension: &str) -> String {
    let name = given.rsplit(['/', '\\']).next().unwrap_or_default();
    let name: String = name.chars().filter(|c| !c.is_control()).collect();
    if name.is_empty() {
        format!("input.{extension}")
    } else if contents::is_named(&name, kind) {
        name
    } else {
        format!("{name}.{extension}")
    }
}

pub(super) fn broken(error: &axum::Error) -> Problem {
    Problem::new(
        Code::InvalidRequest,
        format!("the body is incomplete: {error}"),
    )
}

// Form parts: their texts and their errors.

/// Names of the part that holds the input.
const INPUT_PARTS: [&str; 3] = ["mesh", "image", "problem"];
/// Maximum length of a text part in bytes: enough for options with some thousand handles.
const MAX_TEXT_BYTES: u64 = 256 << 10;

/// Reads the text of a part.
pub(super) async fn text(mut field: Field<'_>) -> Result<String, Problem> {
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

/// Returns the problem of an unknown part.
pub(super) fn unexpected(part: &str) -> Problem {
    let part: String = part.chars().take(100).collect();
    let detail = format!(
        "unexpected part {part:?}: the parts of a form are mesh, image or problem, resource, options, kind, {}",
        HandlingBuilder::NAMES.join(", ")
    );
    Problem::new(Code::InvalidRequest, detail)
}

/// Returns the problem of a malformed form.
pub(super) fn malformed(error: &MultipartError) -> Problem {
    Problem::new(Code::InvalidRequest, error.body_text())
}
