//! Output of a glTF document with new UVs as an OBJ file, with its materials and pictures as separate files.
use super::GltfDocument;
use super::accessor::Accessor;
use super::baked;
use super::body::Body;
use super::json::{item, items, unsigned};
use super::obj_losses::losses;
use super::obj_names::{Taken, material_names, object_names};
use super::obj_pictures::ObjPictures;
use super::texture_warnings::texture_warnings;
use super::textures::{MaterialTextures, affected, materials};
use crate::document::colors::{Color, from_linear};
use crate::document::material::{Dropped, Material, mtl_text, of_gltf};
use crate::document::new_obj::{self, ObjPart};
use crate::document::{
    BakedTextures, DocumentError, Layout, NewUvs, PrimitiveNote, Warning, WriteNotes, WriteOptions,
    Written, warning,
};
use serde_json::Value;
use std::collections::BTreeSet;
use unwrapd_maps::mesh::VAxis;

/// Writes `document` as OBJ with `uvs`, and with the textures made for them.
pub(super) fn write(
    document: &GltfDocument,
    uvs: &NewUvs,
    options: &WriteOptions,
    baked: Option<&BakedTextures>,
) -> Result<Written, DocumentError> {
    new_obj::only_set(options)?;
    let mut body = document.body.clone();
    let mut notes = WriteNotes::default();
    // New textures, materials and their pictures.
    let resources = match baked {
        Some(baked) => baked::insert(document, &mut body, baked, (0, &options.stem), &mut notes)?,
        None => document.resources.clone(),
    };
    let mut taken = Taken::default();
    let stem = taken.name(&options.stem);
    let mut pictures = ObjPictures::new(&body, &resources, &stem);
    let material_names = material_names(&body.json)?;
    let described = described(document, &body, &material_names, &mut pictures, &mut notes)?;

    // Parts with their names.
    let objects = object_names(&body.json)?;
    let mut parts = Vec::with_capacity(document.primitives.len());
    for (index, primitive) in document.primitives.iter().enumerate() {
        let part = part(document, &body, index, uvs)?;
        let material = material_of(&body, primitive.mesh, primitive.primitive)?;
        parts.push(ObjPart {
            object: &objects[primitive.mesh],
            material: material.and_then(|m| Some(material_names.get(m)?.as_str())),
            ..part
        });
        if uvs.corners[index].is_some() {
            let had_uvs = document.corner_uvs(index, 0)?.is_some();
            notes.primitives.push(PrimitiveNote {
                sources: document.used[index].clone(),
                ..new_obj::note(primitive, had_uvs)
            });
        }
    }
    notes.textures_affected = textures_affected(document, uvs, baked)?;
    let warnings = texture_warnings(document, &notes);
    notes.warnings.extend(warnings);
    notes.warnings.extend(losses(document)?);
    notes.warnings.extend(pictures.warnings());

    let material_file = format!("{stem}.mtl");
    let named = (!described.is_empty()).then_some(material_file.as_str());
    let mut files = vec![(
        format!("{}.obj", options.stem),
        new_obj::text(&parts, named),
    )];
    if !described.is_empty() {
        files.push((material_file.clone(), mtl_text(&described)));
        files.extend(pictures.into_files());
    }
    Ok(Written { files, notes })
}

/// Collects the numbers of a primitive; the caller sets its names.
fn part<'a>(
    document: &'a GltfDocument,
    body: &Body,
    index: usize,
    uvs: &NewUvs,
) -> Result<ObjPart<'a>, DocumentError> {
    let uvs = match uvs.toward(index, VAxis::Up) {
        Some(uvs) => Some(uvs),
        None => document.corner_uvs(index, 0)?.map(|uvs| {
            let upward = |face: [[f64; 2]; 3]| face.map(|[u, v]| [u as f32, (1.0 - v) as f32]);
            uvs.into_iter().map(upward).collect()
        }),
    };
    let normals = document.corner_normals(index)?;
    let single = |face: [[f64; 3]; 3]| face.map(|normal| normal.map(|x| x as f32 + 0.0));
    Ok(ObjPart {
        primitive: &document.primitives[index],
        object: "",
        material: None,
        uvs,
        normals: normals.map(|normals| normals.into_iter().map(single).collect()),
        colors: colors(document, body, index)?,
    })
}

/// Reads `COLOR_0`, if it is a color.
fn colors(
    document: &GltfDocument,
    body: &Body,
    index: usize,
) -> Result<Option<Vec<Color>>, DocumentError> {
    let attributes = &document.object(&document.primitives[index])?["attributes"];
    let Some(accessor) = unsigned(attributes, "COLOR_0")? else {
        return Ok(None);
    };
    let accessor = Accessor::open(body, accessor)?;
    let n_channels = match (accessor.is("VEC3"), accessor.is("VEC4")) {
        (true, _) => 3,
        (_, true) => 4,
        _ => return Ok(None),
    };
    let values = accessor.values()?;
    let all: Vec<Color> = values.chunks_exact(n_channels).map(from_linear).collect();
    let own = match &document.used[index] {
        Some(used) => used.iter().map(|&v| all[v as usize]).collect(),
        None => all,
    };
    Ok(Some(own))
}

fn material_of(body: &Body, mesh: usize, primitive: usize) -> Result<Option<usize>, DocumentError> {
    let primitives = items(item(&body.json, "meshes", mesh)?, "primitives")?;
    match primitives.get(primitive) {
        Some(primitive) => unsigned(primitive, "material"),
        None => Ok(None),
    }
}

/// Converts the materials in use.
fn described(
    document: &GltfDocument,
    body: &Body,
    names: &[String],
    pictures: &mut ObjPictures,
    notes: &mut WriteNotes,
) -> Result<Vec<Material>, DocumentError> {
    let mut used = BTreeSet::new();
    for primitive in &document.primitives {
        used.extend(material_of(body, primitive.mesh, primitive.primitive)?);
    }
    let objects = items(&body.json, "materials")?;
    let mut lost = Dropped::new();
    let mut described = Vec::new();
    for index in used {
        if let (Some(object), Some(name)) = (objects.get(index), names.get(index)) {
            let map = |info: &Value| pictures.map(info);
            described.push(of_gltf(object, name.clone(), map, &mut lost));
        }
    }
    if !lost.is_empty() {
        let counted: Vec<String> = lost
            .iter()
            .map(|(part, n)| format!("{part} ({n})"))
            .collect();
        let parts = warning::listed(counted.iter().map(String::as_str));
        let message =
            format!("MTL cannot hold these material properties, which are left out: {parts}");
        notes
            .warnings
            .push(Warning::new("material_parts_dropped", message));
    }
    Ok(described)
}

/// Returns the textures that were made for replaced UVs.
fn textures_affected(
    document: &GltfDocument,
    uvs: &NewUvs,
    baked: Option<&BakedTextures>,
) -> Result<Vec<crate::document::AffectedTexture>, DocumentError> {
    let json = &document.body.json;
    let mut used = BTreeSet::new();
    for (primitive, corners) in document.primitives.iter().zip(&uvs.corners) {
        if corners.is_some() {
            used.extend(materials(primitive.material, document.object(primitive)?)?);
        }
    }
    let mut textures = Vec::new();
    for material in used {
        let all = MaterialTextures::of_material(json, material);
        let old = match baked {
            Some(baked) => all.without(&baked.plan.replaced),
            None => all,
        };
        let is_gone = |set: u32| set > 0 || uvs.layout == Layout::New;
        let gone = old.uses.iter().filter(|texture| is_gone(texture.set));
        textures.extend(gone.map(|texture| affected(json, texture)));
    }
    textures.sort();
    Ok(textures)
}
