//! Where records and files of processes within the test lie, and how these are started there.

use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use tempfile::TempDir;
use tokio::runtime::Runtime;
use tokio_util::sync::CancellationToken;
use unwrapd::jobs::{Blobs, Deployment, Jobs, OwnerQuotas, Rules, Settings};
use unwrapd::store::{FileBlobs, ObjectBlobs, RecordStore};

use super::faulty::{Fault, Faulty};
use super::processes::Process;
use crate::harness::postgres::Postgres;
use crate::harness::s3::{S3, URL};
use crate::harness::{SOON, program};

const RULES: Rules = Rules {
    lease: Duration::from_secs(2),
    attempts: 3,
    interruptions: 5,
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

    fn deployment(&self) -> Deployment {
        if self.is_shared() {
            Deployment::Shared
        } else {
            Deployment::Embedded
        }
    }

    fn database(&self) -> String {
        match &self.shared {
            Some(shared) => shared.database.clone(),
            None => format!("sqlite://{}/jobs?mode=rwc", self.folder.path().display()),
        }
    }

    fn blobs(&self) -> Box<dyn Blobs> {
        if let Some(shared) = &self.shared {
            let settings = shared.settings.iter().cloned();
            Box::new(ObjectBlobs::open(&shared.files, settings).expect("a bucket"))
        } else {
            let folder = self.folder.path().join("blobs");
            Box::new(FileBlobs::open(&folder).expect("a folder"))
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
        let settings = settings(self.deployment(), scratch.path().to_owned(), workers);
        let jobs = Arc::new(Jobs::new(settings, Arc::new(store), Arc::new(blobs)));
        runtime.block_on(jobs.recover()).expect("order");
        runtime.spawn(Arc::clone(&jobs).run(CancellationToken::new()));
        Process::new(runtime, jobs, self.blobs(), scratch)
    }
}

fn settings(deployment: Deployment, scratch: PathBuf, workers: usize) -> Settings {
    Settings {
        catalog: &unwrapd_worker::Computations,
        deployment,
        rules: RULES,
        scratch,
        program: program().into(),
        workers,
        cores: 1,
        owner_running: None,
        small: None,
        of_owner: OwnerQuotas::default(),
        queue_depth: 100,
        time: SOON,
        memory: 1 << 30,
        triangles: 1000,
        quota: None,
        min_free: 0,
        retention: Some(Duration::from_hours(1)),
        quarantine: Duration::ZERO,
        grace: Duration::ZERO,
    }
}
