//! Interactive editing of UVs.

use std::collections::BTreeMap;

use super::anchors::{Anchor, Held, hold};
use super::chart::{UvChart, UvVertices};
use super::flat_chart::{FlatChart, Grips};
use super::map::UvMap;
use super::{EditError, Spot, UvEditOptions, UvMesh};
use crate::history::History;
use crate::live::Live;
use crate::problem::Model;
use crate::pull::{arrive, pulled};
use unwrapd_maps::mesh::CornerUvs;
use unwrapd_method::solver::Stage;

/// A session in which a UV map is edited, like a [`Session`](crate::Session) for a body: anchors are added, moved and
/// removed, and their charts follow an iteration at a time, without a flipped triangle at any time.
///
/// Charts, units and errors are those of [`edit_uvs`](super::edit_uvs), and so is the map in which a session settles.
/// Each chart is built when its first anchor is added, and its linear systems are analyzed once. Places are those of
/// the map at the start.
pub struct UvSession {
    options: UvEditOptions,
    positions: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
    uvs: Vec<CornerUvs>,
    pub(super) map: UvMap,
    pub(super) vertices: UvVertices,
    /// For each chart the orientation of most of its area.
    pub(super) positive: Vec<i8>,
    pub(super) charts: BTreeMap<u32, LiveChart>,
    pub(super) anchors: BTreeMap<AnchorId, Anchor>,
    next: u32,
    pub(super) history: History<State>,
}

/// Identifier of an anchor of a session; never reused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct AnchorId(u32);

/// A chart that has anchors, or had; it then stays as it is.
pub(super) struct LiveChart {
    pub chart: UvChart,
    pub flat: FlatChart,
    grips: Grips,
    is_held: bool,
    pub live: Live,
}

/// State to which [`UvSession::undo`] returns.
pub(super) struct State {
    pub anchors: BTreeMap<AnchorId, Anchor>,
    /// Positions of the vertices of each chart that was held.
    pub charts: BTreeMap<u32, Vec<f64>>,
}

impl UvSession {
    /// Opens a session with a map without anchors.
    pub fn new(mesh: &UvMesh, options: UvEditOptions) -> Self {
        let map = UvMap::new(mesh);
        Self {
            vertices: UvVertices::new(&map),
            positive: map.chart_orientations(),
            positions: mesh.positions.to_vec(),
            triangles: mesh.triangles.to_vec(),
            uvs: mesh.uvs.to_vec(),
            charts: BTreeMap::new(),
            anchors: BTreeMap::new(),
            next: 0,
            history: History::new(),
            options,
            map,
        }
    }

    /// Adds an anchor at a vertex or a place.
    ///
    /// # Errors
    /// As [`edit_uvs`](super::edit_uvs), where anchors are named by their order in [`anchors`](Self::anchors), this one
    /// last. The session is then unchanged.
    pub fn add(&mut self, anchor: Anchor) -> Result<AnchorId, EditError> {
        let id = AnchorId(self.next);
        let mut anchors = self.anchors.clone();
        anchors.insert(id, anchor);
        self.take(anchors)?;
        self.next += 1;
        Ok(id)
    }

    /// Changes the target of an anchor.
    ///
    /// # Errors
    /// As [`add`](Self::add), or if there is no such anchor.
    pub fn move_anchor(&mut self, id: AnchorId, target: [f64; 2]) -> Result<(), EditError> {
        let mut anchors = self.anchors.clone();
        match anchors.get_mut(&id) {
            Some(Anchor::Vertex { to, .. } | Anchor::Place { to, .. }) => *to = target,
            None => return Err(EditError::UnknownHandle(id.0 as usize)),
        }
        self.take(anchors)
    }

    /// Exchanges an anchor for another one.
    ///
    /// # Errors
    /// As [`add`](Self::add), or if there is no such anchor.
    pub fn exchange(&mut self, id: AnchorId, anchor: Anchor) -> Result<(), EditError> {
        let mut anchors = self.anchors.clone();
        match anchors.get_mut(&id) {
            Some(present) => *present = anchor,
            None => return Err(EditError::UnknownHandle(id.0 as usize)),
        }
        self.take(anchors)
    }

    /// Removes an anchor. A chart without anchors stays as it is.
    ///
    /// # Errors
    /// If there is no such anchor.
    pub fn remove(&mut self, id: AnchorId) -> Result<(), EditError> {
        let mut anchors = self.anchors.clone();
        if anchors.remove(&id).is_none() {
            return Err(EditError::UnknownHandle(id.0 as usize));
        }
        self.take(anchors)
    }

    /// Iterates over the anchors and their identifiers, in the order in which they were added.
    pub fn anchors(&self) -> impl Iterator<Item = (AnchorId, &Anchor)> {
        self.anchors.iter().map(|(id, anchor)| (*id, anchor))
    }

    /// Replaces the anchors; changes nothing on an error.
    pub(super) fn take(&mut self, anchors: BTreeMap<AnchorId, Anchor>) -> Result<(), EditError> {
        // Group the anchors by chart, and build charts that are held for the first time.
        let mut of_chart: BTreeMap<u32, Vec<Held>> = BTreeMap::new();
        for held in self.held(&anchors)? {
            let chart = match held.spot {
                Spot::Vertex(vertex) => self.vertices.chart(&self.map, vertex),
                Spot::Place { chart, .. } => chart,
            };
            of_chart.entry(chart).or_default().push(held);
        }
        for &chart in of_chart.keys() {
            if !self.charts.contains_key(&chart) {
                let live = self.live_chart(chart)?;
                self.charts.insert(chart, live);
            }
        }
        // Make all handles before any chart is aimed: an error then changes nothing.
        let boundary = self.options.boundary;
        let mut aims = Vec::with_capacity(self.charts.len());
        for (number, chart) in &self.charts {
            let held = of_chart.get(number).map_or(&[][..], Vec::as_slice);
            let grips = chart.flat.grips(&chart.chart, held, boundary)?;
            let handles = grips.holds.handles(&chart.flat.body, &chart.flat.start)?;
            aims.push((grips, handles, !held.is_empty()));
        }
        // Aim the charts whose handles have changed.
        for (chart, (grips, handles, is_held)) in self.charts.values_mut().zip(aims) {
            chart.is_held = is_held;
            if chart.live.problem().stations[0] != handles {
                chart.live.aim(handles)?;
            }
            chart.grips = grips;
        }
        self.anchors = anchors;
        Ok(())
    }

    fn held(&self, anchors: &BTreeMap<AnchorId, Anchor>) -> Result<Vec<Held>, EditError> {
        if anchors.is_empty() {
            return Ok(Vec::new());
        }
        let mesh = UvMesh {
            positions: &self.positions,
            triangles: &self.triangles,
            uvs: &self.uvs,
        };
        let list: Vec<Anchor> = anchors.values().copied().collect();
        hold(&mesh, &self.map, &self.vertices, &list)
    }

    fn live_chart(&self, number: u32) -> Result<LiveChart, EditError> {
        let UvEditOptions {
            boundary,
            rest,
            ref model,
            ..
        } = self.options;
        let positive = self.positive[number as usize];
        let mut chart = UvChart::new(&self.map, &self.vertices, number, positive)?;
        chart.untangle(boundary)?;
        let flat = FlatChart::new(&chart, rest)?;
        let grips = flat.grips(&chart, &[], boundary)?;
        let handles = grips.holds.handles(&flat.body, &flat.start)?;
        let problem = pulled(flat.body.clone(), &flat.start, handles, model)?;
        Ok(LiveChart {
            live: Live::new(problem)?,
            is_held: false,
            chart,
            flat,
            grips,
        })
    }

    /// Runs one iteration of every chart that has something left to do; the map is valid before and after.
    pub fn step(&mut self) -> Stage {
        for chart in self.charts.values_mut().filter(|chart| chart.is_held) {
            chart.live.step();
        }
        self.stage()
    }

    /// Runs iterations while there is something to do and `go_on`, called before each, returns `true`.
    pub fn step_while(&mut self, mut go_on: impl FnMut(&Self) -> bool) -> Stage {
        while self.stage() == Stage::Moving && go_on(self) {
            self.step();
        }
        self.stage()
    }

    /// Returns the state of the anchors.
    pub fn stage(&self) -> Stage {
        let held = || self.charts.values().filter(|chart| chart.is_held);
        let any = |stage| held().any(|chart| chart.live.stage() == stage);
        let unfinished = [Stage::Moving, Stage::Unreachable]
            .into_iter()
            .find(|&s| any(s));
        unfinished.unwrap_or(Stage::Settled)
    }

    /// Exchanges energy and barrier. The map, the anchors and the history are kept.
    ///
    /// # Errors
    /// As [`add`](Self::add), or if the present map is outside the domain of the new energy. The session is then
    /// unchanged.
    pub fn remodel(&mut self, model: &Model) -> Result<(), EditError> {
        let before = std::mem::replace(&mut self.options.model, model.clone());
        match self.rebuilt() {
            Ok(lives) => {
                for (chart, live) in self.charts.values_mut().zip(lives) {
                    chart.live = live;
                }
                Ok(())
            }
            Err(error) => {
                self.options.model = before;
                Err(error)
            }
        }
    }

    /// Rebuilds each chart at its present map under the present model.
    fn rebuilt(&self) -> Result<Vec<Live>, EditError> {
        let rebuilt = self.charts.values().map(|chart| {
            let (body, start) = (chart.flat.body.clone(), &chart.flat.start);
            let handles = chart.live.problem().stations[0].clone();
            let mut live = Live::new(pulled(body, start, handles, &self.options.model)?)?;
            live.put(chart.live.x().to_vec())?;
            live.check_domain()?;
            Ok(live)
        });
        rebuilt.collect()
    }

    /// Returns the number of times the linear systems of charts were ordered and analyzed.
    pub fn analyses(&self) -> usize {
        self.charts
            .values()
            .map(|chart| chart.live.analyses())
            .sum()
    }

    /// Returns the UVs of each face's corners. Charts without anchors keep theirs bit for bit, and so does every vertex
    /// that has not moved.
    pub fn uvs(&self) -> Vec<CornerUvs> {
        self.vertices.moved(&self.uvs, &self.moved())
    }

    /// Returns the vertices of the UV map that have moved since the start.
    pub(super) fn moved(&self) -> BTreeMap<u32, [f64; 2]> {
        let mut moved: BTreeMap<u32, [f64; 2]> = BTreeMap::new();
        for LiveChart {
            chart,
            flat,
            grips,
            live,
            ..
        } in self.charts.values()
        {
            let mut places = live.x().as_chunks::<2>().0.to_vec();
            arrive(&mut places, &live.problem().stations[0]);
            let uvs = flat.uvs(chart, grips, &places);
            moved.extend(chart.moved(&self.map, &self.vertices, &uvs));
        }
        moved
    }
}
