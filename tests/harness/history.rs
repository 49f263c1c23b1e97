//! Every version of every row, as PostgreSQL itself writes it down.

use std::collections::BTreeMap;

use serde::Deserialize;
use serde_json::Value;

use super::postgres::Postgres;

pub const DATABASE: &str = "unwrapd";

const TRIGGER: &str = "
    CREATE TABLE history (n BIGSERIAL PRIMARY KEY, op TEXT NOT NULL, job JSONB NOT NULL);
    CREATE FUNCTION remember() RETURNS trigger LANGUAGE plpgsql AS $$
    BEGIN
        IF TG_OP = 'DELETE' THEN
            INSERT INTO history (op, job) VALUES (TG_OP, to_jsonb(OLD));
        ELSE
            INSERT INTO history (op, job) VALUES (TG_OP, to_jsonb(NEW));
        END IF;
        RETURN NULL;
    END $$;
    CREATE TRIGGER remember AFTER INSERT OR UPDATE OR DELETE ON job
        FOR EACH ROW EXECUTE FUNCTION remember();";

/// A row as it was.
#[derive(Clone, Debug, PartialEq)]
pub struct Version {
    pub op: String,
    pub row: Row,
    /// All of it.
    whole: Value,
}

/// What is judged of a row.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct Row {
    pub id: String,
    pub state: String,
    pub attempt: u64,
    pub token: u64,
    pub worker: Option<String>,
    pub lost: u64,
    /// A program of an earlier version does not count it.
    #[serde(default)]
    pub interrupted: u64,
    pub input: String,
    pub output: String,
}

impl Row {
    /// Attempts that were lost, for whatever reason.
    pub fn losses(&self) -> u64 {
        self.lost + self.interrupted
    }

    fn is_final(&self) -> bool {
        ["succeeded", "failed", "cancelled"].contains(&&*self.state)
    }
}

/// From now on every version of a row is written down.
pub fn keep(postgres: &Postgres) {
    postgres.psql(DATABASE, TRIGGER);
}

/// The versions of each job, in their order.
pub fn read(postgres: &Postgres) -> BTreeMap<String, Vec<Version>> {
    let all = "SELECT json_build_array(op, job) FROM history ORDER BY n";
    let mut jobs: BTreeMap<String, Vec<Version>> = BTreeMap::new();
    for line in postgres.psql(DATABASE, all).lines() {
        let (op, whole): (String, Value) = serde_json::from_str(line).expect("a version");
        let row: Row = serde_json::from_value(whole.clone()).expect("a row");
        let versions = jobs.entry(row.id.clone()).or_default();
        versions.push(Version { op, row, whole });
    }
    jobs
}

/// What is wrong with the history of one job: each step is one that may happen, each token has one
/// holder, attempts and losses are counted one by one, and nothing follows the end.
pub fn faults(versions: &[Version]) -> Vec<String> {
    let mut faults = Vec::new();
    let mut holders: BTreeMap<u64, &str> = BTreeMap::new();
    let first = &versions[0];
    if (
        &*first.op,
        &*first.row.state,
        first.row.token,
        first.row.attempt,
    ) != ("INSERT", "queued", 0, 0)
    {
        faults.push(format!("begins with {first:?}"));
    }
    for pair in versions.windows(2) {
        let (before, after) = (&pair[0], &pair[1]);
        if !is_step(before, after) {
            faults.push(format!(
                "{:?} became {:?} by {}",
                before.row, after.row, after.op
            ));
        }
    }
    for version in versions {
        if let Some(worker) = &version.row.worker
            && *holders.entry(version.row.token).or_insert(worker) != worker
        {
            faults.push(format!("a second holder: {:?}", version.row));
        }
    }
    let claims = holders.len() as u64;
    let last = &versions[versions.len() - 1].row;
    if last.attempt != claims {
        faults.push(format!("{claims} claims, and {last:?}"));
    }
    faults
}

/// Whether a row is as it was, but for pictures that were drawn and their size. A newer program may have added columns.
fn is_unchanged(before: &Version, after: &Version) -> bool {
    let columns = before.whole.as_object().expect("a row").iter();
    let mut columns = columns.filter(|(name, _)| !["drawn", "bytes"].contains(&name.as_str()));
    columns.all(|(name, value)| after.whole.get(name) == Some(value))
}

/// Whether a row may become another one.
fn is_step(before: &Version, after: &Version) -> bool {
    let (a, b) = (&before.row, &after.row);
    if after.op == "DELETE" {
        return a.is_final() && is_unchanged(before, after);
    }
    // Who did not hear the answer says it again.
    if a.is_final() {
        return is_unchanged(before, after);
    }
    let is_loss = b.losses() == a.losses() + 1;
    match (&*a.state, &*b.state) {
        ("queued", "running") => {
            (b.token, b.attempt, b.losses()) == (a.token + 1, a.attempt + 1, a.losses())
                && b.worker.is_some()
        }
        ("running", "running") => {
            (b.token, b.attempt, b.losses(), &b.worker)
                == (a.token, a.attempt, a.losses(), &a.worker)
        }
        // Handed back, or lost as its holder says, or taken from its holder.
        ("running", "queued" | "failed") if b.worker.is_none() => {
            let is_taken = b.token == a.token + 1 && is_loss;
            let is_told = b.token == a.token && (is_loss || b.losses() == a.losses());
            b.attempt == a.attempt && (is_taken || is_told)
        }
        ("running", "succeeded") => {
            (b.token, b.attempt, b.losses()) == (a.token, a.attempt, a.losses())
                && b.worker.is_none()
        }
        _ => false,
    }
}
