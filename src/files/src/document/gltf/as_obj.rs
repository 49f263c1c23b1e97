//! Output of a glTF document with new UVs as an OBJ file, with its materials and pictures as separate files.

use super::accessor::Accessor;
use super::body::Body;
use super::json::{extension, item, items, unsigned};
use super::obj_names::{Taken, material_names, object_names};
use super::obj_pictures::ObjPictures;
use super::scene::is_in_place;
use super::texture_warnings::texture_warnings;
use super::textures::{MaterialTextures, affected, materials};
use super::{GltfDocument, baked};
use crate::document::colors::{Color, from_linear};
use crate::document::material::{Dropped, Material, mtl_text, of_gltf};
use crate::document::new_obj::{self, ObjPart};
use crate::document::{
    BakedTextures, DocumentError, Layout, NewUvs, PrimitiveNote, Warning, WriteNotes, WriteOptions,
    Written, warning,
};
use serde_json::{Map, Value};
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
        Some(baked) => baked::insert(document, &mut body, baked, 0, &options.stem, &mut notes)?,
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
    // Collect warnings about everything that is lost.
    notes.textures_affected = textures_affected(document, uvs, baked)?;
    let warnings = texture_warnings(document, &notes);
    notes.warnings.extend(warnings);
    notes.warnings.extend(losses(document)?);
    notes.warnings.extend(pictures.warnings());

    // Put the files together.
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
    // Convert each material in use once.
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
    // Warn of the parts that MTL cannot hold.
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

// Contents of a document that an OBJ file cannot hold.

/// Returns a warning per kind of lost content, with its count.
fn losses(document: &GltfDocument) -> Result<Vec<Warning>, DocumentError> {
    let json = &document.body.json;
    let mut warnings = Vec::new();
    let mut lose = |n: usize, code: &'static str, what: &str| {
        if n > 0 {
            let message = format!("OBJ cannot hold {what}: {n} left out");
            warnings.push(Warning::new(code, message));
        }
    };
    // Top-level objects.
    lose(items(json, "skins")?.len(), "skins_dropped", "skins");
    lose(
        items(json, "animations")?.len(),
        "animations_dropped",
        "animations",
    );
    lose(items(json, "cameras")?.len(), "cameras_dropped", "cameras");
    let lights = extension(json, "KHR_lights_punctual");
    let lights = lights.map_or(Ok(0), |lights| items(lights, "lights").map(<[_]>::len))?;
    lose(lights, "lights_dropped", "lights");
    let variants = extension(json, "KHR_materials_variants");
    let variants = variants.map_or(Ok(0), |all| items(all, "variants").map(<[_]>::len))?;
    lose(variants, "variants_dropped", "material variants");
    // Contents of primitives.
    let counts = Counts::of(document)?;
    lose(
        counts.morphed,
        "morph_targets_dropped",
        "morph targets of primitives",
    );
    lose(
        counts.uv_sets,
        "uv_sets_dropped",
        "UV sets beyond the first",
    );
    lose(
        counts.attributes,
        "attributes_dropped",
        "further vertex attributes",
    );
    lose(
        counts.elements,
        "elements_dropped",
        "primitives without triangles",
    );
    // Placements.
    let moved = n_moved(json)?;
    if moved > 0 {
        let message = format!(
            "the OBJ file holds each mesh once, without node transforms: {moved} appear elsewhere or repeatedly in the scene"
        );
        warnings.push(Warning::new("transforms_lost", message));
    }
    Ok(warnings)
}

#[derive(Default)]
struct Counts {
    morphed: usize,
    uv_sets: usize,
    attributes: usize,
    elements: usize,
}

impl Counts {
    fn of(document: &GltfDocument) -> Result<Self, DocumentError> {
        let mut counts = Self::default();
        let mut n_primitives = 0;
        for mesh in items(&document.body.json, "meshes")? {
            n_primitives += items(mesh, "primitives")?.len();
        }
        counts.elements = n_primitives - document.primitives.len();
        for primitive in &document.primitives {
            let object = document.object(primitive)?;
            counts.morphed += items(object, "targets")?.len();
            let attributes = object["attributes"].as_object();
            for name in attributes.into_iter().flat_map(Map::keys) {
                match name.as_str() {
                    // Skins are counted themselves, and tangents follow from UVs.
                    "POSITION" | "NORMAL" | "TANGENT" | "TEXCOORD_0" | "COLOR_0" => {}
                    name if name.starts_with("JOINTS_") || name.starts_with("WEIGHTS_") => {}
                    name if name.starts_with("TEXCOORD_") => counts.uv_sets += 1,
                    _ => counts.attributes += 1,
                }
            }
        }
        Ok(counts)
    }
}

/// Counts the meshes that the scene shows elsewhere than in their own placement, or more than once.
fn n_moved(json: &Value) -> Result<usize, DocumentError> {
    let in_place = is_in_place(json)?;
    let mut moved: BTreeSet<usize> = (0..in_place.len())
        .filter(|&mesh| !in_place[mesh])
        .collect();
    let mut shown = BTreeSet::new();
    for node in items(json, "nodes")? {
        let Some(mesh) = unsigned(node, "mesh")? else {
            continue;
        };
        if !shown.insert(mesh) || extension(node, "EXT_mesh_gpu_instancing").is_some() {
            moved.insert(mesh);
        }
    }
    Ok(moved.len())
}
