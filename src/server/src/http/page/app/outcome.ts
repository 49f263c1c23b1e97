// The outcome of a job, and the stages on the way, in words.

import { isFinal, type Job, type Progress } from "./api";

/** Returns the outcome of a job as a word for style sheets. */
export function outcome(job: Job): "certified" | "open" | "failed" | "cancelled" | "done" {
  if (job.state === "failed" || job.state === "cancelled") return job.state;
  return job.certified === null ? "done" : job.certified ? "certified" : "open";
}

/** The outcomes in words. */
export const OUTCOMES: Record<ReturnType<typeof outcome>, string> = { certified: "certified", open: "not certified", failed: "failed", cancelled: "cancelled", done: "done" };

const STAGES: Record<string, string> = {
  read: "Reading the file", cut: "Finding seams", map: "Relaxing charts", deform: "Deforming", pack: "Packing the atlas",
  bake: "Resampling textures", write: "Writing the result", judge: "Proving the result",
};

/** Describes the current work of a job. */
export function doing({ stage, state }: Progress): string {
  if (isFinal(state)) return "Fetching the result";
  return STAGES[stage ?? ""] ?? "Starting";
}
