//! What the server and its child write for each other.
//!
//! The server writes `job.json` ([`Task`]) and the input files into the attempt's folder. The child answers with one
//! JSON line per [`Message`] on standard output, and leaves either `outcome.json` ([`Outcome`]), written last and
//! renamed into place, with the files that it lists, or `error.json` ([`crate::Failure`]).

use std::collections::BTreeMap;
use std::io::Write;
use std::path::Path;

use serde::{Deserialize, Serialize, de::DeserializeOwned};

use crate::{Kind, Limits, OutputFile, Progress, Upload, Verdict};

/// The file of a [`Task`].
pub const TASK: &str = "job.json";
/// The file of an [`Outcome`].
pub const OUTCOME: &str = "outcome.json";
/// The file of a [`Failure`](crate::Failure).
pub const ERROR: &str = "error.json";

/// Exit code of a child that has no space to write what it made. It may not even be able to say so in a file.
pub const NO_SPACE: i32 = 75;

/// Name of the n-th input file in the folder of an attempt.
pub fn input_file(index: usize) -> String {
    format!("input-{index}")
}

/// Name of the n-th output file in the folder of an attempt.
pub fn output_file(index: usize) -> String {
    format!("output-{index}")
}

/// What a child has to do and what it may use.
#[derive(Serialize, Deserialize)]
pub struct Task {
    /// What.
    pub kind: Kind,
    /// Names of the input files, the mesh first; the n-th lies in [`input_file`]`(n)`.
    pub input: Vec<String>,
    /// Its options, complete.
    pub options: serde_json::Value,
    /// What it may use.
    pub limits: Limits,
    /// Bytes.
    pub memory: u64,
    /// When an atlas is drawn.
    pub pictures: Pictures,
}

/// When the layout and the distortion of an atlas are drawn. For a small mesh that takes longer than unwrapping it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Pictures {
    /// With the atlas.
    Drawn,
    /// When somebody asks for them, which may also ask for the UVs as arrays: these are made with the atlas.
    OnRequest,
    /// Never.
    LeftOut,
}

/// One line of a child's standard output.
#[derive(Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Message {
    /// Signals are understood from now on.
    Ready,
    /// How far it is.
    Progress(Progress),
    /// Milliseconds of processor time that it took in all.
    Cpu(u64),
    /// A frame of maps that was asked for is in the folder, see `map_frame.rs`.
    Maps,
}

impl Message {
    /// Writes one line to the server. Nobody listens any more if this fails: there is no reason to go on.
    pub fn tell(&self) {
        let mut line = serde_json::to_vec(self).unwrap_or_default();
        line.push(b'\n');
        let mut out = std::io::stdout().lock();
        if out.write_all(&line).and_then(|()| out.flush()).is_err() {
            std::process::exit(1);
        }
    }
}

/// What a child made; the n-th file lies in [`output_file`]`(n)`.
#[derive(Serialize, Deserialize)]
pub struct Outcome {
    /// The files.
    pub output: Vec<OutputFile>,
    /// What is known of them.
    pub verdict: Verdict,
}

/// Writes JSON so that a reader sees all of it or nothing.
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

/// Reads what [`write_json`] wrote.
pub fn read_json<T: DeserializeOwned>(folder: &Path, name: &str) -> std::io::Result<T> {
    Ok(serde_json::from_slice(&std::fs::read(folder.join(name))?)?)
}
