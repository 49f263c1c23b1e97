// Reads paths of glTF files, one per line, and prints for each the codes of its errors as a JSON array.
import { readFileSync } from "node:fs";
import { basename, dirname, join } from "node:path";
import { validateBytes } from "gltf-validator";

for (const path of readFileSync(0, "utf8").split("\n").filter(Boolean)) {
  let codes;
  try {
    const report = await validateBytes(new Uint8Array(readFileSync(path)), {
      uri: basename(path),
      maxIssues: 0,
      externalResourceFunction: async (uri) =>
        new Uint8Array(readFileSync(join(dirname(path), decodeURIComponent(uri)))),
    });
    codes = report.issues.messages.filter((m) => m.severity === 0).map((m) => m.code);
  } catch (error) {
    codes = [`UNREADABLE ${error}`];
  }
  console.log(JSON.stringify(codes));
}
