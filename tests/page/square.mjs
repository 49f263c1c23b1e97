// A glTF with a picture in KTX2.

/** Returns the text of a glTF: a square with a picture in KTX2. */
export function square(picture) {
  const floats = (...numbers) => Buffer.from(new Float32Array(numbers).buffer);
  const parts = [floats(-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0), floats(0, 1, 1, 1, 1, 0, 0, 0), Buffer.from(new Uint16Array([0, 1, 2, 0, 2, 3]).buffer), picture];
  const bufferViews = parts.map((part, k) => ({ buffer: 0, byteOffset: parts.slice(0, k).reduce((sum, { length }) => sum + length, 0), byteLength: part.length }));
  const accessor = (bufferView, componentType, count, type, more = {}) => ({ bufferView, componentType, count, type, ...more });
  return JSON.stringify({
    asset: { version: "2.0" }, extensionsUsed: ["KHR_texture_basisu"], extensionsRequired: ["KHR_texture_basisu"], scene: 0, scenes: [{ nodes: [0] }], nodes: [{ mesh: 0 }],
    meshes: [{ primitives: [{ attributes: { POSITION: 0, TEXCOORD_0: 1 }, indices: 2, material: 0 }] }],
    materials: [{ pbrMetallicRoughness: { baseColorTexture: { index: 0 }, metallicFactor: 0 } }],
    textures: [{ extensions: { KHR_texture_basisu: { source: 0 } } }], images: [{ mimeType: "image/ktx2", bufferView: 3 }],
    accessors: [accessor(0, 5126, 4, "VEC3", { min: [-1, -1, 0], max: [1, 1, 0] }), accessor(1, 5126, 4, "VEC2"), accessor(2, 5123, 6, "SCALAR")],
    bufferViews, buffers: [{ byteLength: parts.reduce((sum, { length }) => sum + length, 0), uri: `data:application/octet-stream;base64,${Buffer.concat(parts).toString("base64")}` }],
  });
}
