//! Surfaces moved by a map of space.

use super::accessor::{self, Accessor, Component};
use super::body::{GltfBody, Target};
use super::document::GltfDocument;
use super::json::{as_unsigned, invalid, item, items, object_mut, primitive_mut, remove, unsigned};
use super::primitives::Positions;
use crate::document::group::{AddedVertex, Subdivision};
use crate::document::{DocumentError, Primitive, SpaceMap};
use serde_json::{Value, json};
use std::collections::HashMap;

/// Most bytes of the new accessors: primitives may share large accessors and use little of them.
const MAX_MOVED: usize = 1 << 31;

/// Attributes that a map changes.
const ATTRIBUTES: [&str; 3] = ["POSITION", "NORMAL", "TANGENT"];

impl GltfDocument {
    /// Moves the triangles of the document by a map.
    pub fn moved(mut self, map: &dyn SpaceMap) -> Result<Self, DocumentError> {
        move_surfaces(&mut self.body, &self.primitives, map)?;
        self.collect()?;
        Ok(self)
    }
}

/// Gives the primitives moved positions, normals and tangents in new accessors of f32; shared accessors stay shared.
/// Morph targets are differences of positions and stay unchanged.
fn move_surfaces(
    body: &mut GltfBody,
    primitives: &[Primitive],
    map: &dyn SpaceMap,
) -> Result<(), DocumentError> {
    let mut surfaces = SurfaceMoves {
        positions: Positions::new(body)?,
        body,
        map,
        budget: MAX_MOVED,
        done: HashMap::new(),
    };
    for primitive in primitives {
        surfaces.push(primitive)?;
    }
    Ok(())
}

struct SurfaceMoves<'a> {
    body: &'a mut GltfBody,
    positions: Positions,
    map: &'a dyn SpaceMap,
    /// Number of bytes that may still be written.
    budget: usize,
    /// New accessor for each combination of positions, attribute and accessor of its values.
    done: HashMap<(usize, &'static str, usize), usize>,
}

impl SurfaceMoves<'_> {
    fn push(&mut self, primitive: &Primitive) -> Result<(), DocumentError> {
        let mesh = item(&self.body.json, "meshes", primitive.mesh)?;
        let attributes = items(mesh, "primitives")?
            .get(primitive.primitive)
            .map(|object| object["attributes"].clone())
            .unwrap_or_default();
        let Some(positions) = unsigned(&attributes, "POSITION")? else {
            return Err(invalid("a primitive has no positions"));
        };
        for name in ATTRIBUTES {
            let Some(old) = unsigned(&attributes, name)? else {
                continue;
            };
            let new = match self.done.get(&(positions, name, old)) {
                Some(new) => *new,
                None => self.moved(positions, name, old)?,
            };
            self.done.insert((positions, name, old), new);
            let object = primitive_mut(&mut self.body.json, primitive.mesh, primitive.primitive)?;
            object_mut(&mut object["attributes"])?.insert(name.to_owned(), json!(new));
        }
        Ok(())
    }

    /// Creates an accessor with the moved values of accessor `old` and its other properties.
    fn moved(
        &mut self,
        positions: usize,
        name: &'static str,
        old: usize,
    ) -> Result<usize, DocumentError> {
        let places = self.positions.read(self.body, positions)?;
        // Charge the budget: at most four numbers of four bytes per vertex.
        self.budget = self
            .budget
            .checked_sub(16 * places.len())
            .ok_or_else(|| DocumentError::LimitExceeded("moved vertices".to_owned()))?;
        // Move the values.
        let is_position = name == "POSITION";
        let (values, width) = match name {
            "POSITION" => (self.map.positions(&places).into_flattened(), 3),
            "NORMAL" => {
                let normals = self.vectors(name, old, "VEC3")?;
                (self.map.normals(&places, &normals).into_flattened(), 3)
            }
            _ => (self.tangents(&places, old)?, 4),
        };
        // Write them to a new accessor with the other properties of the old one.
        let packed: Vec<u8> = values.into_iter().flat_map(f32::to_le_bytes).collect();
        let mut object: Value = item(&self.body.json, "accessors", old)?.clone();
        for member in ["byteOffset", "sparse", "normalized", "min", "max"] {
            remove(&mut object, member);
        }
        object["componentType"] = json!(Component::F32.code());
        if is_position {
            accessor::set(&mut object, &packed, Component::F32, width);
        }
        object["bufferView"] = json!(self.body.push_vertices(&packed, 4 * width)?);
        self.body.push_accessor(object)
    }

    /// Moves tangents; they keep their fourth number, the handedness.
    fn tangents(&self, places: &[[f32; 3]], old: usize) -> Result<Vec<f32>, DocumentError> {
        let tangents: Vec<[f32; 4]> = self.vectors("TANGENT", old, "VEC4")?;
        let directions: Vec<[f32; 3]> = tangents.iter().map(|&[x, y, z, _]| [x, y, z]).collect();
        let moved = self.map.tangents(places, &directions).into_iter();
        let signed = moved.zip(tangents).map(|([x, y, z], t)| [x, y, z, t[3]]);
        Ok(signed.flatten().collect())
    }

    fn vectors<const N: usize>(
        &self,
        name: &str,
        accessor: usize,
        kind: &str,
    ) -> Result<Vec<[f32; N]>, DocumentError> {
        let accessor = Accessor::open(self.body, accessor)?;
        if accessor.is(kind) {
            accessor.vectors()
        } else {
            Err(invalid(format!("{name} is not of type {kind}")))
        }
    }
}

// A primitive whose triangles are cut into pieces.

impl GltfDocument {
    /// Cuts the triangles of the document into pieces.
    pub fn subdivided(mut self, cuts: &[Subdivision]) -> Result<Self, DocumentError> {
        let mut body = self.body.clone();
        for (index, cut) in cuts.iter().enumerate() {
            subdivide(&self, &mut body, index, cut)?;
        }
        self.body = body;
        self.collect()?;
        Ok(self)
    }
}

/// Writes the pieces of primitive `index` into `body`, a copy of the document's, as a list of triangles over new
/// accessors of f32. Attributes are kept, and interpolated at added vertices. Morph targets, skins and whole numbers of
/// unknown meaning are refused, as they cannot be interpolated.
fn subdivide(
    document: &GltfDocument,
    body: &mut GltfBody,
    index: usize,
    cut: &Subdivision,
) -> Result<(), DocumentError> {
    if cut.added.is_empty() {
        return Ok(());
    }
    let primitive = &document.primitives[index];
    let mut changed = document.object(primitive)?.clone();
    if changed.get("targets").is_some() {
        return Err(DocumentError::Indivisible("morph targets".to_owned()));
    }
    // Attributes of own and added vertices.
    for (name, index_of) in object_mut(&mut changed["attributes"])? {
        let old = as_unsigned(index_of)
            .ok_or_else(|| invalid("an attribute is not an accessor index"))?;
        let accessor = Accessor::open(&document.body, old)?;
        let values = if name == "POSITION" {
            let added = cut.added.iter().map(|vertex| &vertex.position);
            let positions = primitive.positions.iter().chain(added);
            positions.flatten().copied().collect()
        } else {
            let own = own_values(primitive, document.used[index].as_deref(), &accessor)?;
            interpolated(name, &accessor, own, &cut.added)?
        };
        *index_of = json!(push(body, &accessor, name == "POSITION", &values)?);
    }
    // Triangles as a list.
    let indices: Vec<u8> = (cut.triangles.iter().flatten())
        .flat_map(|v| v.to_le_bytes())
        .collect();
    let view = body.push_view(&indices, None, Target::Indices)?;
    let accessor = json!({
        "bufferView": view,
        "componentType": Component::U32.code(),
        "count": 3 * cut.triangles.len(),
        "type": "SCALAR",
    });
    changed["indices"] = json!(body.push_accessor(accessor)?);
    changed["mode"] = json!(4);
    *primitive_mut(&mut body.json, primitive.mesh, primitive.primitive)? = changed;
    Ok(())
}

/// Returns the numbers of the primitive's own vertices, one after another.
fn own_values(
    primitive: &Primitive,
    used: Option<&[u32]>,
    accessor: &Accessor,
) -> Result<Vec<f64>, DocumentError> {
    let (all, width) = (accessor.values()?, accessor.width);
    let mut own = Vec::with_capacity(primitive.positions.len() * width);
    for vertex in 0..primitive.positions.len() {
        let element = used.map_or(vertex, |used| used[vertex] as usize);
        let numbers = all.get(element * width..(element + 1) * width);
        own.extend_from_slice(numbers.ok_or_else(|| invalid("a vertex has no element"))?);
    }
    Ok(own)
}

/// Returns the numbers of all vertices. Normals and tangents keep length 1; a tangent gets the handedness of its
/// nearest corner.
fn interpolated(
    name: &str,
    accessor: &Accessor,
    own: Vec<f64>,
    added: &[AddedVertex],
) -> Result<Vec<f32>, DocumentError> {
    // Refuse numbers that have no mean.
    if name.starts_with("JOINTS") || name.starts_with("WEIGHTS") {
        return Err(DocumentError::Indivisible("a skin".to_owned()));
    }
    if accessor.component != Component::F32 && !accessor.is_normalized() {
        return Err(DocumentError::Indivisible(name.to_owned()));
    }
    let width = accessor.width;
    let mut values = own;
    // Append the weighted means of the added vertices.
    for vertex in added {
        let at = |corner: usize, k: usize| values[vertex.corners[corner] as usize * width + k];
        let mut numbers: Vec<f64> = (0..width)
            .map(|k| (0..3).map(|c| vertex.weights[c] * at(c, k)).sum::<f64>())
            .collect();
        // Directions keep length 1; a tangent takes its handedness from the nearest corner.
        if name == "NORMAL" || name == "TANGENT" {
            let length = numbers.iter().take(3).map(|x| x * x).sum::<f64>().sqrt();
            if length > 0.0 {
                numbers.iter_mut().take(3).for_each(|x| *x /= length);
            }
            let nearest = (0..3).max_by(|&a, &b| vertex.weights[a].total_cmp(&vertex.weights[b]));
            if let (Some(handedness), Some(nearest)) = (numbers.get_mut(3), nearest) {
                *handedness = at(nearest, 3);
            }
        }
        values.extend(numbers);
    }
    Ok(values.into_iter().map(|x| x as f32).collect())
}

fn push(
    body: &mut GltfBody,
    like: &Accessor,
    is_position: bool,
    values: &[f32],
) -> Result<usize, DocumentError> {
    let packed: Vec<u8> = values.iter().flat_map(|x| x.to_le_bytes()).collect();
    let mut object: Value = json!({
        "bufferView": body.push_view(&packed, None, Target::Vertices)?,
        "componentType": Component::F32.code(),
        "count": values.len() / like.width.max(1),
        "type": like.kind(),
    });
    if is_position {
        accessor::set(&mut object, &packed, Component::F32, like.width);
    }
    body.push_accessor(object)
}
