// Uploads a mesh, shows how its job goes, and what came of it; shows jobs of any kind that others made. The options are read from
// the service's own description.

import { short, summary } from "./report.js";

const byId = (id) => document.getElementById(id);
const MESHES = ["glb", "gltf", "obj", "off", "ply", "stl"];
const FIRST = ["cut", "quality", "resolution", "padding", "rebake"];

let job = null;

function element(tag, properties = {}, ...children) {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children);
  return made;
}

function show(id, visible = true) {
  byId(id).hidden = !visible;
}

function showProblem(text) {
  byId("problem").textContent = text;
  show("problem", Boolean(text));
}

async function call(path, request = {}) {
  const answer = await fetch(path, request);
  if (answer.status === 204) return null;
  const body = await answer.json();
  if (!answer.ok) throw new Error(`${body.title}: ${body.detail}`);
  return body;
}

// ---- options

function variants(schema, schemas) {
  const resolved = (part) => (part.$ref ? schemas[part.$ref.split("/").pop()] : part);
  const parts = [schema, ...(schema.oneOf ?? []), ...(schema.allOf ?? [])].map(resolved);
  return parts.flatMap((part) => [part, ...(part.oneOf ?? [])]);
}

function choices(schema, schemas) {
  const parts = [schema, ...(schema.oneOf ?? []), ...(schema.allOf ?? [])];
  for (const part of parts) {
    const target = part.$ref ? schemas[part.$ref.split("/").pop()] : part;
    if (target?.enum) return target.enum;
    if (target?.oneOf?.every((one) => one.enum)) return target.oneOf.flatMap((one) => one.enum);
  }
  return null;
}

function input(schema, schemas) {
  const words = choices(schema, schemas);
  if (words) return element("select", {}, element("option", { value: "", textContent: "default" }), ...words.map((word) => element("option", { textContent: word })));
  if (schema.type === "boolean") return element("input", { type: "checkbox", value: "true" });
  if (variants(schema, schemas).some((one) => one.type === "string")) return element("input", { type: "text", placeholder: schema.default ?? "default" });
  return element("input", { type: "number", min: 0, step: "any", placeholder: schema.default ?? "default" });
}

async function buildOptions() {
  const description = await call("/openapi.json");
  const { schemas } = description.components;
  // Lists and unions with them are for programs.
  const isTyped = (one) => one.name in schemas.Options.properties && one.schema && !variants(one.schema, schemas).some((part) => part.type === "array" || part.anyOf);
  const parameters = description.paths["/v1/unwrap"].post.parameters.filter(isTyped);
  const rank = ({ name }) => (FIRST.indexOf(name) + FIRST.length + 1) % (FIRST.length + 1);
  const others = element("div");
  for (const parameter of parameters.toSorted((one, other) => rank(one) - rank(other))) {
    const field = input(parameter.schema, schemas);
    field.name = parameter.name;
    const label = element("label", { title: parameter.description ?? "" }, parameter.name.replaceAll("_", " "), field);
    (FIRST.includes(parameter.name) ? byId("options") : others).append(label);
  }
  byId("options").append(element("details", {}, element("summary", { textContent: "More" }), others));
}

// ---- upload

function extension(file) {
  return file.name.split(".").pop().toLowerCase();
}

function form(files) {
  const data = new FormData();
  const query = new URLSearchParams();
  for (const [name, value] of new FormData(byId("form"))) {
    if (value !== "") query.set(name, value);
  }
  const mesh = files.find((file) => MESHES.includes(extension(file))) ?? files[0];
  data.append("mesh", mesh, mesh.name);
  for (const file of files) {
    if (file !== mesh) data.append("resource", file, file.webkitRelativePath || file.name);
  }
  return { data, query };
}

async function submit(event) {
  event.preventDefault();
  showProblem("");
  show("result", false);
  const submitButton = byId("form").querySelector("button[type=submit]");
  submitButton.disabled = true;
  try {
    const { data, query } = form([...byId("files").files]);
    const made = await call(`/v1/jobs?${query}`, { method: "POST", body: data });
    history.replaceState(null, "", `#${made.id}`);
    showJob(made);
    await listJobs();
  } catch (error) {
    showProblem(error.message);
  } finally {
    submitButton.disabled = false;
  }
}

// ---- jobs

async function listJobs() {
  const { jobs } = await call("/v1/jobs?limit=10");
  byId("latest").replaceChildren(...jobs.map((one) => {
    const link = element("a", { href: `#${one.id}`, textContent: one.filename });
    return element("li", {}, element("span", { className: "method", textContent: one.kind.replaceAll("_", " ") }), link, ` ${one.state}`);
  }));
  show("jobs", jobs.length > 0);
}

function showJob(shown) {
  job = shown;
  showProblem("");
  show("result", false);
  byId("job-title").textContent = `${job.kind.replaceAll("_", " ")}: ${job.filename}`;
  show("job");
  showEvent(job);
  if (isFinal(job.state)) showEnd(job).catch((error) => showProblem(error.message));
  else watch(job);
}

async function showLinked() {
  const id = location.hash.slice(1);
  if (id && id !== job?.id) showJob(await call(`/v1/jobs/${encodeURIComponent(id)}`));
}

// ---- progress

function isFinal(state) {
  return ["succeeded", "failed", "cancelled"].includes(state);
}

function watch(watched, after = 0) {
  const address = new URL(`${watched.links.events}?after=${after}`, location.href);
  address.protocol = address.protocol.replace("http", "ws");
  let last = after;
  let over = false;
  const socket = new WebSocket(address);
  socket.onmessage = async (message) => {
    const event = JSON.parse(message.data);
    last = event.seq;
    if (watched.id !== job?.id) return socket.close();
    showEvent(event);
    if (isFinal(event.state)) {
      over = true;
      showEnd(await call(watched.links.self));
      listJobs();
    }
  };
  socket.onclose = () => {
    if (!over && watched.id === job?.id) setTimeout(() => watch(watched, last), 1000);
  };
}

function pairs(list, entries) {
  list.replaceChildren(...entries.map(([name, value]) => element("div", {}, element("dt", { textContent: name }), element("dd", { textContent: value }))));
}

function showEvent(event) {
  byId("state").textContent = event.stage ? `${event.state}: ${event.stage}` : event.state;
  byId("fraction").value = event.fraction;
  pairs(byId("numbers"), [
    ...(event.charts ? [["charts", `${event.chart} of ${event.charts}`]] : []),
    ["iteration", event.iteration],
    ["energy", short(event.energy)],
    ["smallest element", short(event.smallest)],
    ["seconds", (event.elapsed_ms / 1000).toFixed(1)],
  ]);
  byId("finish").disabled = byId("cancel").disabled = isFinal(event.state);
}

// ---- result

async function showEnd(ended) {
  if (ended.error) showProblem(`${ended.error.title}: ${ended.error.detail}`);
  if (ended.state !== "succeeded") return;
  const links = ended.links.files.map((file, index) => element("a", { href: file.href, download: file.name, textContent: file.name, className: index ? "" : "main" }));
  byId("downloads").replaceChildren(...links);
  byId("pictures").replaceChildren(...pictures(ended).map(([href, caption]) => element("figure", {}, element("img", { src: href, alt: caption }), element("figcaption", { textContent: caption }))));
  show("uncertified", ended.certified === false);
  byId("warnings").replaceChildren(...ended.warnings.map((warning) => element("li", { textContent: warning.message })));
  const report = await call(`${ended.links.self}/report`);
  pairs(byId("report"), summary(report));
  show("result");
}

function pictures(ended) {
  const captions = { "layout.png": "UV layout", "heatmap.png": "Distortion", result: ended.filename };
  const drawn = ended.links.files.filter((file) => file.name.endsWith(".png"));
  return drawn.map((file) => [file.href, captions[file.href.split("/").pop()] ?? file.name]);
}

// ---- wiring

function announceFiles() {
  byId("chosen").textContent = [...byId("files").files].map((file) => file.name).join(", ");
}

const drop = byId("drop");
for (const kind of ["dragenter", "dragover"]) {
  drop.addEventListener(kind, (event) => { event.preventDefault(); drop.classList.add("over"); });
}
for (const kind of ["dragleave", "drop"]) {
  drop.addEventListener(kind, () => drop.classList.remove("over"));
}
drop.addEventListener("drop", (event) => {
  event.preventDefault();
  byId("files").files = event.dataTransfer.files;
  announceFiles();
});
byId("files").addEventListener("change", announceFiles);
byId("form").addEventListener("submit", submit);
byId("cancel").addEventListener("click", () => call(job.links.self, { method: "DELETE" }).catch((error) => showProblem(error.message)));
byId("finish").addEventListener("click", () => call(`${job.links.self}/finish`, { method: "POST" }).catch((error) => showProblem(error.message)));
addEventListener("hashchange", () => showLinked().catch((error) => showProblem(error.message)));
Promise.all([buildOptions(), listJobs(), showLinked()]).catch((error) => showProblem(error.message));
