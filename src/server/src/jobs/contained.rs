//! One computation in a child process of its own, without a queue: for commands that have many to do.

use std::path::Path;
use std::time::Duration;

use super::child::{Child, Exit};
use super::deadline::{given_up_after, timed_out};
use super::program::Program;
use unwrapd_api::{
    ERROR, Failure, Kind, Limits, NO_SPACE, OUTCOME, Outcome, OutputFile, Pictures, TASK, Task,
    Upload, input_file, read_json, write_json,
};

/// What contains a computation: a process that ends with its own failure, and limits.
#[derive(Clone, Debug)]
pub struct Contained {
    /// What is started as compute child.
    pub program: Program,
    /// Threads at most.
    pub threads: usize,
    /// Wall-clock time, after which the present valid map becomes the result.
    pub time: Duration,
    /// Memory, in bytes.
    pub memory: u64,
    /// When an atlas is drawn.
    pub pictures: Pictures,
}

impl Contained {
    /// Does what a job of this kind does. The n-th file that it makes is left in `folder`, which
    /// exists and is empty, as [`output_file`](unwrapd_api::output_file)`(n)`. Dropped before its end, it
    /// kills the child.
    ///
    /// # Errors
    /// What the computation says of the input and the options, or why it could not say anything.
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

/// Waits until a child that works in `folder` has done its work. After a time it is ended, and the failure is `late`.
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

/// The mesh first, then what it refers to.
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
