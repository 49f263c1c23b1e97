//! Processes within the test, each with a runtime of its own, that can die at a call of a store.

use std::sync::Arc;

use futures_util::TryStreamExt;
use tempfile::TempDir;
use tokio::runtime::Runtime;
use unwrapd::jobs::access::{Owner, Visibility};
use unwrapd::jobs::{
    Blobs, Ended, Handling, Job, JobId, Jobs, Listing, State, Submission, SubmitError, Submitted,
};
use unwrapd_api::{InputFile, Kind};
use unwrapd_worker::Work;

use super::faulty::Fault;
use crate::harness::SOON;
use crate::meshes;

/// A process. It dies without a word, with all that it was doing, when this is dropped.
pub struct Process {
    runtime: Option<Runtime>,
    jobs: Option<Arc<Jobs>>,
    blobs: Box<dyn Blobs>,
    files: TempDir,
}

impl Process {
    /// One with a runtime of its own, in which its queue is at work.
    pub fn new(runtime: Runtime, jobs: Arc<Jobs>, blobs: Box<dyn Blobs>, files: TempDir) -> Self {
        Self {
            runtime: Some(runtime),
            jobs: Some(jobs),
            blobs,
            files,
        }
    }

    fn runtime(&self) -> &Runtime {
        self.runtime.as_ref().expect("it lives")
    }

    pub fn jobs(&self) -> Arc<Jobs> {
        Arc::clone(self.jobs.as_ref().expect("it lives"))
    }

    /// Does something as this process.
    pub fn does<T>(&self, something: impl Future<Output = T>) -> T {
        self.runtime().block_on(something)
    }

    /// A mesh and what it refers to, under one key.
    fn submission(&self) -> Submission {
        let file = |name: &str, bytes: &[u8]| {
            let path = tempfile::NamedTempFile::new_in(self.files.path()).expect("a file");
            std::fs::write(path.path(), bytes).expect("a file");
            let file = InputFile {
                name: name.to_owned(),
                bytes: bytes.len() as u64,
                sha256: None,
            };
            (file, path.into_temp_path().keep().expect("a file"))
        };
        let options = Work::new(Kind::Unwrap, serde_json::json!({ "cut": "disk" }));
        Submission {
            owner: Owner::anonymous(),
            kind: Kind::Unwrap,
            options: options.expect("options").into_options(),
            files: vec![file("mesh.glb", &meshes::hills(2)), file("more.bin", b"x")],
            digest: "always the same".to_owned(),
            handling: Handling::default(),
            trace: None,
            reuse: false,
            key: Some("night-run".to_owned()),
            ephemeral: false,
        }
    }

    /// Submits always the same.
    pub fn submit(&self) -> Result<Submitted, SubmitError> {
        self.does(self.jobs().submit(self.submission()))
    }

    /// Submits, and dies while it does, once the call that fails has come.
    pub fn die_submitting(self, fault: &Fault) {
        let (jobs, submission) = (self.jobs(), self.submission());
        self.die_doing(async move { jobs.submit(submission).await }, fault);
    }

    /// Begins something, and dies once the call that fails has come.
    pub fn die_doing<T: Send + 'static>(
        self,
        something: impl Future<Output = T> + Send + 'static,
        fault: &Fault,
    ) {
        self.runtime().spawn(something);
        self.die_at(fault);
    }

    /// Dies once the call that fails has come.
    pub fn die_at(self, fault: &Fault) {
        let reached = async { tokio::time::timeout(SOON, fault.reached.notified()).await };
        let reached = self.does(reached);
        reached.expect("it comes");
        drop(self);
    }

    /// A new job.
    pub fn accepted(&self) -> JobId {
        match self.submit().expect("it is accepted") {
            Submitted::New(job) => job.id,
            Submitted::Replay(job) => panic!("there was {job:?}"),
        }
    }

    /// The only job, after its end.
    pub fn ended(&self, id: JobId) -> Job {
        let ended = self.does(self.jobs().wait(&Visibility::All, id, SOON));
        match ended.expect("an answer") {
            Some(Ended::Yes(job)) => job,
            other => panic!("it does not end: {other:?}"),
        }
    }

    /// The job after its end; it succeeded, and its files are whole.
    pub fn succeeded(&self, id: JobId) -> Job {
        let job = self.ended(id);
        assert_eq!(job.state, State::Succeeded, "{job:?}");
        assert!(!job.output.is_empty());
        for file in &job.output {
            let content = self.does(async {
                let content = self.jobs().read(&job, file, 0..file.bytes).await;
                content.expect("a file").try_collect::<Vec<_>>().await
            });
            let content = content.expect("the whole file").concat();
            assert_eq!(content.len() as u64, file.bytes);
        }
        job
    }

    /// Every job there is.
    pub fn all(&self) -> Vec<JobId> {
        let listing = Listing {
            limit: 10,
            ..Listing::default()
        };
        let list = self.does(self.jobs().list(&Visibility::All, &listing));
        let list = list.expect("an answer");
        list.iter().map(|job| job.id).collect()
    }

    /// The jobs that have files.
    pub fn owners(&self) -> Vec<JobId> {
        let owners = self.does(self.blobs.owners());
        owners.expect("an answer")
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        let runtime = self.runtime.take().expect("it lives");
        let handle = runtime.handle().clone();
        runtime.shutdown_timeout(SOON);
        // Connections look for their runtime once more.
        let _within = handle.enter();
        self.jobs = None;
    }
}
