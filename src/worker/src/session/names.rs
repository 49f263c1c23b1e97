//! The names that clients give handles.

use std::collections::BTreeMap;

use unwrapd_api::Failure;

/// Names of handles by what the library calls them. An undo may bring a handle back, so none is forgotten.
pub(super) struct Names<Id>(BTreeMap<Id, u32>);

impl<Id: Copy + Ord> Names<Id> {
    /// None yet.
    pub fn none() -> Self {
        Self(BTreeMap::new())
    }

    /// Gives a handle its name.
    pub fn give(&mut self, id: Id, name: u32) {
        self.0.insert(id, name);
    }

    /// The name of a handle, if a client gave it one.
    pub fn of(&self, id: Id) -> Option<u32> {
        self.0.get(&id).copied()
    }

    /// Which of the present handles has this name.
    pub fn find(&self, present: impl Iterator<Item = Id>, name: u32) -> Option<Id> {
        let mut present = present;
        present.find(|id| self.of(*id) == Some(name))
    }

    /// The same where there must be one.
    pub fn expect(&self, present: impl Iterator<Item = Id>, name: u32) -> Result<Id, Failure> {
        self.find(present, name).ok_or_else(|| {
            let detail = format!("there is no handle named {name}");
            Failure::new("unknown_handle", detail)
        })
    }
}
