// Lookup of boxes in the plane: a grid of cells, each with the boxes that touch it.

/** Boxes: four numbers each, least u and v, greatest u and v. */
export type Boxes = Float64Array;

/** Maximum number of cells along one side, which bounds the memory of the grid. */
const MAX_SIDE = 2048;

/** Calls with each pair of boxes that meet, once. The best `cell` is about twice as wide as a box. */
export function meetingBoxes(boxes: Boxes, cell: number, found: (one: number, other: number) => void): void {
  const n = boxes.length / 4;
  if (n === 0) return;
  const grid = gridOf(boxes, cell);
  const { begins, members } = filled(boxes, grid);
  for (let c = 0; c + 1 < begins.length; c++) {
    for (let i = begins[c]!; i < begins[c + 1]!; i++) {
      const a = 4 * members[i]!;
      for (let j = begins[c]!; j < i; j++) {
        const b = 4 * members[j]!;
        if (boxes[b + 2]! < boxes[a]! || boxes[a + 2]! < boxes[b]! || boxes[b + 3]! < boxes[a + 1]! || boxes[a + 3]! < boxes[b + 1]!) continue;
        // Count a pair only in the cell with the lower left corner of the intersection.
        const u = grid.column(Math.max(boxes[a]!, boxes[b]!));
        const v = grid.row(Math.max(boxes[a + 1]!, boxes[b + 1]!));
        if (u + grid.columns * v === c) found(b / 4, a / 4);
      }
    }
  }
}

interface Grid {
  columns: number;
  rows: number;
  column: (u: number) => number;
  row: (v: number) => number;
}

function gridOf(boxes: Boxes, cell: number): Grid {
  let [u0, v0, u1, v1] = [Infinity, Infinity, -Infinity, -Infinity];
  for (let k = 0; k < boxes.length; k += 4) {
    u0 = Math.min(u0, boxes[k]!);
    v0 = Math.min(v0, boxes[k + 1]!);
    u1 = Math.max(u1, boxes[k + 2]!);
    v1 = Math.max(v1, boxes[k + 3]!);
  }
  const side = Math.max(cell, (u1 - u0) / MAX_SIDE, (v1 - v0) / MAX_SIDE) || 1;
  const columns = Math.floor((u1 - u0) / side) + 1;
  const rows = Math.floor((v1 - v0) / side) + 1;
  return { columns, rows, column: (u) => Math.floor((u - u0) / side), row: (v) => Math.floor((v - v0) / side) };
}

function filled(boxes: Boxes, grid: Grid): { begins: Uint32Array; members: Uint32Array } {
  const begins = new Uint32Array(grid.columns * grid.rows + 1);
  const visit = (use: (cell: number, box: number) => void) => {
    for (let k = 0; k < boxes.length; k += 4) {
      const [left, right] = [grid.column(boxes[k]!), grid.column(boxes[k + 2]!)];
      const top = grid.row(boxes[k + 3]!);
      for (let v = grid.row(boxes[k + 1]!); v <= top; v++) {
        for (let u = left; u <= right; u++) use(u + grid.columns * v, k / 4);
      }
    }
  };
  visit((cell) => begins[cell + 1]!++);
  for (let c = 1; c < begins.length; c++) begins[c]! += begins[c - 1]!;
  const members = new Uint32Array(begins.at(-1)!);
  const at = begins.slice();
  visit((cell, box) => {
    members[at[cell]!] = box;
    at[cell]!++;
  });
  return { begins, members };
}
