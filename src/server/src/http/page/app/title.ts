// The name of the shown file, in the bar and on the browser's tab.

import { byId } from "./dom";

let shown = "";
let inHand: string | null = null;

/** Names the file that both views show. */
export function nameShown(name: string): void {
  shown = name;
  draw();
}

/** Names the file in the pull view while that view is open; null while another is. */
export function nameInHand(name: string | null): void {
  inHand = name;
  draw();
}

function draw(): void {
  const name = inHand ?? shown;
  byId("title").textContent = name;
  document.title = name ? `${name} · unwrapd` : "unwrapd";
}
