// Decoders of compressed meshes and pictures in glTF. They are fetched when a file needs them.

import type { LoadingManager } from "three";
import { MeshoptDecoder } from "three/addons/libs/meshopt_decoder.module.js";
import { DRACOLoader } from "three/addons/loaders/DRACOLoader.js";
import type { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import type { KTX2Loader } from "three/addons/loaders/KTX2Loader.js";
import { decode } from "../app/api";

/** Workers that decode at once. Each has a copy of the decoder, a fifth of a megabyte. */
const WORKERS = 2;

/** Loads pictures in KTX2 as the PNG that the service makes of them. A transcoder in the page would need `eval`, which its
 * security policy forbids. */
class ServiceDecoder {
  /** Tells `GLTFLoader` to expect pictures, not textures. */
  readonly isImageBitmapLoader = true;

  constructor(readonly manager: LoadingManager) {}

  load(url: string, loaded: (picture: ImageBitmap) => void, _progressed: unknown, failed: (error: unknown) => void): void {
    const address = this.manager.resolveURL(url);
    void this.#picture(address).then(loaded, (error: unknown) => {
      this.manager.itemError(address);
      failed(error);
    });
  }

  async #picture(address: string): Promise<ImageBitmap> {
    const texture = await (await fetch(address)).blob();
    return createImageBitmap(await decode(texture), { premultiplyAlpha: "none", colorSpaceConversion: "none" });
  }
}

/** Lets a loader read compressed files; `assets` is the address of the decoders. Returns a function that frees them. */
export async function addDecoders(loader: GLTFLoader, manager: LoadingManager, assets: string): Promise<() => void> {
  const draco = new DRACOLoader(manager).setDecoderPath(assets).setWorkerLimit(WORKERS);
  await MeshoptDecoder.ready;
  loader.setDRACOLoader(draco).setMeshoptDecoder(MeshoptDecoder).setKTX2Loader(new ServiceDecoder(manager) as unknown as KTX2Loader);
  return () => draco.dispose();
}
