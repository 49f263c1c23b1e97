// The options of each kind of job, from the OpenAPI document of the service.

import { call } from "./api";

/** An option as a form shows it. */
export interface Definition {
  name: string;
  /** Help, with empty lines between paragraphs. */
  help: string;
  control: "choice" | "switch" | "number" | "text";
  words: { word: string; help: string }[];
  default: unknown;
  minimum?: number;
  maximum?: number;
  isWhole: boolean;
}

interface Schema {
  $ref?: string;
  type?: string | string[];
  description?: string;
  default?: unknown;
  minimum?: number;
  maximum?: number;
  enum?: unknown[];
  oneOf?: Schema[];
  anyOf?: Schema[];
  allOf?: Schema[];
  properties?: Record<string, Schema>;
}

type Schemas = Record<string, Schema>;

/** Kinds of jobs that need no handles, with the schemas of their options. */
export const KINDS = { unwrap: "Options", repack: "RepackOptions", measure: "MeasureOptions", verify: "VerifyOptions" } as const;
export type FormKind = keyof typeof KINDS;

/** The schemas of all kinds' options. */
const ALL: Record<string, string> = { ...KINDS, solve: "SolveOptions", deform: "DeformOptions", warp: "WarpOptions", edit_uv: "EditOptions", texture_map: "EditOptions", untangle: "UntangleOptions" };

let fetched: Promise<Schemas> | null = null;

function schemas(): Promise<Schemas> {
  fetched ??= call<{ components: { schemas: Schemas } }>("openapi.json").then(({ components }) => components.schemas);
  return fetched;
}

/** Returns the options of a kind that a form can show. */
export async function definitions(kind: string): Promise<Definition[]> {
  const all = await schemas();
  const properties = all[ALL[kind] ?? "Options"]?.properties ?? {};
  return Object.entries(properties).map(([name, schema]) => definition(name, schema, all)).filter((one) => one !== null);
}

function definition(name: string, schema: Schema, all: Schemas): Definition | null {
  const parts = partsOf(schema, all);
  const types = parts.flatMap(({ type }) => type ?? []);
  // Forms have no fields for lists and objects.
  if (types.includes("array") || (types.includes("object") && !types.includes("string"))) return null;
  const words = parts.flatMap(({ enum: some, description }) => (some ?? []).filter((word) => word !== null).map((word) => ({ word: String(word), help: some?.length === 1 ? (description ?? "") : "" })));
  const find = <K extends keyof Schema>(key: K) => parts.find((part) => part[key] !== undefined)?.[key];
  return {
    name, help: schema.description ?? schema.oneOf?.[0]?.description ?? "", words, default: schema.default ?? null,
    control: 0 < words.length ? "choice" : types.includes("boolean") ? "switch" : types.includes("string") ? "text" : "number",
    minimum: find("minimum"), maximum: find("maximum"), isWhole: types.includes("integer"),
  };
}

/** Returns a schema with all that it refers to and chooses from. */
function partsOf(schema: Schema, all: Schemas): Schema[] {
  const target = schema.$ref ? all[schema.$ref.split("/").pop() ?? ""] : undefined;
  const inner = [target ?? [], schema.oneOf ?? [], schema.anyOf ?? [], schema.allOf ?? []].flat();
  return [schema, ...inner.flatMap((part) => partsOf(part, all))];
}

/** Returns the options of a job that differ from the defaults. */
export async function chosenOptions(kind: string, options: Record<string, unknown>): Promise<Record<string, unknown>> {
  const all = await schemas();
  const properties = all[ALL[kind] ?? "Options"]?.properties ?? {};
  const isDefault = (name: string, value: unknown) => JSON.stringify(properties[name]?.default ?? null) === JSON.stringify(value);
  return Object.fromEntries(Object.entries(options).filter(([name, value]) => value !== null && !isDefault(name, value)));
}
