// The interface of the package `watlas`, which glTF-Transform's `unwrap` is given, with charts and maps of unwrapd.

import { taken, takenUvs } from './atlas_input.js';
import { chartsAsked, enlarged, layoutAsked } from './atlas_options.js';
import { Mesh } from './mesh.js';
import { answered, native, toJson } from './native.js';

/** How a chart was mapped: here all at once, for which LSCM stands. */
export const ChartType = Object.freeze({ Planar: 0, Ortho: 1, LSCM: 2, Piecewise: 3, Invalid: 4 });

/** There is nothing to wait for. */
export async function Initialize() {}

/** The same interface, whose atlases have options of `unwrapd unwrap` besides. */
export function withOptions(options) {
  return {
    ChartType,
    Initialize,
    Atlas: class extends Atlas {
      constructor() {
        super(options);
      }
    },
  };
}

/** Meshes that share an atlas, in the order in which they were added. */
export class Atlas {
  #own;
  #inputs = [];
  #charting = {};
  #meshes = [];
  #utilization = [];
  #size = [0, 0];
  #texelsPerUnit = 0;

  constructor(options = {}) {
    this.#own = options;
  }

  /** Adds a mesh. */
  addMesh(meshDecl) {
    this.#add(taken(meshDecl));
  }

  /** Adds UVs of faces, whose islands are to be packed. */
  addUvMesh(meshDecl) {
    this.#add(takenUvs(meshDecl));
  }

  #add(input) {
    if (this.#inputs.some((other) => other.isFlat !== input.isFlat)) {
      throw new Error('Unspecified error occured while adding mesh');
    }
    this.#inputs.push(input);
  }

  /** Takes the options of charts, which are made with the layout. */
  computeCharts(options = {}) {
    this.#charting = chartsAsked(options);
  }

  /** Cuts, maps and packs all meshes. */
  packCharts(options = {}) {
    const area = this.#inputs.reduce((sum, input) => sum + input.area(), 0);
    const [asked, layout] = [{ ...this.#charting, ...this.#own }, { ...layoutAsked(options, area), ...this.#own }];
    const used = this.#inputs.filter((input) => input.triangles.length > 0);
    if (used.length > 0) this.#keep(used, this.#made(used, asked, layout, options.resolution > 0));
  }

  /** Both. */
  generate(chartOptions = {}, packOptions = {}) {
    this.computeCharts(chartOptions);
    this.packCharts(packOptions);
  }

  /** What the library makes, with more room while a density needs it. */
  #made(used, asked, layout, isFixed) {
    const isFlat = used[0].isFlat;
    const [withUvs, withNormals] = [isFlat || asked.cut === 'keep', asked.seams === 'normals'];
    const meshes = used.map((input) => input.arrays({ withUvs, withNormals }));
    for (;;) {
      const made = isFlat
        ? native.repackMeshes(meshes, toJson(layout))
        : native.unwrapMeshes(meshes, toJson({ ...asked, ...layout }));
      const larger = made.code === 'texture_too_small' ? enlarged(layout, isFixed) : undefined;
      if (!larger) return { ...answered(made), resolution: layout.resolution };
      layout = larger;
    }
  }

  #keep(used, { meshes, report, resolution }) {
    const [width, height = width] = String(resolution).split('x').map(Number);
    this.#size = [width, height];
    const [group] = report.groups;
    this.#texelsPerUnit = group.texels_per_unit ?? 0;
    this.#utilization = group.measures.pages.map((page) => page.fill);
    const made = new Map(used.map((input, i) => [input, meshes[i]]));
    let nCharts = 0;
    this.#meshes = this.#inputs.map((input) => {
      const mesh = new Mesh(input, made.get(input), nCharts, this.#size, this.atlasCount);
      nCharts += mesh.chartCount;
      return mesh;
    });
  }

  /** A mesh of the finished atlas. */
  getMesh(index) {
    return this.#meshes[index];
  }

  /** Fills an array with the covered share of each page; false if it is too short. */
  getUtilization(jsArray) {
    if (jsArray.length < this.#utilization.length) return false;
    jsArray.set(this.#utilization);
    return true;
  }

  get width() {
    return this.#size[0];
  }

  get height() {
    return this.#size[1];
  }

  get atlasCount() {
    return this.#utilization.length;
  }

  get chartCount() {
    return this.#meshes.reduce((sum, mesh) => sum + mesh.chartCount, 0);
  }

  get meshCount() {
    return this.#meshes.length;
  }

  get texelsPerUnit() {
    return this.#texelsPerUnit;
  }

  /** Lets everything go. */
  delete() {
    this.#inputs = [];
    this.#meshes = [];
    this.#utilization = [];
    this.#size = [0, 0];
  }
}
