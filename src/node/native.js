// The addon, and what it answers as values or exceptions.

import { fileURLToPath } from 'node:url';
import { errorOf, InvalidOptions } from './errors.js';

const loaded = { exports: {} };
process.dlopen(loaded, fileURLToPath(new URL('./unwrapd.node', import.meta.url)));

export const native = loaded.exports;

/** An answer of the addon, thrown if it says why there is none. */
export function answered(answer) {
  if (answer.code !== undefined) throw errorOf(answer);
  return { ...answer, report: JSON.parse(answer.report) };
}

/** Options as an object; none for null. */
export function optionsOf(options) {
  if (options === undefined || options === null) return {};
  if (typeof options === 'object' && !Array.isArray(options)) return options;
  throw new InvalidOptions(`options must be an object, not ${typeof options}`, 'invalid_options', 2);
}

/** Options in camel case as the addon takes them; those that are absent are left out. A name that is none is refused. */
export function toJson(options) {
  const known = native.optionNames().map(camel);
  for (const name of Object.keys(options)) {
    if (!known.includes(name)) throw new InvalidOptions(unknown(name, known), 'invalid_options', 2);
  }
  const given = Object.entries(options).filter(([, value]) => value !== undefined && value !== null);
  return JSON.stringify(Object.fromEntries(given.map(([name, value]) => [snake(name), value])));
}

function snake(name) {
  return name.replace(/[A-Z]/g, (letter) => `_${letter.toLowerCase()}`);
}

function camel(name) {
  return name.replace(/_([a-z])/g, (_, letter) => letter.toUpperCase());
}

/** Why a name is no option, with the nearest that is one. */
function unknown(name, known) {
  const near = known.map((word) => [distance(camel(name), word), word]).sort(([a], [b]) => a - b)[0][1];
  return `unknown option '${name}'; did you mean '${near}'?`;
}

/** Letters to change, add or remove to come from one word to another (Levenshtein). */
function distance(from, to) {
  let row = Array.from({ length: to.length + 1 }, (_, i) => i);
  for (let i = 1; i <= from.length; i++) {
    const next = [i];
    for (let j = 1; j <= to.length; j++) {
      const replaced = row[j - 1] + (from[i - 1] === to[j - 1] ? 0 : 1);
      next.push(Math.min(replaced, row[j] + 1, next[j - 1] + 1));
    }
    row = next;
  }
  return row[to.length];
}
