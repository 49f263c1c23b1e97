// Display of each kind of job in the views.

import { address, download, fileOf, type FileLink, type Job } from "./api";
import type { Source } from "./source";
import { type Chosen, modelOfJob } from "./store";
import { extension, SHOWN } from "../viewer/formats";
import type { Report } from "./reports";

/** Display of a job. */
export type Shape = { surface: Source } | { pictures: [string, string][] } | { nothing: string };

/** Returns the display of a succeeded job. */
export async function shapeOf(job: Job, report: Report | null, input: Chosen | null): Promise<Shape> {
  const result = fileOf(job, "result");
  if (job.kind === "warp" && result) {
    const given = job.links.inputs.slice(0, 1).map(({ href }): [string, string] => [address(href), "Before"]);
    return { pictures: [...given, [address(result.href), "After"]] };
  }
  if (!result) {
    const record = { padding: Number(job.options.padding ?? 0), resolution: (job.options.resolution ?? 1024) as number | string };
    return input && SHOWN.includes(extension(input.name)) ? { surface: { ...input, model: modelOfJob(job), record } } : { nothing: "This job has no mesh to show. Its report is beside." };
  }
  if (!SHOWN.includes(extension(result.name))) return { nothing: `There is no view of ${extension(result.name)} files here. Download ${result.name}, or see the report.` };
  const others = job.links.files.filter(({ href }) => href.includes("/files/"));
  const content = await download(result.href);
  return { surface: { name: result.name, model: modelOfJob(job), content, resources: await resources(others), ...written(report) } };
}

/** Returns the UV set that a report names as written, primitive by primitive. */
function written(report: Report | null): Pick<Source, "texcoord"> {
  const primitives = report?.written?.primitives;
  if (!primitives?.length) return {};
  const sets = new Map(primitives.map(({ mesh, primitive, texcoord }) => [`${mesh}/${primitive}`, texcoord]));
  return { texcoord: (mesh, primitive) => sets.get(`${mesh}/${primitive}`) ?? primitives[0]!.texcoord };
}

/** Fetches the input of a job from the service. */
export async function inputOf(job: Job): Promise<Chosen | null> {
  const [mesh, ...others] = job.links.inputs;
  if (!mesh || !SHOWN.includes(extension(mesh.name))) return null;
  return { name: mesh.name, content: await download(mesh.href), resources: await resources(others) };
}

async function resources(files: FileLink[]): Promise<Map<string, Blob>> {
  return new Map(await Promise.all(files.map(async ({ href, name }) => [name, await download(href)] as const)));
}
