//! Documents prepared for unwrapping.

use crate::arrays::plan::Plan;
use crate::arrays::position_key::position_key;
use crate::arrays::seams::Seams;
use crate::arrays::soup::{Part, Soup};
use crate::documents::selection::{FaceAttributes, add_control, face_control, rule_materials};
use crate::options::{GivenSeams, NamedSeams, Options, check_grouping};
use crate::options::{Stacking, TexelWeight};
use crate::{PipelineError, limits, rebake};
use std::collections::BTreeMap;
use std::collections::{HashMap, HashSet};
use unwrapd_files::document::{
    Document, DocumentError, Group, GroupBy, MergePlan, OldUvs, OutputFormat, Primitive, Upload,
    Warning,
};
use unwrapd_maps::mesh::{CornerUvs, Resolution, VAxis};

/// A document in the form in which it is written.
pub struct Prepared {
    pub document: Document,
    /// Meshes that share one atlas.
    pub group_by: GroupBy,
    /// Options, with seams in the numbering of the document.
    pub seams: Options,
    /// Origins of vertices and faces in the file.
    pub origins: Origins,
    /// Texture for which kept UVs were made, if the file states it.
    pub texture: Option<Resolution>,
    /// Materials to merge; `None` if that was not requested.
    pub merge: Option<MergePlan>,
}

/// Original numbers of vertices and faces over all primitives of a document; `None` if they are unchanged.
pub struct Origins {
    pub vertices: Option<Vec<u32>>,
    pub faces: Option<Vec<u32>>,
}

impl Prepared {
    /// Reads a document, and rejects options that it cannot be written with before any work is done.
    pub fn read(upload: &Upload, options: &Options, plan: &Plan) -> Result<Self, PipelineError> {
        let document = Document::read(upload)?;
        limits::check(&options.caller.limits, &document)?;
        // Choose the grouping, and reject what cannot be written.
        let group_by = match options.format {
            // An OBJ file has one UV space, whatever was asked for.
            OutputFormat::Obj => GroupBy::Scene,
            OutputFormat::Glb | OutputFormat::Gltf => {
                options.group_by.unwrap_or(document.grouping())
            }
        };
        check_grouping(options, Some(group_by)).map_err(PipelineError::InvalidOptions)?;
        if options.baking.rebake && !can_rebake(&document, options.format) {
            let what =
                "new textures for an OBJ file from another format than glTF: write .glb or .gltf";
            return Err(DocumentError::UnsupportedOutput(what.to_owned()).into());
        }
        // Convert the document to the form of the output.
        let old_uvs = if plan.reads_uvs() {
            OldUvs::Kept
        } else {
            OldUvs::Sampled
        };
        check_given(document.primitives(), options)?;
        let texture = document.texture_of(options.sets.source());
        let conversion = document.for_output(options.format, old_uvs)?;
        // Renumber the given seams if vertices have changed their numbers.
        let mut seams = options.clone();
        if let Some(vertices) = &conversion.vertices {
            let primitives = conversion.document.primitives();
            if let Some(GivenSeams::Edges(edges)) = &options.seams {
                let edges = renumbered(edges, vertices, primitives);
                seams.seams = Some(GivenSeams::Edges(edges));
            }
            if let Some(cones) = &options.cone_vertices {
                let pairs: Vec<[u32; 2]> = cones.iter().map(|&v| [v; 2]).collect();
                let cones = renumbered(&pairs, vertices, primitives).into_iter();
                seams.cone_vertices = Some(cones.map(|[v, _]| v).collect());
            }
        }
        let mut document = options.nodes().prepared(conversion.document)?;
        if plan.reads_uvs() && options.format == OutputFormat::Obj {
            document = document.with_mapped_faces();
        }
        let kept = document.kept_faces().map(<[u32]>::to_vec);
        Ok(Self {
            merge: rebake::merge_plan(&document, options)?,
            document,
            group_by,
            seams,
            origins: Origins {
                vertices: conversion.vertices,
                faces: kept.or(conversion.faces),
            },
            texture,
        })
    }
}

fn can_rebake(document: &Document, format: OutputFormat) -> bool {
    matches!(document, Document::Gltf(_)) || format != OutputFormat::Obj
}

/// Renumbers [checked](check_given) edges of a file for each primitive that now contains them. `vertices` are the
/// original numbers of the vertices of all primitives.
fn renumbered(edges: &[[u32; 2]], vertices: &[u32], primitives: &[Primitive]) -> Vec<[u32; 2]> {
    // Copies of a vertex lie in one place, so the first in each primitive is enough.
    let mut numbers: HashMap<u32, Vec<(usize, u32)>> = edges
        .as_flattened()
        .iter()
        .map(|&v| (v, Vec::new()))
        .collect();
    let sizes = primitives.iter().map(|primitive| primitive.positions.len());
    let owners = sizes
        .enumerate()
        .flat_map(|(index, n)| std::iter::repeat_n(index, n));
    for ((number, vertex), owner) in (0..).zip(vertices).zip(owners) {
        if let Some(numbers) = numbers.get_mut(vertex)
            && numbers.last().is_none_or(|(last, _)| *last != owner)
        {
            numbers.push((owner, number));
        }
    }
    let mut inside = Vec::new();
    for [a, b] in edges {
        let others: HashMap<usize, u32> = numbers[b].iter().copied().collect();
        let both = numbers[a]
            .iter()
            .filter_map(|(owner, a)| Some([*a, *others.get(owner)?]));
        inside.extend(both);
    }
    inside
}

// The primitives that are mapped.

/// Primitives that get UVs.
pub struct Mapped {
    /// Groups of those that share an atlas.
    pub groups: Vec<Group>,
    /// Warning about primitives that are left as they are, as they have no UVs.
    pub warning: Option<Warning>,
}

impl Mapped {
    /// Returns all primitives of a document, or those with UVs where the plan begins with these.
    ///
    /// # Errors
    /// Fails if there are none, or if others cannot be left as they are: textures are resampled for all of a material.
    pub fn of(
        document: &Document,
        options: &Options,
        plan: &Plan,
        group_by: GroupBy,
    ) -> Result<Self, PipelineError> {
        let mut groups = document.groups(group_by);
        let set = options.sets.source();
        let primitives = document.primitives();
        let missing_of = |missing: usize, all: usize| {
            let text =
                format!("{missing} of {all} triangles have no UV set {set} and stay without");
            Some(Warning::new("uvs_missing", text))
        };
        let left_out = document.n_left_out();
        if left_out > 0 {
            let warning = missing_of(left_out, left_out + primitives[0].triangles.len());
            return Ok(Self { groups, warning });
        }
        let can_leave = options.format != OutputFormat::Obj && !options.baking.rebake;
        if !plan.reads_uvs() || !can_leave {
            let warning = None;
            return Ok(Self { groups, warning });
        }
        let has_uvs = (0..primitives.len())
            .map(|index| Ok(document.corner_uvs(index, set)?.is_some()))
            .collect::<Result<Vec<bool>, DocumentError>>()?;
        let count = |is_counted: &dyn Fn(usize) -> bool| -> usize {
            let counted = (0..primitives.len()).filter(|&index| is_counted(index));
            counted.map(|index| primitives[index].triangles.len()).sum()
        };
        let missing = count(&|index| !has_uvs[index]);
        if missing == 0 || !has_uvs.contains(&true) {
            let warning = None;
            return Ok(Self { groups, warning });
        }
        for group in &mut groups {
            group.primitives.retain(|&index| has_uvs[index]);
        }
        groups.retain(|group| !group.primitives.is_empty());
        let warning = missing_of(missing, count(&|_| true));
        Ok(Self { groups, warning })
    }
}

// The primitives of a group as one mesh.

/// The primitives of a group as one mesh.
pub struct Merged {
    pub positions: Vec<[f64; 3]>,
    pub triangles: Vec<[u32; 3]>,
    pub seams: Seams,
    /// Meshes that it was merged from.
    pub parts: Vec<Part>,
}

impl Merged {
    pub fn new(primitives: &[Primitive], group: &Group) -> Self {
        Self::of(group.primitives.iter().map(|&index| &primitives[index]))
    }

    fn of<'a>(primitives: impl Iterator<Item = &'a Primitive>) -> Self {
        let mut merged = Self {
            positions: Vec::new(),
            triangles: Vec::new(),
            seams: Seams::default(),
            parts: Vec::new(),
        };
        let mut last = None;
        for primitive in primitives {
            let first = merged.positions.len() as u32;
            let first_face = merged.triangles.len() as u32;
            let positions = primitive.positions.iter();
            (merged.positions).extend(positions.map(|p| p.map(f64::from)));
            let triangles = primitive.triangles.iter();
            merged
                .triangles
                .extend(triangles.map(|t| t.map(|v| v + first)));
            // Begin a part where the mesh changes; its primitives extend it.
            if last.replace(primitive.mesh) != Some(primitive.mesh) {
                merged.parts.push(Part {
                    vertices: first..first,
                    faces: first_face..first_face,
                });
            }
            if let Some(part) = merged.parts.last_mut() {
                part.vertices.end = merged.positions.len() as u32;
                part.faces.end = merged.triangles.len() as u32;
            }
        }
        merged
    }

    /// Merges a group and adds the seams that the options request. Seam edges and cones must have been [checked](check_given);
    /// `primitives` are those of the document, in any space.
    pub fn with_seams(
        document: &Document,
        primitives: &[Primitive],
        group: &Group,
        options: &Options,
        plan: &Plan,
    ) -> Result<Self, PipelineError> {
        let mut merged = Self::new(primitives, group);
        if plan.reads_uvs() {
            merged.seams.uvs = Some(corner_uvs(document, group, options.sets.source())?);
        }
        if options.material_borders {
            merged.seams.labels = Some(face_materials(document, group));
        }
        if plan.stacking != Stacking::Off {
            merged.seams.materials = Some(face_materials(document, group));
        }
        if !options.texel_weight.is_empty() {
            let weights = face_weights(document, group, &options.texel_weight);
            merged.seams.weights = Some(weights?);
        }
        let rules = options.control.rules();
        if !rules.is_empty() {
            let attributes = FaceAttributes::of_primitives(document, &group.primitives)?;
            let materials = rule_materials(&rules, |name| document.material(name))?;
            let v_axis = document.v_axis();
            let control = face_control(
                &options.control,
                &attributes,
                &materials,
                &merged.soup(),
                plan,
                v_axis,
            )?;
            if let Some(control) = control {
                add_control(&mut merged.seams, control);
            }
        }
        if plan.keeps_polygons {
            merged.seams.polygons = polygon_corners(document, group);
        }
        match &options.seams {
            Some(GivenSeams::Named(NamedSeams::Normals)) => {
                merged.seams.normals = Some(corner_normals(document, group)?);
            }
            Some(GivenSeams::Edges(edges)) => {
                let number = numbers_in_group(primitives, group);
                let ends = |&[a, b]: &[u32; 2]| Some([number(a)?, number(b)?]);
                let edges: Vec<[u32; 2]> = edges.iter().filter_map(ends).collect();
                if let Some(corners) = &mut merged.seams.polygons {
                    release_diagonals(corners, &merged.triangles, &merged.positions, &edges);
                }
                merged.seams.edges = Some(edges);
            }
            None => {}
        }
        if let Some(cones) = &options.cone_vertices {
            let number = numbers_in_group(primitives, group);
            merged.seams.cones = Some(cones.iter().filter_map(|&v| number(v)).collect());
        }
        Ok(merged)
    }

    pub fn soup(&self) -> Soup<'_> {
        Soup {
            positions: &self.positions,
            triangles: &self.triangles,
            seams: &self.seams,
            parts: &self.parts,
            originals: &[],
        }
    }
}

/// Returns the material of each face of a group as a number, 0 for none.
fn face_materials(document: &Document, group: &Group) -> Vec<u32> {
    let of_primitive = |&index: &usize| document.face_materials(index);
    let materials = group.primitives.iter().flat_map(of_primitive);
    materials
        .map(|material| material.map_or(0, |material| 1 + material as u32))
        .collect()
}

/// Returns the UVs of a group with v up.
pub fn corner_uvs(
    document: &Document,
    group: &Group,
    texcoord: u32,
) -> Result<Vec<CornerUvs>, PipelineError> {
    let (mut all, mut missing, mut triangles) = (Vec::new(), 0, 0);
    for &index in &group.primitives {
        triangles += document.primitives()[index].triangles.len();
        match document.corner_uvs(index, texcoord)? {
            Some(uvs) => all.extend(uvs),
            None => missing += document.faces_without_uvs(index),
        }
    }
    if missing > 0 {
        let group = group.label.clone();
        return Err(if missing == triangles {
            PipelineError::NoUvs { group, texcoord }
        } else {
            PipelineError::PartlyNoUvs {
                group,
                texcoord,
                missing,
                triangles,
            }
        });
    }
    if document.v_axis() == VAxis::Down {
        for uv in all.as_flattened_mut() {
            uv[1] = 1.0 - uv[1];
        }
    }
    Ok(all)
}

/// Returns for each corner of a group's faces the number of its corner of a polygon; `None` unless all primitives come
/// from polygons.
fn polygon_corners(document: &Document, group: &Group) -> Option<Vec<[u32; 3]>> {
    let mut all = Vec::new();
    let mut first = 0;
    for &index in &group.primitives {
        let (corners, n_corners) = document.polygon_corners(index)?;
        all.extend(corners.iter().map(|face| face.map(|corner| first + corner)));
        first += n_corners;
    }
    Some(all)
}

/// Takes the faces at those diagonals of polygons that are given seams out of their polygons.
fn release_diagonals(
    corners: &mut [[u32; 3]],
    triangles: &[[u32; 3]],
    positions: &[[f64; 3]],
    seams: &[[u32; 2]],
) {
    let key = |v: u32| position_key(positions[v as usize]);
    let sorted = |[a, b]: [_; 2]| if a < b { [a, b] } else { [b, a] };
    let seams: HashSet<_> = seams.iter().map(|edge| sorted(edge.map(key))).collect();
    let sides = |face: [u32; 3]| [0, 1, 2].map(|k| [face[k], face[(k + 1) % 3]]);
    // A diagonal joins two corners of a polygon in two of its faces.
    let mut n_faces: HashMap<[u32; 2], u32> = HashMap::new();
    for [a, b] in corners.iter().flat_map(|face| sides(*face)) {
        *n_faces.entry([a.min(b), a.max(b)]).or_default() += 1;
    }
    let mut next = 1 + corners
        .as_flattened()
        .iter()
        .max()
        .copied()
        .unwrap_or_default();
    for (face, triangle) in corners.iter_mut().zip(triangles) {
        let is_released = |([a, b], ends): ([u32; 2], [u32; 2])| {
            n_faces[&[a.min(b), a.max(b)]] > 1 && seams.contains(&sorted(ends.map(key)))
        };
        if sides(*face)
            .into_iter()
            .zip(sides(*triangle))
            .any(is_released)
        {
            *face = [next, next + 1, next + 2];
            next += 3;
        }
    }
}

fn corner_normals(document: &Document, group: &Group) -> Result<Vec<[[f64; 3]; 3]>, PipelineError> {
    let mut all = Vec::new();
    for &index in &group.primitives {
        all.extend(
            document
                .corner_normals(index)?
                .ok_or_else(|| PipelineError::Seams(format!("{} has no normals", group.label)))?,
        );
    }
    Ok(all)
}

/// Checks the edges and cones that options name, which count vertices over all primitives.
pub fn check_given(primitives: &[Primitive], options: &Options) -> Result<(), PipelineError> {
    if let Some(cones) = &options.cone_vertices {
        let sizes = primitives.iter().map(|primitive| primitive.positions.len());
        Seams::check_cones(cones, sizes.sum())?;
    }
    let Some(GivenSeams::Edges(edges)) = &options.seams else {
        return Ok(());
    };
    let whole = Merged::of(primitives.iter());
    Seams::check_edges(edges, &whole.positions, &whole.triangles)
}

/// Returns the numbers within a group of vertices of the file; `None` for those of other groups.
fn numbers_in_group(primitives: &[Primitive], group: &Group) -> impl Fn(u32) -> Option<u32> {
    let mut local = Vec::new();
    let mut next = 0;
    for (index, primitive) in primitives.iter().enumerate() {
        let is_inside = group.primitives.contains(&index);
        for _ in &primitive.positions {
            local.push(is_inside.then_some(next));
            next += u32::from(is_inside);
        }
    }
    move |v: u32| local.get(v as usize).copied().flatten()
}

/// Returns the weight of every face of a group. If a material is named twice, the last weight counts.
fn face_weights(
    document: &Document,
    group: &Group,
    weights: &[TexelWeight],
) -> Result<Vec<f64>, PipelineError> {
    let mut of_material = BTreeMap::new();
    for TexelWeight { material, weight } in weights {
        let index = document
            .material(material)
            .ok_or_else(|| PipelineError::UnknownMaterial(material.clone()))?;
        of_material.insert(index, *weight);
    }
    let materials = group.primitives.iter();
    let materials = materials.flat_map(|&index| document.face_materials(index));
    let weight = |material: Option<usize>| {
        let weight = material.and_then(|material| of_material.get(&material));
        weight.copied().unwrap_or(1.0)
    };
    Ok(materials.map(weight).collect())
}
