// Reactions to the stage's own changes: resting cameras, and the loss of the GPU.

import type { Stage } from "../viewer/stage";
import { writePlace } from "./address";
import { byId } from "./dom";
import { type JobView, showFallback } from "./job_view";
import type { Viewer } from "./viewer";

/** Time for which cameras must rest before they are written to the address. Shorter times write it more often. */
const REST_MS = 400;

/** Keeps the cameras in the address, and survives the loss of the GPU. */
export function followStage(viewer: Viewer, stage: Stage, jobs: JobView): void {
  let timer = 0;
  stage.onFrame = () => {
    clearTimeout(timer);
    // While a file is read, the cameras are still those of the previous one.
    if (stage.solid.isTurning || !jobs.job || !byId("panes").dataset.shown) return;
    const { job } = jobs;
    timer = setTimeout(() => {
      // Another job or file may have been opened since.
      if (jobs.job !== job || !byId("panes").dataset.shown) return;
      Object.assign(viewer.place, { camera: stage.solid.place, plane: stage.plane.place });
      writePlace(viewer.place);
    }, REST_MS);
  };
  const canvas = byId("canvas");
  canvas.addEventListener("webglcontextlost", (event) => {
    event.preventDefault();
    showFallback(jobs.job, "The graphics device was lost. Pictures are shown until it is back; the report is complete.");
  });
  canvas.addEventListener("webglcontextrestored", () => {
    showFallback(null);
    stage.redraw();
  });
}
