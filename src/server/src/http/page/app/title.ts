// The name of what is shown, in the bar and on the browser's tab.

import { batchOf } from "./api";
import { byId } from "./dom";
import { titleOf } from "./notes";
import type { State } from "./store";

/** Names what is shown. */
export function showTitle(state: State): void {
  const name = nameOf(state);
  byId("title").textContent = name || (state.subject.kind === "missing" ? "Not found" : "Loading …");
  const before = state.subject.kind === "job" && state.place.uvs === "before" ? "before" : "";
  byId("title-state").textContent = before;
  for (const pane of ["solid", "plane"]) byId(pane).dataset.uvs = before;
  document.title = name ? `${name} · unwrapd` : "unwrapd";
}

function nameOf({ place, subject, inHand }: State): string {
  if (place.tab === "pull" && inHand) return inHand.name;
  if (place.tab === "batch" && subject.kind === "job") return batchOf(subject.job) ?? "";
  if (subject.kind === "file") return subject.file.name;
  return subject.kind === "job" ? titleOf(subject.job) : "";
}
