// Meshes of a finished atlas, as the package `watlas` gives them.

/** The atlas and the chart of what has no place. */
const NONE = -1;
const LSCM = 2;

/** A mesh of a finished atlas. Its UVs are in texels, v down, as in glTF. */
export class Mesh {
  #origins;
  #indices;
  #uvs;
  #charts;
  #pages;
  #chartOfTriangle;
  #firstChart;

  constructor(input, made, firstChart, [width, height], nPages) {
    const nUsed = made ? made.origins.length : 0;
    const used = new Map((made ? input.triangles : []).map((triangle, i) => [triangle, i]));
    // Vertices of triangles that took no part come last, without a place.
    const left = new Map();
    this.#indices = input.indices.map((vertex, corner) => {
      const at = used.get(Math.floor(corner / 3));
      if (at !== undefined) return made.indices[3 * at + (corner % 3)];
      if (!left.has(vertex)) left.set(vertex, nUsed + left.size);
      return left.get(vertex);
    });
    this.#origins = Uint32Array.from([...(made ? made.origins : []), ...left.keys()]);
    this.#firstChart = firstChart;
    const numbers = [...new Set(made ? made.charts : [])].sort((a, b) => a - b);
    const rank = new Map(numbers.map((number, i) => [number, firstChart + i]));
    this.#chartOfTriangle = Int32Array.from({ length: this.#indices.length / 3 }, (_, triangle) => {
      const at = used.get(triangle);
      return at === undefined ? NONE : rank.get(made.charts[at]);
    });
    this.chartCount = numbers.length;

    const n = this.#origins.length;
    this.#uvs = new Float64Array(2 * n);
    this.#charts = new Int32Array(n).fill(NONE);
    this.#pages = new Int32Array(n).fill(NONE);
    for (const [triangle, chart] of this.#chartOfTriangle.entries()) {
      if (chart === NONE) continue;
      const corners = this.#indices.subarray(3 * triangle, 3 * triangle + 3);
      const middle = (made.uvs[2 * corners[0]] + made.uvs[2 * corners[1]] + made.uvs[2 * corners[2]]) / 3;
      const page = Math.min(nPages - 1, Math.max(0, Math.floor(middle)));
      for (const vertex of corners) {
        this.#charts[vertex] = chart;
        this.#pages[vertex] = page;
        const [u, v] = made.uvs.subarray(2 * vertex, 2 * vertex + 2);
        this.#uvs.set([(u - page) * width, (1 - v) * height], 2 * vertex);
      }
    }
  }

  get vertexCount() {
    return this.#origins.length;
  }

  get indexCount() {
    return this.#indices.length;
  }

  /** A vertex: its place, and which of the given mesh it is. */
  getVertex(index) {
    if (!(index >= 0 && index < this.vertexCount)) return undefined;
    return {
      atlasIndex: this.#pages[index],
      chartIndex: this.#charts[index],
      uv: [this.#uvs[2 * index], this.#uvs[2 * index + 1]],
      xref: this.#origins[index],
    };
  }

  /** Fills an array with three vertices for each triangle; false if it is too short. */
  getIndexArray(jsArray) {
    return filled(jsArray, this.#indices);
  }

  /** A chart of this mesh. */
  getChart(index) {
    if (!(index >= 0 && index < this.chartCount)) return undefined;
    const triangles = [...this.#chartOfTriangle.keys()];
    const faces = triangles.filter((t) => this.#chartOfTriangle[t] === this.#firstChart + index);
    return {
      getFaceArray: (jsArray) => filled(jsArray, faces),
      faceCount: faces.length,
      atlasIndex: this.#pages[this.#indices[3 * faces[0]]],
      type: LSCM,
      material: 0,
    };
  }
}

function filled(array, values) {
  if (array.length < values.length) return false;
  array.set(values);
  return true;
}
