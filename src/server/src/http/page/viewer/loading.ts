// Files as three.js scenes: glTF with its resources, OBJ, PLY, STL, OFF.

import { BufferAttribute, BufferGeometry, InstancedMesh, LoadingManager, Mesh, MeshStandardMaterial, type Object3D, type SkinnedMesh } from "three";
import { GLTFLoader, type GLTFParser } from "three/addons/loaders/GLTFLoader.js";
import { OBJLoader } from "three/addons/loaders/OBJLoader.js";
import { PLYLoader } from "three/addons/loaders/PLYLoader.js";
import { STLLoader } from "three/addons/loaders/STLLoader.js";
import { extension, resourceAt } from "./formats";

/** A file with the files that it may reference. */
export interface Bundle {
  name: string;
  content: Blob;
  /** Files by the paths that the main file uses. */
  resources: Map<string, Blob>;
}

/** A loaded file. */
export interface Loaded {
  scene: Object3D;
  /** The file's record of UVs that this program wrote. */
  record: UvRecord | null;
  parser: GLTFParser | null;
  /** Names of pictures that are not shown: those that were not chosen, and those that cannot be read. */
  missing: string[];
}

/** Record of UVs, as in `asset.extras.unwrapd`. */
export interface UvRecord {
  texcoord?: number;
  group_by?: "scene" | "mesh" | "material" | "primitive";
  separate_nodes?: boolean;
  padding?: number;
  resolution?: number | string;
  pages?: number;
  mips?: number;
}

/** Error of a file that may be valid, but that the page cannot show. */
export class NoView extends Error {}

/** One white pixel, in place of pictures that were not chosen. */
const WHITE = "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mP8/5+hHgAHggJ/PchI7wAAAABJRU5ErkJggg==";

/** Name of pictures inside a file. */
const EMBEDDED = "an embedded picture";

/** Loads a file; errors say what to do. */
export async function load(bundle: Bundle): Promise<Loaded> {
  const kind = extension(bundle.name);
  if (kind === "glb" || kind === "gltf") return loadGltf(bundle);
  const plain = (scene: Object3D, missing: string[] = []): Loaded => ({ scene, record: null, parser: null, missing });
  if (kind === "obj") return parseObj(bundle).then(({ scene, missing }) => plain(withoutPlaceholders(scene), missing));
  if (kind === "ply") return plain(meshOf(new PLYLoader().parse(await bundle.content.arrayBuffer())));
  if (kind === "stl") return plain(meshOf(new STLLoader().parse(await bundle.content.arrayBuffer())));
  if (kind === "off") return plain(meshOf(parseOff(await bundle.content.text())));
  if (kind === "zip") throw new NoView("The archive cannot be read here. Unwrap it to be told what is wrong with it.");
  throw new NoView(`There is no view of .${kind} files here. The job works on it all the same.`);
}

async function parseObj({ content, resources }: Bundle): Promise<{ scene: Object3D; missing: string[] }> {
  const text = await content.text();
  const loader = new OBJLoader();
  if (!resources.size) return { scene: loader.parse(text), missing: [] };
  const { creator, missing } = await (await import("../demand")).materialsOf(text, resources);
  return { scene: loader.setMaterials(creator).parse(text), missing };
}

/** Replaces zeros by NaN: three.js gives them to faces without UVs if other faces of the object have UVs. */
function withoutPlaceholders(scene: Object3D): Object3D {
  scene.traverse((object) => {
    const uv = (object as Partial<Mesh>).geometry?.getAttribute("uv");
    if (!uv) return;
    const { array } = uv;
    for (let k = 0; k + 6 <= array.length; k += 6) {
      if (array.subarray(k, k + 6).every((x) => x === 0)) array.fill(Number.NaN, k, k + 6);
    }
  });
  return scene;
}

function meshOf(geometry: BufferGeometry): Mesh {
  return new Mesh(geometry, new MeshStandardMaterial());
}

async function loadGltf({ content, resources }: Bundle): Promise<Loaded> {
  const manager = new LoadingManager();
  const assets = new URL("assets/", document.baseURI).href;
  // Addresses that stand for files, with their names, and the files that were not chosen or cannot be read.
  const made = new Map<string, string>();
  const missing = new Set<string>();
  const stand = (name: string, file: Blob) => {
    const url = URL.createObjectURL(file);
    made.set(url, name);
    return url;
  };
  manager.onError = (url) => missing.add(made.get(url) ?? EMBEDDED);
  let free = () => {};
  manager.setURLModifier((url) => {
    if (url.startsWith("blob:") || url.startsWith(assets)) return url;
    if (url.startsWith("data:")) return stand(EMBEDDED, embedded(url));
    const path = decodeURIComponent(url);
    const resource = resourceAt(resources, path);
    // Do not ask the service for the resources of a file that is not uploaded yet.
    if (!resource) {
      missing.add(path);
      return stand(path, isPicture(path) ? embedded(WHITE) : new Blob());
    }
    return stand(path, resource);
  });
  try {
    const loader = new GLTFLoader(manager);
    const isCompressed = (await extensionsOf(content)).some((extension) => COMPRESSED.includes(extension));
    if (isCompressed) free = await (await import("../demand")).addDecoders(loader, manager, assets);
    const gltf = await loader.parseAsync(await content.arrayBuffer(), "");
    if (!gltf.scene) throw new Error("it has no scene. Its meshes can be unwrapped all the same.");
    const extras: { unwrapd?: UvRecord } | undefined = gltf.parser.json.asset?.extras;
    return { scene: gltf.scene, record: extras?.unwrapd ?? null, parser: gltf.parser, missing: [...missing] };
  } catch (error) {
    const detail = String(error instanceof Error ? error.message : error);
    const buffer = [...missing].find((path) => path !== EMBEDDED && !isPicture(path));
    if (buffer) throw new NoView(`The file needs ${buffer}, which was not chosen with it. Choose both together.`);
    throw new Error(`The view cannot read this glTF${detail.startsWith("it has") ? `: ${detail}` : ". Unwrap it to be told what is wrong with it."}`);
  } finally {
    free();
    for (const url of made.keys()) URL.revokeObjectURL(url);
  }
}

function isPicture(path: string): boolean {
  return /\.(png|jpe?g|webp|ktx2|avif)$/i.test(path);
}

/** Decodes a `data:` address, which the page's security policy does not let loaders fetch. */
function embedded(url: string): Blob {
  const [, type = "", base64, content = ""] = /^data:([^,;]*)(?:;(?!base64)[^,;]*)*(;base64)?,(.*)$/s.exec(url) ?? [];
  const text = base64 ? atob(content) : decodeURIComponent(content);
  return new Blob([Uint8Array.from(text, (byte) => byte.charCodeAt(0))], { type });
}

/** Extensions of glTF that need a decoder. */
const COMPRESSED = ["KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_meshopt_compression", "KHR_texture_basisu"];

/** Magic number of binary glTF, and the bytes before its JSON. */
const GLB = 0x46546c67;
const GLB_HEADER = 20;

/** Returns the extensions that a glTF uses; none if it cannot be read. */
async function extensionsOf(content: Blob): Promise<string[]> {
  const header = new DataView(await content.slice(0, GLB_HEADER).arrayBuffer());
  const isBinary = header.byteLength === GLB_HEADER && header.getUint32(0, true) === GLB;
  const json = isBinary ? content.slice(GLB_HEADER, GLB_HEADER + header.getUint32(12, true)) : content;
  try {
    return (JSON.parse(await json.text()) as { extensionsUsed?: string[] }).extensionsUsed ?? [];
  } catch {
    return [];
  }
}

/** Parses the Object File Format: a line of counts, vertices, polygons. */
function parseOff(text: string): BufferGeometry {
  const words = text.replace(/#.*/g, "").trim().split(/\s+/);
  if (!/OFF$/.test(words[0] ?? "")) throw new Error("The file does not begin like an OFF file.");
  const numbers = words.slice(1).map(Number);
  const [vertices = 0, polygons = 0] = numbers;
  const positions = numbers.slice(3, 3 + 3 * vertices);
  const index: number[] = [];
  let at = 3 + 3 * vertices;
  for (let k = 0; k < polygons; k++) {
    const corners = numbers[at] ?? 0;
    for (let i = 2; i < corners; i++) index.push(numbers[at + 1]!, numbers[at + i]!, numbers[at + i + 1]!);
    at += 1 + corners;
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(Float32Array.from(positions), 3));
  geometry.setIndex(index);
  return geometry;
}

/** Frees the GPU memory of a scene. */
export function dispose(scene: Object3D): void {
  scene.traverse((object) => {
    const { geometry, material } = object as Partial<Mesh>;
    geometry?.dispose();
    // Bones and instances have textures and buffers of their own.
    (object as Partial<SkinnedMesh>).skeleton?.dispose();
    if (object instanceof InstancedMesh) object.dispose();
    for (const one of [material ?? []].flat()) {
      for (const value of Object.values(one)) {
        if (value && typeof value === "object" && "isTexture" in value) (value as unknown as { dispose(): void }).dispose();
      }
      one.dispose();
    }
  });
}

