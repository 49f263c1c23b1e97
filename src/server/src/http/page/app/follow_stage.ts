// What happens to the stage by itself.

import type { Stage } from "../viewer/stage";
import { writePlace } from "./address";
import { byId } from "./dom";
import { type JobView, showFallback } from "./job_view";
import type { Viewer } from "./viewer";

/** Cameras that rest so long are in the address. */
const REST_MS = 400;

/** Keeps the cameras in the address, and survives the loss of the GPU. */
export function followStage(viewer: Viewer, stage: Stage, jobs: JobView): void {
  let timer = 0;
  stage.onFrame = () => {
    clearTimeout(timer);
    // While a file is read, the cameras are still those of the one before.
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
