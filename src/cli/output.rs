//! Output files: checked before the work, written atomically after it, all or none.

use std::fs::{self, OpenOptions};
use std::io::{self, Write};
use std::os::unix::fs::MetadataExt;
use std::path::{Path, PathBuf};

use clap::ValueEnum;
use indicatif::HumanBytes;

use super::console::{self, Lines};
use super::failure::Failure;
use super::input::{folder, is_standard};
use crate::bulk::read_regular;
use unwrapd_files::document::Upload;
use unwrapd_pipeline::Caller;

/// Output file of a document.
#[derive(clap::Args)]
pub(super) struct Target {
    /// Output file. Its extension decides the format: .glb, .gltf or .obj. `-` is standard output
    #[arg(short, long, value_name = "OUT")]
    pub(super) output: PathBuf,
}

/// In which format a result is written, and what beside it.
#[derive(clap::Args)]
#[command(next_help_heading = "Files and messages")]
pub(super) struct Files<F: ValueEnum + Clone + Send + Sync + 'static> {
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
    ) -> Result<Self, Failure> {
        // At most one result can go to standard output, and one input can come from standard input.
        let others = others.iter().filter_map(|path| path.as_deref());
        let places: Vec<&Path> = [main].into_iter().chain(others).collect();
        let n_printed = count_standard(&places) + usize::from(args.talk.json);
        if n_printed > 1 {
            let text = "only one result can go to standard output: give `-` or --json once";
            return Err(Failure::usage(text));
        }
        if count_standard(inputs) > 1 {
            return Err(Failure::usage(
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
                return Err(Failure::usage(text));
            }
            files.push(file);
        }
        // Direct lines about the result to a stream that carries no result.
        console::direct(match (args.talk.quiet || args.talk.json, n_printed) {
            (true, _) => Lines::None,
            (false, 0) => Lines::Output,
            (false, _) => Lines::Error,
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
    ) -> Result<WrittenFiles, Failure> {
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
    fn check_apart(&self, path: &Path) -> Result<(), Failure> {
        let is_read = |input: &&PathBuf| !is_standard(input) && is_same(input, path);
        match self.inputs.iter().find(is_read) {
            Some(input) if !self.is_forced => Err(Failure::usage(format!(
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
        let named = |(path, bytes): &(PathBuf, usize)| {
            format!("{} ({})", path.display(), HumanBytes(*bytes as u64))
        };
        let (shown, rest) = self.0.split_at(self.0.len().min(MOST_NAMED));
        let mut files: Vec<String> = shown.iter().map(named).collect();
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
pub(super) fn is_stream(path: &Path) -> bool {
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
    let in_folder = || Some(fs::canonicalize(parent(path)).ok()?.join(path.file_name()?));
    let whole = fs::canonicalize(path).ok();
    whole.or_else(in_folder).unwrap_or(path.to_path_buf())
}

/// Returns the folder of a path.
fn parent(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    }
}

/// Checks that a path can be written, using an empty file under another name that is removed immediately.
fn check_writable(path: &Path) -> Result<(), Failure> {
    let refused = |cause: &dyn std::fmt::Display| {
        Failure::other(format!("cannot write {}: {cause}", path.display()))
    };
    let folder = parent(path);
    if path.is_dir() {
        return Err(refused(&"it is a directory"));
    }
    if !folder.is_dir() {
        let text = format!("the directory {} does not exist", folder.display());
        return Err(refused(&text));
    }
    let path = resolved(path);
    if path.exists() {
        let opened = OpenOptions::new().write(true).open(&path);
        opened.map_err(|error| refused(&error))?;
    }
    let part = part(&path);
    let tried = fs::write(&part, []).and_then(|()| fs::remove_file(&part));
    tried.map_err(|error| refused(&error))
}

/// Checks the folder for numbered files. Creates it if only it is missing, but not its parents.
pub(super) fn check_folder(path: &Path) -> Result<(), Failure> {
    let made = match fs::create_dir(path) {
        Err(error) if error.kind() == io::ErrorKind::AlreadyExists => Ok(()),
        made => made,
    };
    made.map_err(|error| Failure::other(format!("cannot create {}: {error}", path.display())))?;
    check_writable(&path.join("0"))
}

/// Writes a file completely or not at all.
pub(super) fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    write_all(&[(path.to_path_buf(), bytes)])
}

/// Returns the name under which a file is written before it is moved into place.
fn part(path: &Path) -> PathBuf {
    let mut name = path.file_name().unwrap_or_default().to_os_string();
    name.push(format!(".{}.part", std::process::id()));
    path.with_file_name(name)
}

/// Writes all files or none, except for streams.
fn write_all(contents: &[(PathBuf, &[u8])]) -> Result<(), Failure> {
    let (streams, files): (Vec<_>, Vec<_>) = contents.iter().partition(|(path, _)| is_stream(path));
    let files: Vec<(PathBuf, &[u8])> = (files.into_iter())
        .map(|(path, bytes)| (resolved(path), *bytes))
        .collect();
    let failed = |path: &Path, error: &io::Error| {
        for (path, _) in &files {
            // Remove what was written; only the first error is reported.
            let _ = fs::remove_file(part(path));
        }
        Failure::other(format!("cannot write {}: {error}", path.display()))
    };
    for (path, bytes) in &files {
        // Files beside a result may lie in a subfolder; the folder of the result itself was checked before.
        fs::create_dir_all(parent(path)).map_err(|error| failed(path, &error))?;
        fs::write(part(path), bytes).map_err(|error| failed(path, &error))?;
    }
    for (path, bytes) in streams {
        stream(path, bytes).map_err(|error| failed(path, &error))?;
    }
    for (path, _) in &files {
        fs::rename(part(path), path).map_err(|error| failed(path, &error))?;
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
