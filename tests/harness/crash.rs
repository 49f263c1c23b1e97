//! A run of jobs during which something goes wrong again and again, at moments drawn from a seed.

use std::path::Path;
use std::time::{Duration, Instant};

use tokio::time::sleep;
use unwrapd::numerics::random::Random;

use super::SOON;
use super::client::Clients;
use super::fault::Fault;
use super::judge::{Judgment, judge};
use super::machines::Machines;

/// A run: what goes wrong how often, during how many jobs.
#[derive(Clone, Copy, Debug)]
pub struct Run {
    pub fault: Fault,
    pub jobs: usize,
    pub moments: usize,
    pub seed: u64,
    /// When jobs that have not ended are given up.
    pub patience: Duration,
}

/// All that took part in a run, afterward.
pub struct Done {
    pub machines: Machines,
    pub clients: Clients,
    /// How often something went wrong.
    pub happened: usize,
}

/// How a run went.
pub struct Judged {
    pub judgment: Judgment,
    pub happened: usize,
    pub took: Duration,
}

/// When something goes wrong: so long after so many jobs were accepted or seen to have ended,
/// together.
#[derive(Clone, Copy, Debug)]
struct Moment {
    events: usize,
    later: Duration,
}

/// The longest time after an event.
const LATER: f64 = 0.3;

impl Run {
    /// How it went; `None` where the fault cannot be made.
    pub async fn judged(&self, logs: Option<&Path>) -> Option<Judged> {
        let begin = Instant::now();
        let mut done = self.done(logs).await?;
        let judgment = judge(&mut done.machines, &done.clients, SOON).await;
        Some(Judged {
            judgment,
            happened: done.happened,
            took: begin.elapsed(),
        })
    }

    /// What there is when all jobs have ended, or patience has.
    pub async fn done(&self, logs: Option<&Path>) -> Option<Done> {
        let mut machines = Machines::start(self.fault, logs)?;
        let mut random = Random::new(self.seed);
        let moments = self.drawn(&mut random);
        let clients = Clients::new(self.jobs, random.bits());
        clients.tell(machines.addresses());
        let mut happened = 0;
        let faults = async {
            for moment in moments {
                clients.events(moment.events).await;
                sleep(moment.later).await;
                let has_happened = self.fault.happen(&mut machines, &mut random).await;
                happened += usize::from(has_happened);
                clients.tell(machines.addresses());
            }
        };
        let both = async { tokio::join!(clients.run(), faults) };
        let _ = tokio::time::timeout(self.patience, both).await;
        for clock in &machines.clocks {
            clock.set(0);
        }
        Some(Done {
            machines,
            clients,
            happened,
        })
    }

    /// The moments in their order. The last quarter of the run is left to what follows from them.
    fn drawn(&self, random: &mut Random) -> Vec<Moment> {
        let events = 2 * self.jobs * 3 / 4;
        let mut moments: Vec<Moment> = (0..self.moments)
            .map(|_| Moment {
                events: random.below(events.max(1)),
                later: Duration::from_secs_f64(LATER * random.unit()),
            })
            .collect();
        moments.sort_by_key(|moment| moment.events);
        moments
    }
}
