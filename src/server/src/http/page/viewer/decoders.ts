// Decoders of meshes in glTF that are compressed by Draco or meshopt. They are fetched when a file needs them.

import type { LoadingManager } from "three";
import { MeshoptDecoder } from "three/addons/libs/meshopt_decoder.module.js";
import { DRACOLoader } from "three/addons/loaders/DRACOLoader.js";
import type { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";

/** Workers that decode at once. Each has a copy of the decoder, a fifth of a megabyte. */
const WORKERS = 2;

/** Lets a loader read compressed files; `assets` is the address of the decoders. Returns a function that frees them. */
export async function addDecoders(loader: GLTFLoader, manager: LoadingManager, assets: string): Promise<() => void> {
  const draco = new DRACOLoader(manager).setDecoderPath(assets).setWorkerLimit(WORKERS);
  await MeshoptDecoder.ready;
  loader.setDRACOLoader(draco).setMeshoptDecoder(MeshoptDecoder);
  return () => draco.dispose();
}
