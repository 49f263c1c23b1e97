// The report as a page.

import type { Analysis, Atlas } from "../analysis/analysis";
import { MEASURES } from "../analysis/distortion";
import { address, fileOf, type Job } from "./api";
import { histogram } from "./charts_svg";
import { button, byId, element } from "./dom";
import { duration, percent, plain, short, whole } from "./format";
import { generic } from "./inspector";
import { type Claim, claimed, claims, type GroupReport, measure, measured, type Report } from "./reports";
import { MEASURE_NAMES } from "./toolbar";

/** Contents of a report. */
export interface Shown {
  job: Job;
  report: Report | null;
  /** Analyses of the result, and of its input with its own UVs. */
  analysis: Analysis | null;
  before: Analysis | null;
  atlas: number;
  /** Shows a face in both views. */
  flyTo: (face: number) => void;
}

/** Fills the page. */
export function showReport(shown: Shown): void {
  const { job, report } = shown;
  const atlas = shown.analysis?.atlases[shown.atlas];
  const parts: (Node | null)[] = [
    element("h2", { className: "first", textContent: job.filename }),
    report?.proven ? certificate(claims(report.proven), report.certified) : null,
    compared(shown),
    atlas?.isMapped ? histograms(atlas) : null,
    atlas?.isMapped && shown.analysis ? worst(shown.analysis, atlas, shown.flyTo) : null,
    measured(report).length ? atlases(measured(report)) : null,
    report && !report.groups ? block("Numbers", generic(report)) : null,
    pictures(job), report?.seconds ? times(report.seconds) : null,
  ];
  byId("report").replaceChildren(element("div", { className: "sheet" }, ...parts.filter((part) => part !== null)));
}

function block(title: string, ...content: (Node | null)[]): HTMLElement {
  return element("section", {}, element("h3", { textContent: title }), ...content);
}

function certificate(all: Claim[], certified: boolean | null | undefined): HTMLElement {
  const rows = all.map(({ holds, text, detail }) => element("li", { className: holds ? "holds" : "fails" },
    element("span", { className: "tick", aria: { hidden: "true" }, textContent: holds ? "✓" : "✕" }),
    element("div", {}, element("b", { textContent: claimed({ holds, text, detail }) }), element("p", { textContent: detail }))));
  const title = certified === null || certified === undefined ? "What is proven" : certified ? "Certified" : "Not certified";
  return block(title, element("ul", { className: "certificate" }, ...rows));
}

function table(head: string[], rows: (string | Node)[][]): HTMLElement {
  return element("div", { className: "scroll", tabIndex: 0, aria: { role: "region", label: head[0] || "Table" } }, element("table", {},
    element("thead", {}, element("tr", {}, ...head.map((text) => element("th", { scope: "col", textContent: text })))),
    element("tbody", {}, ...rows.map(([name, ...cells]) => element("tr", {}, element("th", { scope: "row" }, name!), ...cells.map((cell) => element("td", {}, cell)))))));
}

function compared({ analysis, before }: Shown): HTMLElement | null {
  if (!analysis || !before?.atlases.some(({ isMapped }) => isMapped)) return null;
  const rows: [string, (one: Analysis) => string][] = [
    ["Charts", ({ charts }) => whole(charts)],
    ["Seam length", ({ seamLength }) => short(seamLength)],
    ["Mean symmetric Dirichlet", (one) => short(meanOf(one, 0))],
    ["Mean angle distortion", (one) => short(meanOf(one, 1))],
    ["Covered share of the texture", ({ atlases }) => percent(atlases.reduce((sum, { fill }) => sum + fill, 0) / atlases.length)],
    ["Flipped faces", ({ atlases }) => whole(atlases.reduce((sum, { flipped }) => sum + flipped, 0))],
    ["Overlapping pairs", ({ atlases }) => whole(atlases.reduce((sum, { overlapping }) => sum + overlapping, 0))],
  ];
  return block("Before and after", table(["", "Before", "After"], rows.map(([name, of]) => [name, of(before), of(analysis)])));
}

/** Returns the mean of a measure over all atlases, weighted by area as in reports. */
function meanOf({ atlases }: Analysis, k: number): number {
  const known = atlases.filter(({ spreads }) => spreads[k]);
  const area = known.reduce((sum, one) => sum + one.area, 0);
  return known.reduce((sum, one) => sum + one.area * one.spreads[k]!.mean, 0) / area;
}

function histograms({ spreads, label }: Atlas): HTMLElement {
  const drawn = MEASURES.map((name, k) => {
    const spread = spreads[k];
    if (!spread) return null;
    const title = MEASURE_NAMES[name];
    return element("figure", {}, element("figcaption", {}, element("b", { textContent: title }), ` mean ${short(spread.mean)}, 99 % below ${short(spread.p99)}`), histogram(spread, title));
  });
  return block(`How distortion is spread: ${label}`, element("div", { className: "figures" }, ...drawn));
}

function worst({ values, chart }: Analysis, { spreads }: Atlas, flyTo: (face: number) => void): HTMLElement {
  const rows = (spreads[0]?.worst ?? []).map((face) => [
    button(`Face ${whole(face)}`, () => flyTo(face), { className: "link", title: "Show it in both views" }),
    whole(chart[face]! + 1), ...[0, 1, 2, 3].map((k) => short(values[4 * face + k])),
  ]);
  return block("Worst faces", table(["Face", "Chart", ...MEASURES.map((name) => MEASURE_NAMES[name])], rows));
}

function atlases(groups: GroupReport[]): HTMLElement {
  const columns: [string, (group: GroupReport) => string][] = [
    ["Faces", (group) => whole(measure(group, "faces") ?? 0)],
    ["Charts", (group) => whole(measure(group, "charts") ?? 0)],
    ["Seams / √area", (group) => short(measure(group, "seam_over_sqrt_area"))],
    ["Mean energy", (group) => short(measure(group, "sym_dirichlet_mean"))],
    ["99 % below", (group) => short(measure(group, "sym_dirichlet_p99"))],
    ["Covered", (group) => percent(measure(group, "pack_unit") ?? 0)],
    ["Texels per unit", (group) => short(group.texels_per_unit)],
    ["Overlaps", (group) => whole(measure(group, "overlap_pairs") ?? 0)],
  ];
  return block("Atlases", table(["Atlas", ...columns.map(([name]) => name)], groups.map((group) => [group.label, ...columns.map(([, of]) => of(group))])));
}

function pictures(job: Job): HTMLElement | null {
  const made = [["layout.png", "UV layout"], ["heatmap.png", "Heat map"]] as const;
  const drawn = made.map(([role, caption]) => {
    const file = fileOf(job, role);
    if (!file) return null;
    const image = element("img", { src: address(file.href), alt: `${caption} of ${job.filename}`, loading: "lazy", width: 512, height: 512, className: "drawn" });
    return element("figure", {}, element("a", { href: address(file.href) }, image), element("figcaption", { textContent: caption }));
  });
  return drawn.some(Boolean) ? block("Pictures", element("div", { className: "figures" }, ...drawn)) : null;
}

function times(seconds: Record<string, number>): HTMLElement {
  return block("Time", table(["Stage", "Wall clock"], Object.entries(seconds).filter(([, value]) => typeof value === "number").map(([name, value]) => [plain(name), duration(1000 * value)])));
}
