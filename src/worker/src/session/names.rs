//! Names of handles.

use std::collections::BTreeMap;

use unwrapd_api::Failure;

/// Client names of handles by library id. An undo may bring a handle back, so no name is forgotten.
pub(super) struct Names<Id>(BTreeMap<Id, u32>);

impl<Id: Copy + Ord> Names<Id> {
    /// Creates an empty map of names.
    pub fn none() -> Self {
        Self(BTreeMap::new())
    }

    /// Names a handle.
    pub fn give(&mut self, id: Id, name: u32) {
        self.0.insert(id, name);
    }

    /// Returns the name of a handle; `None` if no client named it.
    pub fn of(&self, id: Id) -> Option<u32> {
        self.0.get(&id).copied()
    }

    /// Returns the present handle with this name.
    pub fn find(&self, present: impl Iterator<Item = Id>, name: u32) -> Option<Id> {
        let mut present = present;
        present.find(|id| self.of(*id) == Some(name))
    }

    /// Returns the present handle with this name, or an error if there is none.
    pub fn expect(&self, present: impl Iterator<Item = Id>, name: u32) -> Result<Id, Failure> {
        self.find(present, name).ok_or_else(|| {
            let detail = format!("there is no handle named {name}");
            Failure::new("unknown_handle", detail)
        })
    }
}
