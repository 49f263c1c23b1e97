//! Output of a glTF document with new UVs as an OBJ file, with its materials and pictures as separate files.

use super::accessor::Accessor;
use super::body::GltfBody;
use super::document::{COLOR, GltfDocument};
use super::images;
use super::json::{extension, item, items, unsigned};
use super::scene::is_in_place;
use super::textures::{self, MaterialTextures, TRANSFORM, affected, materials, texture_warnings};
use crate::document::material::{Dropped, Material, TextureMap, mtl_text, of_gltf};
use crate::document::new_obj::{self, Color, ObjPart, from_linear};
use crate::document::{
    BakedTextures, DocumentError, Layout, NewUvs, PrimitiveNote, Warning, WriteNotes, WriteOptions,
    Written, error, uri,
};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet, HashMap};
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
        Some(baked) => textures::insert(document, &mut body, baked, 0, &options.stem, &mut notes)?,
        None => document.resources.clone(),
    };
    let mut taken = TakenNames::default();
    let stem = taken.name(&options.stem);
    let mut pictures = ObjPictures::new(&body, &resources, &stem);
    let material_names = material_names(&body.json)?;
    let described = described(document, &body, &material_names, &mut pictures, &mut notes)?;

    // Parts with their names.
    let objects = object_names(&body.json)?;
    let mut parts = Vec::with_capacity(document.primitives.len());
    for (index, primitive) in document.primitives.iter().enumerate() {
        let mut part = part(document, &body, index, uvs)?;
        if baked.is_some_and(|baked| baked.plan.is_colored(index)) {
            part.colors = None;
        }
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
    body: &GltfBody,
    index: usize,
    uvs: &NewUvs,
) -> Result<ObjPart<'a>, DocumentError> {
    let uvs = match uvs.toward(index, VAxis::Up) {
        Some(uvs) => Some(uvs),
        None => document.corner_uvs(index, 0)?.map(|uvs| {
            uvs.into_iter()
                .map(|face: [[f64; 2]; 3]| face.map(|[u, v]| [u as f32, (1.0 - v) as f32]))
                .collect()
        }),
    };
    let normals = document.corner_normals(index)?;
    Ok(ObjPart {
        primitive: &document.primitives[index],
        object: "",
        material: None,
        uvs,
        normals: normals.map(|normals| {
            normals
                .into_iter()
                .map(|face: [[f64; 3]; 3]| face.map(|normal| normal.map(|x| x as f32 + 0.0)))
                .collect()
        }),
        colors: document.colors_in(body, index)?,
    })
}

impl GltfDocument {
    /// Returns the colors of a primitive's vertices, linear; `None` if it has none.
    pub fn vertex_colors(&self, index: usize) -> Result<Option<Vec<Color>>, DocumentError> {
        self.colors_in(&self.body, index)
    }

    /// Reads `COLOR_0` from a body, if it is a color.
    fn colors_in(
        &self,
        body: &GltfBody,
        index: usize,
    ) -> Result<Option<Vec<Color>>, DocumentError> {
        let attributes = &self.object(&self.primitives[index])?["attributes"];
        let Some(accessor) = unsigned(attributes, COLOR)? else {
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
        let own = match &self.used[index] {
            Some(used) => used.iter().map(|&v| all[v as usize]).collect(),
            None => all,
        };
        Ok(Some(own))
    }
}

fn material_of(
    body: &GltfBody,
    mesh: usize,
    primitive: usize,
) -> Result<Option<usize>, DocumentError> {
    let primitives = items(item(&body.json, "meshes", mesh)?, "primitives")?;
    match primitives.get(primitive) {
        Some(primitive) => unsigned(primitive, "material"),
        None => Ok(None),
    }
}

/// Converts the materials in use.
fn described(
    document: &GltfDocument,
    body: &GltfBody,
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
            described.push(of_gltf(
                object,
                name.clone(),
                |info: &Value| pictures.map(info),
                &mut lost,
            ));
        }
    }
    // Warn of the parts that MTL cannot hold.
    if !lost.is_empty() {
        let counted: Vec<String> = lost
            .iter()
            .map(|(part, n)| format!("{part} ({n})"))
            .collect();
        let parts = error::listed(counted.iter().map(String::as_str));
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
            for name in attributes.into_iter().flat_map(serde_json::Map::keys) {
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

// Pictures of textures as separate files next to an OBJ file.

/// Pictures to which materials refer.
struct ObjPictures<'a> {
    body: &'a GltfBody,
    resources: &'a BTreeMap<String, Vec<u8>>,
    stem: &'a str,
    taken: TakenNames,
    /// For each image the name of its file; `None` if there is no file.
    names: BTreeMap<usize, Option<String>>,
    files: BTreeMap<String, Vec<u8>>,
    missing: BTreeSet<String>,
    n_turned: usize,
    n_without_image: usize,
}

impl<'a> ObjPictures<'a> {
    /// Starts without pictures, for a document with these resources.
    pub fn new(
        body: &'a GltfBody,
        resources: &'a BTreeMap<String, Vec<u8>>,
        stem: &'a str,
    ) -> Self {
        Self {
            body,
            resources,
            stem,
            taken: TakenNames::default(),
            names: BTreeMap::new(),
            files: BTreeMap::new(),
            missing: BTreeSet::new(),
            n_turned: 0,
            n_without_image: 0,
        }
    }

    /// Returns the map for a texture info.
    pub fn map(&mut self, info: &Value) -> Option<TextureMap> {
        let json = &self.body.json;
        let texture = unsigned(info, "index").ok().flatten();
        let object = texture.and_then(|texture| item(json, "textures", texture).ok());
        let image = object.and_then(|object| images::source(object).ok().flatten());
        let Some(image) = image else {
            self.n_without_image += 1;
            return None;
        };
        let mut map = TextureMap::of(self.name(image)?);
        if let Some(transform) = extension(info, TRANSFORM) {
            let pair = |key: &str, default: f64| {
                let at = |k: usize| transform.get(key)?.get(k)?.as_f64();
                [at(0).unwrap_or(default), at(1).unwrap_or(default)]
            };
            map.scale = pair("scale", 1.0);
            let [u, v] = pair("offset", 0.0);
            // v points up here.
            map.offset = [u, 1.0 - map.scale[1] - v];
            let turn = transform.get("rotation").and_then(Value::as_f64);
            self.n_turned += usize::from(turn.is_some_and(|turn| turn != 0.0));
        }
        Some(map)
    }

    /// Returns the name of an image's file.
    fn name(&mut self, image: usize) -> Option<String> {
        if let Some(name) = self.names.get(&image) {
            return name.clone();
        }
        let name = self.new_name(image);
        self.names.insert(image, name.clone());
        name
    }

    fn new_name(&mut self, image: usize) -> Option<String> {
        let object = item(&self.body.json, "images", image).ok()?;
        let path = object
            .get("uri")
            .and_then(Value::as_str)
            .filter(|uri| !uri::is_data(uri));
        // A supplied file keeps its name; a missing one stays a reference.
        if let Some(path) = path {
            let found = uri::member(path, self.resources);
            let Some((name, bytes)) = found else {
                self.missing
                    .insert(path.chars().filter(|c| !c.is_control()).take(120).collect());
                return Some(path.replace(['\n', '\r'], ""));
            };
            // Reserve the name, so that no other file gets it.
            self.taken
                .name(name.rsplit_once('.').map_or(name, |(stem, _)| stem));
            self.files.insert(name.to_owned(), bytes.to_vec());
            return Some(name.to_owned());
        }
        // An image inside the document gets a file, named after the image or the document.
        let bytes = images::bytes(self.body, image, self.resources).ok()?;
        let given = object
            .get("name")
            .and_then(Value::as_str)
            .unwrap_or_default();
        let given = given
            .rsplit_once('.')
            .map_or(given, |(stem, _)| stem)
            .trim();
        let wanted = if given.is_empty() {
            format!("{}_{image}", self.stem)
        } else {
            given.replace(char::is_whitespace, "_")
        };
        let name = format!(
            "{}.{}",
            self.taken.name(&wanted),
            images::file_extension(&bytes)
        );
        self.files.insert(name.clone(), bytes.into_owned());
        Some(name)
    }

    /// Returns warnings about content that could not be transferred.
    pub fn warnings(&self) -> Vec<Warning> {
        let mut warnings = Vec::new();
        if !self.missing.is_empty() {
            let names = error::listed(self.missing.iter().map(String::as_str));
            let message = format!("images were not supplied and remain references: {names}");
            warnings.push(Warning::new("image_missing", message));
        }
        if self.n_turned > 0 {
            let n = self.n_turned;
            let message = format!("MTL cannot rotate textures: {n} lose their rotation");
            warnings.push(Warning::new("turns_dropped", message));
        }
        if self.n_without_image > 0 {
            let n = self.n_without_image;
            let message = format!("textures without a PNG, JPEG or WebP image are left out: {n}");
            warnings.push(Warning::new("textures_dropped", message));
        }
        warnings
    }

    /// Returns the files by name.
    pub fn into_files(self) -> impl Iterator<Item = (String, Vec<u8>)> {
        self.files.into_iter()
    }
}

// Names of objects, materials and files in OBJ, where every character up to the end of a line may count.

/// Names in use, regardless of case, as file names may have to differ in more than that; each with the number of
/// requests for it.
#[derive(Default)]
struct TakenNames(HashMap<String, u32>);

impl TakenNames {
    /// Returns the name without characters that would end it or have another meaning, and with a number if it is taken.
    pub fn name(&mut self, wanted: &str) -> String {
        let words: String = wanted
            .trim()
            .chars()
            .take(200)
            .map(|c: char| {
                if c.is_control() || "#\\/:\"".contains(c) {
                    '_'
                } else {
                    c
                }
            })
            .collect();
        let mut name = words.clone();
        let mut times = self.0.get(&words.to_lowercase()).copied().unwrap_or(0);
        while self.0.contains_key(&name.to_lowercase()) {
            times += 1;
            name = format!("{words}_{}", times + 1);
        }
        self.0.insert(words.to_lowercase(), times);
        self.0.entry(name.to_lowercase()).or_default();
        name
    }
}

/// Returns unique names of materials.
fn material_names(json: &Value) -> Result<Vec<String>, DocumentError> {
    let mut taken = TakenNames::default();
    let materials = items(json, "materials")?.iter().enumerate();
    let names = materials.map(|(index, material)| {
        let name = own_name(material).map_or_else(|| format!("material{index}"), str::to_owned);
        taken.name(&name)
    });
    Ok(names.collect())
}

/// Returns unique names of meshes: that of the mesh, or of the first node that shows it.
fn object_names(json: &Value) -> Result<Vec<String>, DocumentError> {
    let meshes = items(json, "meshes")?;
    let mut names: Vec<Option<&str>> = meshes.iter().map(own_name).collect();
    for node in items(json, "nodes")? {
        let mesh = unsigned(node, "mesh")?.and_then(|mesh| names.get_mut(mesh));
        if let Some(name) = mesh.filter(|name| name.is_none()) {
            *name = own_name(node);
        }
    }
    let mut taken = TakenNames::default();
    let names = names.into_iter().enumerate().map(|(index, name)| {
        let name = name.map_or_else(|| format!("mesh{index}"), str::to_owned);
        taken.name(&name)
    });
    Ok(names.collect())
}

fn own_name(object: &Value) -> Option<&str> {
    let name = object.get("name")?.as_str()?;
    (!name.trim().is_empty()).then_some(name)
}
