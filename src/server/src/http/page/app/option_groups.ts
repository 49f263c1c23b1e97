// The options in words of the trade, grouped by what a person wants. Options that are not listed are found by a search.

/** Words for an option, and its unit. */
interface Words {
  label: string;
  unit?: string;
}

const words = (label: string, unit?: string): Words => ({ label, unit });

/** Groups in the order of the form, each with its options by their names in the API. */
const GROUPS: Record<string, Record<string, Words>> = {
  "Texture and packing": {
    padding: words("Padding", "px"), mips: words("Padding holds for mips", "levels"), texels_per_unit: words("Texel density", "px/unit"), pages: words("UDIM tiles"),
    rotate: words("Rotate islands"), packing: words("Packing effort"),
  },
  "Seams and stretch": {
    quality: words("Stretch or seams"), cut: words("Where to cut"), max_charts: words("Islands at most"), max_stretch: words("Stretch at most", "× length"),
    seam_weight: words("Cost of a seam", "× usual"), symmetry: words("Mirror symmetry"), material_borders: words("Cut between materials"),
  },
  "UV sets and textures": {
    texcoord: words("Write to UV set"), source_texcoord: words("Take islands of UV set"), overwrite: words("Overwrite the UV set"), rebake: words("Move the textures"),
    bake_tiled: words("Move textures that repeat"), bake_colors: words("Draw vertex colors into the texture"),
    bake_size: words("Size of moved textures", "px"), image_format: words("Format of moved textures"),
    merge_materials: words("Merge materials"),
  },
  "Proof": {
    bijective: words("No overlaps"), unmirrored: words("No mirrored islands"), aligned: words("Islands end on texels"), bits: words("Safe when rounded to", "bits"),
    quantization_safe: words("Safe when rounded to", "bits"), skip_missing: words("Leave out parts without UVs"), separate_nodes: words("Judge each node"),
  },
  "File": { format: words("File format"), group_by: words("One atlas per") },
};

/** Names of the groups, in the order of the form; the last has what only a search finds. */
export const REST = "More options";
export const GROUP_NAMES = [...Object.keys(GROUPS), REST];

/** Returns the group of an option and its words; null words if it is only found by a search. */
export function groupOf(option: string): { group: string; words: Words | null } {
  const found = Object.entries(GROUPS).find(([, options]) => option in options);
  return found ? { group: found[0], words: found[1][option]! } : { group: REST, words: null };
}
