// Shows the OpenAPI document of this service.

import { byId, element, prose } from "../app/dom";

interface Schema { $ref?: string; type?: string | string[]; enum?: unknown[]; items?: Schema; oneOf?: Schema[]; anyOf?: Schema[]; allOf?: Schema[] }
interface Parameter { name: string; in: string; description?: string; schema?: Schema; content?: Record<string, { schema: Schema }> }
interface Described {
  operationId: string; summary?: string; description?: string; tags: string[]; parameters?: Parameter[];
  requestBody?: { description?: string; content: Record<string, unknown> };
  responses: Record<string, { description?: string; content?: Record<string, unknown> }>;
}
interface Document {
  info: { version: string; description: string };
  paths: Record<string, Record<string, Described>>;
  components: { schemas: Record<string, Schema> };
  "x-problems": { code: string; status: number; title: string }[];
}

// Empty lines divide paragraphs.
function paragraphs(text: string | undefined): HTMLElement[] {
  return (text ?? "").split("\n\n").filter(Boolean).map((paragraph) => element("p", {}, ...prose(paragraph)));
}

function typeOf(schema: Schema = {}): string {
  if (schema.$ref) return schema.$ref.split("/").pop() ?? "";
  for (const word of ["oneOf", "anyOf", "allOf"] as const) {
    const parts = schema[word];
    if (parts) return parts.map(typeOf).join(word === "allOf" ? " and " : " or ");
  }
  if (schema.enum) return schema.enum.join(", ");
  const type = [schema.type ?? "any"].flat().join(" or ");
  return schema.items ? `${type} of ${typeOf(schema.items)}` : type;
}

// A parameter that is a list comes as its JSON text.
function schemaOf(parameter: Parameter): Schema | undefined {
  return parameter.schema ?? parameter.content?.["application/json"]?.schema;
}

function table(rows: (string | HTMLElement | HTMLElement[])[][]): HTMLElement {
  return element("table", {}, element("tbody", {}, ...rows.map((cells) => element("tr", {}, ...cells.map((cell) => element("td", {}, ...[cell].flat()))))));
}

function operation(method: string, path: string, described: Described): HTMLElement {
  const parts: HTMLElement[] = [...paragraphs(described.description)];
  if (described.parameters?.length) {
    const rows = described.parameters.map((one) => [element("code", { textContent: one.name }), `${one.in}, ${typeOf(schemaOf(one))}`, paragraphs(one.description)]);
    parts.push(element("h3", { textContent: "Parameters" }), table(rows));
  }
  if (described.requestBody) {
    parts.push(element("h3", { textContent: "Body" }), ...paragraphs(described.requestBody.description), element("p", {}, element("code", { textContent: Object.keys(described.requestBody.content).join(", ") })));
  }
  const answers = Object.entries(described.responses).map(([status, one]) => [status, paragraphs(one.description), Object.keys(one.content ?? {}).join(", ")]);
  parts.push(element("h3", { textContent: "Answers" }), table(answers));
  const summary = element("summary", {}, element("span", { className: "method", textContent: method.toUpperCase() }), element("code", { textContent: path }), ` ${described.summary ?? ""}`);
  return element("details", { className: "operation", id: described.operationId }, summary, ...parts);
}

const api: Document = await (await fetch("openapi.json")).json();
byId("version").textContent = `version ${api.info.version}`;
byId("description").replaceChildren(...paragraphs(api.info.description));
const operations = Object.entries(api.paths).flatMap(([path, methods]) => Object.entries(methods).map(([method, described]) => ({ path, method, described })));
for (const tag of ["synchronous", "jobs", "results", "sessions", "access", "service"]) {
  byId("operations").append(element("h2", { textContent: tag }));
  for (const { path, method, described } of operations.filter((one) => one.described.tags.includes(tag))) {
    byId("operations").append(operation(method, path, described));
  }
}
for (const { code, status, title } of api["x-problems"]) {
  byId("problems").append(element("tr", { id: code }, element("td", {}, element("code", { textContent: code })), element("td", { textContent: String(status) }), element("td", { textContent: title })));
}
for (const [name, schema] of Object.entries(api.components.schemas)) {
  const summary = element("summary", {}, element("code", { textContent: name }));
  byId("schemas").append(element("details", { className: "operation", id: `schema-${name}` }, summary, element("pre", { textContent: JSON.stringify(schema, null, 2) })));
}
document.getElementById(location.hash.slice(1))?.scrollIntoView();
