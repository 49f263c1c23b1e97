//! Schemas of options and reports in the OpenAPI document.

use std::collections::BTreeSet;

use serde_json::{Map, Value, json};
use utoipa::ToSchema;
use utoipa::openapi::{RefOr, Schema};

use super::session_input::JobFile;
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
    let from = |schema: &mut Value| schema.as_object_mut()?.remove("description");
    from(schema).or_else(|| from(schema.get_mut("oneOf")?.get_mut(0)?))
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
