// Files that are dropped anywhere on the page, in folders and archives.

import { extension } from "../viewer/formats";
import { byId } from "./dom";
import type { Given } from "./given";

/** Accepts dropped files and folders, and highlights the drop zone while they are dragged. */
export function takeDropped(take: (files: Given[]) => void, failed: (error: unknown) => void): void {
  const [page, place] = [document.documentElement, byId("drop")];
  for (const kind of ["dragenter", "dragover"]) {
    page.addEventListener(kind, (event) => { event.preventDefault(); place.classList.add("over"); });
  }
  page.addEventListener("dragleave", (event) => { if (!(event as DragEvent).relatedTarget) place.classList.remove("over"); });
  page.addEventListener("drop", (event) => {
    event.preventDefault();
    place.classList.remove("over");
    // The browser empties the list after the event.
    const entries = [...((event as DragEvent).dataTransfer?.items ?? [])].map((item) => item.webkitGetAsEntry()).filter((entry) => entry !== null);
    if (entries.length) void Promise.all(entries.map(filesIn)).then((files) => take(files.flat()), failed);
  });
}

/** Returns a dropped file, or all files in a dropped folder. */
async function filesIn(entry: FileSystemEntry): Promise<Given[]> {
  if (entry.isFile) {
    const content = await new Promise<File>((done, failed) => (entry as FileSystemFileEntry).file(done, failed));
    return [{ path: entry.fullPath.replace(/^\//, ""), content }];
  }
  const reader = (entry as FileSystemDirectoryEntry).createReader();
  const entries: FileSystemEntry[] = [];
  // A reader returns some entries at a time, and none at the end.
  const read = () => new Promise<FileSystemEntry[]>((done, failed) => reader.readEntries(done, failed));
  for (let some = await read(); some.length; some = await read()) entries.push(...some);
  return (await Promise.all(entries.map(filesIn))).flat();
}

/** Returns files with the contents of archives in their place, without hidden files. An archive that cannot be read here is
 * left to the service, which says what is wrong with it. */
export async function unpacked(files: Given[]): Promise<Given[]> {
  const parts = await Promise.all(files.map(async (file) => {
    if (extension(file.path) !== "zip") return [file];
    const { unzipSync } = await import("../demand");
    try {
      const entries = Object.entries(unzipSync(new Uint8Array(await file.content.arrayBuffer())));
      return entries.filter(([path]) => !path.endsWith("/")).map(([path, bytes]): Given => ({ path, content: new Blob([bytes]) }));
    } catch {
      return [file];
    }
  }));
  return parts.flat().filter(({ path }) => !path.split("/").some((name) => name.startsWith(".")));
}
