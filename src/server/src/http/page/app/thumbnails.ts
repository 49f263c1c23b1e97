// Small pictures of jobs in the list, as the service makes them.

import { address, fileOf, type Job } from "./api";
import { element } from "./dom";

/** Seen in place of one that is not there. */
const NONE = "data:image/gif;base64,R0lGODlhAQABAAAAACH5BAEKAAEALAAAAAABAAEAAAICTAEAOw==";

/** The picture of a job, asked for as soon as it is seen. */
export function thumbnail(job: Job): HTMLImageElement {
  const made = fileOf(job, "thumbnail.png");
  const image = element("img", { width: 36, height: 36, alt: "", loading: "lazy", src: made ? address(made.href) : NONE });
  image.addEventListener("error", () => (image.src = NONE), { once: true });
  return image;
}
