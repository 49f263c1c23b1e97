// Small pictures of jobs in the list, drawn by the service.

import { address, fileOf, type Job } from "./api";
import { element } from "./dom";

/** Shown in place of a missing picture. */
const NONE = "data:image/gif;base64,R0lGODlhAQABAAAAACH5BAEKAAEALAAAAAABAAEAAAICTAEAOw==";

/** Creates the picture of a job, which is requested when it becomes visible. */
export function thumbnail(job: Job): HTMLImageElement {
  const made = fileOf(job, "thumbnail.png");
  // A warped picture is no drawing, and looks alike in the dark.
  const className = job.kind === "warp" ? "" : "drawn";
  const image = element("img", { width: 36, height: 36, alt: "", loading: "lazy", className, src: made ? address(made.href) : NONE });
  image.addEventListener("error", () => (image.src = NONE), { once: true });
  return image;
}
