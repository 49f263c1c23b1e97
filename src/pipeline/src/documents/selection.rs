//! Faces that rules for islands select.

use crate::PipelineError;
use crate::arrays::control::FaceControl;
use crate::arrays::placed_faces::stacks_of;
use crate::arrays::plan::Plan;
use crate::arrays::seams::Seams;
use crate::arrays::soup::Soup;
use crate::island_error::IslandError;
use crate::options::{IslandControl, IslandRule, Selector, Stacking};
use std::collections::HashMap;
use unwrapd_files::document::{Document, DocumentError};
use unwrapd_maps::certificate::chart_ids;
use unwrapd_maps::mesh::{CornerUvs, VAxis};

/// Attributes of faces by which selectors choose.
pub struct FaceAttributes {
    /// For each face its primitive and its index in that.
    pub faces: Vec<[u32; 2]>,
    /// For each face its material, if it has one.
    pub materials: Vec<Option<usize>>,
    /// For each face the color of its three vertices, if it is one, as linear numbers of 8 bits.
    pub colors: Vec<Option<[u8; 3]>>,
}

impl FaceAttributes {
    /// Collects the attributes of the faces of primitives.
    pub fn of_primitives(document: &Document, primitives: &[usize]) -> Result<Self, DocumentError> {
        let mut all = Self {
            faces: Vec::new(),
            materials: Vec::new(),
            colors: Vec::new(),
        };
        for &index in primitives {
            let triangles = &document.primitives()[index].triangles;
            // Rules count the faces of the file.
            let kept = document.kept_faces();
            let number = |face: usize| kept.map_or(face as u32, |kept| kept[face]);
            let numbers = (0..triangles.len()).map(number);
            all.faces.extend(numbers.map(|face| [index as u32, face]));
            all.materials.extend(document.face_materials(index));
            let colors = document.vertex_colors(index)?;
            all.colors.extend(triangles.iter().map(|triangle| {
                let colors = colors.as_ref()?;
                let [a, b, c] = triangle.map(|v| colors.get(v as usize).map(in_bytes));
                a.filter(|_| a == b && b == c)
            }));
        }
        Ok(all)
    }

    /// Returns whether a selector selects each face; `material` is the index of the one that it names.
    pub(super) fn selected(&self, selector: &Selector, material: Option<usize>) -> Vec<bool> {
        match selector {
            Selector::All => vec![true; self.faces.len()],
            Selector::Material(_) => (self.materials.iter())
                .map(|own| own.is_some() && *own == material)
                .collect(),
            Selector::Color(color) => {
                let wanted = Some(in_bytes(&linear(*color)));
                self.colors.iter().map(|own| *own == wanted).collect()
            }
            Selector::Faces(faces) => {
                let mut sorted = faces.clone();
                sorted.sort_unstable();
                let is_named = |face: &[u32; 2]| sorted.binary_search(face).is_ok();
                self.faces.iter().map(is_named).collect()
            }
        }
    }
}

/// Rounds a linear color to the bytes in which glTF files mostly have it.
pub(super) fn in_bytes(color: &[f32; 4]) -> [u8; 3] {
    let [r, g, b, _] = *color;
    [r, g, b].map(|x| (x.clamp(0.0, 1.0) * 255.0).round() as u8)
}

/// Converts a color from sRGB.
pub(super) fn linear(color: [u8; 3]) -> [f32; 4] {
    let [r, g, b] = color.map(|x| {
        let x = f32::from(x) / 255.0;
        if x <= 0.040_45 {
            x / 12.92
        } else {
            ((x + 0.055) / 1.055).powf(2.4)
        }
    });
    [r, g, b, 1.0]
}

/// Returns the rules for the faces of a mesh; `None` if there are none.
///
/// # Errors
/// Fails if rules contradict each other.
pub fn face_control(
    control: &IslandControl,
    attributes: &FaceAttributes,
    materials: &[Option<usize>],
    mesh: &Soup,
    plan: &Plan,
    v_axis: VAxis,
) -> Result<Option<FaceControl>, PipelineError> {
    let rules = control.rules();
    if rules.is_empty() {
        return Ok(None);
    }
    let islands = (mesh.seams.uvs.as_deref()).map(|uvs| islands(mesh, uvs, plan.stacking));
    let selected = rules.iter().zip(materials).map(|(rule, material)| {
        let mut is_selected = attributes.selected(&rule.selector, *material);
        if let Some(islands) = &islands {
            extend(&mut is_selected, islands);
        }
        let faces = 0..is_selected.len() as u32;
        faces.filter(|&face| is_selected[face as usize]).collect()
    });
    let selected: Vec<Vec<u32>> = selected.collect();
    let region = |name: &str| control.region(name, v_axis);
    FaceControl::new(mesh.triangles.len(), &rules, selected, region).map(Some)
}

/// Returns the island of each face; those of a stack that stays together are one.
fn islands(mesh: &Soup, uvs: &[CornerUvs], stacking: Stacking) -> Vec<u32> {
    let islands = chart_ids(mesh.positions, mesh.triangles, uvs);
    if stacking != Stacking::Keep {
        return islands;
    }
    let n_islands = islands.iter().max().map_or(0, |last| last + 1) as usize;
    let materials = mesh.seams.materials.as_deref();
    let first = stacks_of(&islands, n_islands, uvs, materials);
    let of_stack = islands.iter().map(|&island| first[island as usize]);
    of_stack.collect()
}

/// Selects all faces of islands with a selected face.
fn extend(is_selected: &mut [bool], islands: &[u32]) {
    let n_islands = islands.iter().max().map_or(0, |last| last + 1) as usize;
    let mut has_selected = vec![false; n_islands];
    for (island, is_selected) in islands.iter().zip(&*is_selected) {
        has_selected[*island as usize] |= is_selected;
    }
    for (island, is_selected) in islands.iter().zip(is_selected) {
        *is_selected = has_selected[*island as usize];
    }
}

/// Returns for each rule the index of the material that it names.
pub fn rule_materials(
    rules: &[IslandRule],
    index: impl Fn(&str) -> Option<usize>,
) -> Result<Vec<Option<usize>>, PipelineError> {
    let named = rules.iter().map(|rule| match &rule.selector {
        Selector::Material(name) => match index(name) {
            Some(material) => Ok(Some(material)),
            None => Err(PipelineError::UnknownMaterial(name.clone())),
        },
        Selector::All | Selector::Color(_) | Selector::Faces(_) => Ok(None),
    });
    named.collect()
}

/// Rejects rules that name faces beyond those of the primitives, whose numbers of faces `n_faces` are.
pub fn check_faces(rules: &[IslandRule], n_faces: &[usize]) -> Result<(), IslandError> {
    for rule in rules {
        let Selector::Faces(faces) = &rule.selector else {
            continue;
        };
        let is_missing = |[primitive, face]: &&[u32; 2]| {
            let n_faces = n_faces.get(*primitive as usize).copied();
            *face as usize >= n_faces.unwrap_or(0)
        };
        if let Some(face) = faces.iter().find(is_missing) {
            return Err(IslandError::NoSuchFace {
                rule: rule.to_string(),
                face: *face,
            });
        }
    }
    Ok(())
}

/// Rejects rules that select nothing in any of the meshes.
pub fn check_selections(rules: &[IslandRule], meshes: &[&Seams]) -> Result<(), IslandError> {
    for (number, rule) in rules.iter().enumerate() {
        let mut controls = meshes.iter().filter_map(|seams| seams.control.as_ref());
        if controls.all(|control| control.selected[number].1.is_empty()) {
            return Err(IslandError::SelectsNothing(rule.to_string()));
        }
    }
    Ok(())
}

/// Adds rules to the seams of a mesh: new charts are cut along the borders of selections.
pub fn add_control(seams: &mut Seams, control: FaceControl) {
    if let Some(scales) = control.scales() {
        seams.weights = Some(match seams.weights.take() {
            Some(weights) => weights.iter().zip(scales).map(|(w, s)| w * s).collect(),
            None => scales,
        });
    }
    let labels = seams.labels.take();
    let mut numbers = HashMap::new();
    let label = |(face, rules): (usize, &u32)| {
        let label = labels.as_ref().map_or(0, |labels| labels[face]);
        let next = numbers.len() as u32;
        *numbers.entry((label, *rules)).or_insert(next)
    };
    seams.labels = Some(control.of_face.iter().enumerate().map(label).collect());
    seams.control = Some(control);
}
