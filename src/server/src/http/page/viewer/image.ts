// A picture of the user's, to fill faces with.

import { NearestFilter, RepeatWrapping, type Texture, TextureLoader } from "three";

/** Its pixels as they are: not smoothed, not corrected, repeated beyond the unit square. */
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
