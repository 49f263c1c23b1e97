//! Files as bytes, unwrapped on a thread of Node's pool.

use std::collections::HashMap;
use std::mem;

use napi::bindgen_prelude::{AsyncTask, Either, Uint8Array};
use napi::{Env, Task};
use napi_derive::napi;
use unwrapd::document::Upload;
use unwrapd::pipeline::{self, Options, Outcome};

use crate::call::{Cancellation, Failure, run};
use crate::options::{json, parsed};

/// A file with the files that it references.
#[napi(object, object_to_js = false)]
pub struct File {
    /// File name; its extension decides the format if the bytes do not.
    pub name: String,
    /// Its bytes.
    pub bytes: Uint8Array,
    /// Referenced files by relative path.
    pub resources: HashMap<String, Uint8Array>,
}

impl From<File> for Upload {
    fn from(file: File) -> Self {
        let resources = file.resources.into_iter();
        Self {
            name: file.name,
            bytes: file.bytes.to_vec(),
            resources: resources
                .map(|(name, bytes)| (name, bytes.to_vec()))
                .collect(),
        }
    }
}

/// An output file.
#[napi(object, object_from_js = false)]
pub struct WrittenFile {
    /// Path relative to the main file.
    pub name: String,
    /// Its bytes.
    pub bytes: Uint8Array,
}

/// Result of unwrapping a document.
#[napi(object, object_from_js = false)]
pub struct Written {
    /// Output files, the main one first.
    pub files: Vec<WrittenFile>,
    /// The report as JSON.
    pub report: String,
}

/// Task of unwrapping a document.
pub struct Unwrapping {
    upload: Upload,
    options: String,
    cancellation: Cancellation,
}

impl Task for Unwrapping {
    type Output = Result<Outcome, Failure>;
    type JsValue = Either<Written, Failure>;

    fn compute(&mut self) -> napi::Result<Self::Output> {
        let upload = mem::replace(&mut self.upload, Upload::single("", Vec::new()));
        Ok(parsed::<Options>(&self.options).and_then(|options| {
            run(self.cancellation.clone(), move |observer| {
                pipeline::unwrap_document(&upload, &options, observer)
            })
        }))
    }

    fn resolve(&mut self, _: Env, output: Self::Output) -> napi::Result<Self::JsValue> {
        Ok(output.and_then(written).map_or_else(Either::B, Either::A))
    }
}

fn written(outcome: Outcome) -> Result<Written, Failure> {
    let files = outcome.files.into_iter().map(|(name, bytes)| WrittenFile {
        name,
        bytes: bytes.into(),
    });
    Ok(Written {
        files: files.collect(),
        report: json(&outcome.report)?,
    })
}

/// Unwraps every mesh of a file.
#[napi]
pub fn unwrap_document(
    file: File,
    options: String,
    cancellation: &Cancellation,
) -> AsyncTask<Unwrapping> {
    AsyncTask::new(Unwrapping {
        upload: file.into(),
        options,
        cancellation: cancellation.clone(),
    })
}
