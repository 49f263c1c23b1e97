// The user's picture for filling faces.

import { NearestFilter, RepeatWrapping, type Texture, TextureLoader } from "three";

/** Loads a picture without smoothing or color correction, repeated beyond the unit square. */
export async function imageOf(file: Blob): Promise<Texture> {
  const url = URL.createObjectURL(file);
  const texture = await new TextureLoader().loadAsync(url).finally(() => URL.revokeObjectURL(url));
  texture.magFilter = NearestFilter;
  texture.minFilter = NearestFilter;
  texture.generateMipmaps = false;
  texture.wrapS = texture.wrapT = RepeatWrapping;
  texture.colorSpace = "";
  return texture;
}
