// Small pictures of jobs: made once from the pictures of the service, and kept by the browser.

import { address, fileOf, type Job } from "./api";

const PREFIX = "unwrapd-thumb-";
const SIDE = 72;
/** A picture of nothing. */
const NONE = "data:image/gif;base64,R0lGODlhAQABAAAAACH5BAEKAAEALAAAAAABAAEAAAICTAEAOw==";
/** So many are kept. */
const KEPT = 60;

/** Puts the picture of a job into an image as soon as it is seen. */
export function thumbnail(image: HTMLImageElement, job: Job): void {
  const source = fileOf(job, "layout.png") ?? (job.kind === "warp" ? fileOf(job, "result") : undefined);
  image.src = NONE;
  if (!source) return;
  const stored = localStorage.getItem(PREFIX + job.id);
  if (stored) {
    image.src = stored;
    return;
  }
  const observer = new IntersectionObserver((entries) => {
    if (!entries.some((entry) => entry.isIntersecting)) return;
    observer.disconnect();
    void small(address(source.href)).then((data) => {
      image.src = data;
      keep(job.id, data);
    }).catch(() => (image.src = NONE));
  });
  observer.observe(image);
}

async function small(url: string): Promise<string> {
  const picture = new Image();
  picture.src = url;
  await picture.decode();
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = SIDE;
  const context = canvas.getContext("2d")!;
  context.imageSmoothingQuality = "high";
  // Of several atlases, the first.
  const side = Math.min(picture.naturalWidth, picture.naturalHeight);
  context.drawImage(picture, 0, 0, side, side, 0, 0, SIDE, SIDE);
  return canvas.toDataURL("image/webp", 0.8);
}

/** Removes all pictures that are kept. */
export function forgetThumbnails(): void {
  for (const key of kept()) localStorage.removeItem(key);
}

function kept(): string[] {
  return Object.keys(localStorage).filter((key) => key.startsWith(PREFIX));
}

function keep(id: string, data: string): void {
  const keys = kept().sort();
  for (const key of keys.slice(0, Math.max(0, keys.length - KEPT))) localStorage.removeItem(key);
  try {
    localStorage.setItem(PREFIX + id, data);
  } catch {
    // Full: the picture is made again next time.
  }
}
