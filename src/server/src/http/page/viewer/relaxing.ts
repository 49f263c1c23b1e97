// Relaxing charts, side by side: their places in the atlas are not known yet.

import { BufferAttribute, BufferGeometry, DoubleSide, GLSL3, Mesh, NoBlending, ShaderMaterial } from "three";
import type { ChartMap } from "../live/maps";
import { COLORS } from "./colors";

const VERTEX = /* glsl */ `
uniform vec3 uPlace;
out vec3 vCorner;
void main() {
  int corner = gl_VertexID % 3;
  vCorner = vec3(corner == 0, corner == 1, corner == 2);
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position.xy * uPlace.z + uPlace.xy, 0.0, 1.0);
}`;

const FRAGMENT = /* glsl */ `
precision highp float;
precision highp int;
${COLORS}
uniform uint uChart;
in vec3 vCorner;
layout(location = 0) out vec4 color;
void main() {
  vec3 width = fwidth(vCorner);
  vec3 inside = smoothstep(width * 0.4, width * 1.2, vCorner);
  float strength = 0.42 * clamp(1.0 - 2.2 * max(width.x, max(width.y, width.z)), 0.0, 1.0);
  color = vec4(chartColor(uChart) * (1.0 - strength * (1.0 - min(inside.x, min(inside.y, inside.z)))), 1.0);
}`;

/** Margin around each chart, as a share of its size. */
const MARGIN = 0.06;

/** A drawn map: its bounds, its sides in lengths of the surface, and its place. */
interface Drawn { map: ChartMap; mesh: Mesh; box: [number, number, number, number]; place: [number, number] }

/** The charts of a running job. A chart that is cut again is mapped again; each face is shown where it was mapped
 * last. */
export class Relaxing {
  readonly #charts = new Map<string, Drawn>();
  /** The chart of each face, by surface. */
  readonly #owners = new Map<number, Map<number, string>>();
  #count = 0;
  #sides: [number, number] = [1, 1];

  /** Shows a map in place of the former ones of its faces. */
  take(map: ChartMap): void {
    const name = `${map.surface}/${map.first}`;
    this.#claim(map, name);
    const former = this.#charts.get(name);
    const mesh = former?.mesh ?? this.#mesh();
    mesh.geometry.dispose();
    mesh.geometry = geometryOf(map);
    this.#charts.set(name, { map, mesh, box: boxOf(map), place: [0, 0] });
  }

  /** Removes other charts that had these faces, which were mapped anew. */
  #claim({ surface, faces }: ChartMap, name: string): void {
    const owners = this.#owners.get(surface) ?? new Map<number, string>();
    this.#owners.set(surface, owners);
    for (const face of faces) {
      const owner = owners.get(face);
      if (owner !== undefined && owner !== name) this.#remove(owner);
      owners.set(face, name);
    }
  }

  #remove(name: string): void {
    const gone = this.#charts.get(name);
    if (!gone) return;
    this.#charts.delete(name);
    release(gone.mesh);
    // Faces without a map now come back with their next one.
    const owners = this.#owners.get(gone.map.surface)!;
    for (const face of gone.map.faces) if (owners.get(face) === name) owners.delete(face);
  }

  #mesh(): Mesh {
    const uniforms = { uPlace: { value: [0, 0, 1] }, uChart: { value: this.#count++ } };
    const mesh = new Mesh(new BufferGeometry(), new ShaderMaterial({ glslVersion: GLSL3, vertexShader: VERTEX, fragmentShader: FRAGMENT, uniforms, side: DoubleSide, depthTest: false, blending: NoBlending }));
    mesh.frustumCulled = false;
    return mesh;
  }

  /** Places all charts side by side in rows, the tallest first, at one scale. */
  arrange(): void {
    const charts = [...this.#charts.values()];
    const sizes = new Map(charts.map((chart) => [chart, sizeOf(chart)]));
    charts.sort((one, other) => sizes.get(other)![1] - sizes.get(one)![1]);
    const area = charts.reduce((sum, chart) => sum + sizes.get(chart)![0] * sizes.get(chart)![1], 0);
    const widest = charts.reduce((most, chart) => Math.max(most, sizes.get(chart)![0]), 0);
    const row = Math.max(widest, 1.1 * Math.sqrt(area));
    let [x, y, height] = [0, 0, 0];
    for (const chart of charts) {
      const [w, h] = sizes.get(chart)!;
      if (0 < x && row < x + w) [x, y, height] = [0, y + height, 0];
      chart.place = [x + w / 2, y + h / 2];
      x += w;
      height = Math.max(height, h);
    }
    this.#sides = [row, y + height];
    const scale = 1 / Math.max(...this.#sides, Number.MIN_VALUE);
    for (const { map, mesh, box: [u0, v0, u1, v1], place: [px, py] } of charts) {
      const size = map.unit * scale;
      const uniforms = (mesh.material as ShaderMaterial).uniforms;
      uniforms.uPlace!.value = [px * scale - ((u0 + u1) / 2) * size, 1 - py * scale - ((v0 + v1) / 2) * size, size];
    }
  }

  get meshes(): Mesh[] {
    return [...this.#charts.values()].map(({ mesh }) => mesh);
  }

  get count(): number {
    return this.#charts.size;
  }

  get flips(): number {
    return [...this.#charts.values()].reduce((sum, { map }) => sum + map.flips, 0);
  }

  /** Set if a chart is a simplified mesh on which seams are planned. */
  get isPlan(): boolean {
    return [...this.#charts.values()].some(({ map }) => map.isPlan);
  }

  /** Share of the faces of charts that is drawn: 1, or less if there are too many. */
  get share(): number {
    const charts = [...this.#charts.values()];
    const sum = (of: (map: ChartMap) => number) => charts.reduce((all, { map }) => all + of(map), 0);
    return sum(({ faces }) => faces.length) / Math.max(sum(({ total }) => total), 1);
  }

  dispose(): void {
    this.meshes.forEach(release);
    this.#charts.clear();
    this.#owners.clear();
  }
}

function release({ geometry, material }: Mesh): void {
  geometry.dispose();
  (material as ShaderMaterial).dispose();
}

function geometryOf({ corners }: ChartMap): BufferGeometry {
  const places = new Float32Array((corners.length / 2) * 3);
  for (let k = 0; k < corners.length / 2; k++) {
    places[3 * k] = corners[2 * k]!;
    places[3 * k + 1] = corners[2 * k + 1]!;
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(places, 3));
  return geometry;
}

/** Returns the least and greatest u and v. */
function boxOf({ corners }: ChartMap): [number, number, number, number] {
  const box: [number, number, number, number] = [Infinity, Infinity, -Infinity, -Infinity];
  for (let k = 0; k < corners.length; k += 2) {
    box[0] = Math.min(box[0], corners[k]!);
    box[1] = Math.min(box[1], corners[k + 1]!);
    box[2] = Math.max(box[2], corners[k]!);
    box[3] = Math.max(box[3], corners[k + 1]!);
  }
  return box;
}

/** Returns width and height with the margin, in lengths of the surface. */
function sizeOf({ map, box: [u0, v0, u1, v1] }: Drawn): [number, number] {
  const margin = MARGIN * Math.max(u1 - u0, v1 - v0);
  return [(u1 - u0 + margin) * map.unit, (v1 - v0 + margin) * map.unit];
}
