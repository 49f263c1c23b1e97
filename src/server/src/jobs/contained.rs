//! A single computation in a child process, without a queue, for commands that run many.

use std::path::Path;
use std::time::Duration;

use super::child::{Child, Exit};
use super::deadline::{given_up_after, timed_out};
use super::program::Program;
use unwrapd_api::{
    ERROR, Failure, Kind, Limits, NO_SPACE, OUTCOME, Outcome, OutputFile, Pictures, TASK, Task,
    Upload, input_file, read_json, write_json,
};

/// Settings of a contained computation, whose crash ends only its child process.
#[derive(Clone, Debug)]
pub struct Contained {
    /// Program started as the compute child.
    pub program: Program,
    /// Maximum number of threads.
    pub threads: usize,
    /// Wall-clock time limit, after which the current valid map becomes the result.
    pub time: Duration,
    /// Memory limit in bytes.
    pub memory: u64,
    /// Time at which the pictures of an atlas are drawn.
    pub pictures: Pictures,
}

impl Contained {
    /// Runs a job of this kind. Leaves the n-th output file as [`output_file`](unwrapd_api::output_file)`(n)` in
    /// `folder`, which must exist and be empty. Dropping the future kills the child.
    ///
    /// # Errors
    /// Returns the failure that the computation reports, or the reason why it could not report one.
    pub async fn run(
        &self,
        kind: Kind,
        options: &serde_json::Value,
        upload: &Upload,
        folder: &Path,
    ) -> Result<Vec<OutputFile>, Failure> {
        let task = Task {
            kind,
            input: names(upload).map(str::to_owned).collect(),
            options: options.clone(),
            limits: Limits {
                triangles: None,
                threads: Some(self.threads),
                seconds: Some(self.time.as_secs_f64()),
            },
            memory: self.memory,
            pictures: self.pictures,
        };
        prepare(&task, upload, folder).await?;
        let child = Child::start(&self.program, "compute", folder)?;
        let at_most = given_up_after(self.time);
        finished(child, folder, at_most, timed_out(self.time)).await?;
        let outcome: Outcome = read_json(folder, OUTCOME)?;
        Ok(outcome.output)
    }
}

/// Waits until a child that works in `folder` has finished. Ends it after `at_most` and returns `late`.
pub(super) async fn finished(
    mut child: Child,
    folder: &Path,
    at_most: Duration,
    late: Failure,
) -> Result<(), Failure> {
    let heard = async { while child.next_message().await.is_some() {} };
    if tokio::time::timeout(at_most, heard).await.is_err() {
        child.terminate().await?;
        return Err(late);
    }
    let exit = child.wait().await?;
    match exit {
        Exit::Code(0) => Ok(()),
        Exit::Code(NO_SPACE) => {
            let detail = format!("no space left in {}", folder.display());
            Err(Failure::new("storage_full", detail))
        }
        _ => Err(read_json(folder, ERROR).unwrap_or_else(|_| exit.cause())),
    }
}

/// Returns the name of the mesh, then the names of the files it refers to.
fn names(upload: &Upload) -> impl Iterator<Item = &str> {
    let resources = upload.resources.keys().map(String::as_str);
    std::iter::once(upload.name.as_str()).chain(resources)
}

async fn prepare(task: &Task, upload: &Upload, folder: &Path) -> std::io::Result<()> {
    let contents = std::iter::once(&upload.bytes).chain(upload.resources.values());
    for (index, content) in contents.enumerate() {
        tokio::fs::write(folder.join(input_file(index)), content).await?;
    }
    write_json(folder, TASK, task)
}
