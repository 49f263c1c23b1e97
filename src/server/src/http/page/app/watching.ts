// Display of charts while a job relaxes them.

import { decodeMaps } from "../live/maps";
import { Relaxing } from "../viewer/relaxing";
import { type Job, maps, Refused } from "./api";
import { percent, whole } from "./format";
import type { Viewer } from "./viewer";

/** Delay after a response without a frame. Shorter delays mean more requests while a job is at other stages. */
const PAUSE_MS = 500;

/** Shows the charts of a running job until its result takes their place. Returns a function that stops. Calls
 * `elsewhere` if another machine computes the job, since only that one has its maps. */
export function watchCharts(job: Job, viewer: Viewer, elsewhere: () => void): () => void {
  const abort = new AbortController();
  // Errors only end the display; events report the state of the job.
  if (job.kind === "unwrap" && viewer.stage) void follow(job, viewer, elsewhere, abort.signal).catch(() => {});
  return () => abort.abort();
}

async function follow(job: Job, viewer: Viewer, elsewhere: () => void, signal: AbortSignal): Promise<void> {
  const relaxing = new Relaxing();
  for (let after = "0"; !signal.aborted;) {
    const answer = await maps(job, after, signal).catch((error: unknown) => {
      // Start over with the frames of a service that was restarted, since it counts them from the beginning.
      if (error instanceof Refused && error.problem.status < 500) throw error;
      return "gone" as const;
    });
    if (signal.aborted) return;
    if (answer === "elsewhere") return elsewhere();
    if (answer === "gone") after = "0";
    if (answer === "none" || answer === "gone") {
      await new Promise((over) => setTimeout(over, PAUSE_MS));
      continue;
    }
    const frame = decodeMaps(answer);
    after = frame.number;
    frame.maps.forEach((map) => relaxing.take(map));
    relaxing.arrange();
    viewer.relax(relaxing, described(relaxing));
  }
}

function described({ count, flips, share, isPlan }: Relaxing): string {
  const drawn = share < 1 ? `, ${percent(share)} of the faces drawn` : "";
  return `${whole(count)} ${count === 1 ? "chart" : "charts"}, as the solver has them · ${whole(flips)} flips${drawn}${isPlan ? " · seams of large charts are planned on a simplified copy" : ""}`;
}
