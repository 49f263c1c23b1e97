// Ways to pull a file, and the session that does so.

import { address, call } from "../app/api";
import { modelOf } from "../app/store";
import { extension } from "../viewer/formats";

/** A way to pull a file. */
export interface Way {
  name: string;
  title: string;
  kind: "deform" | "warp" | "edit_uv" | "texture_map" | "repack";
  options: Record<string, unknown>;
  /** Set if UVs are pulled. */
  isMap: boolean;
}

const way = (name: string, title: string, kind: Way["kind"], options: Way["options"] = {}): Way => ({ name, title, kind, options, isMap: kind === "edit_uv" || kind === "texture_map" });

const UVS = way("UVs", "Anchors pull the UVs; the shapes that they have are kept", "edit_uv");
const TEXTURE = way("UVs to a texture", "Anchors pull the UVs inside fixed borders; the shapes of the surface are kept", "texture_map");
const CAGE = way("Surface in a cage", "A cage of cubes around the surface is pulled and carries it along", "deform", { cage: 14 });
const PLANAR = way("Planar mesh", "The triangles of a mesh in the plane are pulled", "deform");
const SOLID = way("Mesh", "The tetrahedra, or the triangles of the plane, are pulled", "deform");
const PICTURE = way("Picture", "A grid over the picture is pulled", "warp");
const DRAWING = way("Outline", "The outline is filled with triangles, which are pulled", "deform");

/** Extensions of files that can be pulled. */
export const ACCEPTED = ".glb,.gltf,.obj,.ply,.stl,.off,.msh,.mesh,.tet,.png,.jpg,.jpeg,.webp,.svg";

/** Facts about a surface, and the UV set of it that is shown. */
export interface Known { isMapped: boolean; isFlat: boolean; set: number }

/** Returns the ways to pull a file, the likeliest first; all of them if nothing is known of a surface. */
export function waysOf(name: string, known: Known | null): Way[] {
  switch (extension(name)) {
    case "png": return [PICTURE, DRAWING];
    case "jpg": case "jpeg": case "webp": return [PICTURE];
    case "svg": return [DRAWING];
    case "msh": case "mesh": case "tet": return [SOLID];
    default:
      if (!known) return [CAGE, PLANAR, UVS, TEXTURE];
      return [...(known.isFlat ? [PLANAR] : []), ...(known.isMapped ? [UVS, TEXTURE].map((one) => ofSet(one, known.set)) : []), ...(known.isFlat ? [] : [CAGE])];
  }
}

/** Returns a way that pulls another UV set. */
function ofSet(way: Way, set: number): Way {
  return set === 0 ? way : { ...way, options: { ...way.options, texcoord: set } };
}

/** Input of a session: a file, or the result of a job. */
export type Origin = { name: string; content: Blob; resources: Map<string, Blob> } | { name: string; job: string };

/** Identifies what is pulled and how. */
export function pulledOf(origin: Origin, way: Way): string {
  return ["job" in origin ? origin.job : modelOf(origin), way.name, ...Object.values(way.options)].join(" ");
}

/** A session, in the JSON of the service. */
export interface Session {
  id: string;
  kind: Way["kind"];
  filename: string;
  links: { self: string; live: string; bake: string };
}

/** Opens a session. */
export async function openSession(origin: Origin, { kind, options }: Pick<Way, "kind" | "options">): Promise<Session> {
  if ("job" in origin) {
    const query = new URLSearchParams({ job: origin.job, kind });
    for (const [name, value] of Object.entries(options)) query.set(name, String(value));
    return call(`v1/sessions?${query}`, { method: "POST" });
  }
  const form = new FormData();
  form.append("options", JSON.stringify(options));
  form.append("mesh", origin.content, origin.name);
  for (const [name, file] of origin.resources) form.append("resource", file, name);
  return call(`v1/sessions?kind=${kind}`, { method: "POST", body: form });
}

/** Returns the address of a session's WebSocket. */
export function socketOf(session: Session): URL {
  const url = new URL(address(session.links.live), document.baseURI);
  url.protocol = url.protocol.replace("http", "ws");
  return url;
}
