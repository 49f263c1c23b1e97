// Reports of `unwrap`, `repack`, `measure` and `verify`, as far as the page shows them.

export interface Report {
  unwrapd_version?: string;
  certified?: boolean | null;
  proven?: Proven;
  warnings?: { code: string; message: string }[];
  groups?: GroupReport[];
  written?: { primitives?: { mesh: number; primitive: number; texcoord: number }[] };
  seconds?: Record<string, number>;
  options?: Record<string, unknown>;
  [other: string]: unknown;
}

export interface Proven {
  locally_injective: boolean;
  bijective: boolean;
  /** Accepted stacks of charts that coincide; absent in reports of older versions. */
  stacks?: { stacks: number; charts: number; kept: boolean; unmirrored: boolean } | null;
  unmirrored: boolean;
  padding: { asked_texels: number; resolution: number | string; kept: boolean; reached_texels: number | null } | null;
  aligned: boolean | null;
  pages: { asked: number; used: number; kept: boolean } | null;
  safe_bits: number | null;
  bits: { asked: number; hold: boolean } | null;
}

export interface GroupReport {
  name: string;
  label: string;
  texels_per_unit?: number;
  /** Absent if only proofs were requested. */
  measures?: Record<string, number | boolean | null | unknown>;
  certificate?: Record<string, unknown>;
  defects?: Record<string, number>;
  atlas?: { bound?: { max_distortion: number; distortion: number; kept: boolean } };
}

/** A property that is proven or not. */
export interface Claim {
  holds: boolean;
  text: string;
  detail: string;
}

/** Returns the properties of the written UVs in plain words. */
export function claims({ locally_injective, bijective, stacks, unmirrored, padding, aligned, pages, safe_bits, bits }: Proven): Claim[] {
  const made: Claim[] = [
    { holds: locally_injective, text: "No face is flipped or without area", detail: "Judged in exact arithmetic on the bytes of the file." },
    apart(bijective, stacks ?? null),
    facing(unmirrored, stacks ?? null),
  ];
  if (padding) {
    const reached = padding.reached_texels === null ? "" : ` The nearest two are ${padding.reached_texels.toFixed(2)} texels apart.`;
    made.push({ holds: padding.kept, text: `Charts keep ${padding.asked_texels} texels at ${padding.resolution}`, detail: `No color bleeds from one chart into another.${reached}` });
  }
  if (aligned !== null) made.push({ holds: aligned, text: "Charts end on borders of texels", detail: "Light does not leak across their edges." });
  if (pages && 1 < pages.asked) made.push({ holds: pages.kept, text: `Each chart lies on one of ${pages.asked} pages`, detail: `${pages.used} are used.` });
  if (bits) made.push({ holds: bits.hold, text: `Safe when rounded to ${bits.asked} bits`, detail: "Nothing flips or overlaps when an engine stores fewer digits." });
  else if (safe_bits) made.push({ holds: true, text: `Safe when rounded to ${safe_bits} bits`, detail: "Nothing flips or overlaps when an engine stores that many digits or more." });
  return made;
}

/** Returns whether faces overlap; accepted stacks of charts may. */
function apart(bijective: boolean, stacks: Proven["stacks"]): Claim {
  if (bijective || !stacks?.stacks) return { holds: bijective, text: "No two faces overlap", detail: "Each point of the texture belongs to one place of the surface." };
  const count = stacks.stacks === 1 ? "1 stack" : `${stacks.stacks} stacks`;
  return { holds: stacks.kept, text: `No two faces overlap except in ${count}`, detail: `${stacks.charts} charts share texels on purpose: those of a stack coincide exactly.` };
}

/** Returns whether charts are mirrored; those in accepted stacks may be. */
function facing(unmirrored: boolean, stacks: Proven["stacks"]): Claim {
  if (unmirrored || !stacks?.stacks) return { holds: unmirrored, text: "No chart is mirrored", detail: "Text in a texture reads the right way around." };
  return { holds: stacks.unmirrored, text: "No chart is mirrored except in stacks", detail: "Text in a texture reads the right way around elsewhere." };
}

/** Returns a true sentence about a claim. */
export function claimed({ holds, text }: Claim): string {
  return holds ? text : `Not so: ${text.charAt(0).toLowerCase()}${text.slice(1)}`;
}

/** Returns the measured groups. */
export function measured(report: Report | null): GroupReport[] {
  return report?.groups?.filter(({ measures }) => measures) ?? [];
}

/** Figures of all measured groups together. */
export interface Figures {
  faces: number;
  charts: number;
  /** Length of all seams over the square root of the surface area. */
  seams: number;
  /** Mean symmetric Dirichlet energy over the surface; an isometry has 4. */
  energy: number;
  /** Mean share of the textures that charts cover. */
  fill: number;
}

/** Returns the figures of a report; null if nothing was measured. */
export function figuresOf(report: Report | null): Figures | null {
  const groups = measured(report);
  if (!groups.length) return null;
  const sum = (of: (group: GroupReport) => number) => groups.reduce((total, group) => total + of(group), 0);
  const total = (key: string) => sum((group) => measure(group, key) ?? 0);
  const area = total("area_3d") || 1;
  return {
    faces: total("faces"), charts: total("charts"), seams: total("seam_length") / Math.sqrt(area),
    energy: sum((group) => (measure(group, "sym_dirichlet_mean") ?? 0) * (measure(group, "area_3d") ?? 0)) / area, fill: total("pack_unit") / groups.length,
  };
}

/** Returns a number among a group's measures. */
export function measure(group: GroupReport, key: string): number | null {
  const value = group.measures?.[key];
  return typeof value === "number" ? value : null;
}
