// Formats by the names of files.

/** Extensions of files that can be shown. */
export const SHOWN = ["glb", "gltf", "obj", "ply", "stl", "off"];

export function extension(name: string): string {
  return name.split(".").pop()?.toLowerCase() ?? "";
}
