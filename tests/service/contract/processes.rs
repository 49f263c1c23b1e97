//! Processes within the test, each with a runtime of its own, that share records and files and can
//! die at a call of a store.

use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use futures_util::TryStreamExt;
use tempfile::TempDir;
use tokio::runtime::Runtime;
use tokio_util::sync::CancellationToken;
use unwrapd::jobs::{
    Blobs, Deployment, Ended, InputFile, Job, JobId, Jobs, Kind, Listing, Rules, Settings, State,
    Submission, SubmitError, Submitted, Work,
};
use unwrapd::store::{FileBlobs, ObjectBlobs, RecordStore};

use super::faulty::{Fault, Faulty};
use crate::harness::postgres::Postgres;
use crate::harness::s3::{S3, URL};
use crate::harness::{SOON, program};
use crate::meshes;

const RULES: Rules = Rules {
    lease: Duration::from_secs(2),
    attempts: 3,
    pause: Duration::from_millis(50),
};

/// Servers of records and files.
pub struct Servers {
    pub postgres: Postgres,
    pub s3: S3,
}

/// Records and files, in a folder or on servers.
pub struct Place {
    folder: TempDir,
    shared: Option<Shared>,
}

/// A database of its own, and files below a prefix of its own.
struct Shared {
    database: String,
    files: String,
    settings: Vec<(String, String)>,
}

impl Place {
    /// SQLite and a folder.
    pub fn alone() -> Self {
        Self {
            folder: tempfile::tempdir().expect("a folder"),
            shared: None,
        }
    }

    /// PostgreSQL and S3, of which others have another part.
    pub fn shared(servers: &Servers, part: usize) -> Self {
        let shared = Shared {
            database: servers.postgres.database(&format!("part{part}")),
            files: format!("{URL}/part{part}"),
            settings: servers.s3.settings(),
        };
        Self {
            shared: Some(shared),
            ..Self::alone()
        }
    }

    pub fn is_shared(&self) -> bool {
        self.shared.is_some()
    }

    fn database(&self) -> String {
        match &self.shared {
            Some(shared) => shared.database.clone(),
            None => format!("sqlite://{}/jobs?mode=rwc", self.folder.path().display()),
        }
    }

    fn blobs(&self) -> Box<dyn Blobs> {
        match &self.shared {
            Some(shared) => {
                let settings = shared.settings.iter().cloned();
                let blobs = ObjectBlobs::open(&shared.files, settings);
                Box::new(blobs.expect("a bucket"))
            }
            None => {
                let blobs = FileBlobs::open(&self.folder.path().join("blobs"));
                Box::new(blobs.expect("a folder"))
            }
        }
    }

    /// A process that works, or that only accepts jobs.
    pub fn start(&self, workers: usize, fault: &Arc<Fault>) -> Process {
        let runtime = Runtime::new().expect("threads");
        let scratch = TempDir::new_in(self.folder.path()).expect("a folder");
        let store = runtime.block_on(RecordStore::open(&self.database(), RULES));
        let store = Faulty {
            inner: store.expect("records"),
            fault: Arc::clone(fault),
        };
        let blobs = Faulty {
            inner: self.blobs(),
            fault: Arc::clone(fault),
        };
        let settings = settings(self.is_shared(), scratch.path().to_owned(), workers);
        let jobs = Arc::new(Jobs::new(settings, Arc::new(store), Arc::new(blobs)));
        runtime.block_on(jobs.recover()).expect("order");
        runtime.spawn(Arc::clone(&jobs).run(CancellationToken::new()));
        Process {
            runtime,
            jobs,
            blobs: self.blobs(),
            files: scratch,
        }
    }
}

fn settings(is_shared: bool, scratch: PathBuf, workers: usize) -> Settings {
    Settings {
        deployment: match is_shared {
            true => Deployment::Shared,
            false => Deployment::Embedded,
        },
        rules: RULES,
        scratch,
        program: program(),
        workers,
        threads: 1,
        queue_depth: 100,
        time: SOON,
        memory: 1 << 30,
        triangles: 1000,
        quota: None,
        min_free: 0,
        retention: Some(Duration::from_hours(1)),
        grace: Duration::ZERO,
    }
}

/// A process.
pub struct Process {
    pub runtime: Runtime,
    pub jobs: Arc<Jobs>,
    blobs: Box<dyn Blobs>,
    files: TempDir,
}

impl Process {
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
            kind: Kind::Unwrap,
            options: options.expect("options").into_options(),
            files: vec![file("mesh.glb", &meshes::hills(2)), file("more.bin", b"x")],
            digest: "always the same".to_owned(),
            priority: 0,
            reuse: false,
            key: Some("night-run".to_owned()),
            ephemeral: false,
        }
    }

    /// Submits always the same.
    pub fn submit(&self) -> Result<Submitted, SubmitError> {
        self.runtime.block_on(self.jobs.submit(self.submission()))
    }

    /// Submits, and dies while it does, once the call that fails has come.
    pub fn die_submitting(self, fault: &Fault) {
        let submission = self.submission();
        let jobs = Arc::clone(&self.jobs);
        self.runtime
            .spawn(async move { jobs.submit(submission).await.map(drop) });
        self.die_at(fault);
    }

    /// Dies once the call that fails has come.
    pub fn die_at(self, fault: &Fault) {
        let reached = async { tokio::time::timeout(SOON, fault.reached.notified()).await };
        let reached = self.runtime.block_on(reached);
        reached.expect("it comes");
        self.runtime.shutdown_timeout(SOON);
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
        let ended = self.runtime.block_on(self.jobs.wait(id, SOON));
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
            let content = self.runtime.block_on(async {
                let content = self.jobs.read(&job, file, 0..file.bytes).await;
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
            state: None,
            before: None,
            limit: 10,
        };
        let list = self.runtime.block_on(self.jobs.list(listing));
        let list = list.expect("an answer");
        list.iter().map(|job| job.id).collect()
    }

    /// The jobs that have files.
    pub fn owners(&self) -> Vec<JobId> {
        let owners = self.runtime.block_on(self.blobs.owners());
        owners.expect("an answer")
    }
}
