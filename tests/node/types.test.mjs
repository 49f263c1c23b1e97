// The declarations: what they allow, and that they name what there is.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import { test } from 'node:test';
import * as unwrapd from 'unwrapd';

const require = createRequire(import.meta.url);
const folder = new URL('./node_modules/unwrapd/', import.meta.url);

test('a program that uses them compiles', () => {
  const flags = ['--noEmit', '--strict', '--skipLibCheck', '--target', 'es2023', '--lib', 'es2023,dom'];
  const modules = ['--module', 'nodenext', '--moduleResolution', 'nodenext', '--types', ''];
  execFileSync('node_modules/.bin/tsc', [...flags, ...modules, 'types.ts'], { stdio: 'inherit' });
});

test('they name what is exported', async () => {
  const text = await readFile(new URL('index.d.ts', folder), 'utf8');
  const named = [...text.matchAll(/^export (?:class|function|const) (\w+)/gm)].map((match) => match[1]);
  assert.deepEqual(named.sort(), Object.keys(unwrapd).sort());
});

test('they name the options that there are', async () => {
  const text = await readFile(new URL('options.d.ts', folder), 'utf8');
  const named = new Set([...text.matchAll(/^ {2}(\w+)\?:/gm)].map((match) => match[1]));
  for (const own of ['signal', 'onProgress', 'onReport', 'name', 'resources']) assert.ok(named.delete(own), own);
  const loaded = { exports: {} };
  process.dlopen(loaded, new URL('unwrapd.node', folder).pathname);
  const camel = (name) => name.replace(/_(\w)/g, (_, letter) => letter.toUpperCase());
  const known = loaded.exports.optionNames().map(camel);
  assert.deepEqual([...named].sort(), [...new Set(known)].sort());
});

test('nothing but Node is needed to load it', async () => {
  const { files } = require('unwrapd/package.json');
  for (const name of files.filter((file) => file.endsWith('.js'))) {
    const text = await readFile(new URL(name, folder), 'utf8');
    const imported = [...text.matchAll(/ from '(.*)';/g)].map((match) => match[1]);
    assert.ok(imported.every((module) => /^(\.|node:)/.test(module)), `${name}: ${imported}`);
  }
});

test('the version is that of the library', () => {
  const manifest = require('unwrapd/package.json');
  assert.equal(manifest.version, process.env.UNWRAPD_VERSION);
});
