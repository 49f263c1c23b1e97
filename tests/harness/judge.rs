//! What became of the jobs of a run: judged by the clients' own list of what was accepted, by the
//! history of the rows, and by the files. The counters of the service are not asked.

use std::collections::{BTreeMap, BTreeSet};
use std::process::Command;
use std::time::{Duration, Instant};

use serde_json::Value;

use super::client::{Accepted, Clients, Seen, sha256};
use super::clock::Clock;
use super::history::{self, Version};
use super::machines::Machines;
use super::program;

/// Files without a row go into quarantine when their job would be this old. Those of a submission
/// under way do not.
const AHEAD_SECONDS: i64 = 25 * 3600;

/// Everything that is wrong, a line each.
#[derive(Debug, Default)]
pub struct Judgment {
    /// Accepted, and did not succeed with whole files.
    pub lost: Vec<String>,
    /// Done twice with effect: a row or files that changed after the end, a step of a row that may
    /// not be, two jobs of one submission.
    pub twice: Vec<String>,
    /// Compute children, folders of attempts, or files of no job that are left.
    pub orphans: Vec<String>,
    /// Results whose UVs are not proven, not those of the mesh that was sent, or that came too late for their client.
    pub unverified: Vec<String>,
}

impl Judgment {
    /// Numbers of lost, twice, orphans and unverified.
    pub fn counts(&self) -> [usize; 4] {
        self.all().map(|(_, faults)| faults.len())
    }

    /// What is wrong, by its name.
    pub fn all(&self) -> [(&'static str, &[String]); 4] {
        [
            ("lost", &self.lost),
            ("twice", &self.twice),
            ("orphan", &self.orphans),
            ("unverified", &self.unverified),
        ]
    }
}

/// Judges a run that is over, and then removes its jobs. What should go is waited for this long.
pub async fn judge(machines: &mut Machines, clients: &Clients, patience: Duration) -> Judgment {
    let mut judgment = Judgment::default();
    judgment.left_by_processes(machines, patience).await;
    let accepted = clients.accepted();
    let history = history::read(&machines.postgres);
    for job in &accepted {
        let versions = history.get(&job.id).map_or(&[][..], Vec::as_slice);
        judgment.job(job, versions, clients).await;
    }
    judgment.list(&accepted, &history);
    for job in &accepted {
        if !clients.delete(&job.id).await {
            judgment.orphans.push(format!("{} is not deleted", job.id));
        }
    }
    judgment.left_in_store(machines, patience).await;
    // What was deleted stays so, and was not changed before.
    for (id, versions) in history::read(&machines.postgres) {
        let faults = history::faults(&versions);
        judgment
            .twice
            .extend(faults.iter().map(|fault| format!("{id}: {fault}")));
    }
    judgment
}

impl Judgment {
    /// Children and folders: both go when attempts end, those of killed processes when these start
    /// again.
    async fn left_by_processes(&mut self, machines: &Machines, patience: Duration) {
        let left = || {
            let each = machines.processes.iter().enumerate();
            each.flat_map(|(index, process)| {
                let children = process.children().into_iter();
                let children = children.map(|child| format!("child {child}"));
                let left = children.chain(process.scratch());
                left.map(move |what| format!("process {index}: {what}"))
            })
        };
        within(patience, || left().next().is_none()).await;
        self.orphans.extend(left());
    }

    async fn job(&mut self, accepted: &Accepted, versions: &[Version], clients: &Clients) {
        let Accepted { number, id } = accepted;
        let mesh = clients.mesh(*number);
        let (Some(last), Some(now)) = (versions.last(), clients.look(id).await) else {
            self.lost.push(format!("{id} is not there"));
            return;
        };
        let (row, state) = (&last.row, &now.job["state"]);
        if row.state != "succeeded" || *state != "succeeded" {
            let error = &now.job["error"];
            self.lost.push(format!("{id} is {state}: {error}; {row:?}"));
            return;
        }
        let input: Value = serde_json::from_str(&row.input).expect("files");
        if input[0]["sha256"] != *sha256(&mesh) {
            self.lost.push(format!("{id} is of another input"));
        }
        let output: Vec<Value> = serde_json::from_str(&row.output).expect("files");
        for file in &output {
            let role = file["role"].as_str().expect("a role");
            let bytes = now.files.get(role);
            if bytes.is_none_or(|bytes| file["sha256"] != *sha256(bytes)) {
                self.lost.push(format!("{id} has no whole {role}"));
            }
        }
        match clients.ended(id) {
            Some(seen) if seen.is_still(&now) => {}
            Some(_) => self.twice.push(format!("{id} changed after its end")),
            None => (self.unverified).push(format!("{id} ended after its client gave up")),
        }
        if let Err(why) = verified(&now, clients.triangles(*number)) {
            self.unverified.push(format!("{id}: {why}"));
        }
    }

    /// Every submission made one job, and there are no others.
    fn list(&mut self, accepted: &[Accepted], history: &BTreeMap<String, Vec<Version>>) {
        let mut ids: BTreeMap<usize, BTreeSet<&str>> = BTreeMap::new();
        for job in accepted {
            ids.entry(job.number).or_default().insert(&job.id);
        }
        for (number, ids) in &ids {
            if ids.len() > 1 {
                self.twice.push(format!("submission {number} made {ids:?}"));
            }
        }
        let known: BTreeSet<&str> = ids.into_values().flatten().collect();
        for id in history.keys().filter(|id| !known.contains(&***id)) {
            self.twice.push(format!("{id}, of which no client knows"));
        }
    }

    /// Files whose jobs were never recorded are in quarantine when a service looks for them that
    /// starts a day later; those of others went with their jobs.
    async fn left_in_store(&mut self, machines: &mut Machines, patience: Duration) {
        let clock = Clock::ahead(AHEAD_SECONDS);
        let _later = machines.api_ahead(&clock);
        let left = || {
            let held = "SELECT job FROM quarantine";
            let held = machines.postgres.psql(history::DATABASE, held);
            let held: BTreeSet<&str> = held.lines().collect();
            let mut left = machines.s3.objects();
            left.retain(|key| !held.contains(key.split('/').next().unwrap_or_default()));
            left
        };
        within(patience, || left().is_empty()).await;
        self.orphans.extend(left());
    }
}

/// Whether the result has so many triangles, and its UVs are proven, by what was downloaded alone.
fn verified(seen: &Seen, triangles: u32) -> Result<(), String> {
    let report = seen.files.get("report").ok_or("no report")?;
    let report: Value = serde_json::from_slice(report).map_err(|error| error.to_string())?;
    if seen.job["certified"] != true || report["certified"] != true {
        return Err("it is not certified".to_owned());
    }
    let result = seen.files.get("result").ok_or("no result")?;
    let file = tempfile::Builder::new().suffix(".glb").tempfile();
    let file = file.expect("a file");
    std::fs::write(file.path(), result).expect("a file");
    let verify = Command::new(program())
        .arg("verify")
        .arg(file.path())
        .output();
    let verify = verify.expect("it runs");
    let said = String::from_utf8_lossy(&verify.stdout).into_owned();
    if verify.status.success() && said.contains(&format!(" {triangles} faces (0 exempt)")) {
        return Ok(());
    }
    Err(said)
}

/// Waits for something that is meant to happen; whoever asked looks whether it did.
async fn within(patience: Duration, happened: impl Fn() -> bool) {
    let begin = Instant::now();
    while !happened() && begin.elapsed() < patience {
        tokio::time::sleep(Duration::from_millis(20)).await;
    }
}
