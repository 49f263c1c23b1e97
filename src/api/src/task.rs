//! Messages between the server and its child.
//!
//! The server writes `job.json` ([`Task`]) and the input files into the attempt's folder. The child answers with one
//! JSON line per [`Message`] on standard output, and leaves either `outcome.json` ([`Outcome`]), written last and
//! renamed into place, with the files that it lists, or `error.json` ([`crate::Failure`]).

use crate::{Content, Failure, Format, Limits, OutputFile, Progress, Upload, Verdict};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Debug;
use std::io::Write;
use std::path::Path;
#[cfg(feature = "schema")]
use utoipa::openapi::{RefOr, Schema};

/// Name of the file with a [`Task`].
pub const TASK: &str = "job.json";
/// Name of the file with an [`Outcome`].
pub const OUTCOME: &str = "outcome.json";
/// Name of the file with a [`Failure`].
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
    pub options: Value,
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

// Kinds of jobs.

/// Kind of job: the work that it does with its file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// Makes a UV map and writes the file with it.
    #[default]
    Unwrap,
    /// Measures the UV map that the file already has.
    Measure,
    /// Proves what holds of the UV map that the file already has.
    Verify,
    /// Solves a problem file: handles pulled to targets, no element inverted.
    Solve,
    /// Pulls a mesh, a picture's outline, a drawing or surfaces in a cage by handles, no element inverted.
    Deform,
    /// Warps a picture by handles without folding it.
    Warp,
    /// Moves anchors of a file's UVs, no face flipped.
    EditUv,
    /// Aligns points of a surface with points of a texture, no face flipped.
    TextureMap,
    /// Packs the UV islands that the file has into one atlas, each as it is.
    Repack,
    /// Moves vertices of a folded mesh until no element is inverted.
    Untangle,
}

impl Kind {
    /// All kinds.
    pub const ALL: [Self; 10] = [
        Self::Unwrap,
        Self::Measure,
        Self::Verify,
        Self::Solve,
        Self::Deform,
        Self::Warp,
        Self::EditUv,
        Self::TextureMap,
        Self::Repack,
        Self::Untangle,
    ];

    /// Returns the content that jobs of this kind read.
    pub fn reads(self) -> Content {
        match self {
            Self::Unwrap
            | Self::Measure
            | Self::Verify
            | Self::EditUv
            | Self::TextureMap
            | Self::Repack => Content::Surface,
            Self::Solve => Content::Problem,
            Self::Deform | Self::Untangle => Content::Body,
            Self::Warp => Content::Picture,
        }
    }

    /// Returns whether jobs of this kind report what is proven of their result.
    pub fn proves(self) -> bool {
        !matches!(self, Self::Measure | Self::Solve | Self::Deform)
    }

    /// Returns whether jobs of this kind measure atlases.
    pub fn measures(self) -> bool {
        matches!(self, Self::Unwrap | Self::Repack | Self::Measure)
    }

    /// Returns the name used in JSON and in the store.
    pub fn word(self) -> &'static str {
        match self {
            Self::Unwrap => "unwrap",
            Self::Measure => "measure",
            Self::Verify => "verify",
            Self::Solve => "solve",
            Self::Deform => "deform",
            Self::Warp => "warp",
            Self::EditUv => "edit_uv",
            Self::TextureMap => "texture_map",
            Self::Repack => "repack",
            Self::Untangle => "untangle",
        }
    }
}

// The server's knowledge of computations that it does not contain.

/// Rejection of options.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RefusedOptions {
    /// Code and message.
    pub failure: Failure,
    /// Column of the error in a formula, from 1.
    pub column: Option<usize>,
}

/// Catalog of computations: their options, their reports, the files that they read. A server asks it instead of
/// linking the code that computes.
pub trait Catalog: Debug + Send + Sync {
    /// Checks the options of a kind, as far as possible without the file, and completes them with defaults.
    ///
    /// # Errors
    /// Fails if an option is unknown, has a wrong type or is out of range.
    fn complete(&self, kind: Kind, options: Value) -> Result<Value, RefusedOptions>;

    /// Returns the format of a file of `size` bytes that is read for `content`, from its first bytes `head`;
    /// [`SEARCHED_BYTES`](crate::SEARCHED_BYTES) of them suffice.
    fn format(&self, head: &[u8], size: u64, content: Content) -> Option<Format>;

    /// Returns the paths that the main file, and the material files beside it, refer to.
    fn references(&self, upload: &Upload) -> BTreeSet<String>;

    /// Returns the format of the main file as a surface.
    fn format_of(&self, upload: &Upload) -> Option<Format>;

    /// Returns the schemas of all options and reports, with those that they refer to.
    #[cfg(feature = "schema")]
    fn schemas(&self) -> Vec<(String, RefOr<Schema>)>;
}
