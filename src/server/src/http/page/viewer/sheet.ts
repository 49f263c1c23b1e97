// Background of the UVs: pages with their lines, and the picture of a material.

import {
  BufferAttribute, BufferGeometry, LineBasicMaterial, LineSegments, Mesh, MeshBasicMaterial, PlaneGeometry, type Texture,
} from "three";

/** Colors of lines and paper. */
export interface SheetColors {
  paper: string;
  line: string;
  border: string;
}

const DIVISIONS = 8;

/** Background of the UVs. It is rebuilt only if it changes; the former objects are freed. */
export class Sheet {
  #key = "";
  #things: (Mesh | LineSegments)[] = [];

  of(pages: number, aspect: number, colors: SheetColors, picture: Texture | null): (Mesh | LineSegments)[] {
    const key = [pages, aspect, ...Object.values(colors), picture?.uuid].join();
    if (key === this.#key) return this.#things;
    for (const { geometry, material } of this.#things) {
      geometry.dispose();
      for (const one of [material].flat()) one.dispose();
    }
    this.#key = key;
    this.#things = [...sheetOf(pages, aspect, colors), ...(picture ? [pictureOf(picture, aspect)] : [])];
    return this.#things;
  }
}

/** Creates pages of this number and aspect. */
export function sheetOf(pages: number, aspect: number, colors: SheetColors): (Mesh | LineSegments)[] {
  const inner: number[] = [];
  const outer: number[] = [];
  for (let page = 0; page < pages; page++) {
    for (let k = 0; k <= DIVISIONS; k++) {
      const to = k % DIVISIONS === 0 ? outer : inner;
      const t = k / DIVISIONS;
      to.push(page * aspect, t, 0, (page + 1) * aspect, t, 0);
      to.push((page + t) * aspect, 0, 0, (page + t) * aspect, 1, 0);
    }
  }
  const paper = new Mesh(new PlaneGeometry(pages * aspect, 1), flat(colors.paper));
  paper.position.set((pages * aspect) / 2, 0.5, 0);
  return [ordered(paper, -3), ordered(lines(inner, colors.line), -2), ordered(lines(outer, colors.border), -1)];
}

/** Returns the number of pages, side by side, that UVs extend over, at least one. */
export function pagesOf(bounds: [number, number, number, number]): number {
  return Number.isFinite(bounds[2]) ? Math.min(Math.max(Math.ceil(bounds[2] - 1e-4), 1), 10) : 1;
}

/** Creates the picture of a material on the first page. */
export function pictureOf(texture: Texture, aspect: number): Mesh {
  const geometry = new PlaneGeometry(aspect, 1);
  // Pictures of glTF begin at the top.
  if (!texture.flipY) {
    const uv = geometry.getAttribute("uv");
    for (let k = 0; k < uv.count; k++) uv.setY(k, 1 - uv.getY(k));
  }
  const picture = new Mesh(geometry, new MeshBasicMaterial({ map: texture, depthTest: false, depthWrite: false, toneMapped: false }));
  picture.position.set(aspect / 2, 0.5, 0);
  return ordered(picture, -2);
}

function flat(color: string): MeshBasicMaterial {
  return new MeshBasicMaterial({ color, depthTest: false, depthWrite: false, toneMapped: false });
}

function lines(ends: number[], color: string): LineSegments {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(Float32Array.from(ends), 3));
  return new LineSegments(geometry, new LineBasicMaterial({ color, depthTest: false, depthWrite: false, toneMapped: false }));
}

function ordered<T extends Mesh | LineSegments>(thing: T, order: number): T {
  thing.renderOrder = order;
  return thing;
}
