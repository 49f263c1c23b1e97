// Files that are dropped anywhere on the page.

import { byId } from "./dom";

/** Takes them, and has the place for them show that it would. */
export function takeDropped(take: (files: File[]) => void): void {
  const [page, place] = [document.documentElement, byId("drop")];
  for (const kind of ["dragenter", "dragover"]) {
    page.addEventListener(kind, (event) => { event.preventDefault(); place.classList.add("over"); });
  }
  page.addEventListener("dragleave", (event) => { if (!(event as DragEvent).relatedTarget) place.classList.remove("over"); });
  page.addEventListener("drop", (event) => {
    event.preventDefault();
    place.classList.remove("over");
    take([...((event as DragEvent).dataTransfer?.files ?? [])]);
  });
}
