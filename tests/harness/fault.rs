//! The nine faults, each for as long as is drawn.

use std::str::FromStr;
use std::time::Duration;

use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;
use tokio::time::{Instant, sleep};
use unwrapd::numerics::random::Random;

use super::machines::Machines;
use super::proxy::{Cut, Proxy};

/// What goes wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// A service is killed.
    Api,
    /// A worker is killed.
    Worker,
    /// A compute child is killed.
    Child,
    /// The database is killed.
    Database,
    /// The server of the files is killed.
    Store,
    /// The server of the files is stopped.
    StoreStopped,
    /// The disk of a process or of the files is full.
    Disk,
    /// The ways of a process or of all are cut, to the database, to the files, or both.
    Network,
    /// The clock of a process or of the database jumps by up to an hour, there or back.
    Clock,
}

const NAMES: [(&str, Fault); 9] = [
    ("api", Fault::Api),
    ("worker", Fault::Worker),
    ("child", Fault::Child),
    ("database", Fault::Database),
    ("store", Fault::Store),
    ("store-stopped", Fault::StoreStopped),
    ("disk", Fault::Disk),
    ("network", Fault::Network),
    ("clock", Fault::Clock),
];

/// How far a clock jumps, in seconds.
const JUMP: f64 = 3600.0;
/// How long a child is waited for that can be killed.
const IDLE: Duration = Duration::from_secs(3);

impl Fault {
    /// All, in their order.
    pub fn all() -> impl Iterator<Item = Self> {
        NAMES.iter().map(|(_, fault)| *fault)
    }

    pub fn name(self) -> &'static str {
        let named = NAMES.iter().find(|(_, fault)| *fault == self);
        named.expect("all have names").0
    }

    /// Lets it happen and pass; whether it could.
    pub async fn happen(self, machines: &mut Machines, random: &mut Random) -> bool {
        match self {
            Self::Api => replace(machines, &Machines::APIS, random).await,
            Self::Worker => replace(machines, &Machines::WORKERS, random).await,
            Self::Child => return kill_child(machines, random).await,
            Self::Database => {
                machines.postgres.kill();
                sleep(drawn(0.0, 4.0, random)).await;
                machines.postgres.restart();
            }
            Self::Store => {
                machines.s3.kill();
                sleep(drawn(0.0, 4.0, random)).await;
                machines.s3.restart();
            }
            Self::StoreStopped => {
                machines.s3.signal(Signal::SIGSTOP);
                sleep(drawn(0.2, 6.0, random)).await;
                machines.s3.signal(Signal::SIGCONT);
            }
            Self::Disk => {
                let disk = &machines.disks[random.below(machines.disks.len())];
                disk.fill();
                sleep(drawn(0.2, 4.0, random)).await;
                disk.free();
            }
            Self::Network => cut(machines, random).await,
            Self::Clock => {
                let clock = &machines.clocks[random.below(machines.clocks.len())];
                clock.set((JUMP * (2.0 * random.unit() - 1.0)) as i64);
            }
        }
        true
    }
}

impl FromStr for Fault {
    type Err = String;

    fn from_str(name: &str) -> Result<Self, Self::Err> {
        let named = NAMES.iter().find(|(known, _)| *known == name);
        named.map(|(_, fault)| *fault).ok_or_else(|| {
            let names: Vec<&str> = NAMES.iter().map(|(name, _)| *name).collect();
            format!("there is no fault {name}; there are {}", names.join(", "))
        })
    }
}

/// So many seconds.
fn drawn(least: f64, most: f64, random: &mut Random) -> Duration {
    Duration::from_secs_f64(least + (most - least) * random.unit())
}

/// Kills one of these, and starts it again after a while.
async fn replace(machines: &mut Machines, those: &[usize], random: &mut Random) {
    let process = &mut machines.processes[those[random.below(those.len())]];
    process.kill();
    sleep(drawn(0.0, 2.0, random)).await;
    process.restart();
}

/// Kills one that computes, as soon as there is one; whether there was.
async fn kill_child(machines: &Machines, random: &mut Random) -> bool {
    let begin = Instant::now();
    while begin.elapsed() < IDLE {
        let workers = Machines::WORKERS.iter();
        let children: Vec<i32> = workers
            .flat_map(|&worker| machines.processes[worker].children())
            .collect();
        if !children.is_empty() {
            let child = Pid::from_raw(children[random.below(children.len())]);
            if kill(child, Signal::SIGKILL).is_ok() {
                return true;
            }
        }
        sleep(Duration::from_millis(1)).await;
    }
    false
}

/// Cuts ways, and mends them after a while that may be longer than a lease.
async fn cut(machines: &Machines, random: &mut Random) {
    let how = [Cut::Reset, Cut::Silent][random.below(2)];
    let links = &machines.links[..];
    // Of all at once, or of one.
    let one = random.below(2 * links.len());
    let meant = links.get(one..=one).unwrap_or(links);
    let (database, files) = [(true, true), (true, false), (false, true)][random.below(3)];
    let each = || {
        let ways = meant.iter().flat_map(|links| {
            [
                database.then_some(&links.database),
                files.then_some(&links.files),
            ]
        });
        ways.flatten()
    };
    each().for_each(|way| way.cut(how));
    sleep(drawn(0.2, 6.0, random)).await;
    each().for_each(Proxy::mend);
}
