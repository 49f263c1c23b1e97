// Shows the OpenAPI document of this service.

const byId = (id) => document.getElementById(id);

function element(tag, properties = {}, ...children) {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children);
  return made;
}

// Text in which `words between backticks` are code and empty lines divide paragraphs.
function prose(text) {
  return (text ?? "").split("\n\n").filter(Boolean).map((paragraph) => {
    const parts = paragraph.split("`").map((part, index) => (index % 2 ? element("code", { textContent: part }) : part));
    return element("p", {}, ...parts);
  });
}

function typeOf(schema = {}) {
  if (schema.$ref) return schema.$ref.split("/").pop();
  for (const word of ["oneOf", "anyOf", "allOf"]) {
    if (schema[word]) return schema[word].map(typeOf).join(word === "allOf" ? " and " : " or ");
  }
  if (schema.enum) return schema.enum.join(", ");
  const type = [schema.type ?? "any"].flat().join(" or ");
  return schema.items ? `${type} of ${typeOf(schema.items)}` : type;
}

// A parameter that is a list comes as its JSON text.
function schemaOf(parameter) {
  return parameter.schema ?? parameter.content["application/json"].schema;
}

function table(rows) {
  return element("table", {}, element("tbody", {}, ...rows.map((cells) => element("tr", {}, ...cells.map((cell) => element("td", {}, ...[cell].flat()))))));
}

function operation(method, path, described) {
  const parts = [...prose(described.description)];
  if (described.parameters?.length) {
    const rows = described.parameters.map((one) => [element("code", { textContent: one.name }), `${one.in}, ${typeOf(schemaOf(one))}`, prose(one.description)]);
    parts.push(element("h3", { textContent: "Parameters" }), table(rows));
  }
  if (described.requestBody) {
    parts.push(element("h3", { textContent: "Body" }), ...prose(described.requestBody.description), element("p", {}, element("code", { textContent: Object.keys(described.requestBody.content).join(", ") })));
  }
  const answers = Object.entries(described.responses).map(([status, one]) => [status, prose(one.description), Object.keys(one.content ?? {}).join(", ")]);
  parts.push(element("h3", { textContent: "Answers" }), table(answers));
  const summary = element("summary", {}, element("span", { className: "method", textContent: method.toUpperCase() }), element("code", { textContent: path }), ` ${described.summary ?? ""}`);
  return element("details", { className: "operation", id: described.operationId }, summary, ...parts);
}

const api = await (await fetch("/openapi.json")).json();
byId("version").textContent = `version ${api.info.version}`;
byId("description").replaceChildren(...prose(api.info.description));
const operations = Object.entries(api.paths).flatMap(([path, methods]) => Object.entries(methods).map(([method, described]) => ({ path, method, described })));
for (const tag of ["synchronous", "jobs", "results", "service"]) {
  byId("operations").append(element("h2", { textContent: tag }));
  for (const { path, method, described } of operations.filter((one) => one.described.tags.includes(tag))) {
    byId("operations").append(operation(method, path, described));
  }
}
for (const { code, status, title } of api["x-problems"]) {
  byId("problems").append(element("tr", { id: code }, element("td", {}, element("code", { textContent: code })), element("td", { textContent: status }), element("td", { textContent: title })));
}
for (const [name, schema] of Object.entries(api.components.schemas)) {
  const summary = element("summary", {}, element("code", { textContent: name }));
  byId("schemas").append(element("details", { className: "operation", id: `schema-${name}` }, summary, element("pre", { textContent: JSON.stringify(schema, null, 2) })));
}
document.getElementById(location.hash.slice(1))?.scrollIntoView();
