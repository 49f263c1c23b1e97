//! Messages between the server and its child.
//!
//! The server writes `job.json` ([`Task`]) and the input files into the attempt's folder. The child answers with one
//! JSON line per [`Message`] on standard output, and leaves either `outcome.json` ([`Outcome`]), written last and
//! renamed into place, with the files that it lists, or `error.json` ([`crate::Failure`]).

use std::collections::BTreeMap;
use std::io::Write;
use std::path::Path;

use serde::{Deserialize, Serialize, de::DeserializeOwned};

use crate::{Kind, Limits, OutputFile, Progress, Upload, Verdict};

/// Name of the file with a [`Task`].
pub const TASK: &str = "job.json";
/// Name of the file with an [`Outcome`].
pub const OUTCOME: &str = "outcome.json";
/// Name of the file with a [`Failure`](crate::Failure).
pub const ERROR: &str = "error.json";

/// Exit code of a child without space for its output, which may be unable to write a file that says so. The number is
/// that of `EX_TEMPFAIL` in sysexits.h.
pub const NO_SPACE: i32 = 75;

/// Returns the name of the n-th input file in the folder of an attempt.
pub fn input_file(index: usize) -> String {
    format!("input-{index}")
}

/// Returns the name of the n-th output file in the folder of an attempt.
pub fn output_file(index: usize) -> String {
    format!("output-{index}")
}

/// Task of a child and its limits.
#[derive(Serialize, Deserialize)]
pub struct Task {
    /// Kind of the computation.
    pub kind: Kind,
    /// Names of the input files, the mesh first; the n-th lies in [`input_file`]`(n)`.
    pub input: Vec<String>,
    /// Options of its kind, complete with defaults.
    pub options: serde_json::Value,
    /// Limits of the computation.
    pub limits: Limits,
    /// Memory limit in bytes.
    pub memory: u64,
    /// Time at which the pictures of an atlas are drawn.
    pub pictures: Pictures,
}

/// Time at which the layout and the distortion of an atlas are drawn. For a small mesh, drawing takes longer than
/// unwrapping.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Pictures {
    /// With the atlas.
    Drawn,
    /// On request. The UVs as arrays, which may be requested too, are made with the atlas.
    OnRequest,
    /// Never.
    LeftOut,
}

/// One line of a child's standard output.
#[derive(Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Message {
    /// The child handles signals from now on.
    Ready,
    /// Progress of the computation.
    Progress(Progress),
    /// Total processor time used, in milliseconds.
    Cpu(u64),
    /// A requested frame of maps is in the folder; see `map_frame.rs`.
    Maps,
}

impl Message {
    /// Writes the message as one line to the server. Exits if that fails, because nobody listens any more.
    pub fn tell(&self) {
        let mut line = serde_json::to_vec(self).unwrap_or_default();
        line.push(b'\n');
        let mut out = std::io::stdout().lock();
        if out.write_all(&line).and_then(|()| out.flush()).is_err() {
            std::process::exit(1);
        }
    }
}

/// Result of a child; the n-th file lies in [`output_file`]`(n)`.
#[derive(Serialize, Deserialize)]
pub struct Outcome {
    /// Output files.
    pub output: Vec<OutputFile>,
    /// Verdict on the files.
    pub verdict: Verdict,
}

/// Writes JSON atomically: a reader sees all of it or nothing.
pub fn write_json<T: Serialize>(folder: &Path, name: &str, value: &T) -> std::io::Result<()> {
    let partial = folder.join(format!("{name}.partial"));
    std::fs::write(&partial, serde_json::to_vec(value)?)?;
    std::fs::rename(&partial, folder.join(name))
}

/// Reads the input files with these names, the mesh first.
pub fn read_upload(folder: &Path, names: &[String]) -> std::io::Result<Upload> {
    let mut files = Vec::new();
    for (index, name) in names.iter().enumerate() {
        files.push((name.clone(), std::fs::read(folder.join(input_file(index)))?));
    }
    let (name, bytes) = files.remove(0);
    let resources: BTreeMap<_, _> = files.into_iter().collect();
    Ok(Upload {
        name,
        bytes,
        resources,
    })
}

/// Reads JSON that [`write_json`] wrote.
pub fn read_json<T: DeserializeOwned>(folder: &Path, name: &str) -> std::io::Result<T> {
    Ok(serde_json::from_slice(&std::fs::read(folder.join(name))?)?)
}
