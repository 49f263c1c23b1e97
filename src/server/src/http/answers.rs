//! Responses shared by several operations, for the OpenAPI document.

use std::collections::BTreeMap;

use utoipa::IntoResponses;
use utoipa::openapi::{ContentBuilder, Ref, RefOr, Response, ResponseBuilder};

use super::problem::Code;

/// Responses by status.
type Responses = BTreeMap<String, RefOr<Response>>;

/// Responses to a request for a file of a job, other than the file itself.
pub(super) struct FileAnswers;

/// Responses to a request for a picture, other than the picture itself.
pub(super) struct PictureAnswers;

/// Responses to a request for all files of a job, other than the archive itself.
pub(super) struct ArchiveProblems;

/// Responses to a synchronous request, other than its result.
pub(super) struct CallProblems;

/// Problems of requests for files.
const OF_FILES: [Code; 9] = [
    Code::JobNotFound,
    Code::JobExpired,
    Code::NoSuchFile,
    Code::NotFinished,
    Code::NoResult,
    Code::RangeNotSatisfiable,
    Code::DamagedFile,
    Code::MissingFile,
    Code::StoreUnavailable,
];

/// Problems of drawing pictures.
const OF_DRAWING: [Code; 6] = [
    Code::OutOfMemory,
    Code::InternalError,
    Code::Crashed,
    Code::WorkerLost,
    Code::TimedOut,
    Code::StorageFull,
];

impl IntoResponses for FileAnswers {
    fn responses() -> Responses {
        let mut answers = problems(&OF_FILES);
        answers.extend(parts());
        answers
    }
}

impl IntoResponses for PictureAnswers {
    fn responses() -> Responses {
        let mut answers = problems(&[&OF_FILES[..], &OF_DRAWING].concat());
        answers.extend(parts());
        answers
    }
}

/// Returns the responses to conditional and range requests.
fn parts() -> Responses {
    let mut answers = Responses::new();
    for (status, description) in [
        ("206", "The requested range"),
        ("304", "The file is unchanged"),
    ] {
        let answer = ResponseBuilder::new().description(description);
        answers.insert(status.to_owned(), answer.into());
    }
    answers
}

impl IntoResponses for ArchiveProblems {
    fn responses() -> Responses {
        let others = [
            Code::JobNotFound,
            Code::JobExpired,
            Code::NotFinished,
            Code::NoResult,
            Code::DamagedFile,
            Code::MissingFile,
            Code::StoreUnavailable,
        ];
        problems(&[&others[..], &OF_DRAWING].concat())
    }
}

impl IntoResponses for CallProblems {
    fn responses() -> Responses {
        let mut answers = problems(&[
            Code::InvalidRequest,
            Code::InvalidOptions,
            Code::MissingMesh,
            Code::NeedsJob,
            Code::UploadTooLarge,
            Code::UnsupportedMediaType,
            Code::InternalError,
            Code::Crashed,
            Code::OwnerQuotaUsed,
            Code::QueueFull,
            Code::Stopping,
            Code::Draining,
            Code::WorkerLost,
            Code::TimedOut,
            Code::StoreUnavailable,
            Code::StorageFull,
        ]);
        let unusable = "The mesh cannot be used; the code names the cause";
        answers.insert("422".to_owned(), problem(unusable.to_owned()));
        answers
    }
}

/// Returns one response per status, which lists the codes with that status.
pub(super) fn problems(codes: &[Code]) -> Responses {
    let mut descriptions: BTreeMap<u16, Vec<String>> = BTreeMap::new();
    for code in codes {
        let (word, status, title) = code.row();
        let lines = descriptions.entry(status).or_default();
        lines.push(format!("`{word}`: {title}"));
    }
    descriptions
        .into_iter()
        .map(|(status, lines)| (status.to_string(), problem(lines.join("; "))))
        .collect()
}

fn problem(description: String) -> RefOr<Response> {
    let schema = Ref::from_schema_name("Problem");
    let content = ContentBuilder::new().schema(Some(schema)).build();
    ResponseBuilder::new()
        .description(description)
        .content("application/problem+json", content)
        .into()
}
