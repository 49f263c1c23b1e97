//! The textures of a document, resampled for its new UVs.

use rayon::prelude::*;
use std::collections::BTreeMap;

use super::PipelineError;
use super::options::Options;
use crate::bake::{Coverage, Frames, MOST_TEXELS, Plane, Sampled, Texture, baked, side_for};
use crate::document::gltf::{GltfDocument, tangents};
use crate::document::{
    BakePlane, BakedTextures, CornerTangents, Document, DocumentError, Encoding, Group, NewUvs,
    TextureSource,
};
use crate::picture::Image;

/// Pixels of all images together at most: a gigabyte.
const MOST_PIXELS: usize = 1 << 28;

/// Textures for `uvs`, v up, in place of all that can be read and are understood.
pub(super) fn rebaked(
    document: &Document,
    groups: &[Group],
    uvs: &NewUvs,
    options: &Options,
) -> Result<BakedTextures, PipelineError> {
    let Document::Gltf(document) = document else {
        let what = "new textures for another format than glTF".to_owned();
        return Err(DocumentError::UnsupportedOutput(what).into());
    };
    let hoped = document.bake_plan(groups, &BTreeMap::new())?;
    let (images, unreadable) = read_images(document, &hoped.planes)?;
    let plan = document.bake_plan(groups, &unreadable)?;
    let surfaces: Vec<Surface> = (0..document.primitives().len())
        .into_par_iter()
        .map(|index| Surface::new(document, index, uvs, plan.is_normal_mapped(index)))
        .collect::<Result<_, _>>()?;
    let bake = Bake {
        document,
        images: &images,
        surfaces: &surfaces,
    };
    let least = options.bake_size.unwrap_or(options.resolution);
    check_texels(u64::from(least).pow(2) * plan.planes.len() as u64)?;
    let mut files = Vec::new();
    let mut texels = 0;
    let mut coverage: Option<(usize, Coverage)> = None;
    for wanted in &plan.planes {
        let members = &groups[wanted.group].primitives;
        let plane = bake.plane(wanted, members)?;
        let faces = bake.faces(members);
        let side = options.bake_size.unwrap_or_else(|| {
            let dense = side_for(&plane, &faces);
            options.resolution.max(dense)
        });
        texels += u64::from(side).pow(2);
        check_texels(texels)?;
        let key = wanted.group;
        let ready = coverage
            .take()
            .filter(|(of, c)| *of == key && c.side() == side as usize);
        let (_, covered) =
            coverage.insert(ready.unwrap_or_else(|| (key, Coverage::new(&faces, side as usize))));
        files.push((side, baked(&plane, covered).png()));
    }
    Ok(BakedTextures {
        plan,
        files,
        tangents: surfaces
            .into_iter()
            .map(Surface::written_tangents)
            .collect(),
    })
}

fn check_texels(texels: u64) -> Result<(), DocumentError> {
    if texels <= MOST_TEXELS {
        return Ok(());
    }
    let (most, wanted) = (MOST_TEXELS >> 20, texels >> 20);
    Err(DocumentError::LimitExceeded(format!(
        "the new textures would have {wanted} Mi texels or more; at most {most} Mi are made"
    )))
}

/// Images by index.
type Images = BTreeMap<usize, Image>;

/// The images that are sampled, and why others cannot be read.
fn read_images(
    document: &GltfDocument,
    planes: &[BakePlane],
) -> Result<(Images, BTreeMap<usize, String>), DocumentError> {
    let sources = planes.iter().flat_map(|plane| plane.sources.values());
    let mut indices: Vec<usize> = sources.map(|source| source.image).collect();
    indices.sort_unstable();
    indices.dedup();
    let (mut images, mut unreadable) = (Images::new(), BTreeMap::new());
    let mut pixels = 0;
    for index in indices {
        let decoded = match document.image(index) {
            Ok(bytes) => Image::decode(&bytes).map_err(|error| error.to_string()),
            Err(error) => Err(error.to_string()),
        };
        match decoded {
            Ok(image) => {
                pixels += image.pixels.len();
                images.insert(index, image);
            }
            Err(reason) => drop(unreadable.insert(index, reason)),
        }
        if pixels > MOST_PIXELS {
            let most = MOST_PIXELS >> 20;
            return Err(DocumentError::LimitExceeded(format!(
                "the images have more than {most} Mi pixels"
            )));
        }
    }
    Ok((images, unreadable))
}

/// A primitive with its new UVs.
struct Surface {
    /// v down.
    uvs: Vec<[[f64; 2]; 3]>,
    directions: Option<Directions>,
}

/// What normal maps are relative to.
struct Directions {
    normals: Vec<[[f32; 3]; 3]>,
    tangents: Vec<CornerTangents>,
    /// Whether the document has these normals; else they are those of the flat faces, and tangents have no place in it.
    are_given: bool,
}

impl Surface {
    fn new(
        document: &GltfDocument,
        index: usize,
        uvs: &NewUvs,
        is_normal_mapped: bool,
    ) -> Result<Self, DocumentError> {
        let upward = uvs.corners[index].as_deref().unwrap_or_default();
        let downward = |[u, v]: [f32; 2]| [f64::from(u), 1.0 - f64::from(v)];
        let directions = if is_normal_mapped {
            Some(Directions::new(document, index, upward)?)
        } else {
            None
        };
        Ok(Self {
            uvs: upward.iter().map(|face| face.map(downward)).collect(),
            directions,
        })
    }

    fn written_tangents(self) -> Option<Vec<CornerTangents>> {
        let directions = self.directions.filter(|directions| directions.are_given);
        directions.map(|directions| directions.tangents)
    }
}

impl Directions {
    fn new(
        document: &GltfDocument,
        index: usize,
        uvs: &[[[f32; 2]; 3]],
    ) -> Result<Self, DocumentError> {
        let primitive = &document.primitives()[index];
        let single = |face: [[f64; 3]; 3]| face.map(|n| n.map(|x| x as f32));
        let given = document.corner_normals(index)?;
        let are_given = given.is_some();
        let normals: Vec<_> = match given {
            Some(normals) => normals.into_iter().map(single).collect(),
            None => (primitive.triangles.iter())
                .map(|face| [flat_normal(face.map(|v| primitive.positions[v as usize])); 3])
                .collect(),
        };
        let tangents = tangents(primitive, &normals, uvs);
        Ok(Self {
            tangents: tangents.unwrap_or_else(|| vec![[[1.0, 0.0, 0.0, 1.0]; 3]; uvs.len()]),
            normals,
            are_given,
        })
    }
}

/// The normal of a face, not of unit length.
fn flat_normal([a, b, c]: [[f32; 3]; 3]) -> [f32; 3] {
    let (e, f) = (
        [0, 1, 2].map(|k| b[k] - a[k]),
        [0, 1, 2].map(|k| c[k] - a[k]),
    );
    let normal = [
        e[1] * f[2] - e[2] * f[1],
        e[2] * f[0] - e[0] * f[2],
        e[0] * f[1] - e[1] * f[0],
    ];
    let length = normal.iter().map(|x| x * x).sum::<f32>().sqrt();
    normal.map(|x| x / length.max(f32::MIN_POSITIVE))
}

/// What textures are made of.
struct Bake<'a> {
    document: &'a GltfDocument,
    images: &'a Images,
    surfaces: &'a [Surface],
}

impl<'a> Bake<'a> {
    /// The new UVs of a group, v down.
    fn faces(&self, members: &[usize]) -> Vec<[[f64; 2]; 3]> {
        let all = members.iter().flat_map(|&index| &self.surfaces[index].uvs);
        all.copied().collect()
    }

    fn plane(&self, wanted: &BakePlane, members: &[usize]) -> Result<Plane<'a>, DocumentError> {
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

    /// Where in its image the corners of a primitive lie; without UVs all at the place of (0, 0), as renderers have it.
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
        let from = match self.document.corner_tangents(index)? {
            Some(tangents) => tangents,
            None => {
                let upward = |[u, v]: [f64; 2]| [u as f32, (1.0 - v) as f32];
                let uvs: Vec<_> = places.iter().map(|face| face.map(upward)).collect();
                let primitive = &self.document.primitives()[index];
                let found = tangents(primitive, &directions.normals, &uvs);
                found.unwrap_or_else(|| directions.tangents.clone())
            }
        };
        frames.from.extend(from);
        frames.normals.extend(&directions.normals);
        frames.to.extend(&directions.tangents);
        Ok(())
    }
}
