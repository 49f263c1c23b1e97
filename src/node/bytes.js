// Files in memory.

import { answered, native, toJson } from './native.js';

/** Unwraps a file. */
export async function unwrapBytes(bytes, { name = 'mesh.glb', resources = {}, signal, ...options } = {}) {
  signal?.throwIfAborted();
  const cancellation = new native.Cancellation();
  const cancel = () => cancellation.cancel();
  signal?.addEventListener('abort', cancel, { once: true });
  try {
    const answer = await native.unwrapDocument({ name, bytes, resources }, toJson(options), cancellation);
    signal?.throwIfAborted();
    const { files, report } = answered(answer);
    const [main, ...others] = files;
    return { bytes: main.bytes, others, report };
  } finally {
    signal?.removeEventListener('abort', cancel);
  }
}
