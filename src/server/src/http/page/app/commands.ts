// Equivalents of a job on other interfaces: curl and the command line.

import { needsKey } from "./sign_in";

/** Quotes a word for a shell. */
function quoted(word: string): string {
  return /^[\w@%+=:,./-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`;
}

function text(value: unknown): string {
  return typeof value === "string" ? value : JSON.stringify(value);
}

/** Name of the form part that holds the input of a kind. */
const PART: Record<string, string> = { warp: "image", solve: "problem" };

/** Returns the curl command that submits this job. */
export function curl(kind: string, filename: string, options: Record<string, unknown>): string {
  const url = new URL("v1/jobs", document.baseURI).href;
  const parts = [["-F", `kind=${kind}`], ["-F", `${PART[kind] ?? "mesh"}=@${filename}`]];
  if (Object.keys(options).length) parts.push(["-F", `options=${JSON.stringify(options)}`]);
  // The shell inserts the key, which is not on the page.
  const key = needsKey() ? ['-H "Authorization: Bearer $UNWRAPD_KEY"'] : [];
  return ["curl -s", quoted(url), ...key, ...parts.flat().map(quoted)].join(" ");
}

/** Returns the command that does the same without the service; null if handles or islands would need a file. */
export function commandLine(kind: string, filename: string, options: Record<string, unknown>): string | null {
  if (!["unwrap", "repack", "measure", "verify"].includes(kind) || "islands" in options) return null;
  const { format = "glb", ...others } = options;
  const stem = filename.replace(/\.[^.]*$/, "");
  const flags = Object.entries(others).flatMap(([name, value]) => {
    const flag = `--${name.replaceAll("_", "-")}`;
    return value === true ? [flag] : [flag, text(value)];
  });
  const output = kind === "measure" || kind === "verify" ? [] : ["-o", `${stem}-${kind}.${text(format)}`];
  return ["unwrapd", kind === "measure" ? "verify" : kind, filename, ...output, ...flags].map(quoted).join(" ");
}

/** Copies a text to the clipboard. Returns false if that is not allowed. */
export async function copy(text: string): Promise<boolean> {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    return false;
  }
}
