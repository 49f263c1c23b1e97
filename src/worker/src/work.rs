//! Kinds of jobs: their options, their pipeline functions, their output files.

use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

use crate::quality::quality_of;
use unwrapd_api::{Kind, Limits, Pictures, Quality, Upload, Verdict, Warning};
use unwrapd_pipeline::{
    self as pipeline, AtlasPicture, CommandOptions, DeformOptions, Deformed, EditOptions, Editing,
    MeasureOptions, Observer, Options, PipelineError, RepackOptions, SolveOptions, VerifyOptions,
    WarpOptions,
};

/// Result of a job.
pub(crate) struct Made {
    /// Role, name and content of each file.
    pub files: Vec<(String, String, Vec<u8>)>,
    /// Source of the pictures of an atlas, and its UVs.
    atlas: Option<(pipeline::Pictures, pipeline::UvArrays)>,
    /// Verdict on the files.
    pub verdict: Verdict,
}

/// A kind of job with its options, checked as far as possible without the file.
pub struct Work {
    options: Value,
    run: Box<RunComputation>,
}

type RunComputation = dyn FnOnce(&Upload, Limits, &dyn Observer) -> WorkResult + Send;
type WorkResult = Result<Made, PipelineError>;

impl Work {
    /// Parses and checks the options of a kind; absent options have their defaults.
    pub fn new(kind: Kind, options: Value) -> Result<Self, PipelineError> {
        match kind {
            Kind::Unwrap => Self::of(options, unwrap),
            Kind::Measure => Self::of(options, measure),
            Kind::Verify => Self::of(options, verify),
            Kind::Solve => Self::of(options, solve),
            Kind::Deform => Self::of(options, deform),
            Kind::Warp => Self::of(options, warp),
            Kind::EditUv => Self::of(options, edit_uv),
            Kind::TextureMap => Self::of(options, texture_map),
            Kind::Repack => Self::of(options, repack),
        }
    }

    fn of<O>(
        options: Value,
        run: fn(&Upload, &O, &dyn Observer) -> WorkResult,
    ) -> Result<Self, PipelineError>
    where
        O: CommandOptions + DeserializeOwned + Serialize + Send + 'static,
    {
        let refused = |error: serde_json::Error| PipelineError::InvalidOptions(error.to_string());
        let mut options: O = serde_json::from_value(options).map_err(refused)?;
        options.check()?;
        Ok(Self {
            options: serde_json::to_value(&options).map_err(refused)?,
            run: Box::new(move |upload, limits, observer| {
                options.caller_mut().limits = limits;
                run(upload, &options, observer)
            }),
        })
    }

    /// Returns the options, complete with defaults.
    pub fn into_options(self) -> Value {
        self.options
    }

    /// Runs the job.
    pub(crate) fn run(
        self,
        upload: &Upload,
        limits: Limits,
        observer: &dyn Observer,
    ) -> WorkResult {
        (self.run)(upload, limits, observer)
    }
}

fn unwrap(upload: &Upload, options: &Options, observer: &dyn Observer) -> WorkResult {
    pipeline::unwrap_document(upload, options, observer).map(atlas)
}

fn repack(upload: &Upload, options: &RepackOptions, observer: &dyn Observer) -> WorkResult {
    pipeline::repack_document(upload, options, observer).map(atlas)
}

/// Returns the result for an atlas with its report.
fn atlas(outcome: pipeline::Outcome) -> Made {
    let report = &outcome.report;
    let made = Made::new(outcome.files);
    let groups = report.groups.iter();
    let mut bounds = groups.filter_map(|group| Some(group.atlas.as_ref()?.bound.as_ref()?.kept));
    let within_bound = bounds.next().map(|first| first && bounds.all(|kept| kept));
    let mut made = made.reported(report, quality_of(report), &report.warnings);
    made.atlas = Some((outcome.pictures, outcome.uvs));
    made.verdict.within_bound = within_bound;
    made
}

fn measure(upload: &Upload, options: &MeasureOptions, _: &dyn Observer) -> WorkResult {
    let report = pipeline::measure_document(upload, options)?;
    // A measurement requests nothing that could be proven.
    let quality = Quality {
        certified: None,
        ..quality_of(&report)
    };
    Ok(Made::new(Vec::new()).reported(&report, quality, &report.warnings))
}

fn verify(upload: &Upload, options: &VerifyOptions, _: &dyn Observer) -> WorkResult {
    let verified = pipeline::verify_document(upload, options)?;
    let lacking = verified.lacking.iter();
    let lacking = lacking.map(|words| Warning::new("not_proven", (*words).to_owned()));
    let warnings: Vec<Warning> = verified.warnings.iter().cloned().chain(lacking).collect();
    let quality = Quality::proven(verified.certified);
    Ok(Made::new(Vec::new()).reported(&verified, quality, &warnings))
}

fn solve(upload: &Upload, options: &SolveOptions, observer: &dyn Observer) -> WorkResult {
    pipeline::solve_file(upload, options, observer).map(body)
}

fn deform(upload: &Upload, options: &DeformOptions, observer: &dyn Observer) -> WorkResult {
    pipeline::deform_file(upload, options, observer).map(body)
}

fn body(deformed: Deformed) -> Made {
    let report = &deformed.report;
    let mut made = Made::new(deformed.files).reported(report, Quality::default(), &report.warnings);
    made.add("files/trace.csv", "trace.csv", deformed.trace.into_bytes());
    made
}

fn warp(upload: &Upload, options: &WarpOptions, observer: &dyn Observer) -> WorkResult {
    let warped = pipeline::warp_file(upload, options, observer)?;
    let report = &warped.report;
    Ok(Made::new(warped.files).reported(
        report,
        Quality::proven(report.certified),
        &report.warnings,
    ))
}

fn edit_uv(upload: &Upload, options: &EditOptions, observer: &dyn Observer) -> WorkResult {
    edit(upload, Editing::Map, options, observer)
}

fn texture_map(upload: &Upload, options: &EditOptions, observer: &dyn Observer) -> WorkResult {
    edit(upload, Editing::Texture, options, observer)
}

fn edit(
    upload: &Upload,
    editing: Editing,
    options: &EditOptions,
    observer: &dyn Observer,
) -> WorkResult {
    let edited = pipeline::edit_document(upload, editing, options, observer)?;
    let report = &edited.report;
    Ok(Made::new(edited.files).reported(
        report,
        Quality::proven(report.certified),
        &report.warnings,
    ))
}

impl Made {
    /// Creates a result from the main file and the files that belong to it.
    fn new(files: Vec<(String, Vec<u8>)>) -> Self {
        let with_role = |(index, (name, bytes)): (usize, (String, Vec<u8>))| {
            let role = match index {
                0 => "result".to_owned(),
                _ => format!("files/{name}"),
            };
            (role, name, bytes)
        };
        Self {
            files: files.into_iter().enumerate().map(with_role).collect(),
            atlas: None,
            verdict: Verdict::default(),
        }
    }

    /// Adds the files that come with an atlas before the report: its pictures, or its UVs as arrays.
    pub fn complete(&mut self, wanted: Pictures) -> Result<(), PipelineError> {
        let Some((drawn, uvs)) = self.atlas.take() else {
            return Ok(());
        };
        let files = match wanted {
            Pictures::LeftOut => Vec::new(),
            Pictures::OnRequest => vec![("uvs.bin", uvs.to_bytes())],
            Pictures::Drawn => vec![
                ("layout.png", drawn.draw(AtlasPicture::Layout)?),
                ("heatmap.png", drawn.draw(AtlasPicture::Heatmap)?),
            ],
        };
        let files = files.into_iter();
        let files = files.map(|(name, bytes)| (name.to_owned(), name.to_owned(), bytes));
        let place = self.files.iter().position(|(role, ..)| role == "report");
        let place = place.unwrap_or(self.files.len());
        self.files.splice(place..place, files);
        Ok(())
    }

    fn add(&mut self, role: &str, name: &str, bytes: Vec<u8>) {
        self.files.push((role.to_owned(), name.to_owned(), bytes));
    }

    /// Adds the report, and derives the verdict of the job from it.
    fn reported(mut self, report: &impl Serialize, quality: Quality, warnings: &[Warning]) -> Self {
        // Reports are plain data, so serialization cannot fail.
        let bytes = serde_json::to_vec_pretty(report).unwrap_or_default();
        self.add("report", "report.json", bytes);
        self.verdict = Verdict {
            quality,
            warnings: warnings.to_vec(),
            ..Verdict::default()
        };
        self
    }
}
