//! The compute child: one attempt at a job, the drawing of a picture, or the decoding of a texture, in a process of its own.
//!
//! It reads the attempt's folder, limits its own memory, reports progress on standard output and leaves its results
//! in the folder. SIGTERM ends it like any process. SIGINT makes it finish early with its current valid map. A byte
//! on its standard input requests the maps under way. When standard input closes, the server is gone and the child
//! exits.

use std::io::{ErrorKind, Read};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use nix::sys::resource::{Resource, setrlimit};
use nix::sys::signal::{SigSet, Signal};

use crate::maps::{IterationFiles, Maps};
use crate::reporter::Reporter;
use crate::work::Work;
use unwrapd_api::{
    DRAWING, Drawing, ERROR, Failure, NO_SPACE, OUTCOME, Outcome, OutputFile, PICTURE, Picture,
    Subject, TASK, Task, Upload, input_file, output_file, read_json, read_upload, sha256,
    write_json,
};
use unwrapd_files::picture::{Picture as Texture, thumbnail_png};
use unwrapd_pipeline::{AtlasPicture, Pictures, PipelineError};

/// Runs the job in `folder` and returns the exit code of the process: 0 with results written, else that of the error.
pub fn run(folder: &Path) -> u8 {
    reported(attempt(folder), folder)
}

/// Draws the picture of a result in `folder`, and returns the exit code of the process as [`run`] does.
pub fn draw(folder: &Path) -> u8 {
    reported(drawn(folder), folder)
}

fn reported(attempt: AttemptResult<()>, folder: &Path) -> u8 {
    match attempt {
        Ok(()) => 0,
        Err((exit_code, failure)) => {
            eprintln!("{}: {}", failure.code, failure.detail);
            match write_json(folder, ERROR, &failure) {
                Ok(()) => exit_code,
                Err(error) => unwritten(error).0,
            }
        }
    }
}

type AttemptResult<T> = Result<T, (u8, Failure)>;

fn attempt(folder: &Path) -> AttemptResult<()> {
    // Listen to the server first: a child whose server is gone must exit.
    let finish = Arc::new(AtomicBool::new(false));
    let maps = Arc::new(Maps::new(folder));
    listen(&finish, &maps).map_err(internal)?;
    // Read the task, and limit the memory before reading the input.
    let task: Task = read_json(folder, TASK).map_err(internal)?;
    contain(task.memory).map_err(internal)?;
    let reporter = Reporter::start(finish, IterationFiles::new(folder), maps).map_err(internal)?;
    let upload = read_upload(folder, &task.input).map_err(internal)?;
    // Do the work.
    let work = Work::new(task.kind, task.options).map_err(|e| refusal(&e))?;
    let mut made = work
        .run(&upload, task.limits, &reporter)
        .map_err(|e| refusal(&e))?;
    made.complete(task.pictures).map_err(|e| refusal(&e))?;
    // Write the files, and the outcome last: it makes them valid.
    let mut output = Vec::new();
    for (index, (role, name, bytes)) in made.files.into_iter().enumerate() {
        std::fs::write(folder.join(output_file(index)), &bytes).map_err(unwritten)?;
        output.push(OutputFile {
            role,
            name,
            bytes: bytes.len() as u64,
            sha256: Some(sha256(&bytes)),
        });
    }
    Reporter::tell_cpu();
    let frames = reporter.into_frames();
    frames.into_output(&mut output).map_err(unwritten)?;
    let verdict = made.verdict;
    write_json(folder, OUTCOME, &Outcome { output, verdict }).map_err(unwritten)
}

fn drawn(folder: &Path) -> AttemptResult<()> {
    end_with_server(|| {}).map_err(internal)?;
    let task = DrawingTask::read(folder).map_err(internal)?;
    contain(task.memory()).map_err(internal)?;
    let png = task.png(folder).map_err(|error| match error {
        DrawingError::Pipeline(error) => refusal(&error),
        DrawingError::Io(error) => internal(error),
    })?;
    DrawingTask::write(folder, &png).map_err(unwritten)
}

/// Limits the memory of this process, in bytes.
pub fn contain(memory: u64) -> std::io::Result<()> {
    setrlimit(Resource::RLIMIT_DATA, memory, memory)?;
    // The signal reports a crash; a core dump would only fill the disk.
    Ok(setrlimit(Resource::RLIMIT_CORE, 0, 0)?)
}

/// Starts the threads that listen to standard input, where a byte requests maps, to its end, and to SIGINT. Must be
/// called before any other thread exists, since threads inherit the set of blocked signals.
fn listen(finish: &Arc<AtomicBool>, maps: &Arc<Maps>) -> std::io::Result<()> {
    let mut signals = SigSet::empty();
    signals.add(Signal::SIGINT);
    signals.thread_block()?;
    let finish = Arc::clone(finish);
    std::thread::Builder::new().spawn(move || {
        while signals.wait().is_ok() {
            finish.store(true, Ordering::Relaxed);
        }
    })?;
    let maps = Arc::clone(maps);
    end_with_server(move || maps.ask())
}

/// Starts the thread that ends this process when its standard input closes. Calls `hear` for every byte before that.
fn end_with_server(hear: impl Fn() + Send + 'static) -> std::io::Result<()> {
    std::thread::Builder::new().spawn(move || {
        let mut byte = [0];
        while matches!(std::io::stdin().read(&mut byte), Ok(1..)) {
            hear();
        }
        std::process::exit(1);
    })?;
    Ok(())
}

fn refusal(error: &PipelineError) -> (u8, Failure) {
    (
        error.exit_code(),
        Failure::new(error.code(), error.to_string()),
    )
}

/// Returns exit code and failure for a file that could not be written.
fn unwritten(error: std::io::Error) -> (u8, Failure) {
    match error.kind() {
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded => {
            let detail = format!("no space left: {error}");
            (NO_SPACE as u8, Failure::new("storage_full", detail))
        }
        _ => internal(error),
    }
}

fn internal(error: impl std::fmt::Display) -> (u8, Failure) {
    (1, Failure::new("internal_error", error.to_string()))
}

// Pictures of results, drawn in the child from the files of a job.

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
        match &self.0.subject {
            Subject::Result {
                picture,
                input,
                output,
            } => of_result(*picture, input, output, folder),
            Subject::Texture => {
                let texture = std::fs::read(folder.join(input_file(0)))?;
                Ok(Texture::decode(&texture)
                    .map_err(PipelineError::from)?
                    .png())
            }
        }
    }

    /// Writes the picture to the file where the service expects it.
    pub fn write(folder: &Path, png: &[u8]) -> std::io::Result<()> {
        std::fs::write(folder.join(PICTURE), png)
    }
}

/// Draws a picture of the result in a folder.
fn of_result(
    picture: Picture,
    input: &[String],
    output: &[OutputFile],
    folder: &Path,
) -> Result<Vec<u8>, DrawingError> {
    match picture {
        Picture::Layout => of_atlas(AtlasPicture::Layout, input, output, folder),
        Picture::Heatmap => of_atlas(AtlasPicture::Heatmap, input, output, folder),
        Picture::Thumbnail => {
            let shown = match output {
                [_] => std::fs::read(folder.join(output_file(0)))?,
                _ => of_atlas(AtlasPicture::Layout, input, output, folder)?,
            };
            Ok(thumbnail_png(&shown).map_err(PipelineError::from)?)
        }
    }
}

fn of_atlas(
    picture: AtlasPicture,
    input: &[String],
    output: &[OutputFile],
    folder: &Path,
) -> Result<Vec<u8>, DrawingError> {
    let mut report = Vec::new();
    let mut result = Upload::default();
    for (index, file) in output.iter().enumerate() {
        let content = std::fs::read(folder.join(output_file(index)))?;
        let (role, name) = (file.role.as_str(), file.name.clone());
        match role {
            "report" => report = content,
            "result" => (result.name, result.bytes) = (name, content),
            _ => drop(result.resources.insert(name, content)),
        }
    }
    let input = match input {
        [] => None,
        names => Some(read_upload(folder, names)?),
    };
    let report = serde_json::from_slice(&report).map_err(std::io::Error::from)?;
    let pictures = Pictures::of_result(&result, report, input.as_ref(), THREADS)?;
    Ok(pictures.draw(picture)?)
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
