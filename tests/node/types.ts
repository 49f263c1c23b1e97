// What a user of the package writes must pass the compiler; what is wrong must not.

import { Document } from '@gltf-transform/core';
import { unwrap } from '@gltf-transform/functions';
import * as unwrapdModule from 'unwrapd';
import { Atlas, InvalidInput, unwrapBytes, unwrapd, withOptions } from 'unwrapd';
import type * as watlas from 'watlas';

const document = new Document();
await document.transform(
  unwrap({ watlas: unwrapdModule, groupBy: 'scene' }),
  unwrap({ watlas: withOptions({ padding: 8, quality: 'few' }) }),
  unwrapd({ texcoord: 1, preset: 'lightmap', onReport: (report) => console.log(report.certified) }),
);

const atlas: watlas.Atlas = Object.assign(new Atlas(), { new: () => new Atlas() as unknown as watlas.Atlas });
atlas.addMesh({ vertexPositionData: new Float32Array(9), vertexCount: 3, vertexPositionStride: 12 });

try {
  const { bytes, report } = await unwrapBytes(new Uint8Array(), { name: 'mesh.obj', signal: AbortSignal.timeout(5) });
  console.log(bytes.length, report.warnings.length);
} catch (error) {
  if (error instanceof InvalidInput) console.log(error.code, error.exitCode);
}

// @ts-expect-error: there is no such word.
unwrapd({ quality: 'best' });
// @ts-expect-error: textures concern files.
unwrapd({ rebake: true });
