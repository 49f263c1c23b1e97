//! Sampling planes: sources of the texels of each group.

use super::images::Images;
use super::surface::Surface;
use unwrapd_files::bake::{Frames, Plane, Sampled, Texture};
use unwrapd_files::document::gltf::{GltfDocument, tangents};
use unwrapd_files::document::{BakePlane, DocumentError, Encoding, TextureSource};

/// Inputs of resampling.
pub(super) struct Bake<'a> {
    pub document: &'a GltfDocument,
    pub images: &'a Images,
    pub surfaces: &'a [Surface],
}

impl<'a> Bake<'a> {
    /// Returns the new UVs of a group, v down.
    pub fn faces(&self, members: &[usize]) -> Vec<[[f64; 2]; 3]> {
        let all = members.iter().flat_map(|&index| &self.surfaces[index].uvs);
        all.copied().collect()
    }

    /// Returns the sources of a group in one texture.
    pub fn plane(&self, wanted: &BakePlane, members: &[usize]) -> Result<Plane<'a>, DocumentError> {
        let mut plane = Plane {
            encoding: wanted.encoding,
            textures: Vec::new(),
            faces: Vec::new(),
            frames: None,
        };
        let mut frames = Frames {
            normals: Vec::new(),
            from: Vec::new(),
            to: Vec::new(),
        };
        for &index in members {
            let n_faces = self.surfaces[index].uvs.len();
            // Primitives without this texture have empty faces.
            let Some(source) = wanted.sources.get(&index) else {
                plane.faces.extend(std::iter::repeat_n(None, n_faces));
                frames.skip(n_faces);
                continue;
            };
            let texture = Texture {
                image: &self.images[&source.image],
                encoding: wanted.encoding,
                wrap: source.wrap,
                is_nearest: wanted.is_nearest(),
            };
            // Append the places of its faces, with frames for a normal map.
            let places = self.places(index, source)?;
            if wanted.encoding == Encoding::Normal {
                self.extend_frames(&mut frames, index, &places)?;
            }
            let (size, number) = (texture.size(), plane.textures.len() as u32);
            plane.textures.push(texture);
            plane.faces.extend(places.iter().map(|face| {
                Some(Sampled {
                    texture: number,
                    corners: face.map(|[u, v]| [u * size[0], v * size[1]]),
                })
            }));
        }
        plane.frames = (wanted.encoding == Encoding::Normal).then_some(frames);
        Ok(plane)
    }

    /// Returns the places of a primitive's corners in its image. Without UVs all are at (0, 0), as in renderers.
    fn places(
        &self,
        index: usize,
        source: &TextureSource,
    ) -> Result<Vec<[[f64; 2]; 3]>, DocumentError> {
        let uvs = self.document.corner_uvs(index, source.set)?;
        let uvs = uvs.unwrap_or_else(|| vec![[[0.0; 2]; 3]; self.surfaces[index].uvs.len()]);
        Ok(uvs
            .iter()
            .map(|face| face.map(|uv| source.place(uv)))
            .collect())
    }

    fn extend_frames(
        &self,
        frames: &mut Frames,
        index: usize,
        places: &[[[f64; 2]; 3]],
    ) -> Result<(), DocumentError> {
        let Some(directions) = &self.surfaces[index].directions else {
            return Ok(());
        };
        let from = if let Some(tangents) = self.document.corner_tangents(index)? {
            tangents
        } else {
            let upward = |[u, v]: [f64; 2]| [u as f32, (1.0 - v) as f32];
            let uvs: Vec<_> = places.iter().map(|face| face.map(upward)).collect();
            let primitive = &self.document.primitives()[index];
            let found = tangents(primitive, &directions.normals, &uvs);
            found.unwrap_or_else(|| directions.tangents.clone())
        };
        frames.from.extend(from);
        frames.normals.extend(&directions.normals);
        frames.to.extend(&directions.tangents);
        Ok(())
    }
}
