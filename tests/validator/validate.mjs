// Reads paths of glTF files, one per line, and prints for each the codes of its errors as a JSON array. With --counts prints how many
// errors, warnings, infos and hints there are instead, and of these how many unused objects that are no UV sets; null for a file that
// cannot be read.
import { readFileSync } from "node:fs";
import { basename, dirname, join } from "node:path";
import { validateBytes } from "gltf-validator";

const counts = process.argv.includes("--counts");
for (const path of readFileSync(0, "utf8").split("\n").filter(Boolean)) {
  let found;
  try {
    const { issues } = await validateBytes(new Uint8Array(readFileSync(path)), {
      uri: basename(path),
      maxIssues: 0,
      externalResourceFunction: async (uri) =>
        new Uint8Array(readFileSync(join(dirname(path), decodeURIComponent(uri)))),
    });
    const { numErrors, numWarnings, numInfos, numHints, messages } = issues;
    const isUnused = (m) => m.code === "UNUSED_OBJECT" && !m.pointer.includes("/attributes/TEXCOORD_");
    const unused = messages.filter(isUnused).length;
    const codes = messages.filter((m) => m.severity === 0).map((m) => m.code);
    found = counts ? [numErrors, numWarnings, numInfos, numHints, unused] : codes;
  } catch (error) {
    found = counts ? null : [`UNREADABLE ${error}`];
  }
  console.log(JSON.stringify(found));
}
