//! An undo history.

/// Most states that are kept; the oldest are dropped.
const MOST: usize = 100;

/// The states before the present one and, after undoing, those after it.
pub(super) struct History<T> {
    before: Vec<T>,
    after: Vec<T>,
}

impl<T> History<T> {
    pub fn new() -> Self {
        Self {
            before: Vec::new(),
            after: Vec::new(),
        }
    }

    /// Records the present state and drops those after it.
    pub fn remember(&mut self, present: T) {
        self.after.clear();
        if self.before.len() == MOST {
            self.before.remove(0);
        }
        self.before.push(present);
    }

    /// Returns the state before, if any, and stores `present` after it.
    pub fn back(&mut self, present: T) -> Option<T> {
        let state = self.before.pop()?;
        self.after.push(present);
        Some(state)
    }

    /// Returns the state after, if any, and stores `present` before it.
    pub fn forth(&mut self, present: T) -> Option<T> {
        let state = self.after.pop()?;
        self.before.push(present);
        Some(state)
    }
}
