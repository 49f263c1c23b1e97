// Materials of OBJ files, with their pictures.

import { LoadingManager, type Material, Texture } from "three";
import { MTLLoader } from "three/addons/loaders/MTLLoader.js";
import { resourceAt } from "./formats";

/** Loads the materials that an OBJ file names, from the files beside it. Pictures that are missing or in another format than
 * browsers show are left out. */
export async function materialsOf(obj: string, resources: Map<string, Blob>): Promise<MTLLoader.MaterialCreator> {
  // A line names one file, which may have blanks in its name, or several.
  const lines = [...obj.matchAll(/^[ \t]*mtllib[ \t]+(.*\S)/gm)].map(([, names]) => names!);
  const files = lines.flatMap((names) => (resourceAt(resources, names) ? [names] : names.split(/\s+/)));
  const texts = await Promise.all(files.map((name) => resourceAt(resources, name)?.text()));
  const made: string[] = [];
  const manager = new LoadingManager();
  manager.setURLModifier((path) => made[made.push(URL.createObjectURL(resourceAt(resources, path) ?? new Blob())) - 1]!);
  const creator = new MTLLoader(manager).parse(texts.join("\n"), "");
  await new Promise<void>((done) => {
    manager.onLoad = done;
    // There may be no picture to wait for.
    manager.itemStart("materials");
    creator.preload();
    manager.itemEnd("materials");
  });
  for (const url of made) URL.revokeObjectURL(url);
  Object.values(creator.materials).forEach(withoutMissing);
  return creator;
}

/** Removes pictures that could not be loaded, which would be black. */
function withoutMissing(material: Material): void {
  for (const [name, value] of Object.entries(material)) {
    if (value instanceof Texture && !value.image) Object.assign(material, { [name]: null });
  }
}
