// Files that a person gives: dropped anywhere on the page or chosen in a dialog, in folders and archives.

import { extension } from "../viewer/formats";
import { byId } from "./dom";

/** A file with its path in the folder or archive that it came in. */
export interface Given {
  path: string;
  content: Blob;
}

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

/** Returns the files of a dialog. */
export function chosenIn(input: HTMLInputElement): Given[] {
  const files = [...(input.files ?? [])].map((file) => ({ path: file.webkitRelativePath || file.name, content: file }));
  // The same file can be chosen again.
  input.value = "";
  return files;
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

/** Returns the files that a mesh may reference, by their paths from it: those in the largest folder around it that has no other
 * mesh, or else in its own folder. */
export function resourcesOf(mesh: Given, meshes: Given[], others: Given[]): Map<string, Blob> {
  const own = folderOf(mesh.path);
  let around = own;
  for (let folder = own; folder; ) {
    folder = folderOf(folder.slice(0, -1));
    if (meshes.some((other) => other !== mesh && other.path.startsWith(folder))) break;
    around = folder;
  }
  return new Map(others.filter(({ path }) => path.startsWith(around)).map(({ path, content }) => [fromFolder(own, path), content]));
}

/** Returns the folder of a path, with a slash at its end, or nothing. */
function folderOf(path: string): string {
  return path.replace(/[^/]*$/, "");
}

/** Returns a path as seen from a folder. */
function fromFolder(folder: string, path: string): string {
  const up: string[] = [];
  for (; !path.startsWith(folder); folder = folderOf(folder.slice(0, -1))) up.push("../");
  return up.join("") + path.slice(folder.length);
}

/** Returns the name that files came under: of their folder or archive; null if they came one by one. */
export function nameOfAll(files: Given[]): string | null {
  const [first] = files;
  if (files.length === 1 && extension(first!.path) === "zip") return first!.path.replace(/\.zip$/i, "");
  const top = first?.path.split("/")[0];
  return top && files.every(({ path }) => path.startsWith(`${top}/`)) ? top : null;
}
