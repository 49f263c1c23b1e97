// Materials of OBJ files, with their pictures.

import { LoadingManager, type Material, Texture } from "three";
import { MTLLoader } from "three/addons/loaders/MTLLoader.js";
import { resourceAt } from "./formats";

/** Loads the materials that an OBJ file names, from the files beside it. Pictures that are missing or in another format than
 * browsers show are left out, and named. */
export async function materialsOf(obj: string, resources: Map<string, Blob>): Promise<{ creator: MTLLoader.MaterialCreator; missing: string[] }> {
  // A line names one file, which may have blanks in its name, or several.
  const lines = [...obj.matchAll(/^[ \t]*mtllib[ \t]+(.*\S)/gm)].map(([, names]) => names!);
  const files = lines.flatMap((names) => (resourceAt(resources, names) ? [names] : names.split(/\s+/)));
  const texts = await Promise.all(files.map((name) => resourceAt(resources, name)?.text()));
  const made = new Map<string, string>();
  const missing = new Set<string>();
  const manager = new LoadingManager();
  manager.setURLModifier((path) => {
    const url = URL.createObjectURL(resourceAt(resources, path) ?? new Blob());
    made.set(url, path);
    return url;
  });
  manager.onError = (url) => missing.add(made.get(url) ?? url);
  const creator = new MTLLoader(manager).parse(texts.join("\n"), "");
  await new Promise<void>((done) => {
    manager.onLoad = done;
    // There may be no picture to wait for.
    manager.itemStart("materials");
    creator.preload();
    manager.itemEnd("materials");
  });
  for (const url of made.keys()) URL.revokeObjectURL(url);
  Object.values(creator.materials).forEach(withoutMissing);
  return { creator, missing: [...missing] };
}

/** Removes pictures that could not be loaded, which would be black. */
function withoutMissing(material: Material): void {
  for (const [name, value] of Object.entries(material)) {
    if (value instanceof Texture && !value.image) Object.assign(material, { [name]: null });
  }
}
