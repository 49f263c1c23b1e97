// The page: creates its parts and connects them.

import { type Place, readPlace, START } from "./address";
import type { Analysis } from "../analysis/analysis";
import type { BatchView } from "./batch";
import { analyzed } from "./analyst";
import { ArrangeView } from "../arrange/arrange_view";
import { arrangeKeys } from "../arrange/keys";
import { address, batchOf, call, connection, download, fileOf, type Job, Unanswered } from "./api";
import { byId, element, pairs } from "./dom";
import { startDivider } from "./divider";
import { takeDropped } from "./dropped";
import { followStage } from "./follow_stage";
import { bytes, sentence, short, whole } from "./format";
import { JobList } from "./job_list";
import { JobView, note } from "./job_view";
import type { Given } from "./given";
import { type Key, listen, showKeys } from "./keys";
import { forget } from "./memory";
import { load, NoView } from "../viewer/loading";
import { startNavigation } from "./navigation";
import { type Caller, showCaller } from "./sign_in";
import { Setup } from "./setup";
import { soupOf } from "../viewer/soups";
import { showLegend, showPointed } from "./status";
import { type Chosen, elsewhere, modelOf, modelOfJob, Store } from "./store";
import { startTheme } from "./theme";
import { showTitle } from "./title";
import type { PullView } from "../pull/pull_view";
import type { Known, Origin } from "../pull/what";
import { Toolbar } from "./toolbar";
import { viewKeys } from "./view_keys";
import { Viewer } from "./viewer";

const store = new Store(readPlace());
const viewer = new Viewer(store);
const toolbar = new Toolbar(viewer, change, compare);
const list = new JobList(store, (id) => void open(id), (listed) => { jobs.listed(listed); batch?.listed(listed); });
const setup = new Setup(store, { shown: (chosen) => void preview(chosen), made, pulled: (file) => void takeInHand([file]).catch(failed), failed });
const jobs = new JobView({ store, viewer, list, setup, failed, ended: solved, removed: () => void open(null), made });
const arrange = new ArrangeView(viewer, { failed, open: (job) => open(job, { ...store.place, face: null, chart: null, seam: null }), changed: refresh });
/** The views of a batch and of pulling, fetched when they are first shown. */
let batch: BatchView | null = null;
let pull: PullView | null = null;
/** Keys of the view of pulling. */
let pulls: Key[] = [];
/** Analysis of the input of the shown job, which the report compares with the result. */
let before: { job: Job; analysis: Analysis } | null = null;

const TABS = ["view", "report", "batch", "pull"] as const;

// ---- state

/** Changes what the address says. */
function change(changes: Partial<Place>): void {
  const { set } = store.place;
  store.go(changes);
  if (store.place.set !== set) void viewer.again().catch(failed);
}

/** Shows the state around the views. */
function refresh(): void {
  const { place, subject, inHand } = store.state;
  const job = subject.kind === "job" ? subject : null;
  toolbar.refresh(jobs.before() !== null);
  showLegend(viewer, change);
  arrange.offer(isResult() ? store.job : null, job?.report ?? null);
  if (!arrange.isOn) showPointed(viewer);
  for (const tab of TABS) {
    byId(`tab-${tab}`).setAttribute("aria-selected", String(place.tab === tab));
    byId(`tab-${tab}`).tabIndex = place.tab === tab ? 0 : -1;
    byId(tab).hidden = place.tab !== tab;
  }
  const isOfBatch = batchOf(store.job) !== null;
  byId("tab-batch").hidden = !isOfBatch;
  if (place.tab === "batch" && !isOfBatch && store.job?.id === place.job) return change({ tab: "view" });
  if (place.tab === "report") void report().catch(failed);
  if (place.tab === "batch") void showBatch().catch(failed);
  if (place.tab === "pull") void showPull().then((pull) => pull.offer(inHand ?? offered(), inHand ? null : known())).catch(failed);
  const isPulled = place.tab === "pull" && (inHand !== null || (pull?.isActive ?? false));
  byId("inspector").hidden = isPulled;
  byId("pull-facts").hidden = !isPulled;
  showTitle(store.state);
}

/** Returns whether the views show the result of the job, not its input or another UV set. */
function isResult(): boolean {
  const { facts } = viewer;
  return store.place.uvs !== "before" && facts?.set === facts?.first;
}

/** Returns the file that is shown, to be pulled: the result of a job, or a chosen file. */
function offered(): Origin | null {
  const { subject, chosen } = store.state;
  if (subject.kind === "file") return subject.file;
  const result = subject.kind === "job" && subject.job.state === "succeeded" ? fileOf(subject.job, "result") : undefined;
  return subject.kind === "job" && result ? { name: result.name, job: subject.job.id } : (chosen[0] ?? null);
}

/** Returns what is known of the shown file. */
function known(): Known {
  return { isMapped: viewer.analysis?.atlases.some(({ isMapped }) => isMapped) ?? false, isFlat: viewer.model?.isFlat ?? false, set: viewer.facts?.set ?? 0 };
}

/** Hides the last problem. */
function solved(): void {
  byId("problem").hidden = true;
}

function failed(error: unknown): void {
  const text = sentence(error instanceof Error ? error.message : String(error));
  const close = element("button", { type: "button", textContent: "Close", on: { click: solved } });
  byId("problem").replaceChildren(element("span", { textContent: text }), close);
  byId("problem").hidden = false;
}

// ---- files and jobs

/** Opens a job, or the chosen file if there is none, with the looks that the views have. */
async function open(id: string | null, place: Place = { ...elsewhere(store.place), tab: store.place.tab }): Promise<void> {
  solved();
  viewer.keepCameras();
  before = null;
  store.change({ inHand: null });
  const model = list.find(id);
  const camera = place.camera || place.plane || !model ? {} : store.cameraOf(modelOfJob(model));
  store.go({ ...place, ...camera, job: id }, id !== store.place.job);
  try {
    const [first] = store.state.chosen;
    if (id) await jobs.open(id);
    else if (first) await preview(first);
    else await sample();
  } catch (error) {
    jobs.leave();
    // What is not known for lack of an answer is opened once there is one.
    store.change({ subject: { kind: error instanceof Unanswered ? "none" : "missing" } });
    viewer.clear();
    byId("inspector").replaceChildren();
    if (!(error instanceof Unanswered)) failed(error);
  }
}

/** Loads the sample mesh. */
async function sample(): Promise<void> {
  setup.choose([{ name: "spot.ply", content: await download("assets/sample.ply"), resources: new Map(), from: [-0.8, 0.3, -1] }]);
}

/** Shows a chosen file before a job is made. */
async function preview(file: Chosen): Promise<void> {
  jobs.leave();
  viewer.keepCameras();
  const subject = { kind: "file", file } as const;
  store.change({ subject, inHand: null });
  const { tab } = store.place;
  store.go({ ...elsewhere(store.place), ...store.cameraOf(modelOf(file)), tab: tab === "pull" ? tab : START.tab });
  note("Reading the file …");
  solved();
  byId("inspector").replaceChildren();
  try {
    viewer.clear();
    if (await viewer.show({ ...file, model: modelOf(file), isTurning: true })) describe(viewer);
  } catch (error) {
    if (store.state.subject !== subject) return;
    viewer.clear();
    note(error instanceof NoView ? error.message : "");
    if (!(error instanceof NoView)) failed(error);
    byId("inspector").replaceChildren(element("section", {}, element("h2", { textContent: "File" }), pairs([["Name", file.name], ["Size", bytes(file.content.size)]])));
  }
}

/** Describes a file without a job. */
function describe({ analysis, facts }: Viewer): void {
  if (!analysis) return;
  const { missing = [] } = facts ?? {};
  const isMapped = analysis.atlases.some((atlas) => atlas.isMapped);
  const unmapped = isMapped ? analysis.atlases.reduce((sum, atlas) => sum + atlas.unmapped, 0) : 0;
  note(isMapped ? "" : "No UVs yet. Unwrap makes them.");
  byId("inspector").replaceChildren(element("section", {}, element("h2", { textContent: "File" }), pairs([
    ["Faces", whole(analysis.faces)], ["Surface area", short(analysis.area)], ["UV charts", isMapped ? whole(analysis.charts) : "none"],
    ...(unmapped ? [["Faces without UVs", whole(unmapped)] as [string, string]] : []),
    ...(missing.length ? [["Pictures not shown", missing.join(", ")] as [string, string]] : []),
  ])), element("section", { className: "intro" }, element("h2", { textContent: "What comes back" }),
    element("p", { textContent: "The same mesh with UVs in which no face is flipped and no two overlap. That is proven on the bytes of the file." })));
}

/** Lists a new job, and opens it unless it is a further one of several files. */
function made(job: Job, input: Chosen | null, isFurther = false): void {
  jobs.remember(job, input);
  list.add(job);
  batch?.add(job);
  void list.refresh();
  if (isFurther) return;
  // Where the form is below the views, they come into sight.
  scrollTo({ top: 0 });
  void open(job.id, { ...elsewhere(store.place), tab: batchOf(job) === null ? store.place.tab : "batch" });
}

// ---- report, before and after

async function report(): Promise<void> {
  const { subject } = store.state;
  if (subject.kind !== "job") {
    byId("report").replaceChildren(element("p", { className: "none", textContent: "The report of a job is shown here. Unwrap a mesh, or choose a job." }));
    return;
  }
  const { job } = subject;
  const { showReport } = await import("../demand");
  if (store.job !== job) return;
  const show = () => showReport({ job, report: subject.report, analysis: isResult() ? viewer.analysis : null, before: before?.analysis ?? null, atlas: viewer.atlas, flyTo: visit });
  show();
  const source = jobs.before();
  if (before || !source) return;
  const loaded = await load(source).catch(() => null);
  if (!loaded) return;
  const { record = {} } = source;
  const analysis = await analyzed(soupOf(loaded, { record, texcoord: () => record.texcoord ?? 0 }));
  if (store.job !== job) return;
  before = { job, analysis };
  if (store.place.tab === "report") show();
}

/** Shows a face in both views. */
function visit(face: number): void {
  change({ tab: "view", aim: "face", face, chart: null, seam: null });
  viewer.stage?.resize();
  viewer.flyTo(face);
}

/** Shows the UVs of the input, alone or beside the result, or the result alone again. */
function compare(uvs: "before" | "both"): void {
  // Charts and seams of other UVs have other numbers.
  if (jobs.before()) change({ uvs: store.place.uvs === uvs ? "after" : uvs, chart: null, seam: null });
}

// ---- batches

async function showBatch(): Promise<void> {
  const { BatchView } = await import("../demand");
  batch ??= new BatchView(store, { open: (id) => void open(id, elsewhere(store.place)), failed });
  batch.follow();
}

// ---- pulling

async function showPull(): Promise<PullView> {
  const { PullView, pullKeys } = await import("../demand");
  if (pull) return pull;
  pull = new PullView(store, { failed, changed: refresh, shown: () => (store.state.inHand ? null : viewer.shown), baked: (job) => { void list.refresh(); void open(job.id, { ...elsewhere(store.place) }); } });
  pulls = pullKeys(pull);
  return pull;
}

/** Shows files in the view of pulling. */
async function takeInHand(files: Given[]): Promise<void> {
  change({ tab: "pull" });
  (await showPull()).takeFiles(files);
}

// ---- keys and events

function wire(): void {
  const [views, arranges] = [viewKeys({ viewer, setup, arrange, change, compare }), arrangeKeys(arrange)];
  const keys = () => (store.place.tab === "pull" ? pulls : store.place.tab === "view" && arrange.isOn ? arranges : views);
  listen(keys);
  byId("keys-button").addEventListener("click", () => showKeys(keys()));
  for (const tab of TABS) byId(`tab-${tab}`).addEventListener("click", () => change({ tab }));
  document.querySelector(".tabs")!.addEventListener("keydown", (event) => stepTabs(event as KeyboardEvent));
  byId("skip").addEventListener("click", () => byId("plane").focus());
  viewer.pointing.onHover = () => arrange.isOn || showPointed(viewer);
  viewer.pointing.onSelect = change;
  viewer.changed = refresh;
  store.show(refresh);
  connection.changed = (isUp) => {
    byId("connection").hidden = isUp;
    if (!isUp) void list.refresh();
    else if (store.state.subject.kind === "none") void begin();
  };
  startDivider(store, change);
  startTheme(() => viewer.apply());
  addEventListener("popstate", () => {
    const place = readPlace();
    if (place.job !== store.place.job) void open(place.job, place);
    else change(place);
  });
  takeDropped((files) => void (store.place.tab === "pull" ? takeInHand(files).catch(failed) : setup.takeFiles(files)), failed);
}

/** Goes to the tab beside by the arrow keys. */
function stepTabs(event: KeyboardEvent): void {
  const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
  if (!step) return;
  const shown = TABS.filter((tab) => !byId(`tab-${tab}`).hidden);
  const tab = shown[(shown.indexOf(store.place.tab) + step + shown.length) % shown.length]!;
  change({ tab });
  byId(`tab-${tab}`).focus();
}

/** Signs out, and removes all data of the caller from this browser. */
async function signOut(): Promise<void> {
  await call("v1/sign-in", { method: "DELETE" });
  forget();
  location.hash = "";
  location.reload();
}

/** Shows whose page it is, the jobs, and what the address says, as soon as the service answers. */
async function begin(): Promise<void> {
  const who = call<Caller>("v1/sign-in").then((caller) => showCaller(caller, () => void signOut().catch(failed)), (error: unknown) => error instanceof Unanswered || failed(error));
  await Promise.all([who, list.refresh(), open(store.place.job, store.place)]);
}

wire();
if (viewer.stage) {
  followStage(viewer, viewer.stage);
  startNavigation(viewer.stage.solid);
}
// Expose the views to scripts that drive the page.
Object.assign(window, { unwrapd: { viewer, store, address } });
await begin();
