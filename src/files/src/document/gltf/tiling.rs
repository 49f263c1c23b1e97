//! Textures that repeat on a surface.
//!
//! A texture repeats where an island of the UVs that it samples is longer than its picture along an axis on which its
//! sampler repeats. Resampled for an atlas, such a texture needs texels of its own for every repetition.

use super::document::GltfDocument;
use super::slots::{slots, users};
use crate::document::{DocumentError, Group, Primitive, TextureSource, Wrap};
use std::collections::{BTreeMap, HashMap};
use unwrapd_maps::mesh::{CornerUvs, UnionFind};
use unwrapd_method::numerics::vec3::{area_vector, norm};

/// Length of an island, in multiples of the picture, up to which the picture counts as shown once: layouts overshoot
/// the square by their padding.
const ONCE: f64 = 1.1;

/// A texture that repeats on an island.
#[derive(Debug, Clone, PartialEq)]
pub struct TiledTexture {
    /// Index of the material.
    pub material: usize,
    /// Where in the material the texture is named.
    pub slot: String,
    /// Index of the image.
    pub image: usize,
    /// Greatest width and height of an island, in multiples of those of the picture.
    pub repeats: [f64; 2],
    /// Area of the faces that show it, in multiples of the picture's.
    pub area: f64,
    /// Area of a full atlas in which these faces keep their texels, in multiples of the picture's; the largest over all
    /// atlases. Faces are taken to have one texel density.
    pub atlas: f64,
}

impl GltfDocument {
    /// Returns the textures that repeat on an island of `groups`, each with an atlas.
    pub fn tiled_textures(&self, groups: &[Group]) -> Result<Vec<TiledTexture>, DocumentError> {
        let all: Vec<usize> = (groups.iter().flat_map(|group| &group.primitives))
            .copied()
            .collect();
        let users = users(self, &all)?;
        let mut tiled = Vec::new();
        for (material, slots) in slots(self, &users, &[], &BTreeMap::new()) {
            for slot in slots {
                let Ok(resampled) = slot.resampled else {
                    continue;
                };
                let source = resampled.source;
                // Measure the texture on each primitive.
                let mut shown: BTreeMap<usize, TextureOnPrimitive> = BTreeMap::new();
                for &index in &users[&material] {
                    if let Some(uvs) = self.corner_uvs(index, source.set)? {
                        shown.insert(
                            index,
                            TextureOnPrimitive::on(&self.primitives[index], &uvs, &source),
                        );
                    }
                }
                let longest =
                    |axis: usize| shown.values().fold(0.0, |n: f64, s| n.max(s.repeats[axis]));
                let repeats = [longest(0), longest(1)];
                if repeats.iter().any(|n| *n > ONCE) {
                    let atlases = groups.iter().map(|group| self.atlas_of(group, &shown));
                    tiled.push(TiledTexture {
                        material,
                        slot: slot.texture.slot,
                        image: source.image,
                        repeats,
                        area: shown.values().map(|shown| shown.area).sum(),
                        atlas: atlases.fold(0.0, f64::max),
                    });
                }
            }
        }
        Ok(tiled)
    }

    /// Returns the area of a full atlas of a group, in multiples of the picture's, in which texels keep their size.
    fn atlas_of(&self, group: &Group, shown: &BTreeMap<usize, TextureOnPrimitive>) -> f64 {
        let (mut area, mut own, mut whole) = (0.0, 0.0, 0.0);
        for index in &group.primitives {
            let surface = surface_area(&self.primitives[*index]);
            whole += surface;
            if let Some(shown) = shown.get(index) {
                area += shown.area;
                own += surface;
            }
        }
        if own > 0.0 { area * whole / own } else { 0.0 }
    }
}

/// A texture on a primitive.
struct TextureOnPrimitive {
    /// Greatest width and height of an island in multiples of the picture; 0 along axes without repetition.
    repeats: [f64; 2],
    /// Area of the faces in multiples of the picture's.
    area: f64,
}

impl TextureOnPrimitive {
    fn on(primitive: &Primitive, uvs: &[CornerUvs], source: &TextureSource) -> Self {
        let places: Vec<[[f64; 2]; 3]> = uvs
            .iter()
            .map(|face| face.map(|uv| source.place(uv)))
            .collect();
        // No island is longer than all of them together.
        let mut repeats = longest(&places, &vec![0; places.len()]);
        if repeats.iter().any(|n| *n > ONCE) {
            repeats = longest(&places, &islands(primitive, uvs));
        }
        for (n, wrap) in repeats.iter_mut().zip(source.wrap) {
            if wrap == Wrap::Clamp {
                *n = 0.0;
            }
        }
        let doubled = |[a, b, c]: &[[f64; 2]; 3]| {
            ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])).abs()
        };
        Self {
            repeats,
            area: 0.5 * places.iter().map(doubled).sum::<f64>(),
        }
    }
}

/// Returns the greatest extents of islands, given the island of each face.
fn longest(places: &[[[f64; 2]; 3]], islands: &[u32]) -> [f64; 2] {
    let empty = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
    let mut boxes: HashMap<u32, [[f64; 2]; 2]> = HashMap::new();
    for (face, island) in places.iter().zip(islands) {
        let [low, high] = boxes.entry(*island).or_insert(empty);
        for place in face {
            for k in 0..2 {
                low[k] = low[k].min(place[k]);
                high[k] = high[k].max(place[k]);
            }
        }
    }
    let extents = boxes.values();
    extents.fold([0.0; 2], |most, [low, high]| {
        [0, 1].map(|k| (high[k] - low[k]).max(most[k]))
    })
}

/// Returns the island of each face: faces are connected by corners with one position and one UV.
fn islands(primitive: &Primitive, uvs: &[CornerUvs]) -> Vec<u32> {
    let mut sets = UnionFind::new(uvs.len());
    let mut first: HashMap<([u32; 3], [u64; 2]), u32> = HashMap::new();
    for ((face, triangle), corners) in (0..).zip(&primitive.triangles).zip(uvs) {
        for (vertex, uv) in triangle.iter().zip(corners) {
            let position = primitive.positions[*vertex as usize].map(|x| (x + 0.0).to_bits());
            let key = (position, uv.map(|x| (x + 0.0).to_bits()));
            sets.unite(face, *first.entry(key).or_insert(face));
        }
    }
    sets.labels().0
}

fn surface_area(primitive: &Primitive) -> f64 {
    let position = |vertex: u32| primitive.positions[vertex as usize].map(f64::from);
    let area = |face: &[u32; 3]| {
        let [a, b, c] = face.map(position);
        0.5 * norm(area_vector(a, b, c))
    };
    primitive.triangles.iter().map(area).sum()
}
