//! Two services that only answer, three workers, a PostgreSQL and an S3 server, with what it takes
//! to do them harm.

use std::fs::File;
use std::path::Path;

use tempfile::TempDir;

use super::clock::Clock;
use super::disk::Disk;
use super::fault::Fault;
use super::history;
use super::postgres::Postgres;
use super::process::{Process, Role};
use super::program;
use super::proxy::Proxy;
use super::s3::S3;

/// A worker is taken for lost after this many seconds.
pub const LEASE: &str = "3";
const ROLES: [Role; 5] = [
    Role::Serve,
    Role::Serve,
    Role::Worker,
    Role::Worker,
    Role::Worker,
];
/// Of the disk of a process, and of that of the files: two thirds of a megabyte for each job.
const MEGABYTES: u32 = 24;
const FILES_MEGABYTES: u32 = 256;

/// The ways of one process to what all share.
pub struct Links {
    pub database: Proxy,
    pub files: Proxy,
}

/// All of them. The first two processes answer, the others work.
pub struct Machines {
    pub processes: Vec<Process>,
    pub postgres: Postgres,
    pub s3: S3,
    /// Of the processes, if connections are to be cut.
    pub links: Vec<Links>,
    /// Of the processes and of the database, if clocks are to jump.
    pub clocks: Vec<Clock>,
    /// Of the processes and of the files, if disks are to be filled. They go last.
    pub disks: Vec<Disk>,
}

impl Machines {
    /// Starts them in order for a fault; `None` where that one cannot be made. Each process tells
    /// what it does to a file in `logs`, if there is that folder.
    pub fn start(fault: Fault, logs: Option<&Path>) -> Option<Self> {
        Self::of(&program(), Some(fault), logs)
    }

    /// The same with processes of this program, for a fault or none.
    pub fn of(program: &Path, fault: Option<Fault>, logs: Option<&Path>) -> Option<Self> {
        let disks = match fault {
            Some(Fault::Disk) => {
                let sizes = ROLES.map(|_| MEGABYTES).into_iter();
                let disks = sizes.chain([FILES_MEGABYTES]).map(Disk::mount);
                disks.collect::<Option<_>>()?
            }
            _ => Vec::new(),
        };
        let clocks: Vec<Clock> = match fault {
            Some(Fault::Clock) => (0..=ROLES.len()).map(|_| Clock::ahead(0)).collect(),
            _ => Vec::new(),
        };
        let folder = |index: usize| match disks.get(index) {
            Some(disk) => TempDir::new_in(disk.folder()).expect("a folder"),
            None => tempfile::tempdir().expect("a folder"),
        };
        let clock = |index: usize| clocks.get(index).map_or_else(Vec::new, Clock::settings);
        let postgres = Postgres::with(clock(ROLES.len()));
        postgres.database("unwrapd");
        let s3 = S3::on(folder(ROLES.len()), &[]);
        let links: Vec<Links> = match fault {
            Some(Fault::Network) => ROLES.map(|_| Links::to(&postgres, &s3)).into(),
            _ => Vec::new(),
        };
        let processes = ROLES.iter().enumerate().map(|(index, &role)| {
            let ports = links
                .get(index)
                .map_or((postgres.port(), s3.port()), |links| {
                    (links.database.port(), links.files.port())
                });
            let mut settings = settings(role, &s3, ports);
            settings.extend(clock(index));
            let log = logs.map(|logs| logs.join(format!("{index}.log")));
            let log = log.map(|log| File::create(log).expect("a file"));
            Process::of(program, role, folder(index), &settings, log)
        });
        let processes = processes.collect();
        history::keep(&postgres);
        Some(Self {
            processes,
            postgres,
            s3,
            links,
            clocks,
            disks,
        })
    }

    /// The places of those that answer, and of those that work.
    pub const APIS: [usize; 2] = [0, 1];
    pub const WORKERS: [usize; 3] = [2, 3, 4];

    /// Where the services answer now.
    pub fn addresses(&self) -> Vec<String> {
        let apis = self.processes[..Self::APIS.len()].iter();
        apis.map(|api| api.address().to_owned()).collect()
    }

    /// Another service on the same, by a clock that is this far ahead, as is that of the files.
    pub fn api_ahead(&mut self, clock: &Clock) -> Process {
        self.s3.kill();
        self.s3.restart_with(&clock.settings());
        let ports = (self.postgres.port(), self.s3.port());
        let mut settings = settings(Role::Serve, &self.s3, ports);
        settings.extend(clock.settings());
        Process::start(
            Role::Serve,
            tempfile::tempdir().expect("a folder"),
            &settings,
        )
    }
}

impl Links {
    fn to(postgres: &Postgres, s3: &S3) -> Self {
        Self {
            database: Proxy::to(postgres.port()),
            files: Proxy::to(s3.port()),
        }
    }
}

/// What a process is told, with the ports at which it finds database and files.
fn settings(role: Role, s3: &S3, (database, files): (u16, u16)) -> Vec<(String, String)> {
    let mut settings = s3.settings();
    let mut set = |name: &str, value: String| settings.push((name.to_owned(), value));
    set(
        "UNWRAPD_DATABASE_URL",
        format!("postgres://unwrapd@127.0.0.1:{database}/unwrapd"),
    );
    set("AWS_ENDPOINT_URL", format!("http://127.0.0.1:{files}"));
    set("UNWRAPD_LEASE_SECONDS", LEASE.to_owned());
    set("UNWRAPD_MIN_FREE_MIB", "2".to_owned());
    if role == Role::Serve {
        set("UNWRAPD_WORKERS", "0".to_owned());
    }
    settings
}
