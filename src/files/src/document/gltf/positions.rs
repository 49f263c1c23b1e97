//! Positions that several primitives may share.
use super::accessor::Accessor;
use super::body::Body;
use super::json::{invalid, items};
use super::mode::position_accessor;
use crate::document::DocumentError;
use std::collections::HashMap;
use std::rc::Rc;
use unwrapd_maps::mesh::UsedVertices;

/// Largest count of positions or indices without bytes behind them.
const MAX_UNBACKED: usize = 1 << 20;

/// Positions by accessor; those that several primitives share are read once.
pub(super) struct Positions {
    n_users: HashMap<usize, usize>,
    shared: HashMap<usize, Rc<Vec<[f32; 3]>>>,
}

impl Positions {
    pub fn new(body: &Body) -> Result<Self, DocumentError> {
        let mut n_users = HashMap::new();
        for mesh in items(&body.json, "meshes")? {
            for primitive in items(mesh, "primitives")? {
                if let Some(accessor) = position_accessor(primitive)? {
                    *n_users.entry(accessor).or_insert(0) += 1;
                }
            }
        }
        let shared = HashMap::new();
        Ok(Self { n_users, shared })
    }

    pub fn is_shared(&self, accessor: usize) -> bool {
        self.n_users.get(&accessor).is_some_and(|n| *n > 1)
    }

    pub fn read(&mut self, body: &Body, index: usize) -> Result<Rc<Vec<[f32; 3]>>, DocumentError> {
        if let Some(positions) = self.shared.get(&index) {
            return Ok(Rc::clone(positions));
        }
        let accessor = Accessor::open(body, index)?;
        if !accessor.is("VEC3") {
            return Err(invalid("POSITION is not of type VEC3"));
        }
        check_backed(&accessor)?;
        let positions = Rc::new(accessor.vectors()?);
        if self.is_shared(index) {
            self.shared.insert(index, Rc::clone(&positions));
        }
        Ok(positions)
    }
}

/// Renumbers indices by the vertices that they use; returns these, or `None` if all are used.
pub(super) fn compact(indices: &mut [u32], positions: &[[f32; 3]]) -> Option<Vec<u32>> {
    let used = UsedVertices::new(indices.iter().copied());
    if used.count() == positions.len() {
        return None;
    }
    used.renumber(indices);
    Some(used.into_vec())
}

/// Refuses long accessors without data.
pub(super) fn check_backed(accessor: &Accessor) -> Result<(), DocumentError> {
    if accessor.is_backed() || accessor.count <= MAX_UNBACKED {
        return Ok(());
    }
    Err(DocumentError::LimitExceeded(format!(
        "an accessor without data has {} elements",
        accessor.count
    )))
}
