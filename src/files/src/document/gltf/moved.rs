//! Surfaces moved by a map of space.
use super::accessor::Accessor;
use super::body::Body;
use super::bounds;
use super::component::Component;
use super::json::{invalid, item, items, object_mut, primitive_mut, remove, unsigned};
use super::positions::Positions;
use crate::document::{DocumentError, Primitive, SpaceMap};
use serde_json::{Value, json};
use std::collections::HashMap;

/// Most bytes of the new accessors: primitives may share large accessors and use little of them.
const MAX_MOVED: usize = 1 << 31;

/// Attributes that a map changes.
const ATTRIBUTES: [&str; 3] = ["POSITION", "NORMAL", "TANGENT"];

/// Gives the primitives moved positions, normals and tangents in new accessors of f32; shared accessors stay shared.
/// Morph targets are differences of positions and stay unchanged.
pub(super) fn move_surfaces(
    body: &mut Body,
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
    body: &'a mut Body,
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
            bounds::set(&mut object, &packed, Component::F32, width);
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
