// Reactions to the stage's own changes: resting cameras, and the loss of the GPU.

import type { Stage } from "../viewer/stage";
import { byId } from "./dom";
import { showFallback } from "./job_view";
import { addCube } from "./view_cube";
import type { Viewer } from "./viewer";

/** Time for which cameras must rest before they are written to the state. Shorter times write it more often. */
const REST_MS = 400;

/** Keeps the cameras in the state, turns the cube, and survives the loss of the GPU. */
export function followStage(viewer: Viewer, stage: Stage): void {
  let timer = 0;
  const turnCube = addCube(stage.solid);
  stage.onFrame = () => {
    turnCube(stage.solid.camera);
    clearTimeout(timer);
    timer = setTimeout(() => viewer.keepCameras(), REST_MS);
  };
  const canvas = byId("canvas");
  canvas.addEventListener("webglcontextlost", (event) => {
    event.preventDefault();
    showFallback(viewer.store.job, "The graphics device was lost. Pictures are shown until it is back; the report is complete.");
  });
  canvas.addEventListener("webglcontextrestored", () => {
    showFallback(null);
    stage.restore();
  });
}
