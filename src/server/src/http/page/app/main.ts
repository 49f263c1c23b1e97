// The page: creates its parts and connects them.

import { type Place, readPlace, START, writePlace } from "./address";
import type { Analysis } from "../analysis/analysis";
import { analyzed } from "./analyst";
import { ArrangeView } from "../arrange/arrange_view";
import { arrangeKeys } from "../arrange/keys";
import { address, call, download, fileOf, type Job } from "./api";
import { byId, element, pairs } from "./dom";
import { takeDropped } from "./dropped";
import { followStage } from "./follow_stage";
import { bytes, short, whole } from "./format";
import { JobList } from "./job_list";
import { JobView, note } from "./job_view";
import { listen, showKeys } from "./keys";
import { load, NoView } from "../viewer/loading";
import { showReport } from "./report_page";
import { type Caller, showCaller } from "./sign_in";
import { type Chosen, Setup } from "./setup";
import { soupOf } from "../viewer/soups";
import { showLegend, showPointed } from "./status";
import { startTheme } from "./theme";
import { nameInHand, nameShown } from "./title";
import { pullKeys } from "../pull/keys";
import { PullView } from "../pull/pull_view";
import { Toolbar } from "./toolbar";
import { viewKeys } from "./view_keys";
import { Viewer } from "./viewer";

const viewer = new Viewer();
const toolbar = new Toolbar(viewer, change, () => void compare());
const list = new JobList((id) => void open(id));
const setup = new Setup({ shown: (chosen) => void preview(chosen), made, failed });
const jobs = new JobView({ viewer, list, setup, failed, ended: solved, removed: () => void open(null), shown: refresh });
const pull = new PullView({ failed, chosen: () => nameInHand(pull.name), changed: refresh, baked: (job) => { void list.refresh(); void open(job.id, { ...START }); } });
const arrange = new ArrangeView(viewer, { failed, open: (job) => open(job, { ...viewer.place, face: null, chart: null, seam: null }), changed: refresh });
let before: Analysis | null = null;
let isBefore = false;

const TABS = ["view", "report", "pull"] as const;

// ---- state

/** Changes the state and everything that shows it. */
function change(changes: Partial<Place>): void {
  const { set } = viewer.place;
  viewer.apply({ ...viewer.place, ...changes });
  if (viewer.place.set !== set) void viewer.again().catch(failed);
  refresh();
}

/** Shows the state everywhere. */
function refresh(): void {
  const { place } = viewer;
  toolbar.refresh(isBefore, jobs.report !== null && jobs.input !== null);
  showLegend(viewer, change);
  arrange.offer(isResult() ? jobs.job : null, jobs.report);
  if (!arrange.isOn) showPointed(viewer);
  for (const tab of TABS) {
    byId(`tab-${tab}`).setAttribute("aria-selected", String(place.tab === tab));
    byId(tab).hidden = place.tab !== tab;
  }
  byId("title-state").textContent = isBefore ? "before" : "";
  if (place.tab === "report") void report();
  if (place.tab === "pull") offer();
  const isPulled = place.tab === "pull" && pull.isActive;
  byId("inspector").hidden = isPulled;
  byId("pull-facts").hidden = !isPulled;
  nameInHand(place.tab === "pull" ? pull.name : null);
  writePlace(place);
}

/** Returns whether the views show the result of the job, not its input or another UV set. */
function isResult(): boolean {
  const { facts } = viewer;
  return !isBefore && facts?.set === facts?.first;
}

/** Offers the file that is shown to the pull view. */
function offer(): void {
  const { job } = jobs;
  const result = job?.state === "succeeded" ? fileOf(job, "result") : undefined;
  const known = { isMapped: viewer.analysis?.atlases.some(({ isMapped }) => isMapped) ?? false, isFlat: viewer.model?.isFlat ?? false };
  if (job && result) pull.offer({ name: result.name, job: job.id }, known);
  else pull.offer(setup.chosen[0] ?? null, known);
}

/** Hides the last problem. */
function solved(): void {
  byId("problem").hidden = true;
}

function failed(error: unknown): void {
  const text = error instanceof Error ? error.message : String(error);
  const close = element("button", { type: "button", textContent: "Close", on: { click: () => (byId("problem").hidden = true) } });
  byId("problem").replaceChildren(element("span", { textContent: text }), close);
  byId("problem").hidden = false;
}

// ---- files and jobs

/** Opens a job, or the chosen file if there is none. */
async function open(id: string | null, place: Place = { ...START, tab: viewer.place.tab }): Promise<void> {
  solved();
  before = null;
  isBefore = false;
  writePlace({ ...place, job: id }, id !== viewer.place.job);
  viewer.apply({ ...place, job: id });
  list.select(id);
  refresh();
  try {
    if (id) await jobs.open(id);
    else if (setup.chosen[0]) await preview(setup.chosen[0]);
    else await sample();
  } catch (error) {
    viewer.clear();
    jobs.leave();
    nameShown("Not found");
    byId("inspector").replaceChildren();
    failed(error);
  }
  refresh();
}

/** Loads the sample mesh. */
async function sample(): Promise<void> {
  const chosen: Chosen = { name: "spot.ply", content: await download("assets/sample.ply"), resources: new Map(), from: [-0.8, 0.3, -1] };
  setup.choose([chosen]);
}

/** Shows a chosen file before a job is made. */
async function preview(chosen: Chosen): Promise<void> {
  jobs.leave();
  list.select(null);
  isBefore = false;
  const { shade, measure, seams, wire, problems, cells, aim, tab } = viewer.place;
  viewer.place = { ...START, ...{ shade, measure, seams, wire, problems, cells, aim }, tab: tab === "pull" ? tab : START.tab };
  nameShown(chosen.name);
  note("Reading the file …");
  solved();
  byId("inspector").replaceChildren();
  try {
    viewer.clear();
    if (await viewer.show({ ...chosen, isTurning: true })) describe(viewer.analysis);
  } catch (error) {
    if (setup.looked !== chosen || jobs.job) return;
    note(error instanceof NoView ? error.message : "");
    if (!(error instanceof NoView)) failed(error);
    byId("inspector").replaceChildren(element("section", {}, element("h2", { textContent: "File" }), pairs([["Name", chosen.name], ["Size", bytes(chosen.content.size)]])));
  }
  refresh();
}

/** Describes a file without a job. */
function describe(analysis: Analysis | null): void {
  if (!analysis) return;
  const isMapped = analysis.atlases.some((atlas) => atlas.isMapped);
  const unmapped = isMapped ? analysis.atlases.reduce((sum, atlas) => sum + atlas.unmapped, 0) : 0;
  note(isMapped ? "" : "No UVs yet. Unwrap makes them.");
  byId("inspector").replaceChildren(element("section", {}, element("h2", { textContent: "File" }), pairs([
    ["Faces", whole(analysis.faces)], ["Surface area", short(analysis.area)], ["UV charts", isMapped ? whole(analysis.charts) : "none"],
    ...(unmapped ? [["Faces without UVs", whole(unmapped)] as [string, string]] : []),
  ])), element("section", { className: "intro" }, element("h2", { textContent: "What comes back" }),
    element("p", { textContent: "The same mesh with UVs in which no face is flipped and no two overlap. That is proven on the bytes of the file." })));
}

function made(created: Job[]): void {
  created.forEach((job, k) => jobs.remember(job, setup.chosen[k]!));
  void list.refresh();
  const { camera, shade, measure, seams, wire, problems, cells, aim } = viewer.place;
  const isSeen = viewer.facts?.source.content === setup.chosen[0]?.content;
  const solid = viewer.stage?.solid;
  // Keep the camera of a person who has turned the mesh.
  const kept = isSeen && solid && !solid.isTurning ? solid.place : null;
  void open(created[0]!.id, { ...START, shade, measure, seams, wire, problems, cells, aim, camera: isSeen ? (kept ?? camera) : null });
}

// ---- report, before and after

async function report(): Promise<void> {
  const { job } = jobs;
  if (!job) {
    byId("report").replaceChildren(element("p", { className: "none", textContent: "The report of a job is shown here. Unwrap a mesh, or choose a job." }));
    return;
  }
  const show = () => showReport({ job, report: jobs.report, analysis: isResult() ? viewer.analysis : null, before, atlas: viewer.atlas, flyTo: visit });
  show();
  const source = jobs.before();
  if (before || !source) return;
  const loaded = await load(source).catch(() => null);
  if (!loaded) return;
  const { record = {} } = source;
  before = await analyzed(soupOf(loaded, { record, texcoord: () => record.texcoord ?? 0 }));
  if (jobs.job === job && viewer.place.tab === "report") show();
}

/** Shows a face in both views. */
function visit(face: number): void {
  change({ tab: "view", aim: "face", face, chart: null, seam: null });
  viewer.stage?.resize();
  viewer.flyTo(face);
}

/** Toggles between the UVs of the input and the result. */
async function compare(): Promise<void> {
  const source = jobs.before();
  if (!source || !jobs.report) return;
  isBefore = !isBefore;
  await (isBefore ? viewer.show(source) : jobs.showResult()).catch(failed);
  if (isBefore && !viewer.analysis?.atlases.some(({ isMapped }) => isMapped)) note("The input has no UVs.");
  refresh();
}

// ---- keys and events

function wire(): void {
  const [views, pulls, arranges] = [viewKeys({ viewer, setup, arrange, change, compare }), pullKeys(pull), arrangeKeys(arrange)];
  const keys = () => (viewer.place.tab === "pull" ? pulls : viewer.place.tab === "view" && arrange.isOn ? arranges : views);
  listen(keys);
  byId("keys-button").addEventListener("click", () => showKeys(keys()));
  for (const tab of TABS) byId(`tab-${tab}`).addEventListener("click", () => change({ tab }));
  viewer.pointing.onHover = () => arrange.isOn || showPointed(viewer);
  viewer.pointing.onSelect = () => change({});
  viewer.changed = refresh;
  startTheme(() => viewer.apply(viewer.place));
  addEventListener("popstate", () => {
    const place = readPlace();
    if (place.job !== viewer.place.job) void open(place.job, place);
    else change(place);
  });
  takeDropped((files) => (viewer.place.tab === "pull" && pull.isActive ? pull.takeFiles(files) : setup.takeFiles(files)));
}

/** Signs out, and removes all data of the caller from this browser. */
async function signOut(): Promise<void> {
  await call("v1/sign-in", { method: "DELETE" });
  location.hash = "";
  location.reload();
}

wire();
if (viewer.stage) followStage(viewer, viewer.stage, jobs);
void call<Caller>("v1/sign-in").then((caller) => showCaller(caller, () => void signOut().catch(failed)), failed);
// Expose the views to scripts that drive the page.
Object.assign(window, { unwrapd: { viewer, address } });
const first = readPlace();
await Promise.all([list.refresh(), open(first.job, first)]);
