//! The OpenAPI document: the docs of the handlers, and what several of them share.

use std::collections::BTreeSet;

use axum::http::Method;
use serde_json::{Map, Value, json};
use utoipa::openapi::tag::TagBuilder;
use utoipa::openapi::{InfoBuilder, LicenseBuilder, OpenApi, OpenApiBuilder};

use super::admission::{COOKIE, needed};
use super::problem::{CAUSES, Code};
use super::schemas::{self, bytes, problems, reference};
use super::upload::{other_types, surface_types, texture_types};
use crate::jobs::access::Scope;
use unwrapd_api::{Catalog, Kind};

const DESCRIPTION: &str = "Unwraps meshes: a mesh file in, the same file with certified flip-free UVs and a \
    distortion report out. Also deforms meshes, pictures and UVs by handles without inverting an element. Errors are \
    RFC 9457 problems with a stable `code`; `x-problems` lists all codes. Errors caused by the input have status 422. A \
    failed job reports the same codes in `error`, and so does the command line, which ends with 0 done and proven, 1 any other error, \
    2 usage error, 3 unusable input, 4 written but not certified or not accepted, 5 targets not reached, 6 ended early with less than \
    was asked for, 7 partly done. Once a service has an API key, calls need \
    one: `security` of an operation names its scopes. What belongs to another owner does not exist for a caller.";

const WEBHOOK: &str = "Posted to the `webhook` of a job when the job ends, as [Standard Webhooks](https://www.standardwebhooks.com) \
    says. To verify it, take the bytes of the body as they came. Join `webhook-id`, `webhook-timestamp` and the body by `.`, and compute \
    HMAC-SHA256 with the secret of the owner: the base64 after `whsec_` in what `unwrapd webhook-secret --owner NAME` prints. One \
    of the signatures in `webhook-signature`, the base64 after `v1,`, must be equal; compare in constant time, and refuse a \
    timestamp that is more than five minutes off. Any answer but 2xx and 410 is repeated after 5 s, 5 and 30 minutes, 2, 5, 10 and 14 \
    hours. A notice may come twice.";

/// Tags of operations with their descriptions, in display order.
const TAGS: [(&str, &str); 6] = [
    ("synchronous", "Small meshes, answered at once"),
    ("jobs", "Submit, list, watch and end jobs"),
    ("results", "What jobs made"),
    ("sessions", "Pull bodies, pictures and UVs live"),
    ("access", "Keys, and signing in"),
    ("service", "Health, metrics, and operating it"),
];

/// Paths of uploads that state their kind themselves.
const OF_ANY_KIND: [&str; 2] = ["/v1/jobs", "/v1/sessions"];

/// Returns the document without paths.
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
    let tags = TAGS.map(|(name, description)| {
        TagBuilder::new()
            .name(name)
            .description(Some(description))
            .build()
    });
    OpenApiBuilder::new().info(info).tags(Some(tags)).build()
}

/// Returns the complete document as text. Operations at `open` paths need no key.
pub(super) fn document(mut api: OpenApi, catalog: &dyn Catalog, open: &[String]) -> String {
    // Add the parts that the handlers do not declare.
    api.components
        .get_or_insert_default()
        .schemas
        .extend(schemas::schemas(catalog));
    let mut document = serde_json::to_value(api).unwrap_or_default();
    document["servers"] =
        json!([{ "url": "/", "description": "The service that this document comes from" }]);
    document["x-problems"] = table_of_codes();
    document["webhooks"] = webhooks();
    schemas::merge_groups(&mut document["components"]["schemas"]);

    // Describe the uploads, each with the options of its kinds.
    let all = Kind::ALL.map(schemas::options);
    let all: BTreeSet<&str> = all.into_iter().collect();
    describe_upload(&mut document, "/v1/jobs", &Vec::from_iter(all));
    let pulled = ["DeformOptions", "EditOptions", "WarpOptions"];
    describe_upload(&mut document, "/v1/sessions", &pulled);
    describe_upload(&mut document, "/v1/unwrap", &["Options"]);
    describe_upload(&mut document, "/v1/measure", &["MeasureOptions"]);
    let textures = texture_types().map(|it| (it.to_owned(), json!({ "schema": bytes() })));
    document["paths"]["/v1/decode"]["post"]["requestBody"] =
        json!({ "required": true, "content": textures.collect::<Map<_, _>>() });
    // Correct what the attributes of handlers cannot express.
    let paths = &mut document["paths"];
    let report = &mut paths["/v1/jobs/{id}/report"]["get"]["responses"]["200"];
    report["content"]["application/json"]["schema"] = schemas::any_report();
    for path in OF_ANY_KIND {
        let form = &mut paths[path]["post"]["requestBody"]["content"]["multipart/form-data"];
        form["schema"]["properties"]["kind"] = reference("Kind");
    }
    paths["/v1/sessions"]["post"]["requestBody"]["required"] = false.into();
    for status in ["200", "202"] {
        paths["/v1/jobs"]["post"]["responses"][status]["links"] = links();
    }
    // Complete every operation, and add its keys and scopes.
    for operations in members(paths) {
        members(operations).for_each(complete);
    }
    describe(&mut document, open);
    serde_json::to_string_pretty(&document).unwrap_or_default()
}

/// Iterates over the values of an object.
fn members(value: &mut Value) -> impl Iterator<Item = &mut Value> {
    value.as_object_mut().into_iter().flat_map(Map::values_mut)
}

/// Completes an operation: adds a default problem, makes absent parameters absent rather than null, and describes
/// files and ranges of files as bytes.
fn complete(operation: &mut Value) {
    // Give a range of a file the media types of the file; both are bytes.
    if !operation["responses"]["206"].is_null() {
        let mut content = operation["responses"]["200"]["content"].clone();
        members(&mut content).for_each(|of_type| of_type["schema"] = bytes());
        operation["responses"]["206"]["content"] = content;
    }
    // Describe files as bytes, unless they are JSON or text.
    for response in members(&mut operation["responses"]) {
        for (media_type, content) in response
            .get_mut("content")
            .and_then(Value::as_object_mut)
            .into_iter()
            .flatten()
        {
            if !media_type.contains("json") && !media_type.starts_with("text/")
                || media_type == "model/gltf+json"
                || is_list_of_bytes(&content["schema"])
            {
                content["schema"] = bytes();
            }
        }
    }
    operation["responses"]["default"] = json!({
        "description": "Any other error",
        "content": { "application/problem+json": { "schema": reference("Problem") } },
    });
    // Make parameters absent rather than null.
    let parameters = operation
        .get_mut("parameters")
        .and_then(Value::as_array_mut);
    for parameter in parameters.into_iter().flatten() {
        let Some(schema) = parameter.get_mut("schema").and_then(Value::as_object_mut) else {
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

/// Returns whether this is the schema of `Vec<u8>`, which stands for the bytes of a file, not for JSON.
fn is_list_of_bytes(schema: &Value) -> bool {
    let item = &schema["items"];
    schema["type"] == "array" && item["type"] == "integer" && item["minimum"] == 0
}

/// Returns the links from a job to operations on it.
fn links() -> Value {
    let operations = [
        "getJob",
        "watchJob",
        "changeJob",
        "finishJob",
        "retryJob",
        "getResult",
        "getReport",
        "getLayout",
        "getHeatmap",
        "deleteJob",
    ];
    let links = operations.into_iter().map(|name| {
        let to_job = json!({ "operationId": name, "parameters": { "id": "$response.body#/id" } });
        (name.to_owned(), to_job)
    });
    Value::Object(links.collect())
}

/// Describes the request that is posted to the `webhook` of a job.
fn webhooks() -> Value {
    // Describe the notice.
    let time = json!({ "type": "string", "format": "date-time" });
    let data = json!({
        "type": "object",
        "description": "The job, in the words of `getJob`",
        "required": ["id", "kind", "state", "metadata", "created_at", "finished_at"],
        "properties": {
            "id": { "type": "string", "format": "uuid" },
            "kind": reference("Kind"),
            "state": { "type": "string", "enum": ["succeeded", "failed", "cancelled"] },
            "filename": nullable("string"),
            "metadata": { "type": "object" },
            "certified": nullable("boolean"),
            "within_bound": nullable("boolean"),
            "accepted": nullable("boolean"),
            "error": {
                "type": ["object", "null"],
                "properties": { "code": { "type": "string" }, "detail": { "type": "string" } },
            },
            "created_at": time,
            "started_at": { "type": ["string", "null"], "format": "date-time" },
            "finished_at": time,
        },
    });
    let body = json!({
        "type": "object",
        "required": ["type", "timestamp", "data"],
        "properties": {
            "type": { "type": "string", "enum": ["job.succeeded", "job.failed", "job.cancelled"] },
            "timestamp": time,
            "data": data,
        },
    });
    // Describe its delivery.
    json!({ "jobEnded": { "post": {
        "operationId": "jobEnded",
        "tags": ["jobs"],
        "summary": "The end of a job",
        "description": WEBHOOK,
        "parameters": [
            required_header("webhook-id", "Names the notice; repetitions have the same"),
            required_header("webhook-timestamp", "Time of this delivery, in seconds since 1970"),
            required_header("webhook-signature", "`v1,` and a signature; several, with spaces between, while a secret is replaced"),
        ],
        "requestBody": {
            "required": true,
            "content": { "application/json": { "schema": body } },
        },
        "responses": {
            "2XX": { "description": "Received; the notice is not repeated" },
            "410": { "description": "The receiver wants no more of it; the notice is not repeated" },
        },
        "security": [],
    } } })
}

/// Returns the description of a header of a webhook.
fn required_header(name: &str, description: &str) -> Value {
    json!({
        "name": name, "in": "header", "required": true, "schema": { "type": "string" },
        "description": description,
    })
}

/// Returns the schema of a value that may be null.
fn nullable(kind: &str) -> Value {
    json!({ "type": [kind, "null"] })
}

/// Returns the table of codes: those of the service, then those of unusable inputs.
fn table_of_codes() -> Value {
    let own = Code::ALL.iter().map(|code| code.row());
    let causes = CAUSES.iter().map(|&(word, title)| (word, 422, title));
    own.chain(causes)
        .map(|(word, status, title)| json!({ "code": word, "status": status, "title": title }))
        .collect()
}

/// Describes the request body of an upload: a form or raw bytes, with options in the form or the query.
fn describe_upload(document: &mut Value, path: &str, options: &[&str]) {
    // Add the options to the query.
    let is_job = OF_ANY_KIND.contains(&path);
    let parameters = schemas::parameters(&document["components"]["schemas"], options);
    let options: Vec<Value> = options.iter().map(|name| reference(name)).collect();
    let operation = &mut document["paths"][path]["post"];
    if let Some(known) = operation["parameters"].as_array_mut() {
        known.extend(parameters);
    }
    // Describe the parts of the form.
    let input = json!({ "type": "string", "format": "binary", "description": "The input, with its file name" });
    let mut schema = json!({
        "type": "object",
        "properties": {
            "mesh": input,
            "options": { "anyOf": options },
            "resource": {
                "type": "array",
                "items": bytes(),
                "description": "Files that the input references (buffers, images, the mesh of a problem); the file name of \
                    each is the relative path used in the input",
            },
        },
    });
    if is_job {
        schema["properties"]["image"] = input;
        schema["properties"]["priority"] =
            json!({ "type": "integer", "minimum": -100, "maximum": 100 });
        schema["properties"]["accept"] =
            json!({ "type": "string", "description": "Gates, as in the query" });
        schema["properties"]["webhook"] = json!({ "type": "string", "format": "uri", "description": "Where the end of the job is posted" });
        schema["properties"]["metadata"] = json!({
            "type": "object",
            "description": "What the client notes of the job: at most 4096 bytes and 64 members",
        });
        schema["properties"]["problem"] = json!({
            "type": "string",
            "format": "binary",
            "contentMediaType": "application/json",
            "contentSchema": reference("ProblemFile"),
            "description": "A problem file of `solve`, with its file name",
        });
        schema["oneOf"] = json!([{ "required": ["mesh"] }, { "required": ["image"] }, { "required": ["problem"] }]);
    } else {
        schema["required"] = json!(["mesh"]);
    }
    // Add raw bodies of every media type.
    let mut content = Map::new();
    let mut encoding = json!({ "options": { "contentType": "application/json" } });
    if is_job {
        encoding["metadata"] = encoding["options"].clone();
    }
    content.insert(
        "multipart/form-data".to_owned(),
        json!({ "schema": schema, "encoding": encoding }),
    );
    let others = other_types().filter(|_| is_job);
    for media_type in surface_types().chain(others) {
        content.insert(media_type.to_owned(), json!({ "schema": bytes() }));
    }
    operation["requestBody"] = json!({
        "required": true,
        "description": "The input as a form, with the files it references, or the bytes of a single file",
        "content": content,
    });
}

// Keys in the OpenAPI document: how they are sent, and which scopes each operation requires.

/// Names of the security schemes.
const BEARER: &str = "key";
const OF_PAGE: &str = "page";

/// Adds the security requirements of all operations; those at `open` paths have none.
fn describe(document: &mut Value, open: &[String]) {
    document["components"]["securitySchemes"] = json!({
        BEARER: {
            "type": "http",
            "scheme": "bearer",
            "description": "A key that `unwrapd keys create` made. Without any key, a service asks for none.",
        },
        OF_PAGE: {
            "type": "apiKey",
            "in": "cookie",
            "name": COOKIE,
            "description": "The cookie of a page that signed in",
        },
    });
    let paths = document["paths"].as_object_mut();
    for (path, operations) in paths.into_iter().flatten() {
        let operations = operations.as_object_mut();
        for (method, operation) in operations.into_iter().flatten() {
            if open.contains(path) {
                operation["security"] = json!([]);
            } else {
                ask(operation, method, path);
            }
        }
    }
}

fn ask(operation: &mut Value, method: &str, path: &str) {
    // Name the scopes. The empty alternative stands for services without keys.
    let method = method.to_ascii_uppercase();
    let method = Method::from_bytes(method.as_bytes()).unwrap_or_default();
    let scopes: Vec<&str> = needed(&method, path).into_iter().map(Scope::word).collect();
    operation["security"] = json!([{ BEARER: scopes }, { OF_PAGE: scopes }, {}]);
    let mut codes = vec![
        Code::KeyRequired,
        Code::KeyRefused,
        Code::MissingScope,
        Code::RateLimited,
    ];
    // Pages of other sites must not change anything or open a WebSocket.
    if method != Method::GET || !operation["responses"]["101"].is_null() {
        codes.push(Code::ForeignOrigin);
    }
    // Merge the rejections into the declared responses of the same status.
    let mut refusals = json!(problems(&codes));
    let challenge = json!({ "description": "How to send a key", "schema": { "type": "string" } });
    refusals["401"]["headers"] = json!({ "WWW-Authenticate": challenge });
    for (status, refusal) in refusals.as_object().into_iter().flatten() {
        let answer = &mut operation["responses"][status];
        match answer["description"].as_str() {
            Some(known) => {
                let both = format!("{known}; {}", refusal["description"].as_str().unwrap_or(""));
                answer["description"] = both.into();
            }
            None => *answer = refusal.clone(),
        }
    }
    let answers = operation["responses"].as_object_mut();
    answers.into_iter().for_each(Map::sort_keys);
}
