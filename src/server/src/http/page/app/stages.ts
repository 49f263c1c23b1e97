// The stages of a running job, a bar each, and the time that is left.

import { isFinal, type Progress } from "./api";
import { element } from "./dom";
import { duration } from "./format";
import { doing } from "./outcome";

/** Shares of the whole work at which stages end, as the service counts them. The end of mapping depends on the mesh: its bar
 * counts charts. */
const ENDS: Record<string, number> = { read: 0.02, cut: 0.04, pack: 0.92, deform: 0.94, bake: 0.94, write: 0.95, judge: 1 };

/** Share of the work below which its speed says little about the rest: reading and cutting, which go otherwise than mapping. */
const LEAST_SHARE = 0.04;

/** Share beyond which the bar of a stage under way does not go: only that of a stage that is over is full. More charts may be
 * cut again, and the last one may be relaxed for long. */
const MOST_UNDER_WAY = 0.95;

/** A stage that a job has entered: when, and what share of the work was done then. */
interface Entered { name: string; text: string; since: number; from: number }

/** Follows a job through its stages. */
export class Stages {
  readonly list = element("ol", { className: "stages", aria: { label: "Stages" } });
  readonly #entered: Entered[] = [];

  /** Takes an event of the job. */
  show(event: Progress): void {
    const { stage, elapsed_ms, fraction } = event;
    const last = this.#entered.at(-1);
    if (stage && !isFinal(event.state) && stage !== last?.name) this.#entered.push({ name: stage, text: doing(event), since: elapsed_ms, from: fraction });
    this.list.replaceChildren(...this.#entered.map((one, k) => {
      const next = this.#entered[k + 1];
      const done = next || isFinal(event.state) ? 1 : Math.min(shareOf(one, event), MOST_UNDER_WAY);
      return element("li", {}, element("span", { textContent: one.text }), element("progress", { max: 1, value: done, aria: { label: one.text } }),
        element("small", { textContent: duration((next?.since ?? elapsed_ms) - one.since) }));
    }));
  }
}

/** Returns the share of a stage that is done. */
function shareOf({ name, from }: Entered, { fraction, chart, charts }: Progress): number {
  if (name === "map") return charts ? chart / charts : 0;
  const room = (ENDS[name] ?? 1) - from;
  return 0 < room ? Math.min((fraction - from) / room, 1) : 0;
}

/** Describes the time that is left, as long as the work so far suggests; nothing while that is unknown. */
export function left({ state, fraction, elapsed_ms }: Progress): string {
  if (state !== "running" || fraction <= LEAST_SHARE) return "–";
  return `about ${duration((elapsed_ms * (1 - fraction)) / fraction).replace(/\.\d/, "")}`;
}
