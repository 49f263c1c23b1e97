// Small drawings of numbers.

import type { Spread } from "../analysis/statistics";
import { short } from "./format";
import { svg } from "./dom";

const WIDTH = 320;
const HEIGHT = 96;

/** Draws a histogram with its mean. */
export function histogram(spread: Spread, name: string): SVGElement {
  const most = Math.max(...spread.bins, 1e-9);
  const step = WIDTH / spread.bins.length;
  const bars = spread.bins.map((share, k) => {
    const high = share === 0 ? 0 : Math.max((HEIGHT * share) / most, 1);
    return svg("rect", { x: k * step + 0.5, y: HEIGHT - high, width: step - 1, height: high });
  });
  const at = Math.min(Math.max(((spread.mean - spread.from) / (spread.to - spread.from)) * WIDTH, 0), WIDTH);
  const label = `${name}: from ${short(spread.least)} to ${short(spread.greatest)}, mean ${short(spread.mean)}`;
  return svg("svg", { viewBox: `0 0 ${WIDTH} ${HEIGHT + 16}`, role: "img", "aria-label": label, class: "histogram" },
    ...bars,
    svg("line", { x1: at, x2: at, y1: 0, y2: HEIGHT, class: "mean" }),
    svg("text", { x: 0, y: HEIGHT + 13 }, short(spread.from)),
    svg("text", { x: WIDTH, y: HEIGHT + 13, "text-anchor": "end" }, short(spread.to)));
}

/** Draws a curve through numbers on a logarithmic scale. */
export function curve(numbers: number[], name: string): SVGElement {
  const logs = numbers.map((x) => Math.log(Math.max(x, 1e-300)));
  const [low, high] = [Math.min(...logs), Math.max(...logs)];
  const points = logs.map((y, k) => `${(k / Math.max(logs.length - 1, 1)) * WIDTH},${4 + (HEIGHT - 8) * (1 - (y - low) / (high - low || 1))}`);
  const label = `${name}: from ${short(numbers[0])} to ${short(numbers.at(-1))}`;
  return svg("svg", { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, role: "img", "aria-label": label, class: "curve", preserveAspectRatio: "none" },
    svg("polyline", { points: points.join(" ") }));
}
