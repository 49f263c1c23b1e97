//! Choice of the textures to make for new UVs.

use super::document::GltfDocument;
use super::images;
use super::replacement::Replacement;
use super::slots::{BASE_COLOR, Slot, Users, slots, users};
use super::textures::{MaterialTextures, TextureUse};
use super::vertex_colors::VertexColors;
use crate::document::bake::{MaterialPlanes, MergedPlanes};
use crate::document::{
    BakePlan, BakePlane, BakeRequest, DocumentError, Encoding, Group, KeptTexture, MergedMaterial,
    PlaneSource, Primitive, Tint,
};
use std::collections::{BTreeMap, BTreeSet};

impl GltfDocument {
    /// Plans the textures to make for new UVs of `groups`, and the materials to merge.
    pub fn bake_plan(
        &self,
        groups: &[Group],
        request: &BakeRequest,
    ) -> Result<BakePlan, DocumentError> {
        // Find the textures of every material that a group uses.
        let all: Vec<usize> = (groups.iter().flat_map(|group| &group.primitives))
            .copied()
            .collect();
        let users = users(self, &all)?;
        let first_of_equals = images::first_of_equals(&self.body, &self.resources)?;
        let mut slots = slots(self, &users, &first_of_equals, request.unreadable);
        let merged = request.merge.map_or(&[][..], |merge| &merge.merged);
        let members: BTreeSet<usize> = merged
            .iter()
            .flat_map(|merged| merged.members.iter().copied())
            .collect();
        keep_requested(request.kept, &members, &mut slots);
        keep_frames_together(&users, &mut slots);
        let colors = if request.draws_colors {
            VertexColors::of(self, &all, &slots)?
        } else {
            VertexColors::default()
        };
        // Separate the materials to merge.
        let is_colored = |merged: &MergedMaterial| {
            let mut materials = colors.drawn.iter().map(|&p| self.primitives[p].material);
            materials.any(|material| material.is_some_and(|it| merged.members.contains(&it)))
        };
        let replacements: Vec<Replacement> = (merged.iter())
            .map(|merged| Replacement::new(self, merged, &slots, is_colored(merged)))
            .collect::<Result<_, _>>()?;
        let replaced: BTreeMap<usize, Vec<Slot>> = (members.iter())
            .filter_map(|member| slots.remove_entry(member))
            .collect();
        // List the textures that stay, then plan those of each group.
        let mut plan = BakePlan {
            kept: kept(self, &slots)?,
            merge: request.merge.cloned(),
            colored: colors.drawn,
            colors_kept: colors.kept,
            ..BakePlan::default()
        };
        let infos = replaced.values().flatten();
        (plan.replaced).extend(infos.map(|slot| slot.texture.pointer.clone()));
        for (number, group) in groups.iter().enumerate() {
            let group = PlannedGroup {
                number,
                name: &group.name,
                members: group.primitives.iter().copied().collect(),
                first: plan.planes.len(),
            };
            for (number, (merged, replacement)) in merged.iter().zip(&replacements).enumerate() {
                let of_merged = |primitive: &usize| {
                    let material = self.primitives[*primitive].material?;
                    merged
                        .members
                        .contains(&material)
                        .then_some((*primitive, material))
                };
                let primitives = group.members.iter().filter_map(of_merged).collect();
                group.plan_merged(&mut plan, number, replacement, &primitives);
            }
            group.plan_others(&mut plan, &users, &slots);
            group.plan_plain(&mut plan, &self.primitives);
        }
        Ok(plan)
    }
}

/// Keeps the textures that are to stay, except those of materials to merge.
fn keep_requested(
    kept: &[KeptTexture],
    merged: &BTreeSet<usize>,
    slots: &mut BTreeMap<usize, Vec<Slot>>,
) {
    for kept in kept {
        let material = kept.material.filter(|material| !merged.contains(material));
        let slots = material.and_then(|material| slots.get_mut(&material));
        for slot in slots.into_iter().flatten() {
            if slot.texture.slot == kept.slot && slot.resampled.is_ok() {
                slot.resampled = Err(kept.reason.clone());
            }
        }
    }
}

/// Keeps all normal maps of the primitives of a kept one: a primitive has only one tangent per vertex.
fn keep_frames_together(users: &Users, slots: &mut BTreeMap<usize, Vec<Slot>>) {
    loop {
        let keeps = |material: &usize| {
            slots[material]
                .iter()
                .any(|slot| slot.texture.is_normal_map && slot.resampled.is_err())
        };
        let held: BTreeSet<usize> = (users.iter().filter(|(material, _)| keeps(material)))
            .flat_map(|(_, primitives)| primitives.iter().copied())
            .collect();
        let mut changed = false;
        for (material, slots) in &mut *slots {
            if users[material].is_disjoint(&held) {
                continue;
            }
            for slot in slots
                .iter_mut()
                .filter(|slot: &&mut Slot| slot.texture.is_normal_map && slot.resampled.is_ok())
            {
                slot.resampled =
                    Err("another normal map of its surface is not resampled".to_owned());
                changed = true;
            }
        }
        if !changed {
            return;
        }
    }
}

fn kept(
    document: &GltfDocument,
    slots: &BTreeMap<usize, Vec<Slot>>,
) -> Result<Vec<KeptTexture>, DocumentError> {
    let mut kept = BTreeSet::new();
    let mut keep = |texture: &TextureUse, reason: &str| {
        kept.insert(KeptTexture {
            material: texture.material,
            slot: texture.slot.clone(),
            reason: reason.to_owned(),
        })
    };
    for slot in slots.values().flatten() {
        if let Err(reason) = &slot.resampled {
            keep(&slot.texture, reason);
        }
    }
    for primitive in &document.primitives {
        for texture in MaterialTextures::of_primitive(primitive, document.object(primitive)?).uses {
            keep(&texture, "it belongs to the primitive, not to a material");
        }
    }
    Ok(kept.into_iter().collect())
}

/// A group whose textures are planned.
struct PlannedGroup<'a> {
    number: usize,
    name: &'a str,
    /// Indices of its primitives.
    members: BTreeSet<usize>,
    /// Index of its first plane.
    first: usize,
}

impl PlannedGroup<'_> {
    /// Adds the textures of a merged material for `primitives` of the group, which have these materials.
    fn plan_merged(
        &self,
        plan: &mut BakePlan,
        merged: usize,
        replacement: &Replacement,
        primitives: &BTreeMap<usize, usize>,
    ) {
        if primitives.is_empty() {
            return;
        }
        let mut slots = Vec::new();
        for drawn in &replacement.planes {
            let is_base = drawn.slots.iter().any(|slot| slot == BASE_COLOR);
            let source = |(&primitive, material): (&usize, &usize)| {
                let is_colored = is_base && plan.colored.contains(&primitive);
                let source = drawn.sources[material].clone();
                (
                    primitive,
                    PlaneSource {
                        is_colored,
                        ..source
                    },
                )
            };
            let wanted = BakePlane {
                name: format!("{}_{}", self.name, word(&drawn.slots[0])),
                group: self.number,
                encoding: drawn.encoding,
                filters: drawn.filters,
                sources: primitives.iter().map(source).collect(),
            };
            let plane = joined(&mut plan.planes, self.first, wanted);
            slots.extend(drawn.slots.iter().map(|slot| (slot.clone(), plane)));
            if drawn.encoding == Encoding::Normal {
                plan.normal_mapped.extend(primitives.keys());
            }
        }
        plan.merged.push(MergedPlanes {
            merged,
            primitives: primitives.keys().copied().collect(),
            material: replacement.material.clone(),
            slots,
        });
    }

    /// Adds the textures of the other materials: for each slot one texture for all materials, as long as no surface has
    /// two of them.
    fn plan_others(&self, plan: &mut BakePlan, users: &Users, slots: &BTreeMap<usize, Vec<Slot>>) {
        for (&material, slots) in slots {
            // Skip materials that no primitive of the group uses.
            let primitives: BTreeSet<usize> = (users[&material].intersection(&self.members))
                .copied()
                .collect();
            if primitives.is_empty() {
                continue;
            }
            // Assign each texture of the material that can be resampled to a plane.
            let mut planes = Vec::new();
            for slot in slots {
                let Ok(resampled) = &slot.resampled else {
                    continue;
                };
                let is_base = slot.texture.slot == BASE_COLOR;
                let source = |&primitive: &usize| {
                    let source = PlaneSource {
                        texture: Some(resampled.source.clone()),
                        tint: Tint::NONE,
                        is_colored: is_base && plan.colored.contains(&primitive),
                    };
                    (primitive, source)
                };
                let wanted = BakePlane {
                    name: format!("{}_{}", self.name, word(&slot.texture.slot)),
                    group: self.number,
                    encoding: resampled.encoding,
                    filters: resampled.filters,
                    sources: primitives.iter().map(source).collect(),
                };
                planes.push((
                    slot.texture.slot.clone(),
                    joined(&mut plan.planes, self.first, wanted),
                ));
                plan.replaced.insert(slot.texture.pointer.clone());
                if resampled.encoding == Encoding::Normal {
                    plan.normal_mapped.extend(&primitives);
                }
            }
            let has_base = slots.iter().any(|slot| slot.texture.slot == BASE_COLOR);
            if !has_base && !primitives.is_disjoint(&plan.colored) {
                planes.push(self.plan_colors(plan, &primitives));
            }
            // Record the planes of the material.
            if !planes.is_empty() {
                plan.materials.push(MaterialPlanes {
                    material: Some(material),
                    primitives,
                    slots: planes,
                });
            }
        }
    }
}

impl PlannedGroup<'_> {
    /// Adds a material with a texture for the vertex colors of primitives without a material.
    fn plan_plain(&self, plan: &mut BakePlan, primitives: &[Primitive]) {
        let plain = |index: &usize| primitives[*index].material.is_none();
        let colored = self.members.intersection(&plan.colored);
        let primitives: BTreeSet<usize> = colored.copied().filter(plain).collect();
        if !primitives.is_empty() {
            let plane = self.plan_colors(plan, &primitives);
            plan.materials.push(MaterialPlanes {
                material: None,
                primitives,
                slots: vec![plane],
            });
        }
    }

    /// Adds a base-color texture of vertex colors alone. Returns its slot and its plane.
    fn plan_colors(&self, plan: &mut BakePlan, primitives: &BTreeSet<usize>) -> (String, usize) {
        let source = |&primitive: &usize| {
            let source = PlaneSource {
                texture: None,
                tint: Tint::NONE,
                is_colored: plan.colored.contains(&primitive),
            };
            (primitive, source)
        };
        let wanted = BakePlane {
            name: format!("{}_{}", self.name, word(BASE_COLOR)),
            group: self.number,
            encoding: Encoding::Color,
            filters: [None; 2],
            sources: primitives.iter().map(source).collect(),
        };
        let plane = joined(&mut plan.planes, self.first, wanted);
        (BASE_COLOR.to_owned(), plane)
    }
}

/// Returns the plane that a texture joins: one for the same slot in which its surfaces have nothing else, or a new one.
fn joined(planes: &mut Vec<BakePlane>, first: usize, wanted: BakePlane) -> usize {
    let takes = |plane: &BakePlane| {
        let kind = |plane: &BakePlane| (plane.encoding, plane.filters);
        let shares_name = plane.name == wanted.name;
        kind(plane) == kind(&wanted)
            && wanted.sources.iter().all(|(primitive, source)| {
                let present = plane.sources.get(primitive);
                present.is_none_or(|present| present == source)
            })
            && (shares_name || wanted.sources.keys().any(|p| plane.sources.contains_key(p)))
    };
    if let Some(found) = planes[first..].iter().position(takes) {
        planes[first + found].sources.extend(wanted.sources);
        first + found
    } else {
        planes.push(wanted);
        planes.len() - 1
    }
}

/// Returns `baseColor` for `pbrMetallicRoughness/baseColorTexture`.
fn word(slot: &str) -> &str {
    let name = slot.rsplit('/').next().unwrap_or(slot);
    name.strip_suffix("Texture").unwrap_or(name)
}
