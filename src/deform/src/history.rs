//! States that can be returned to.

/// So many at most; the oldest are forgotten.
const MOST: usize = 100;

/// The states before the present one and, where some were left, those after it.
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

    /// Remembers the present state. Those after it are forgotten.
    pub fn remember(&mut self, present: T) {
        self.after.clear();
        if self.before.len() == MOST {
            self.before.remove(0);
        }
        self.before.push(present);
    }

    /// The state to return to, if there is one; the present one comes after it.
    pub fn back(&mut self, present: T) -> Option<T> {
        let state = self.before.pop()?;
        self.after.push(present);
        Some(state)
    }

    /// The reverse.
    pub fn forth(&mut self, present: T) -> Option<T> {
        let state = self.after.pop()?;
        self.before.push(present);
        Some(state)
    }
}
