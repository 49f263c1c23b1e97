//! Files of commands: inputs, formats, outputs. `-` is standard input or output.
//!
//! Each input is opened and read once, so it may be a pipe.

use std::collections::BTreeMap;
use std::fs::{self, OpenOptions};
use std::io::{self, Write};
use std::os::unix::fs::{FileTypeExt, MetadataExt};
use std::path::{Path, PathBuf};

use clap::ValueEnum;
use indicatif::HumanBytes;

use super::console::{self, CommandFailure, LineTarget};
use crate::bulk::{MOST_BYTES, read_bounded, read_regular};
use unwrapd_files::document::{OutputFormat, Upload, with_references};
use unwrapd_files::io::Format;
use unwrapd_pipeline::{BodyFormat, Caller};

/// A file that has UVs.
#[derive(clap::Args)]
pub(super) struct Mapped {
    /// Mesh with UVs: .glb, .gltf or .obj; `-` is standard input
    #[arg(value_name = "IN")]
    pub(super) input: PathBuf,
}

/// Returns whether a name stands for standard input or output.
fn is_standard(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// Reads a file or standard input.
pub(super) fn read_file(path: &Path) -> Result<Vec<u8>, CommandFailure> {
    let read = if is_standard(path) {
        read_bounded(io::stdin(), MOST_BYTES)
    } else {
        read_named(path)
    };
    let name = if is_standard(path) {
        "standard input".to_owned()
    } else {
        path.display().to_string()
    };
    read.map_err(|error| CommandFailure::input(format!("{name}: {error}")))
}

/// Reads a file named on the command line: it may be a pipe, but not a device, which may never end.
fn read_named(path: &Path) -> io::Result<Vec<u8>> {
    let kind = fs::metadata(path)?.file_type();
    if kind.is_fifo() || kind.is_socket() {
        return read_bounded(fs::File::open(path)?, MOST_BYTES);
    }
    read_regular(path)
}

/// Reads a file and the files that it references by relative URI.
pub(super) fn read_upload(path: &Path) -> Result<Upload, CommandFailure> {
    let (upload, folder) = (upload(path, read_file(path)?, []), folder(path));
    Ok(with_references(upload, |reference| {
        read_regular(&folder.join(reference)).ok()
    }))
}

/// Creates an upload from a file that was read and from those of its references that exist.
pub(super) fn upload(
    path: &Path,
    bytes: Vec<u8>,
    references: impl IntoIterator<Item = String>,
) -> Upload {
    let folder = folder(path);
    let mut resources = BTreeMap::new();
    for reference in references {
        if let Ok(content) = read_regular(&folder.join(&reference)) {
            resources.insert(reference, content);
        }
    }
    let name = if is_standard(path) {
        None
    } else {
        path.file_name()
    };
    Upload {
        name: name.unwrap_or_default().to_string_lossy().into_owned(),
        bytes,
        resources,
    }
}

/// Returns the folder to which references of a file are relative; the current one for a pipe.
pub(super) fn folder(path: &Path) -> PathBuf {
    let is_file = !is_standard(path) && path.is_file();
    let folder = if is_file { path.parent() } else { None };
    folder.unwrap_or(Path::new("")).to_path_buf()
}

// Format of a result: given by the extension of OUT, or by `--format` if it has none.

/// Returns the format of a document to write.
pub(super) fn output_format(
    path: &Path,
    given: Option<OutputFormat>,
) -> Result<OutputFormat, CommandFailure> {
    let format = agreed(path, given)?;
    if format == OutputFormat::Gltf && is_stream(path) {
        return Err(several_files(path));
    }
    Ok(format)
}

/// Returns the format of a body to write.
pub(super) fn body_format(
    path: &Path,
    given: Option<BodyFormat>,
) -> Result<BodyFormat, CommandFailure> {
    let format = agreed(path, given)?;
    if format == BodyFormat::Gltf && is_stream(path) {
        return Err(several_files(path));
    }
    Ok(format)
}

/// Checks that a picture is written as PNG.
pub(super) fn check_png(path: &Path) -> Result<(), CommandFailure> {
    let format = Format::of_name(&path.to_string_lossy());
    if format == Some(Format::Png) || is_stream(path) {
        return Ok(());
    }
    let name = path.display();
    Err(CommandFailure::usage(format!(
        "{name}: the name of OUT must end in .png"
    )))
}

fn agreed<F: ValueEnum + PartialEq>(path: &Path, given: Option<F>) -> Result<F, CommandFailure> {
    let extension = path.extension().unwrap_or_default().to_ascii_lowercase();
    let name = path.display();
    match (F::from_str(&extension.to_string_lossy(), false).ok(), given) {
        (Some(named), Some(given)) if named != given => Err(CommandFailure::usage(format!(
            "{name}: --format contradicts the extension"
        ))),
        (_, Some(format)) | (Some(format), None) => Ok(format),
        (None, None) => {
            let values = F::value_variants().iter();
            let values = values.filter_map(ValueEnum::to_possible_value);
            let words: Vec<String> = values.map(|value| value.get_name().to_owned()).collect();
            Err(CommandFailure::usage(format!(
                "{name}: unknown format: use one of the extensions .{}, or --format with one of {}",
                words.join(", ."),
                words.join(", ")
            )))
        }
    }
}

fn several_files(path: &Path) -> CommandFailure {
    let name = path.display();
    CommandFailure::usage(format!(
        "{name}: gltf consists of several files, which a stream cannot carry: use glb"
    ))
}

// Output files: checked before the work, written atomically after it, all or none.

/// Output file of a document.
#[derive(clap::Args)]
pub(super) struct OutputTarget {
    /// Output file. Its extension decides the format: .glb, .gltf or .obj. `-` is standard output
    #[arg(short, long, value_name = "OUT")]
    pub(super) output: PathBuf,
}

/// Format of a result, and files written beside it.
#[derive(clap::Args)]
#[command(next_help_heading = "Files and messages")]
pub(super) struct OutputFiles<F: ValueEnum + Clone + Send + Sync + 'static> {
    /// Format of OUT if its name does not tell
    #[arg(long)]
    pub(super) format: Option<F>,
    /// Write the report as JSON: what was done, quality, proofs
    #[arg(long, value_name = "R.json")]
    pub(super) report: Option<PathBuf>,
    #[command(flatten)]
    pub(super) output: OutputArgs,
}

/// Output files and messages.
#[derive(clap::Args)]
#[command(next_help_heading = "Files and messages")]
pub(super) struct OutputArgs {
    /// Allow OUT to replace an input file
    #[arg(long)]
    force: bool,
    #[command(flatten)]
    pub(super) talk: Talk,
}

/// Amount of output.
#[derive(clap::Args)]
#[command(next_help_heading = "Files and messages")]
pub(super) struct Talk {
    /// Print only warnings and errors
    #[arg(short, long)]
    pub(super) quiet: bool,
    /// Print the report as JSON instead of the summary
    #[arg(long)]
    pub(super) json: bool,
}

/// Destinations of a command's results.
pub(super) struct Outputs {
    main: PathBuf,
    /// Input files, which nothing replaces unless that is forced.
    inputs: Vec<PathBuf>,
    is_forced: bool,
}

impl Outputs {
    /// Checks that results can be written to all of these paths, that no two are the same file, and that none is an
    /// input. Directs lines about the result to a stream without a result.
    pub(super) fn check(
        main: &Path,
        others: &[&Option<PathBuf>],
        inputs: &[&Path],
        args: &OutputArgs,
    ) -> Result<Self, CommandFailure> {
        // At most one result can go to standard output, and one input can come from standard input.
        let others = others.iter().filter_map(|path| path.as_deref());
        let places: Vec<&Path> = [main].into_iter().chain(others).collect();
        let n_printed = count_standard(&places) + usize::from(args.talk.json);
        if n_printed > 1 {
            let text = "only one result can go to standard output: give `-` or --json once";
            return Err(CommandFailure::usage(text));
        }
        if count_standard(inputs) > 1 {
            return Err(CommandFailure::usage(
                "only one input can come from standard input: give `-` once",
            ));
        }
        let outputs = Self {
            main: main.to_path_buf(),
            inputs: inputs.iter().map(|path| path.to_path_buf()).collect(),
            is_forced: args.force,
        };
        // Check that the files are writable, distinct, and no inputs.
        let mut files: Vec<PathBuf> = Vec::new();
        for path in places.into_iter().filter(|path| !is_stream(path)) {
            outputs.check_apart(path)?;
            check_writable(path)?;
            let file = resolved(path);
            if files.contains(&file) {
                let text = format!("{}: two results would go to the same file", path.display());
                return Err(CommandFailure::usage(text));
            }
            files.push(file);
        }
        // Direct lines about the result to a stream that carries no result.
        console::direct(match (args.talk.quiet || args.talk.json, n_printed) {
            (true, _) => LineTarget::None,
            (false, 0) => LineTarget::Output,
            (false, _) => LineTarget::Error,
        });
        Ok(outputs)
    }

    /// Adds the files that an input references to the inputs.
    pub(super) fn with_resources_of(mut self, upload: &Upload) -> Self {
        if let Some(input) = self.inputs.first() {
            let folder = folder(input);
            self.inputs
                .extend(upload.resources.keys().map(|name| folder.join(name)));
        }
        self
    }

    /// Writes the files of a result, the main one to its path and the others beside it, and the other outputs. Each
    /// is written completely under another name; once all are written, they are moved into place, the main one last.
    /// Returns what was written.
    pub(super) fn write(
        &self,
        files: &[(String, Vec<u8>)],
        others: &[(&Option<PathBuf>, &[u8])],
    ) -> Result<WrittenFiles, CommandFailure> {
        // Collect the contents, the main file last, so that its presence proves the others.
        let mut contents: Vec<(PathBuf, &[u8])> = Vec::new();
        for (path, bytes) in others {
            contents.extend(path.iter().map(|path| (path.clone(), *bytes)));
        }
        for (name, bytes) in files.iter().skip(1) {
            if is_stream(&self.main) {
                console::warn_of(format_args!(
                    "{name} is left out: a stream carries one file only"
                ));
                continue;
            }
            let path = self.main.with_file_name(name);
            if read_regular(&path).is_ok_and(|old| old == *bytes) {
                continue;
            }
            self.check_apart(&path)?;
            contents.push((path, bytes));
        }
        if let Some((_, bytes)) = files.first() {
            contents.push((self.main.clone(), bytes));
        }
        // Write all, and list what was written.
        write_all(&contents)?;
        let files = contents.iter().rev().filter(|(path, _)| !is_stream(path));
        Ok(WrittenFiles(
            (files.map(|(path, bytes)| (path.clone(), bytes.len()))).collect(),
        ))
    }

    /// Rejects a path that would replace an input.
    fn check_apart(&self, path: &Path) -> Result<(), CommandFailure> {
        let mut inputs = self.inputs.iter();
        match inputs.find(|input| !is_standard(input) && is_same(input, path)) {
            Some(input) if !self.is_forced => Err(CommandFailure::usage(format!(
                "{} would replace the input {}; use --force to allow that",
                path.display(),
                input.display()
            ))),
            _ => Ok(()),
        }
    }
}

/// Names and sizes in bytes of written files, the main one first.
pub(super) struct WrittenFiles(Vec<(PathBuf, usize)>);

impl WrittenFiles {
    /// Prints which files were written, as the last line of a command.
    pub(super) fn tell(&self) {
        let (shown, rest) = self.0.split_at(self.0.len().min(MOST_NAMED));
        let mut files = Vec::new();
        for (path, bytes) in shown {
            let bytes = HumanBytes(*bytes as u64);
            files.push(format!("{} ({bytes})", path.display()));
        }
        if !rest.is_empty() {
            let bytes: usize = rest.iter().map(|(_, bytes)| bytes).sum();
            let bytes = HumanBytes(bytes as u64);
            files.push(format!("{} more files ({bytes})", rest.len()));
        }
        if !files.is_empty() {
            console::say(format_args!("wrote {}", files.join(", ")));
        }
    }
}

/// Maximum number of files named in the last line of a command, so that the line stays readable.
const MOST_NAMED: usize = 4;

fn count_standard(paths: &[&Path]) -> usize {
    paths.iter().filter(|path| is_standard(path)).count()
}

/// Returns whether a path is standard output, a pipe or a device, where writing replaces nothing.
fn is_stream(path: &Path) -> bool {
    is_standard(path) || fs::metadata(path).is_ok_and(|of| !of.is_file() && !of.is_dir())
}

/// Returns the settings that the command adds to the options: files are named like the one at `path`, if it is a
/// file.
pub(super) fn caller(path: &Path) -> Caller {
    let stem = path.file_stem().filter(|_| !is_stream(path));
    Caller {
        stem: stem.map(|stem| stem.to_string_lossy().into_owned()),
        ..Caller::default()
    }
}

/// Returns whether two paths lead to the same file, through any links.
fn is_same(a: &Path, b: &Path) -> bool {
    match (fs::metadata(a), fs::metadata(b)) {
        (Ok(a), Ok(b)) => a.is_file() && (a.dev(), a.ino()) == (b.dev(), b.ino()),
        _ => false,
    }
}

/// Resolves links in a path: moving a file onto a link would replace the link.
fn resolved(path: &Path) -> PathBuf {
    if let Ok(whole) = fs::canonicalize(path) {
        return whole;
    }
    match (fs::canonicalize(parent(path)), path.file_name()) {
        (Ok(folder), Some(name)) => folder.join(name),
        _ => path.to_path_buf(),
    }
}

/// Returns the folder of a path.
fn parent(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    }
}

/// Checks that a path can be written, using an empty file under another name that is removed immediately.
fn check_writable(path: &Path) -> Result<(), CommandFailure> {
    let folder = parent(path);
    if path.is_dir() {
        return Err(unwritable(path, &"it is a directory"));
    }
    if !folder.is_dir() {
        let text = format!("the directory {} does not exist", folder.display());
        return Err(unwritable(path, &text));
    }
    let file = resolved(path);
    if file.exists() {
        let opened = OpenOptions::new().write(true).open(&file);
        opened.map_err(|error| unwritable(path, &error))?;
    }
    let part = part(&file);
    let tried = fs::write(&part, []).and_then(|()| fs::remove_file(&part));
    tried.map_err(|error| unwritable(path, &error))
}

fn unwritable(path: &Path, cause: &dyn std::fmt::Display) -> CommandFailure {
    CommandFailure::other(format!("cannot write {}: {cause}", path.display()))
}

/// Checks the folder for numbered files. Creates it if only it is missing, but not its parents.
pub(super) fn check_folder(path: &Path) -> Result<(), CommandFailure> {
    let made = match fs::create_dir(path) {
        Err(error) if error.kind() == io::ErrorKind::AlreadyExists => Ok(()),
        made => made,
    };
    made.map_err(|error| {
        CommandFailure::other(format!("cannot create {}: {error}", path.display()))
    })?;
    check_writable(&path.join("0"))
}

/// Writes a file completely or not at all.
pub(super) fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), CommandFailure> {
    write_all(&[(path.to_path_buf(), bytes)])
}

/// Returns the name under which a file is written before it is moved into place.
fn part(path: &Path) -> PathBuf {
    let mut name = path.file_name().unwrap_or_default().to_os_string();
    name.push(format!(".{}.part", std::process::id()));
    path.with_file_name(name)
}

/// Writes all files or none, except for streams.
fn write_all(contents: &[(PathBuf, &[u8])]) -> Result<(), CommandFailure> {
    let (streams, files): (Vec<_>, Vec<_>) = contents.iter().partition(|(path, _)| is_stream(path));
    let files: Vec<(PathBuf, &[u8])> = (files.into_iter())
        .map(|(path, bytes)| (resolved(path), *bytes))
        .collect();
    put_all(&files, &streams).map_err(|(path, error)| {
        for (path, _) in &files {
            // Remove what was written; only the first error is reported.
            let _ = fs::remove_file(part(path));
        }
        unwritable(path, &error)
    })
}

/// Writes files under other names, writes the streams, and moves the files into place. Returns the path of the first
/// error.
fn put_all<'a>(
    files: &'a [(PathBuf, &[u8])],
    streams: &[&'a (PathBuf, &[u8])],
) -> Result<(), (&'a Path, io::Error)> {
    for (path, bytes) in files {
        // Files beside a result may lie in a subfolder; the folder of the result itself was checked before.
        fs::create_dir_all(parent(path)).map_err(|error| (path.as_path(), error))?;
        fs::write(part(path), bytes).map_err(|error| (path.as_path(), error))?;
    }
    for (path, bytes) in streams {
        stream(path, bytes).map_err(|error| (path.as_path(), error))?;
    }
    for (path, _) in files {
        fs::rename(part(path), path).map_err(|error| (path.as_path(), error))?;
    }
    Ok(())
}

fn stream(path: &Path, bytes: &[u8]) -> io::Result<()> {
    if is_standard(path) {
        let mut output = io::stdout().lock();
        return output.write_all(bytes).and_then(|()| output.flush());
    }
    OpenOptions::new().write(true).open(path)?.write_all(bytes)
}
