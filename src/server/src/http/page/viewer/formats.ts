// Files by their names: formats, and files that others name.

/** Extensions of files that can be shown. */
export const SHOWN = ["glb", "gltf", "obj", "ply", "stl", "off"];

export function extension(name: string): string {
  return name.split(".").pop()?.toLowerCase() ?? "";
}

/** Returns the file that another one names: at this path, or of this name in another folder. */
export function resourceAt(resources: Map<string, Blob>, path: string): Blob | undefined {
  const plain = path.replaceAll("\\", "/").replace(/^\.\//, "");
  return resources.get(plain) ?? resources.get(plain.split("/").pop() ?? "");
}
