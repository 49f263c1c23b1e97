//! Undo history of a UV session.

use std::collections::BTreeMap;

use super::session::{LiveChart, State, UvSession};

impl UvSession {
    /// Records the map and the anchors, as before a drag; [`undo`](Self::undo) returns here. The last hundred are kept.
    pub fn remember(&mut self) {
        let state = self.state();
        self.history.remember(state);
    }

    /// Returns to the last recorded UVs and anchors, bit for bit; returns `false` if there are none.
    pub fn undo(&mut self) -> bool {
        let present = self.state();
        let state = self.history.back(present);
        self.restore(state)
    }

    /// Reverts an undo; returns `false` if there is none, or something was recorded since.
    pub fn redo(&mut self) -> bool {
        let present = self.state();
        let state = self.history.forth(present);
        self.restore(state)
    }

    /// Resets the map to its start, without anchors. The history is kept.
    pub fn reset(&mut self) {
        self.restore(Some(State {
            anchors: BTreeMap::new(),
            charts: BTreeMap::new(),
        }));
    }

    fn state(&self) -> State {
        let places = |(&number, chart): (&u32, &LiveChart)| (number, chart.live.x().to_vec());
        State {
            anchors: self.anchors.clone(),
            charts: self.charts.iter().map(places).collect(),
        }
    }

    /// Restores a state, if any, and returns whether that succeeded; charts that were not held then go back to their
    /// start.
    fn restore(&mut self, state: Option<State>) -> bool {
        let Some(State { anchors, charts }) = state else {
            return false;
        };
        // Restore the anchors before the places: the present anchors would set a map at rest in motion.
        if self.take(anchors).is_err() {
            return false;
        }
        self.charts.iter_mut().all(|(number, chart)| {
            let start = || chart.flat.start.as_flattened().to_vec();
            let places = charts.get(number).cloned().unwrap_or_else(start);
            chart.live.put(places).is_ok()
        })
    }
}
