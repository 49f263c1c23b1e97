// A transform of glTF-Transform: a document goes through the library as a glTF; what changed of its meshes comes back.

import { createRequire } from 'node:module';
import { unwrapBytes } from './bytes.js';
import { InvalidInput, InvalidOptions } from './errors.js';
import { optionsOf } from './native.js';

/** Options that change more of a document than its meshes. */
const OF_FILES = ['rebake', 'bakeTiled', 'bakeColors', 'bakeSize', 'imageFormat', 'mergeMaterials', 'format', 'name', 'resources'];

/** Unwraps every mesh of a document; all else stays as it is. */
export function unwrapd(given) {
  const { onReport, ...options } = optionsOf(given);
  const refused = OF_FILES.find((name) => options[name] !== undefined);
  if (refused) {
    throw new InvalidOptions(`\`${refused}\` concerns files: unwrapBytes takes it`, 'invalid_options', 2);
  }
  async function transform(document) {
    const io = await ioOf(document);
    const { json, resources } = await io.writeJSON(document, { basename: 'document' });
    const named = Object.entries(resources).map(([uri, bytes]) => [decodeURIComponent(uri), bytes]);
    const { bytes, report } = await unwrapBytes(new TextEncoder().encode(JSON.stringify(json)), {
      ...options,
      name: 'document.gltf',
      resources: Object.fromEntries(named),
      format: 'glb',
    });
    takeOver(document, await io.readBinary(bytes));
    onReport?.(report);
  }
  return Object.defineProperty(transform, 'name', { value: 'unwrapd' });
}

/** Input and output with all extensions of a document but those that only compress, which need encoders. */
async function ioOf(document) {
  const { NodeIO } = await coreOf(document);
  const used = document.getRoot().listExtensionsUsed();
  const others = used.filter((extension) => extension.writeDependencies.length === 0);
  const io = new NodeIO().registerExtensions(others.map((extension) => extension.constructor));
  return io.setLogger(document.getLogger());
}

/** The copy of glTF-Transform that a document is of: that for `import` or that for `require`. */
async function coreOf(document) {
  // Not before it is needed: files are unwrapped without it.
  const imported = await import('@gltf-transform/core');
  if (document instanceof imported.Document) return imported;
  const required = createRequire(import.meta.url)('@gltf-transform/core');
  if (document instanceof required.Document) return required;
  throw new InvalidInput('the document is of another copy of @gltf-transform/core', 'invalid_document', 3);
}

/** Gives the primitives of a document the attributes, morph targets and indices that those of another have. */
function takeOver(document, unwrapped) {
  const accessors = new Accessors(document);
  const primitives = (from) => from.getRoot().listMeshes().flatMap((mesh) => mesh.listPrimitives());
  const made = primitives(unwrapped);
  for (const [i, primitive] of primitives(document).entries()) {
    const indices = accessors.taken(primitive.getIndices(), made[i].getIndices());
    primitive.setIndices(indices).setMode(made[i].getMode());
    accessors.takeAttributes(primitive, made[i]);
    const targets = made[i].listTargets();
    for (const [t, target] of primitive.listTargets().entries()) {
      accessors.takeAttributes(target, targets[t]);
    }
  }
  accessors.dispose();
}

/** Accessors of a document, and what stands for those of another. */
class Accessors {
  #document;
  #known = new Map();
  #replaced = new Set();

  constructor(document) {
    this.#document = document;
  }

  takeAttributes(primitive, from) {
    const before = new Map(primitive.listSemantics().map((semantic) => [semantic, primitive.getAttribute(semantic)]));
    const present = primitive.getAttribute('POSITION');
    for (const semantic of from.listSemantics()) {
      const own = before.get(semantic);
      primitive.setAttribute(semantic, this.taken(own, from.getAttribute(semantic), own ?? present));
    }
  }

  /** What stands for an accessor: the one that was there if nothing changed, else a copy, once for all who share it. */
  taken(own, made, like = own) {
    if (!made) return own;
    if (own && isEqual(own.getArray(), made.getArray())) return own;
    if (own) this.#replaced.add(own);
    if (this.#known.has(made)) return this.#known.get(made);
    const copy = own ? own.clone() : this.#document.createAccessor().setBuffer(like?.getBuffer() ?? null);
    copy.setArray(made.getArray()).setType(made.getType()).setNormalized(made.getNormalized());
    this.#known.set(made, copy);
    return copy;
  }

  /** Removes those that nothing refers to anymore. */
  dispose() {
    for (const accessor of this.#replaced) {
      const isUsed = accessor.listParents().some((parent) => parent.propertyType !== 'Root');
      if (!isUsed) accessor.dispose();
    }
  }
}

function isEqual(a, b) {
  if (a.constructor !== b.constructor || a.length !== b.length) return false;
  const bytes = (array) => Buffer.from(array.buffer, array.byteOffset, array.byteLength);
  return bytes(a).equals(bytes(b));
}
