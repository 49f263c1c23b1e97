// The addon, and what it answers as values or exceptions.

import { fileURLToPath } from 'node:url';
import { errorOf } from './errors.js';

const loaded = { exports: {} };
process.dlopen(loaded, fileURLToPath(new URL('./unwrapd.node', import.meta.url)));

export const native = loaded.exports;

/** An answer of the addon, thrown if it says why there is none. */
export function answered(answer) {
  if (answer.code !== undefined) throw errorOf(answer);
  return { ...answer, report: JSON.parse(answer.report) };
}

/** Options in camel case as the addon takes them; those that are absent are left out. */
export function toJson(options) {
  const snake = (name) => name.replace(/[A-Z]/g, (letter) => `_${letter.toLowerCase()}`);
  const given = Object.entries(options).filter(([, value]) => value !== undefined && value !== null);
  return JSON.stringify(Object.fromEntries(given.map(([name, value]) => [snake(name), value])));
}
