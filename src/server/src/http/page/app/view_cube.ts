// The cube in the corner of the surface. It turns with the surface, and its sides are buttons that look from there.

import { type Camera, Matrix4 } from "three";
import type { SolidPane } from "../viewer/solid_pane";
import { button, byId, element } from "./dom";

/** The sides: names, directions from which they are seen, and their turns from the front in the style of CSS. */
export const SIDES = [
  ["Front", [0, 0, 1], ""], ["Right", [1, 0, 0], "rotateY(90deg)"], ["Top", [0, 1, 0], "rotateX(90deg)"],
  ["Back", [0, 0, -1], "rotateY(180deg)"], ["Left", [-1, 0, 0], "rotateY(-90deg)"], ["Bottom", [0, -1, 0], "rotateX(-90deg)"],
] as const;

/** Half the side of the cube in pixels. */
const HALF = 21;

/** Adds the cube. Returns a function that turns it with a camera. */
export function addCube(solid: SolidPane): (camera: Camera) => void {
  const sides = SIDES.map(([name, from, turn]) => {
    // The keyboard has keys for the views, and 6 stops less.
    const side = button(name, () => solid.lookFrom(from), { title: `Seen from here: ${name.toLowerCase()}`, tabIndex: -1 });
    side.style.transform = `${turn} translateZ(${HALF}px)`;
    return side;
  });
  const cube = element("div", { className: "cube", aria: { role: "group", label: "Look from" } }, element("div", {}, ...sides));
  // Clicks on the cube are none on the surface behind it.
  for (const event of ["pointerdown", "pointerup", "pointermove"] as const) cube.addEventListener(event, (one) => one.stopPropagation());
  byId("solid").append(cube);
  const turned = cube.firstElementChild as HTMLElement;
  return (camera) => {
    const m = new Matrix4().makeRotationFromQuaternion(camera.quaternion).transpose().elements;
    // In CSS, y points down.
    turned.style.transform = `matrix3d(${[m[0], -m[1]!, m[2], 0, -m[4]!, m[5], -m[6]!, 0, m[8], -m[9]!, m[10], 0, 0, 0, 0, 1].map((x) => x!.toFixed(4)).join(",")})`;
  };
}
