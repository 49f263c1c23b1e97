// Conversion of a scene to the soup that is analyzed: its triangles by mesh and atlas.

import { type BufferGeometry, type Mesh, type SkinnedMesh, Vector3 } from "three";
import type { Group, Part, Soup, Texture } from "../analysis/soup";
import type { Loaded, UvRecord } from "./loading";
import { attributeOf } from "./uv_sets";

/** Selection of UVs. */
export interface Shown {
  record: UvRecord;
  /** UV set of a primitive, if the file has several. */
  texcoord: (mesh: number, primitive: number) => number;
}

interface Place { mesh: number; primitive: number; material: number | null; name: string; materialName: string }

/** Returns the triangles of a scene with the selected UVs. */
export function soupOf(loaded: Loaded, { record, texcoord }: Shown): Soup {
  loaded.scene.updateMatrixWorld(true);
  const parts: Part[] = [];
  const groups: Group[] = [];
  const first = new Map<string, number>();
  const inScene = record.separate_nodes === true;
  let unnamed = 0;
  loaded.scene.traverse((object) => {
    const mesh = object as Mesh;
    if (!mesh.isMesh) return;
    const place = placeOf(loaded, mesh) ?? { mesh: unnamed++, primitive: 0, material: null, name: mesh.name, materialName: "" };
    const key = `${place.mesh}/${place.primitive}`;
    const group = groupIndex(groups, record.group_by ?? (loaded.parser ? "mesh" : "scene"), place);
    const copyOf = inScene ? -1 : (first.get(key) ?? -1);
    first.set(key, first.get(key) ?? parts.length);
    parts.push({ ...trianglesOf(mesh, texcoord(place.mesh, place.primitive), loaded.parser !== null), matrix: mesh.matrixWorld.toArray(), mesh: place.mesh, primitive: place.primitive, group, copyOf });
  });
  return { parts, groups, texture: textureOf(record), inScene };
}

/** Range of the measured faces of a primitive. */
export interface Origin { mesh: number; primitive: number; begin: number; count: number }

/** Returns the primitives that the measured faces of a soup come from, in order. */
export function originsOf({ parts }: Soup): Origin[] {
  let begin = 0;
  return parts.filter(({ copyOf }) => copyOf < 0).map(({ mesh, primitive, positions }) => {
    const count = positions.length / 9;
    begin += count;
    return { mesh, primitive, begin: begin - count, count };
  });
}

/** Returns the texture that a record describes. */
export function textureOf({ resolution = 1024, padding = 0 }: UvRecord): Texture {
  const [width = 1024, height = width] = String(resolution).split("x").map(Number);
  return { width, height, padding };
}

function placeOf({ parser }: Loaded, mesh: Mesh): Place | null {
  const associations = parser?.associations.get(mesh) as { meshes?: number; primitives?: number } | undefined;
  if (!parser || associations?.meshes === undefined) return null;
  const { meshes, materials } = parser.json as { meshes: { name?: string; primitives: { material?: number }[] }[]; materials?: { name?: string }[] };
  const primitive = associations.primitives ?? 0;
  const definition = meshes[associations.meshes]!;
  const material = definition.primitives[primitive]?.material ?? null;
  return {
    mesh: associations.meshes, primitive, material, name: definition.name || `mesh ${associations.meshes}`,
    materialName: material === null ? "" : materials?.[material]?.name || `material ${material}`,
  };
}

/** Returns the index of an atlas, which is named as in reports. */
function groupIndex(groups: Group[], by: NonNullable<UvRecord["group_by"]>, place: Place): number {
  const [name, label] = {
    scene: ["scene", "Whole scene"],
    mesh: [`mesh${place.mesh}`, place.name],
    primitive: [`mesh${place.mesh}/prim${place.primitive}`, `${place.name}, primitive ${place.primitive}`],
    material: place.material === null ? [`mesh${place.mesh}`, place.name] : [`material${place.material}`, place.materialName],
  }[by] as [string, string];
  const index = groups.findIndex((group) => group.name === name);
  return 0 <= index ? index : groups.push({ name, label }) - 1;
}

function trianglesOf(mesh: Mesh, texcoord: number, isGltf: boolean): Pick<Part, "positions" | "uvs" | "normals"> {
  const { geometry } = mesh;
  const corners = cornersOf(geometry);
  const uvs = spread(geometry, attributeOf(texcoord), corners, 2);
  // In glTF v points down, and three.js keeps it so; in OBJ it points up.
  if (uvs && isGltf) for (let i = 1; i < uvs.length; i += 2) uvs[i] = 1 - uvs[i]!;
  return { positions: posed(mesh, corners), uvs, normals: isPosed(mesh) ? null : spread(geometry, "normal", corners, 3) };
}

function cornersOf({ index, attributes }: BufferGeometry): Uint32Array {
  const count = index ? index.count : (attributes.position?.count ?? 0);
  return Uint32Array.from({ length: count - (count % 3) }, (_, k) => (index ? index.getX(k) : k));
}

function spread({ attributes }: BufferGeometry, name: string, corners: Uint32Array, width: 2 | 3): Float32Array | null {
  const attribute = attributes[name];
  if (!attribute) return null;
  const values = new Float32Array(width * corners.length);
  corners.forEach((vertex, k) => {
    values[width * k] = attribute.getX(vertex);
    values[width * k + 1] = attribute.getY(vertex);
    if (width === 3) values[3 * k + 2] = attribute.getZ(vertex);
  });
  return values;
}

function isPosed(mesh: Mesh): boolean {
  return (mesh as SkinnedMesh).isSkinnedMesh === true || (mesh.morphTargetInfluences?.some(Boolean) ?? false);
}

/** Returns positions after applying bones and morph targets. */
function posed(mesh: Mesh, corners: Uint32Array): Float32Array {
  if (!isPosed(mesh)) return spread(mesh.geometry, "position", corners, 3)!;
  const values = new Float32Array(3 * corners.length);
  const point = new Vector3();
  corners.forEach((vertex, k) => mesh.getVertexPosition(vertex, point).toArray(values, 3 * k));
  return values;
}
