// Files that a person gives, with their paths.

import { extension } from "../viewer/formats";

/** A file with its path in the folder or archive that it came in. */
export interface Given {
  path: string;
  content: Blob;
}

/** Returns the files of a dialog. */
export function chosenIn(input: HTMLInputElement): Given[] {
  const files = [...(input.files ?? [])].map((file) => ({ path: file.webkitRelativePath || file.name, content: file }));
  // The same file can be chosen again.
  input.value = "";
  return files;
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
