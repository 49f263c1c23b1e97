//! The material that replaces others.
//!
//! A renderer computes each number of a surface, such as its roughness, from a factor of the material and a texel. The
//! material that replaces others has the largest of their factors; the texels drawn for a material are multiplied by the
//! ratio of its factor to that, so every product stays as it was, and materials of equal factors keep their texels. A
//! material without a texture gets texels of one color.

use super::document::GltfDocument;
use super::json::{invalid, item, object_mut, remove, remove_extension};
use super::slots::{BASE_COLOR, Slot};
use crate::document::{DocumentError, Encoding, MergedMaterial, PlaneSource, TextureSource, Tint};
use serde_json::{Map, Value, json};
use std::collections::BTreeMap;

/// Extension with a factor on emitted light, which may exceed 1.
pub(super) const EMISSIVE_STRENGTH: &str = "KHR_materials_emissive_strength";

const METALLIC_ROUGHNESS: &str = "pbrMetallicRoughness/metallicRoughnessTexture";
const NORMAL: &str = "normalTexture";
const OCCLUSION: &str = "occlusionTexture";
const EMISSIVE: &str = "emissiveTexture";
const CORE: [&str; 5] = [BASE_COLOR, METALLIC_ROUGHNESS, NORMAL, OCCLUSION, EMISSIVE];

/// A material that replaces others, and the textures to make for it.
pub(super) struct Replacement {
    /// The material; its texture infos have no textures yet.
    pub material: Value,
    pub planes: Vec<ReplacementPlane>,
}

/// A texture of a merged material.
pub(super) struct ReplacementPlane {
    /// Paths within the material.
    pub slots: Vec<String>,
    pub encoding: Encoding,
    /// Filters of the sampler, as in `BakePlane`.
    pub filters: [Option<usize>; 2],
    /// Source for each of the materials.
    pub sources: BTreeMap<usize, PlaneSource>,
}

/// Texture and map of the values of one material in one slot.
struct Drawn<'a> {
    source: Option<&'a TextureSource>,
    filters: Option<[Option<usize>; 2]>,
    tint: Tint,
}

/// A material to merge.
struct Member<'a> {
    index: usize,
    object: &'a Value,
    slots: &'a [Slot],
}

impl Replacement {
    /// Merges materials, given their textures; `is_colored` if a texture of base colors is needed in any case. All must
    /// agree in their traits.
    pub fn new(
        document: &GltfDocument,
        merged: &MergedMaterial,
        slots: &BTreeMap<usize, Vec<Slot>>,
        is_colored: bool,
    ) -> Result<Self, DocumentError> {
        let members: Vec<Member> = (merged.members.iter())
            .map(|&index| {
                let slots = slots.get(&index);
                Ok(Member {
                    index,
                    object: item(&document.body.json, "materials", index)?,
                    slots: slots.ok_or_else(|| invalid("a material to merge has no triangles"))?,
                })
            })
            .collect::<Result<_, DocumentError>>()?;
        let first = members
            .first()
            .ok_or_else(|| invalid("no material to merge"))?;
        // Begin with what all have in common.
        let mut material = first.object.clone();
        material["name"] = json!(merged.name);
        let extras = |member: &Member| member.object.get("extras").cloned();
        if members.iter().any(|member| extras(member) != extras(first)) {
            remove(&mut material, "extras");
        }
        for slot in CORE {
            let (parent, name) = slot.rsplit_once('/').unwrap_or(("", slot));
            let parent = if parent.is_empty() {
                Some(&mut material)
            } else {
                material.get_mut(parent)
            };
            parent.and_then(|parent| remove(parent, name));
        }
        let mut replacement = Self {
            material,
            planes: Vec::new(),
        };
        // Draw the core textures, then those of extensions, whose factors agree.
        replacement.draw_base_color(&members, is_colored)?;
        replacement.draw_surface(&members)?;
        replacement.draw_normals(&members);
        replacement.draw_emission(&members)?;
        let of_extensions = (first.slots.iter())
            .map(|slot| slot.texture.slot.as_str())
            .filter(|slot| !CORE.contains(slot));
        for slot in of_extensions {
            let drawn = members
                .iter()
                .map(|member| member.drawn(slot, Tint::NONE, Tint::NONE));
            let encoding = first.resampled(slot).map(|(encoding, ..)| encoding);
            if let Some(encoding) = encoding {
                let drawn = drawn.collect();
                replacement.push(&[slot], encoding, &members, drawn);
            }
        }
        Ok(replacement)
    }

    /// Adds a texture.
    fn push(&mut self, slots: &[&str], encoding: Encoding, members: &[Member], drawn: Vec<Drawn>) {
        let filters = drawn.iter().find_map(|drawn| drawn.filters);
        self.planes.push(ReplacementPlane {
            slots: slots.iter().map(|&slot| slot.to_owned()).collect(),
            encoding,
            filters: filters.unwrap_or_default(),
            sources: (members.iter().zip(drawn))
                .map(|(member, drawn)| (member.index, drawn.source()))
                .collect(),
        });
    }

    /// Sets a member of the part of the material for the metallic-roughness model, unless it is the default.
    fn set_factor(
        &mut self,
        name: &str,
        value: Value,
        default: &Value,
    ) -> Result<(), DocumentError> {
        let object = object_mut(&mut self.material)?;
        let model = object
            .entry("pbrMetallicRoughness")
            .or_insert_with(|| json!({}));
        remove(model, name);
        if value != *default {
            object_mut(model)?.insert(name.to_owned(), value);
        }
        if model.as_object().is_some_and(Map::is_empty) {
            remove(&mut self.material, "pbrMetallicRoughness");
        }
        Ok(())
    }

    fn draw_base_color(
        &mut self,
        members: &[Member],
        is_colored: bool,
    ) -> Result<(), DocumentError> {
        let is_opaque = self
            .material
            .get("alphaMode")
            .is_none_or(|mode| mode == "OPAQUE");
        let factor = |member: &Member| -> [f64; 4] {
            let factor = numbers(member.object, "/pbrMetallicRoughness/baseColorFactor", 1.0);
            // Opaque materials have no alpha.
            if is_opaque {
                [factor[0], factor[1], factor[2], 1.0]
            } else {
                factor
            }
        };
        let most = most(members.iter().map(factor));
        self.set_factor("baseColorFactor", json!(most), &json!([1.0, 1.0, 1.0, 1.0]))?;
        let drawn: Vec<Drawn> = (members.iter())
            .map(|member| {
                let mut tint = Tint::factor(ratio(factor(member), most));
                if is_opaque {
                    (tint.factor[3], tint.offset[3]) = (0.0, 1.0);
                }
                member.drawn(BASE_COLOR, tint, tint)
            })
            .collect();
        if is_colored || is_needed(&drawn) {
            self.push(&[BASE_COLOR], Encoding::Color, members, drawn);
        }
        Ok(())
    }

    /// Draws occlusion, roughness and metalness: red, green and blue of one texture, unless a material takes them from
    /// different ones.
    fn draw_surface(&mut self, members: &[Member]) -> Result<(), DocumentError> {
        let factor = |member: &Member| {
            let number =
                |name| number(member.object, &format!("/pbrMetallicRoughness/{name}"), 1.0);
            [
                1.0,
                number("roughnessFactor"),
                number("metallicFactor"),
                1.0,
            ]
        };
        let most = most(members.iter().map(factor));
        let [_, roughness, metallic, _] = most;
        self.set_factor("roughnessFactor", json!(roughness), &json!(1.0))?;
        self.set_factor("metallicFactor", json!(metallic), &json!(1.0))?;
        let model: Vec<Drawn> = (members.iter())
            .map(|member| {
                let tint = Tint::factor(ratio(factor(member), most));
                member.drawn(METALLIC_ROUGHNESS, tint, tint)
            })
            .collect();
        // Occlusion is 1 + strength (x − 1).
        let strength = |member: &Member| number(member.object, "/occlusionTexture/strength", 1.0);
        let textured = members
            .iter()
            .filter(|member| member.resampled(OCCLUSION).is_some());
        let strongest = textured.map(strength).fold(0.0, f64::max);
        let occlusion: Vec<Drawn> = (members.iter())
            .map(|member| {
                let [share, ..] = ratio([strength(member); 4], [strongest; 4]);
                let tint = Tint {
                    factor: [share, 1.0, 1.0, 1.0],
                    offset: [1.0 - share, 0.0, 0.0, 0.0],
                };
                member.drawn(OCCLUSION, tint, Tint::NONE)
            })
            .collect();
        let needed = [is_needed(&model), is_needed(&occlusion)];
        if needed[1] {
            self.material[OCCLUSION] = info("strength", strongest);
        }
        if needed == [true, true]
            && let Some(both) = united(&occlusion, &model)
        {
            self.push(
                &[OCCLUSION, METALLIC_ROUGHNESS],
                Encoding::Data,
                members,
                both,
            );
            return Ok(());
        }
        if needed[0] {
            self.push(&[METALLIC_ROUGHNESS], Encoding::Data, members, model);
        }
        if needed[1] {
            self.push(&[OCCLUSION], Encoding::Data, members, occlusion);
        }
        Ok(())
    }

    fn draw_normals(&mut self, members: &[Member]) {
        let scale = |member: &Member| number(member.object, "/normalTexture/scale", 1.0);
        let mapped = members
            .iter()
            .filter(|member| member.resampled(NORMAL).is_some());
        let largest = mapped.map(scale).fold(0.0, f64::max);
        let largest = if largest > 0.0 { largest } else { 1.0 };
        let drawn: Vec<Drawn> = (members.iter())
            .map(|member| {
                let share = (scale(member) / largest) as f32;
                // A missing texture is white, (1, 1, 1); only its third component is kept: a flat normal.
                let plain = Tint::factor([0.0, 0.0, 1.0, 1.0]);
                member.drawn(NORMAL, Tint::factor([share, share, 1.0, 1.0]), plain)
            })
            .collect();
        if drawn.iter().any(|drawn| drawn.source.is_some()) {
            self.material[NORMAL] = info("scale", largest);
            self.push(&[NORMAL], Encoding::Normal, members, drawn);
        }
    }

    fn draw_emission(&mut self, members: &[Member]) -> Result<(), DocumentError> {
        let emission = |member: &Member| {
            let factor = numbers::<3>(member.object, "/emissiveFactor", 0.0);
            let strength = format!("/extensions/{EMISSIVE_STRENGTH}/emissiveStrength");
            let strength = number(member.object, &strength, 1.0);
            let [r, g, b] = factor.map(|x| x * strength);
            [r, g, b, 1.0]
        };
        let most = most(members.iter().map(emission));
        let [r, g, b, _] = most;
        let strength = r.max(g).max(b).max(1.0);
        // Write the factor and the strength unless they are the defaults.
        remove(&mut self.material, "emissiveFactor");
        remove_extension(&mut self.material, EMISSIVE_STRENGTH);
        if [r, g, b] == [0.0; 3] {
            return Ok(());
        }
        self.material["emissiveFactor"] = json!([r, g, b].map(|x| x / strength));
        if strength > 1.0 {
            let extensions = object_mut(&mut self.material)?
                .entry("extensions")
                .or_insert_with(|| json!({}));
            let strength = json!({"emissiveStrength": strength});
            object_mut(extensions)?.insert(EMISSIVE_STRENGTH.to_owned(), strength);
        }
        let drawn: Vec<Drawn> = (members.iter())
            .map(|member| {
                let own = emission(member);
                let tint = Tint::factor(ratio(own, most));
                if own[..3] == [0.0; 3] {
                    return Drawn::plain(tint);
                }
                member.drawn(EMISSIVE, tint, tint)
            })
            .collect();
        if is_needed(&drawn) {
            self.push(&[EMISSIVE], Encoding::Color, members, drawn);
        }
        Ok(())
    }
}

impl<'a> Member<'a> {
    fn resampled(&self, slot: &str) -> Option<(Encoding, [Option<usize>; 2], &'a TextureSource)> {
        let mut slots = self.slots.iter();
        let found = slots.find(|candidate| candidate.texture.slot == slot)?;
        let resampled = found.resampled.as_ref().ok()?;
        Some((resampled.encoding, resampled.filters, &resampled.source))
    }

    /// Draws the texture of a slot with one map of its values, or white with the other.
    fn drawn(&self, slot: &str, textured: Tint, plain: Tint) -> Drawn<'a> {
        match self.resampled(slot) {
            Some((_, filters, source)) => Drawn {
                source: Some(source),
                filters: Some(filters),
                tint: textured,
            },
            None => Drawn::plain(plain),
        }
    }
}

impl Drawn<'_> {
    fn plain(tint: Tint) -> Self {
        Self {
            source: None,
            filters: None,
            tint,
        }
    }

    fn source(&self) -> PlaneSource {
        PlaneSource {
            texture: self.source.cloned(),
            tint: self.tint,
            is_colored: false,
        }
    }

    /// Returns a channel as a map of the values of another texture: a constant if this has none.
    fn channel(&self, k: usize) -> [f32; 2] {
        let Tint { factor, offset } = self.tint;
        match self.source {
            Some(_) => [factor[k], offset[k]],
            None => [0.0, factor[k] + offset[k]],
        }
    }
}

/// Returns whether factors alone cannot show the materials.
fn is_needed(drawn: &[Drawn]) -> bool {
    let differs = |drawn: &Drawn| {
        drawn.source.is_some() || drawn.tint.factor[..3] != [1.0; 3] || {
            let [factor, offset] = [drawn.tint.factor[3], drawn.tint.offset[3]];
            factor + offset != 1.0
        }
    };
    drawn.iter().any(differs)
}

/// Unites the red channels of some textures with the other channels of others; `None` if a material has two different
/// textures.
fn united<'a>(red: &[Drawn<'a>], others: &[Drawn<'a>]) -> Option<Vec<Drawn<'a>>> {
    let unite = |(red, other): (&Drawn<'a>, &Drawn<'a>)| {
        if let (Some(a), Some(b)) = (red.source, other.source)
            && a != b
        {
            return None;
        }
        let channels = [
            red.channel(0),
            other.channel(1),
            other.channel(2),
            [0.0, 1.0],
        ];
        Some(Drawn {
            source: red.source.or(other.source),
            filters: red.filters.or(other.filters),
            tint: Tint {
                factor: channels.map(|[factor, _]| factor),
                offset: channels.map(|[_, offset]| offset),
            },
        })
    };
    red.iter().zip(others).map(unite).collect()
}

/// Returns the largest of each factor.
fn most(factors: impl Iterator<Item = [f64; 4]>) -> [f64; 4] {
    factors.fold([0.0; 4], |most, factor| {
        [0, 1, 2, 3].map(|k| factor[k].max(most[k]))
    })
}

/// Returns factors relative to the largest ones; 1 where those are 0.
fn ratio(factor: [f64; 4], most: [f64; 4]) -> [f32; 4] {
    [0, 1, 2, 3].map(|k| {
        if most[k] > 0.0 {
            (factor[k] / most[k]) as f32
        } else {
            1.0
        }
    })
}

/// Returns a texture info without a texture, with a number that differs from 1.
fn info(name: &str, value: f64) -> Value {
    if value == 1.0 {
        json!({})
    } else {
        json!({name: value})
    }
}

pub(super) fn number(object: &Value, pointer: &str, default: f64) -> f64 {
    let number = object.pointer(pointer).and_then(Value::as_f64);
    number.unwrap_or(default)
}

fn numbers<const N: usize>(object: &Value, pointer: &str, default: f64) -> [f64; N] {
    let array = object.pointer(pointer);
    std::array::from_fn(|k| {
        let number = array.and_then(|array| array.get(k)?.as_f64());
        number.unwrap_or(default)
    })
}
