// Unwraps a glTF by way of glTF-Transform and says how long that took, in seconds.
//
//     node gltf_transform.mjs LIBRARY IN OUT
//
// LIBRARY is `watlas` or `unwrapd`, which glTF-Transform's own `unwrap` is given, or `transform` for ours.
// All packages are those of a folder that the environment names as PACKAGES.

import { createRequire } from 'node:module';
import { pathToFileURL } from 'node:url';

const modules = createRequire(pathToFileURL(`${process.env.PACKAGES}/`));
const load = (name) => import(pathToFileURL(modules.resolve(name)));
const [library, input, output] = process.argv.slice(2);
const { NodeIO } = await load('@gltf-transform/core');
const { ALL_EXTENSIONS } = await load('@gltf-transform/extensions');
const { dequantize, unpartition, unwrap } = await load('@gltf-transform/functions');
const { MeshoptDecoder } = await load('meshoptimizer').catch(() => ({}));

const { default: draco } = await load('draco3dgltf').catch(() => ({}));

const io = new NodeIO().registerExtensions(ALL_EXTENSIONS).registerDependencies({
  'draco3d.decoder': await draco?.createDecoderModule(),
  'meshopt.decoder': MeshoptDecoder,
});
const document = await io.read(input);
await document.transform(dequantize(), unpartition());
const { unwrapd } = library === 'transform' ? await load('unwrapd') : {};
const transform = unwrapd
  ? unwrapd({ texcoord: 0, overwrite: true, groupBy: 'mesh' })
  : unwrap({ watlas: await load(library), texcoord: 0, overwrite: true });
const begin = performance.now();
await document.transform(transform);
const seconds = (performance.now() - begin) / 1000;
for (const extension of document.getRoot().listExtensionsUsed()) {
  if (extension.writeDependencies.length > 0) extension.dispose();
}
await io.write(output, document);
console.log(seconds.toFixed(3));
