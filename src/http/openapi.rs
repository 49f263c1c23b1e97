//! The OpenAPI document: what the handlers say, and what several of them have in common.

use serde_json::{Map, Value, json};
use utoipa::openapi::{InfoBuilder, LicenseBuilder, OpenApi, OpenApiBuilder, RefOr, Schema};
use utoipa::{PartialSchema, ToSchema};

use super::problem::Code;
use super::upload::MEDIA_TYPES;
use crate::jobs::Event;
use crate::pipeline::{MeasureOptions, Options};

const DESCRIPTION: &str = "Unwraps meshes: a mesh file in, the same file with certified flip-free UVs and a \
    distortion report out. Errors are RFC 9457 problems with a stable `code`; `x-problems` lists the codes of the \
    service, others come from the mesh and have status 422.";

/// What stands above the paths.
pub(super) fn preamble() -> OpenApi {
    let license = LicenseBuilder::new()
        .name("MIT OR Apache-2.0")
        .identifier(Some("MIT OR Apache-2.0"))
        .build();
    let info = InfoBuilder::new()
        .title("unwrapd")
        .version(env!("CARGO_PKG_VERSION"))
        .description(Some(DESCRIPTION))
        .license(Some(license))
        .build();
    OpenApiBuilder::new().info(info).build()
}

/// The document as text.
pub(super) fn document(mut api: OpenApi) -> String {
    let mut schemas = Vec::new();
    add_schema::<Options>(&mut schemas);
    add_schema::<MeasureOptions>(&mut schemas);
    add_schema::<Event>(&mut schemas);
    api.components
        .get_or_insert_default()
        .schemas
        .extend(schemas);

    let mut document = serde_json::to_value(api).unwrap_or_default();
    document["x-problems"] = problems();
    let unwrap = parameters::<Options>();
    let measure = parameters::<MeasureOptions>();
    let mut either = unwrap.clone();
    either.extend(
        measure
            .iter()
            .filter(|p| !unwrap.iter().any(|q| q["name"] == p["name"]))
            .cloned(),
    );
    let paths = &mut document["paths"];
    let both = json!({ "anyOf": [reference("Options"), reference("MeasureOptions")] });
    describe_upload(&mut paths["/v1/jobs"]["post"], either, &both);
    describe_upload(
        &mut paths["/v1/unwrap"]["post"],
        unwrap,
        &reference("Options"),
    );
    describe_upload(
        &mut paths["/v1/measure"]["post"],
        measure,
        &reference("MeasureOptions"),
    );
    paths["/v1/jobs"]["post"]["requestBody"]["content"]["multipart/form-data"]["schema"]["properties"]
        ["kind"] = reference("Kind");
    for status in ["200", "202"] {
        paths["/v1/jobs"]["post"]["responses"][status]["links"] = links();
    }
    for operations in members(paths) {
        members(operations).for_each(complete);
    }
    serde_json::to_string_pretty(&document).unwrap_or_default()
}

fn add_schema<T: ToSchema>(schemas: &mut Vec<(String, RefOr<Schema>)>) {
    schemas.push((T::name().into_owned(), T::schema()));
    T::schemas(schemas);
}

/// The values of an object.
fn members(value: &mut Value) -> impl Iterator<Item = &mut Value> {
    value.as_object_mut().into_iter().flat_map(Map::values_mut)
}

/// What holds for every operation: it may end with a problem, parameters are absent rather than null, files are bytes,
/// and so are parts of them.
fn complete(operation: &mut Value) {
    if !operation["responses"]["206"].is_null() {
        let mut content = operation["responses"]["200"]["content"].clone();
        members(&mut content).for_each(|of_type| of_type["schema"] = bytes());
        operation["responses"]["206"]["content"] = content;
    }
    for response in members(&mut operation["responses"]) {
        for (media_type, content) in response
            .get_mut("content")
            .and_then(Value::as_object_mut)
            .into_iter()
            .flatten()
        {
            if !media_type.contains("json") && !media_type.starts_with("text/")
                || media_type == "model/gltf+json"
            {
                content["schema"] = bytes();
            }
        }
    }
    operation["responses"]["default"] = json!({
        "description": "Any other problem",
        "content": { "application/problem+json": { "schema": reference("Problem") } },
    });
    let parameters = operation
        .get_mut("parameters")
        .and_then(Value::as_array_mut);
    for parameter in parameters.into_iter().flatten() {
        let Some(schema) = parameter["schema"].as_object_mut() else {
            continue;
        };
        schema.retain(|name, value| name != "default" || !value.is_null());
        if let Some(types) = schema.get_mut("type").and_then(Value::as_array_mut) {
            types.retain(|word| word != "null");
        }
        if let Some(choices) = schema.get_mut("oneOf").and_then(Value::as_array_mut) {
            choices.retain(|choice| choice["type"] != "null");
        }
    }
}

/// Where a job leads.
fn links() -> Value {
    let operations = [
        "getJob",
        "watchJob",
        "finishJob",
        "getResult",
        "getReport",
        "getLayout",
        "getHeatmap",
        "deleteJob",
    ];
    let link = |name: &str| {
        let to_job = json!({ "operationId": name, "parameters": { "id": "$response.body#/id" } });
        (name.to_owned(), to_job)
    };
    Value::Object(operations.into_iter().map(link).collect())
}

fn bytes() -> Value {
    json!({ "type": "string", "format": "binary" })
}

fn reference(schema: &str) -> Value {
    json!({ "$ref": format!("#/components/schemas/{schema}") })
}

/// The table of codes.
fn problems() -> Value {
    let row = |code: Code| {
        let (word, status, title) = code.row();
        json!({ "code": word, "status": status, "title": title })
    };
    Code::ALL.into_iter().map(row).collect()
}

/// The members of an options struct as query parameters.
fn parameters<T: PartialSchema>() -> Vec<Value> {
    let schema = serde_json::to_value(T::schema()).unwrap_or_default();
    let properties = schema["properties"]
        .as_object()
        .cloned()
        .unwrap_or_default();
    let parameter = |(name, mut schema): (String, Value)| {
        let description = schema
            .as_object_mut()
            .and_then(|keys| keys.remove("description"));
        json!({ "name": name, "in": "query", "required": false, "description": description, "schema": schema })
    };
    properties.into_iter().map(parameter).collect()
}

/// What the three uploads share: the body as a form or raw, options in the form or the query.
fn describe_upload(operation: &mut Value, options: Vec<Value>, form_options: &Value) {
    if let Some(parameters) = operation["parameters"].as_array_mut() {
        parameters.extend(options);
    }
    let mut content = Map::new();
    content.insert("multipart/form-data".to_owned(), json!({
        "schema": {
            "type": "object",
            "required": ["mesh"],
            "properties": {
                "mesh": { "type": "string", "format": "binary", "description": "The mesh file, with its file name" },
                "options": form_options,
                "resource": {
                    "type": "array",
                    "items": bytes(),
                    "description": "Files that the mesh references (buffers, images); the file name of each is the \
                        relative path used in the mesh",
                },
            },
        },
        "encoding": { "options": { "contentType": "application/json" } },
    }));
    for (media_type, _) in MEDIA_TYPES {
        content.insert(media_type.to_owned(), json!({ "schema": bytes() }));
    }
    operation["requestBody"] = json!({
        "required": true,
        "description": "The mesh as a form with the files it references, or the bytes of one file",
        "content": content,
    });
}
