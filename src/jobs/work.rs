//! What each kind of job does: its options, its function of the pipeline, the files it leaves.

use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

use super::job::Kind;
use crate::document::Upload;
use crate::pipeline::{
    self, DeformOptions, Deformed, EditOptions, Editing, Limits, MeasureOptions, Observer, Options,
    PipelineError, RepackOptions, SolveOptions, WarpOptions,
};

/// What a job leaves: role, name and content of each file.
pub(super) type Files = Vec<(String, String, Vec<u8>)>;

/// A kind of job with its options, checked as far as that is possible without the file.
pub struct Work {
    options: Value,
    run: Box<Run>,
}

type Run = dyn FnOnce(&Upload, Limits, &dyn Observer) -> Made + Send;
type Made = Result<Files, PipelineError>;

impl Work {
    /// Reads and checks the options of a kind; what is absent has its default.
    pub fn new(kind: Kind, options: Value) -> Result<Self, PipelineError> {
        match kind {
            Kind::Unwrap => Self::of(options, Options::check, unwrap),
            Kind::Measure => Self::of(options, MeasureOptions::check, measure),
            Kind::Solve => Self::of(options, SolveOptions::check, solve),
            Kind::Deform => Self::of(options, DeformOptions::check, deform),
            Kind::Warp => Self::of(options, WarpOptions::check, warp),
            Kind::EditUv => Self::of(options, EditOptions::check, edit_uv),
            Kind::TextureMap => Self::of(options, EditOptions::check, texture_map),
            Kind::Repack => Self::of(options, RepackOptions::check, repack),
        }
    }

    fn of<O: DeserializeOwned + Serialize + Send + 'static>(
        options: Value,
        check: fn(&O) -> Result<(), PipelineError>,
        run: fn(&Upload, O, Limits, &dyn Observer) -> Made,
    ) -> Result<Self, PipelineError> {
        let refused = |error: serde_json::Error| PipelineError::InvalidOptions(error.to_string());
        let options: O = serde_json::from_value(options).map_err(refused)?;
        check(&options)?;
        Ok(Self {
            options: serde_json::to_value(&options).map_err(refused)?,
            run: Box::new(move |upload, limits, observer| run(upload, options, limits, observer)),
        })
    }

    /// The options, complete.
    pub fn into_options(self) -> Value {
        self.options
    }

    /// Does it.
    pub(super) fn run(self, upload: &Upload, limits: Limits, observer: &dyn Observer) -> Made {
        (self.run)(upload, limits, observer)
    }
}

fn unwrap(upload: &Upload, mut options: Options, limits: Limits, observer: &dyn Observer) -> Made {
    options.limits = limits;
    drawn(pipeline::unwrap_document(upload, &options, observer)?)
}

fn repack(
    upload: &Upload,
    mut options: RepackOptions,
    limits: Limits,
    observer: &dyn Observer,
) -> Made {
    options.limits = limits;
    drawn(pipeline::repack_document(upload, &options, observer)?)
}

/// An atlas with its pictures and its report.
fn drawn(outcome: pipeline::Outcome) -> Made {
    let drawn = outcome.pictures.draw()?;
    let mut files = result(outcome.files);
    let mut add = |role: &str, bytes| files.push((role.to_owned(), role.to_owned(), bytes));
    add("layout.png", drawn.layout_png);
    add("heatmap.png", drawn.heatmap_png);
    files.push(report(&outcome.report));
    Ok(files)
}

fn measure(upload: &Upload, mut options: MeasureOptions, limits: Limits, _: &dyn Observer) -> Made {
    options.limits = limits;
    let measured = pipeline::measure_document(upload, &options)?;
    Ok(vec![report(&measured)])
}

fn solve(
    upload: &Upload,
    mut options: SolveOptions,
    limits: Limits,
    observer: &dyn Observer,
) -> Made {
    options.limits = limits;
    pipeline::solve_file(upload, &options, observer).map(body)
}

fn deform(
    upload: &Upload,
    mut options: DeformOptions,
    limits: Limits,
    observer: &dyn Observer,
) -> Made {
    options.limits = limits;
    pipeline::deform_file(upload, &options, observer).map(body)
}

fn body(deformed: Deformed) -> Files {
    let mut files = result(deformed.files);
    files.push(report(&deformed.report));
    let name = "trace.csv".to_owned();
    files.push((format!("files/{name}"), name, deformed.trace.into_bytes()));
    files
}

fn warp(
    upload: &Upload,
    mut options: WarpOptions,
    limits: Limits,
    observer: &dyn Observer,
) -> Made {
    options.limits = limits;
    let warped = pipeline::warp_file(upload, &options, observer)?;
    let mut files = result(warped.files);
    files.push(report(&warped.report));
    Ok(files)
}

fn edit_uv(
    upload: &Upload,
    mut options: EditOptions,
    limits: Limits,
    observer: &dyn Observer,
) -> Made {
    options.limits = limits;
    edit(upload, Editing::Map, &options, observer)
}

fn texture_map(
    upload: &Upload,
    mut options: EditOptions,
    limits: Limits,
    observer: &dyn Observer,
) -> Made {
    options.limits = limits;
    edit(upload, Editing::Texture, &options, observer)
}

fn edit(upload: &Upload, editing: Editing, options: &EditOptions, observer: &dyn Observer) -> Made {
    let edited = pipeline::edit_document(upload, editing, options, observer)?;
    let mut files = result(edited.files);
    files.push(report(&edited.report));
    Ok(files)
}

/// The main file, and what belongs to it.
fn result(files: Vec<(String, Vec<u8>)>) -> Files {
    let with_role = |(index, (name, bytes)): (usize, (String, Vec<u8>))| {
        let role = match index {
            0 => "result".to_owned(),
            _ => format!("files/{name}"),
        };
        (role, name, bytes)
    };
    files.into_iter().enumerate().map(with_role).collect()
}

fn report(report: &impl Serialize) -> (String, String, Vec<u8>) {
    // Reports are plain data, which serialization cannot refuse.
    let bytes = serde_json::to_vec_pretty(report).unwrap_or_default();
    ("report".to_owned(), "report.json".to_owned(), bytes)
}
