// Files dropped anywhere on the page.

import { byId } from "./dom";

/** Accepts dropped files, and highlights the drop zone while files are dragged. */
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
