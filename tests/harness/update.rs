//! A rolling update: a newer program takes the place of each process, one after the other, while
//! jobs run.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use nix::sys::signal::Signal;
use tokio::time::sleep;

use super::client::Clients;
use super::judge::{Judgment, judge};
use super::machines::Machines;
use super::postgres::Postgres;
use super::process::Process;
use super::{SOON, history, program};

/// The order of the processes: each program answers while each works.
const TURNS: [usize; 5] = [2, 0, 3, 1, 4];
/// Workers before services: a program of the older ones fails jobs whose options it does not know.
const WORKERS_FIRST: [usize; 5] = [2, 3, 4, 0, 1];
/// What a newer program does to the database: columns, and a version that the older one has not
/// heard of.
const NEWER: &str = "
    ALTER TABLE job ADD COLUMN newer BIGINT NOT NULL DEFAULT 0;
    ALTER TABLE idempotency ADD COLUMN newer TEXT;
    ALTER TABLE expired ADD COLUMN newer TEXT;
    INSERT INTO _sqlx_migrations (version, description, success, checksum, execution_time)
        VALUES (1000, 'newer', true, '', 0);";
/// How long a worker is waited for to have a job in work.
const IDLE: Duration = Duration::from_secs(3);

/// An update during so many jobs.
#[derive(Clone, Debug)]
pub struct Update {
    /// The program that is replaced. Without one it is the same, and the database becomes that of
    /// a newer one while it is in use.
    pub older: Option<PathBuf>,
    /// Whether workers are replaced before services; otherwise they take turns.
    pub workers_first: bool,
    pub jobs: usize,
    pub seed: u64,
    /// When jobs that have not ended are given up.
    pub patience: Duration,
}

/// How an update went.
pub struct Updated {
    pub judgment: Judgment,
    /// Processes that were replaced, all told by SIGTERM.
    pub replaced: usize,
    /// Those of them that were workers with a job in work.
    pub interrupted: usize,
    /// Workers that held a job.
    pub holders: usize,
    /// Attempts that were lost.
    pub lost: u64,
    /// The longest time from SIGTERM to the end of a process.
    pub stop: Duration,
}

impl Update {
    /// How it goes.
    pub async fn judged(&self, logs: Option<&Path>) -> Updated {
        let older = self.older.clone().unwrap_or_else(program);
        let machines = Machines::of(&older, None, logs);
        let mut machines = machines.expect("no fault needs anything");
        let clients = Clients::new(self.jobs, self.seed);
        clients.tell(machines.addresses());
        let (mut replaced, mut interrupted, mut stop) = (0, 0, Duration::ZERO);
        let update = async {
            // Two events a job; the last seventh is left to the newer programs.
            let part = 2 * self.jobs / 7;
            clients.events(part).await;
            if self.older.is_none() {
                machines.postgres.psql("unwrapd", NEWER);
            }
            let order = if self.workers_first {
                WORKERS_FIRST
            } else {
                TURNS
            };
            for (place, index) in order.into_iter().enumerate() {
                clients.events((place + 2) * part).await;
                let process = &mut machines.processes[index];
                interrupted += usize::from(is_at_work(index, process).await);
                stop = stop.max(stopped(process));
                process.restart_as(&program());
                clients.tell(machines.addresses());
                replaced += 1;
            }
        };
        let both = async { tokio::join!(clients.run(), update) };
        let _ = tokio::time::timeout(self.patience, both).await;
        let (holders, lost) = held(&machines.postgres);
        Updated {
            judgment: judge(&mut machines, &clients, SOON).await,
            replaced,
            interrupted,
            holders,
            lost,
            stop,
        }
    }
}

/// Waits a while for a worker to have a job in work; whether it has.
async fn is_at_work(index: usize, process: &Process) -> bool {
    let begin = Instant::now();
    while Machines::WORKERS.contains(&index) && begin.elapsed() < IDLE {
        if !process.children().is_empty() {
            return true;
        }
        sleep(Duration::from_millis(1)).await;
    }
    false
}

/// Tells a process to stop; how long it takes.
fn stopped(process: &mut Process) -> Duration {
    let begin = Instant::now();
    process.signal(Signal::SIGTERM);
    process.stopped();
    begin.elapsed()
}

/// How many workers held jobs, and how many attempts were lost.
fn held(postgres: &Postgres) -> (usize, u64) {
    let history = history::read(postgres);
    let versions = || history.values().flatten();
    let mut holders: Vec<_> = versions().filter_map(|it| it.row.worker.as_ref()).collect();
    holders.sort();
    holders.dedup();
    let last = history.values().filter_map(|versions| versions.last());
    (holders.len(), last.map(|it| it.row.losses()).sum())
}
