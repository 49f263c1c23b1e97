// What the page says of a report.

export function short(number) {
  return number == null ? "–" : Number(number.toPrecision(4)).toString();
}

function words(value) {
  return typeof value === "boolean" ? (value ? "yes" : "no") : typeof value === "number" ? short(value) : value ?? "–";
}

// What is proven of the UVs written.
function proofs({ locally_injective, bijective, unmirrored, padding, aligned, pages, safe_bits, bits }) {
  return [
    ["nothing flipped or without area", words(locally_injective)],
    ["nothing overlaps", words(bijective)],
    ["no chart mirrored", words(unmirrored)],
    ...(padding ? [[`charts ${padding.asked_texels} texels apart at ${padding.resolution}`, `${words(padding.kept)} (nearest ${short(padding.reached_texels)})`]] : []),
    ...(aligned == null ? [] : [["chart edges on texels", words(aligned)]]),
    ...(pages?.asked > 1 ? [[`each chart on one of ${pages.asked} pages`, words(pages.kept)]] : []),
    ...(bits ? [[`safe at ${bits.asked} bits`, words(bits.hold)]] : safe_bits ? [["safe at", `${safe_bits} bits`]] : []),
  ];
}

// Of a group of UVs, or of one chart.
const MEASURES = {
  faces: "faces",
  charts: "charts",
  "seam / √area": "seam_over_sqrt_area",
  "symmetric Dirichlet (least 4)": "sym_dirichlet_mean",
  "share of the square": "pack_unit",
  flipped: "flipped",
  "overlapping pairs": "overlapping_pairs",
};

// What a report says beside its parts, whichever kind it is of.
export function summary(report) {
  const groups = report.groups ?? report.charts?.map((chart) => ({ name: `chart ${chart.chart}`, ...chart })) ?? [];
  const keys = ["certified", "bijective", "status", "iterations", "energy", "residual", "inverted", "crossings", "smallest_ever", "voxels", "tets"];
  const entries = report.proven ? proofs(report.proven) : [];
  entries.push(...keys.filter((key) => key in report).map((key) => [key.replaceAll("_", " "), words(report[key])]));
  for (const group of groups.slice(0, 4)) {
    const known = Object.entries(MEASURES).map(([name, key]) => [name, (group.measures ?? group)[key]]);
    entries.push(...known.filter(([, value]) => value !== undefined).map(([name, value]) => [`${group.label ?? group.name}: ${name}`, words(value)]));
  }
  return entries;
}
