// Files in memory.

import { InvalidInput } from './errors.js';
import { answered, native, optionsOf, toJson } from './native.js';

/** Unwraps a file. */
export async function unwrapBytes(bytes, options) {
  const { name = 'mesh.glb', resources = {}, signal, onProgress, ...others } = optionsOf(options);
  signal?.throwIfAborted();
  const file = { name, bytes: bytesOf(bytes, 'the file'), resources: {} };
  for (const [uri, content] of Object.entries(resources)) file.resources[uri] = bytesOf(content, uri);
  return await unwrapped(file, toJson(others), signal, onProgress);
}

/** Bytes as the addon takes them: those of any buffer, or of a view of one. */
function bytesOf(given, what) {
  if (given instanceof Uint8Array) return given;
  if (given instanceof ArrayBuffer || given instanceof SharedArrayBuffer) return new Uint8Array(given);
  if (ArrayBuffer.isView(given)) return new Uint8Array(given.buffer, given.byteOffset, given.byteLength);
  const tip = typeof given === 'string' ? ': read a path with fs.readFile first' : '';
  const kind = given === null ? 'null' : typeof given;
  throw new InvalidInput(`${what} must be a Uint8Array or an ArrayBuffer, not ${kind}${tip}`, 'invalid_input', 3);
}

/** Milliseconds between two looks at the progress: ten a second are smooth for a person. */
const PROGRESS_PERIOD = 100;

async function unwrapped(file, options, signal, onProgress) {
  const cancellation = new native.Cancellation();
  const cancel = () => cancellation.cancel();
  signal?.addEventListener('abort', cancel, { once: true });
  const timer = onProgress && setInterval(() => {
    const progress = cancellation.progress();
    if (progress) onProgress(progress);
  }, PROGRESS_PERIOD);
  try {
    const answer = await native.unwrapDocument(file, options, cancellation);
    signal?.throwIfAborted();
    const { files, report } = answered(answer);
    const [main, ...others] = files;
    return { bytes: main.bytes, others, report };
  } finally {
    clearInterval(timer);
    signal?.removeEventListener('abort', cancel);
  }
}
