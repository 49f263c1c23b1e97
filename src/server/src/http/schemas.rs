//! Schemas and responses that several operations share in the OpenAPI document.

use std::collections::{BTreeMap, BTreeSet};

use serde_json::{Map, Value, json};
use utoipa::openapi::{ContentBuilder, Ref, RefOr, Response, ResponseBuilder, Schema};
use utoipa::{IntoResponses, ToSchema};

use super::input::JobFile;
use super::problem::Code;
use crate::jobs::{Event, Order};
use unwrapd_api::{Catalog, Kind};

/// Returns the schemas that no handler refers to, with their dependencies.
pub(super) fn schemas(catalog: &dyn Catalog) -> Vec<(String, RefOr<Schema>)> {
    let mut schemas = catalog.schemas();
    add::<Event>(&mut schemas);
    add::<Order>(&mut schemas);
    add::<JobFile>(&mut schemas);
    schemas
}

fn add<T: ToSchema>(schemas: &mut Vec<(String, RefOr<Schema>)>) {
    schemas.push((T::name().into_owned(), T::schema()));
    T::schemas(schemas);
}

/// Returns the name of the schema for a kind's options.
pub(super) fn options(kind: Kind) -> &'static str {
    match kind {
        Kind::Unwrap => "Options",
        Kind::Measure => "MeasureOptions",
        Kind::Verify => "VerifyOptions",
        Kind::Solve => "SolveOptions",
        Kind::Deform => "DeformOptions",
        Kind::Warp => "WarpOptions",
        Kind::EditUv | Kind::TextureMap => "EditOptions",
        Kind::Repack => "RepackOptions",
        Kind::Untangle => "UntangleOptions",
    }
}

/// Returns the schema of any report.
pub(super) fn any_report() -> Value {
    let reports = [
        "Report",
        "Verified",
        "DeformReport",
        "WarpReport",
        "EditReport",
        "UntangleReport",
    ];
    json!({ "anyOf": reports.map(reference) })
}

/// Returns a reference to a schema of the document.
pub(super) fn reference(schema: &str) -> Value {
    json!({ "$ref": format!("#/components/schemas/{schema}") })
}

/// Returns the schema of a file.
pub(super) fn bytes() -> Value {
    json!({ "type": "string", "format": "binary" })
}

/// Merges the groups of options into one object each and removes the groups' schemas: if each part rejects unknown
/// members, no part accepts the members of all.
pub(super) fn merge_groups(schemas: &mut Value) {
    let mut groups = BTreeSet::new();
    for name in Kind::ALL.map(options) {
        let merged = merged(&schemas[name], schemas, &mut groups);
        schemas[name]["properties"] = Value::Object(merged);
        schemas[name]["type"] = json!("object");
        schemas[name]["additionalProperties"] = json!(false);
        if let Some(schema) = schemas[name].as_object_mut() {
            schema.remove("allOf");
        }
    }
    if let Some(schemas) = schemas.as_object_mut() {
        let own = Kind::ALL.map(options);
        schemas.retain(|name, _| own.contains(&name.as_str()) || !groups.contains(name));
    }
}

/// Returns the members of a schema and of its groups, and collects the names of the groups.
fn merged(schema: &Value, schemas: &Value, groups: &mut BTreeSet<String>) -> Map<String, Value> {
    let mut members = schema["properties"]
        .as_object()
        .cloned()
        .unwrap_or_default();
    for part in schema["allOf"].as_array().into_iter().flatten() {
        let group = part["$ref"]
            .as_str()
            .and_then(|path| path.rsplit('/').next());
        let part = group.map_or(part, |group| &schemas[group]);
        members.extend(merged(part, schemas, groups));
        groups.extend(group.map(str::to_owned));
    }
    members
}

/// Returns the members of options as query parameters. Kinds may use one name with different meanings.
pub(super) fn parameters(schemas: &Value, options: &[&str]) -> Vec<Value> {
    let mut parameters: Map<String, Value> = Map::new();
    for name in options {
        let properties = schemas[*name]["properties"].as_object();
        for (name, schema) in properties.into_iter().flatten() {
            let parameter = parameter(name, schema.clone());
            match parameters.get_mut(name) {
                None => {
                    parameters.insert(name.clone(), parameter);
                }
                Some(known) if without_default(known) == without_default(&parameter) => {}
                Some(known) => join(known, &parameter),
            }
        }
    }
    parameters
        .into_iter()
        .map(|(_, parameter)| parameter)
        .collect()
}

/// Returns the query parameter of an option. A list is given as its JSON text.
fn parameter(name: &str, mut schema: Value) -> Value {
    let mut parameter = json!({ "name": name, "in": "query", "required": false });
    if let Some(description) = take_description(&mut schema) {
        parameter["description"] = description;
    }
    if schema["type"] == "array" {
        parameter["content"]["application/json"]["schema"] = schema;
    } else {
        parameter["schema"] = schema;
    }
    parameter
}

/// Removes and returns the description of a member. For an optional member it is in the first choice.
fn take_description(schema: &mut Value) -> Option<Value> {
    if let Some(description) = remove_description(schema) {
        return Some(description);
    }
    remove_description(schema.get_mut("oneOf")?.get_mut(0)?)
}

fn remove_description(schema: &mut Value) -> Option<Value> {
    schema.as_object_mut()?.remove("description")
}

fn schema_of(parameter: &mut Value) -> &mut Value {
    if parameter["schema"].is_null() {
        &mut parameter["content"]["application/json"]["schema"]
    } else {
        &mut parameter["schema"]
    }
}

fn without_default(parameter: &Value) -> Value {
    let mut schema = schema_of(&mut parameter.clone()).clone();
    schema.as_object_mut().map(|keys| keys.remove("default"));
    schema
}

/// Makes a parameter also accept the values of another one.
fn join(parameter: &mut Value, other: &Value) {
    let other = without_default(other);
    let schema = schema_of(parameter);
    match schema.get_mut("anyOf").and_then(Value::as_array_mut) {
        Some(choices) if choices.contains(&other) => {}
        Some(choices) => choices.push(other),
        None => *schema = json!({ "anyOf": [schema, other] }),
    }
}

// Responses shared by several operations, for the OpenAPI document.

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

/// Responses to a request that decodes a texture, other than the picture.
pub(super) struct DecodingProblems;

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

impl IntoResponses for DecodingProblems {
    fn responses() -> Responses {
        let others = [
            Code::InvalidRequest,
            Code::RequestTimeout,
            Code::UploadTooLarge,
            Code::UnsupportedMediaType,
            Code::Draining,
        ];
        let mut answers = problems(&[&others[..], &OF_DRAWING].concat());
        let unusable = "`unknown_format`, `image_too_large`, `invalid_image`, `out_of_memory`: the texture cannot be decoded";
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
