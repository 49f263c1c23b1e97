//! Kinds of jobs: their options, their pipeline functions, their output files; and the catalog of them.

use std::collections::BTreeSet;

use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;
use utoipa::ToSchema;
use utoipa::openapi::{RefOr, Schema};

use unwrapd_api::{
    Catalog, Content, Failure, Format, Kind, Limits, Pictures, Quality, RefusedOptions, Upload,
    Verdict, Warning,
};
use unwrapd_deform::ProblemFile;
use unwrapd_files::document::{DocumentError, format_of, references};
use unwrapd_files::io::format_of_content;
use unwrapd_pipeline::{
    self as pipeline, AtlasPicture, CommandOptions, DeformOptions, DeformReport, Deformed,
    EditOptions, EditReport, Editing, MeasureOptions, Observer, Options, PipelineError,
    RepackOptions, Report, SolveOptions, UntangleOptions, UntangleReport, Verified, VerifyOptions,
    WarpOptions, WarpReport,
};

/// Result of a job.
pub(crate) struct JobResult {
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
type WorkResult = Result<JobResult, PipelineError>;

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
            Kind::Untangle => Self::of(options, untangle),
        }
    }

    fn of<O>(
        options: Value,
        run: fn(&Upload, &O, &dyn Observer) -> WorkResult,
    ) -> Result<Self, PipelineError>
    where
        O: CommandOptions + DeserializeOwned + Serialize + Send + 'static,
    {
        let mut options: O = serde_json::from_value(options).map_err(|e| invalid_options(&e))?;
        options.check()?;
        Ok(Self {
            options: serde_json::to_value(&options).map_err(|e| invalid_options(&e))?,
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

fn invalid_options(error: &serde_json::Error) -> PipelineError {
    PipelineError::InvalidOptions(error.to_string())
}

fn unwrap(upload: &Upload, options: &Options, observer: &dyn Observer) -> WorkResult {
    pipeline::unwrap_document(upload, options, observer).map(atlas)
}

fn repack(upload: &Upload, options: &RepackOptions, observer: &dyn Observer) -> WorkResult {
    pipeline::repack_document(upload, options, observer).map(atlas)
}

/// Returns the result for an atlas with its report.
fn atlas(outcome: pipeline::Outcome) -> JobResult {
    let report = &outcome.report;
    let made = JobResult::new(outcome.files);
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
    Ok(JobResult::new(Vec::new()).reported(&report, quality, &report.warnings))
}

fn verify(upload: &Upload, options: &VerifyOptions, _: &dyn Observer) -> WorkResult {
    let verified = pipeline::verify_document(upload, options)?;
    let lacking = verified.lacking.iter();
    let lacking = lacking.map(|words| Warning::new("not_proven", (*words).to_owned()));
    let warnings: Vec<Warning> = verified.warnings.iter().cloned().chain(lacking).collect();
    let quality = Quality::proven(verified.certified);
    Ok(JobResult::new(Vec::new()).reported(&verified, quality, &warnings))
}

fn solve(upload: &Upload, options: &SolveOptions, observer: &dyn Observer) -> WorkResult {
    pipeline::solve_file(upload, options, observer).map(body)
}

fn deform(upload: &Upload, options: &DeformOptions, observer: &dyn Observer) -> WorkResult {
    pipeline::deform_file(upload, options, observer).map(body)
}

fn body(deformed: Deformed) -> JobResult {
    let report = &deformed.report;
    let mut made =
        JobResult::new(deformed.files).reported(report, Quality::default(), &report.warnings);
    made.add("files/trace.csv", "trace.csv", deformed.trace.into_bytes());
    made
}

fn warp(upload: &Upload, options: &WarpOptions, observer: &dyn Observer) -> WorkResult {
    let warped = pipeline::warp_file(upload, options, observer)?;
    let report = &warped.report;
    Ok(JobResult::new(warped.files).reported(
        report,
        Quality::proven(report.certified),
        &report.warnings,
    ))
}

fn untangle(upload: &Upload, options: &UntangleOptions, observer: &dyn Observer) -> WorkResult {
    let rest = options.rest_mesh.as_ref().map(|name| {
        let bytes = upload.resources.get(name).cloned();
        let bytes = bytes.ok_or_else(|| DocumentError::MissingResource(name.clone()))?;
        Ok::<_, PipelineError>(Upload::single(name, bytes))
    });
    let rest = rest.transpose()?;
    let untangled = pipeline::untangle_file(upload, rest.as_ref(), options, observer)?;
    // A mesh that is still folded is an error.
    let quality = Quality::proven(true);
    let report = &untangled.report;
    Ok(JobResult::new(untangled.files).reported(report, quality, &report.warnings))
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
    Ok(JobResult::new(edited.files).reported(
        report,
        Quality::proven(report.certified),
        &report.warnings,
    ))
}

impl JobResult {
    /// Creates a result from the main file and the files that belong to it.
    fn new(files: Vec<(String, Vec<u8>)>) -> Self {
        let files = files.into_iter().enumerate();
        let files = files.map(|(index, (name, bytes))| {
            let role = match index {
                0 => "result".to_owned(),
                _ => format!("files/{name}"),
            };
            (role, name, bytes)
        });
        Self {
            files: files.collect(),
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

// Quality figures of an atlas.

/// Returns the quality figures of an atlas from its report.
pub fn quality_of(report: &Report) -> Quality {
    let measures = report.groups.iter().map(|group| &group.measures);
    let distortions = measures.clone().map(|of| &of.distortion);
    Quality {
        certified: Some(report.certified),
        charts: Some(measures.map(|of| of.seams.charts as u64).sum()),
        distortion: (distortions.clone())
            .filter_map(|of| of.sym_dirichlet_mean)
            .reduce(f64::max),
        stretch: (distortions)
            .filter_map(|of| of.stretch_p99)
            .reduce(f64::max),
    }
}

// The catalog of this crate's computations.

/// Catalog of everything that jobs and sessions can compute.
#[derive(Debug)]
pub struct Computations;

impl Catalog for Computations {
    fn complete(&self, kind: Kind, options: Value) -> Result<Value, RefusedOptions> {
        match Work::new(kind, options) {
            Ok(work) => Ok(work.into_options()),
            Err(error) => Err(RefusedOptions {
                failure: Failure::new(error.code(), error.to_string()),
                column: error.column(),
            }),
        }
    }

    fn format(&self, head: &[u8], size: u64, content: Content) -> Option<Format> {
        format_of_content(head, size, content)
    }

    fn references(&self, upload: &Upload) -> BTreeSet<String> {
        references(upload)
    }

    fn format_of(&self, upload: &Upload) -> Option<Format> {
        format_of(upload)
    }

    fn schemas(&self) -> Vec<(String, RefOr<Schema>)> {
        let mut schemas = Vec::new();
        add::<Options>(&mut schemas);
        add::<MeasureOptions>(&mut schemas);
        add::<VerifyOptions>(&mut schemas);
        add::<SolveOptions>(&mut schemas);
        add::<DeformOptions>(&mut schemas);
        add::<WarpOptions>(&mut schemas);
        add::<EditOptions>(&mut schemas);
        add::<RepackOptions>(&mut schemas);
        add::<UntangleOptions>(&mut schemas);
        add::<Report>(&mut schemas);
        add::<Verified>(&mut schemas);
        add::<DeformReport>(&mut schemas);
        add::<WarpReport>(&mut schemas);
        add::<EditReport>(&mut schemas);
        add::<UntangleReport>(&mut schemas);
        add::<ProblemFile>(&mut schemas);
        schemas
    }
}

fn add<T: ToSchema>(schemas: &mut Vec<(String, RefOr<Schema>)>) {
    schemas.push((T::name().into_owned(), T::schema()));
    T::schemas(schemas);
}
