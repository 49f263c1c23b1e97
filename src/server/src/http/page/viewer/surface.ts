// Meshes of an analysis in both views: its faces and the borders of its charts, with shared buffers.

import {
  BufferAttribute, BufferGeometry, DataTexture, DoubleSide, FloatType, GLSL3, InstancedBufferAttribute, InstancedBufferGeometry,
  Int8BufferAttribute, Mesh, NoBlending, NormalBlending, RGBAFormat, RGBAIntegerFormat, ShaderMaterial, UnsignedIntType,
} from "three";
import type { Analysis } from "../analysis/analysis";
import type { Uniforms } from "./look";
import { BORDER_FRAGMENT, BORDER_VERTEX, PICK_FRAGMENT, ROW, SURFACE_FRAGMENT, SURFACE_VERTEX } from "./shaders";

/** The two views. */
export type View = "solid" | "plane";

/** Meshes of a view, and the meshes drawn for picking instead. */
export interface Layer {
  surface: Mesh;
  overlay: Mesh;
  borders: Mesh;
  pickSurface: Mesh;
  pickBorders: Mesh;
}

/** The layers of both views. */
export interface Surface {
  /** Number that no other surface has. */
  id: number;
  layers: Record<View, Layer>;
  /** Size on the GPU, in bytes. */
  bytes: number;
  dispose(): void;
}

/** Number of surfaces that were created. */
let made = 0;

/** Creates the meshes of an analysis on the GPU. */
export function surfaceOf(analysis: Analysis, shared: Uniforms): Surface {
  const faces = faceGeometry(analysis);
  const borders = borderGeometry(analysis);
  const { values, ids } = faceTextures(analysis);
  shared.uValues.value = values;
  shared.uIds.value = ids;
  const layer = (view: View): Layer => ({
    surface: mesh(faces, material(shared, view, SURFACE_VERTEX, SURFACE_FRAGMENT)),
    overlay: mesh(faces, overlaid(material(shared, view, SURFACE_VERTEX, SURFACE_FRAGMENT, "OVERLAY"))),
    borders: mesh(borders, material(shared, view, BORDER_VERTEX, BORDER_FRAGMENT)),
    pickSurface: mesh(faces, material(shared, view, SURFACE_VERTEX, PICK_FRAGMENT)),
    pickBorders: mesh(borders, material(shared, view, BORDER_VERTEX, BORDER_FRAGMENT, "PICK")),
  });
  const layers = { solid: layer("solid"), plane: layer("plane") };
  layers.plane.borders.renderOrder = layers.solid.borders.renderOrder = 2;
  return {
    id: made++,
    layers,
    bytes: bytesOf(faces) + bytesOf(borders) + [values, ids].reduce((sum, one) => sum + (one.image.data as ArrayBufferView).byteLength, 0),
    dispose() {
      for (const { geometry, material } of Object.values(layers).flatMap((one) => Object.values(one) as Mesh[])) {
        geometry.dispose();
        (material as ShaderMaterial).dispose();
      }
      values.dispose();
      ids.dispose();
    },
  };
}

function mesh(geometry: BufferGeometry, material: ShaderMaterial): Mesh {
  const made = new Mesh(geometry, material);
  made.frustumCulled = false;
  return made;
}

function material(shared: Uniforms, view: View, vertexShader: string, fragmentShader: string, define = ""): ShaderMaterial {
  return new ShaderMaterial({
    glslVersion: GLSL3, vertexShader, fragmentShader, uniforms: { ...shared, uThick: { value: define === "PICK" ? 10 : 0 } },
    defines: { ...(view === "plane" ? { PLANE: 1 } : {}), ...(define ? { [define]: 1 } : {}) },
    side: DoubleSide, blending: NoBlending,
  });
}

function overlaid(material: ShaderMaterial): ShaderMaterial {
  Object.assign(material, { transparent: true, blending: NormalBlending, depthWrite: false, polygonOffset: true, polygonOffsetFactor: -1, polygonOffsetUnits: -4 });
  return material;
}

function faceGeometry({ drawn }: Analysis): BufferGeometry {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(drawn.positions, 3));
  geometry.setAttribute("normal", new Int8BufferAttribute(drawn.normals, 4, true));
  geometry.setAttribute("faceUv", new BufferAttribute(drawn.uvs, 2));
  geometry.computeBoundingSphere();
  return geometry;
}

function borderGeometry({ borders, chart, group }: Analysis): InstancedBufferGeometry {
  const geometry = new InstancedBufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(Float32Array.of(0, -1, 0, 1, -1, 0, 1, 1, 0, 0, 1, 0), 3));
  geometry.setIndex([0, 1, 2, 0, 2, 3]);
  const count = borders.face.length;
  const from = new Float32Array(3 * count);
  const to = new Float32Array(3 * count);
  const facts = new Uint32Array(4 * count);
  for (let k = 0; k < count; k++) {
    from.set(borders.ends.subarray(6 * k, 6 * k + 3), 3 * k);
    to.set(borders.ends.subarray(6 * k + 3, 6 * k + 6), 3 * k);
    const face = borders.face[k]!;
    facts.set([chart[face]!, group[face]! | (borders.marks[k]! << 16), borders.seam[k]!, k], 4 * k);
  }
  geometry.setAttribute("from", new InstancedBufferAttribute(from, 3));
  geometry.setAttribute("to", new InstancedBufferAttribute(to, 3));
  geometry.setAttribute("planeEnds", new InstancedBufferAttribute(borders.uvs, 4));
  const integers = new InstancedBufferAttribute(facts, 4);
  integers.gpuType = UnsignedIntType as unknown as typeof integers.gpuType;
  geometry.setAttribute("facts", integers);
  geometry.instanceCount = count;
  return geometry;
}

function faceTextures({ drawn, values, chart, group, marks }: Analysis): { values: DataTexture; ids: DataTexture } {
  const rows = Math.max(1, Math.ceil(drawn.count / ROW));
  const numbers = new Float32Array(4 * ROW * rows);
  const ids = new Uint32Array(4 * ROW * rows);
  drawn.face.forEach((face, k) => {
    numbers.set(values.subarray(4 * face, 4 * face + 4), 4 * k);
    ids[4 * k] = face;
    ids[4 * k + 1] = chart[face]!;
    ids[4 * k + 2] = group[face]! | (marks[face]! << 16);
  });
  const texture = new DataTexture(numbers, ROW, rows, RGBAFormat, FloatType);
  const integers = new DataTexture(ids, ROW, rows, RGBAIntegerFormat, UnsignedIntType);
  integers.internalFormat = "RGBA32UI";
  texture.needsUpdate = integers.needsUpdate = true;
  return { values: texture, ids: integers };
}

function bytesOf(geometry: BufferGeometry): number {
  return Object.values(geometry.attributes).reduce((sum, attribute) => sum + (attribute as BufferAttribute).array.byteLength, 0);
}
