//! The catalog of this crate's computations.

use std::collections::BTreeSet;

use serde_json::Value;
use unwrapd_api::{Catalog, Content, Failure, Format, Kind, RefusedOptions, Upload};
use unwrapd_deform::ProblemFile;
use unwrapd_files::document::{format_of, references};
use unwrapd_files::io::format_of_content;
use unwrapd_pipeline::{
    DeformOptions, DeformReport, EditOptions, EditReport, MeasureOptions, Options, PipelineError,
    RepackOptions, Report, SolveOptions, Verified, VerifyOptions, WarpOptions, WarpReport,
};
use utoipa::ToSchema;
use utoipa::openapi::{RefOr, Schema};

use crate::work::Work;

/// Catalog of everything that jobs and sessions can compute.
#[derive(Debug)]
pub struct Computations;

impl Catalog for Computations {
    fn complete(&self, kind: Kind, options: Value) -> Result<Value, RefusedOptions> {
        let refused = |error: PipelineError| RefusedOptions {
            failure: Failure::new(error.code(), error.to_string()),
            column: error.column(),
        };
        Work::new(kind, options)
            .map(Work::into_options)
            .map_err(refused)
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
        add::<Report>(&mut schemas);
        add::<Verified>(&mut schemas);
        add::<DeformReport>(&mut schemas);
        add::<WarpReport>(&mut schemas);
        add::<EditReport>(&mut schemas);
        add::<ProblemFile>(&mut schemas);
        schemas
    }
}

fn add<T: ToSchema>(schemas: &mut Vec<(String, RefOr<Schema>)>) {
    schemas.push((T::name().into_owned(), T::schema()));
    T::schemas(schemas);
}
