//! Interactive editing of UVs.

use super::anchors::{Anchor, FlatChart, Grips, Held, hold};
use super::chart::{UvChart, UvVertices};
use super::edit::UvEditOptions;
use super::map::{EditError, UvMap, UvMesh};
use crate::editor::{Editable, Editor, HandleId, Live};
use crate::problem::{Model, Problem};
use crate::pull::{arrive, pulled};
use std::collections::BTreeMap;
use unwrapd_maps::mesh::CornerUvs;
use unwrapd_method::solver::Stage;

/// A session in which a UV map is edited, like a [`Session`](crate::Session) for a body: anchors are added, moved and
/// removed, and their charts follow an iteration at a time, without a flipped triangle at any time.
///
/// Charts, units and errors are those of [`edit_uvs`](super::edit_uvs), and so is the map in which a session settles.
/// Each chart is built when its first anchor is added, and its linear systems are analyzed once. Places are those of
/// the map at the start.
pub type UvSession = Editor<LiveUvs>;

/// A UV map while it is edited.
pub struct LiveUvs {
    options: UvEditOptions,
    positions: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
    uvs: Vec<CornerUvs>,
    pub(super) map: UvMap,
    pub(super) vertices: UvVertices,
    /// For each chart the orientation of most of its area.
    pub(super) positive: Vec<i8>,
    pub(super) charts: BTreeMap<u32, LiveChart>,
}

/// A chart that has anchors, or had; it then stays as it is.
pub(super) struct LiveChart {
    pub chart: UvChart,
    pub flat: FlatChart,
    grips: Grips,
    is_held: bool,
    pub live: Live,
}

impl UvSession {
    /// Opens a session with a map without anchors.
    pub fn new(mesh: &UvMesh, options: UvEditOptions) -> Self {
        let map = UvMap::new(mesh);
        Self::of(LiveUvs {
            vertices: UvVertices::new(&map),
            positive: map.chart_orientations(),
            positions: mesh.positions.to_vec(),
            triangles: mesh.triangles.to_vec(),
            uvs: mesh.uvs.to_vec(),
            charts: BTreeMap::new(),
            options,
            map,
        })
    }

    /// Returns the number of times the linear systems of charts were ordered and analyzed.
    pub fn analyses(&self) -> usize {
        let charts = self.map.charts.values();
        charts.map(|chart| chart.live.analyses()).sum()
    }

    /// Returns the UVs of each face's corners. Charts without anchors keep theirs bit for bit, and so does every vertex
    /// that has not moved.
    pub fn uvs(&self) -> Vec<CornerUvs> {
        let LiveUvs { vertices, uvs, .. } = &self.map;
        vertices.moved(uvs, &self.map.moved())
    }

    /// Returns the vertices of the UV map for each face: classes of corners that coincide in space, in UV space and in
    /// their chart.
    pub fn faces(&self) -> &[[u32; 3]] {
        self.map.vertices.of_corner.as_chunks().0
    }

    /// Returns the UVs of the vertices. Those of faces without finite UVs are at the origin.
    pub fn vertex_uvs(&self) -> Vec<[f64; 2]> {
        let n_vertices = self.map.vertices.first_corner.len() as u32;
        let start = (0..n_vertices).map(|vertex| self.map.vertices.uv(&self.map.map, vertex));
        let mut uvs: Vec<[f64; 2]> = start.collect();
        for (vertex, uv) in self.map.moved() {
            uvs[vertex as usize] = uv;
        }
        uvs
    }

    /// Returns for each face the sign that its area keeps, whatever is pulled; 0 in charts that no anchor has held.
    pub fn kept_signs(&self) -> Vec<i8> {
        let mut signs = vec![0; self.map.map.faces.len()];
        for (&number, chart) in &self.map.charts {
            for [corner, ..] in chart.chart.faces.corners() {
                let face = corner as usize / 3;
                signs[face] = self.map.positive[number as usize] * self.map.map.winding[face];
            }
        }
        signs
    }

    /// Returns the energy of the charts that anchors hold or held, including barriers and the pull of points; NaN
    /// before the first iteration of a map.
    pub fn energy(&self) -> f64 {
        let charts = self.map.charts.values();
        charts.map(|chart| chart.live.summary().energy_last).sum()
    }

    /// Returns the smallest ratio of a triangle's area to its rest area in those charts.
    pub fn smallest(&self) -> f64 {
        let of_chart = |chart: &LiveChart| {
            let body = &chart.live.problem().body;
            let (now, rest) = (body.determinants_at(chart.live.x()), body.determinants());
            let ratios = now.iter().zip(rest).map(|(now, rest)| now / rest);
            ratios.fold(f64::INFINITY, f64::min)
        };
        self.map
            .charts
            .values()
            .map(of_chart)
            .fold(f64::INFINITY, f64::min)
    }
}

impl Editable for LiveUvs {
    type Handle = Anchor;
    /// Positions of the vertices of each chart that was held.
    type Places = BTreeMap<u32, Vec<f64>>;
    type Error = EditError;

    fn retarget(anchor: &mut Anchor, target: &[f64]) {
        // What is not two numbers is not a target.
        anchor.retarget(<[f64; 2]>::try_from(target).unwrap_or([f64::NAN; 2]));
    }

    fn no_such_handle(HandleId(number): HandleId) -> EditError {
        EditError::UnknownHandle(number as usize)
    }

    fn hold(&mut self, anchors: &BTreeMap<HandleId, Anchor>) -> Result<(), EditError> {
        // Find the vertices that the anchors hold, and build the charts that were never held.
        let mut of_chart: BTreeMap<u32, Vec<Held>> = BTreeMap::new();
        for held in self.held(anchors)? {
            let chart = held.spot.chart(&self.map, &self.vertices);
            of_chart.entry(chart).or_default().push(held);
        }
        for &chart in of_chart.keys() {
            if !self.charts.contains_key(&chart) {
                let live = self.live_chart(chart)?;
                self.charts.insert(chart, live);
            }
        }
        // Bind everything before anything changes.
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
            let problem = chart.live.problem();
            if problem.stations[0] != handles || problem.soft != grips.holds.soft {
                chart.live.aim(handles, grips.holds.soft.clone())?;
            }
            chart.grips = grips;
        }
        Ok(())
    }

    fn remodel(&mut self, model: &Model) -> Result<(), EditError> {
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

    fn step(&mut self) -> Stage {
        for chart in self.charts.values_mut().filter(|chart| chart.is_held) {
            chart.live.step();
        }
        self.stage()
    }

    fn stage(&self) -> Stage {
        let held = || self.charts.values().filter(|chart| chart.is_held);
        let any = |stage| held().any(|chart| chart.live.stage() == stage);
        let unfinished = [Stage::Moving, Stage::Unreachable]
            .into_iter()
            .find(|&s| any(s));
        unfinished.unwrap_or(Stage::Settled)
    }

    fn places(&self) -> BTreeMap<u32, Vec<f64>> {
        self.charts
            .iter()
            .map(|(&number, chart): (&u32, &LiveChart)| (number, chart.live.x().to_vec()))
            .collect()
    }

    fn first_places(&self) -> BTreeMap<u32, Vec<f64>> {
        BTreeMap::new()
    }

    /// Charts that were not held then go back to their start.
    fn put(&mut self, mut places: BTreeMap<u32, Vec<f64>>) -> Result<(), EditError> {
        for (number, chart) in &mut self.charts {
            let places = places
                .remove(number)
                .unwrap_or_else(|| chart.flat.start.as_flattened().to_vec());
            chart.live.put(places)?;
        }
        Ok(())
    }
}

impl LiveUvs {
    fn held(&self, anchors: &BTreeMap<HandleId, Anchor>) -> Result<Vec<Held>, EditError> {
        if anchors.is_empty() {
            return Ok(Vec::new());
        }
        let mesh = UvMesh {
            positions: &self.positions,
            triangles: &self.triangles,
            uvs: &self.uvs,
        };
        let list: Vec<Anchor> = anchors.values().cloned().collect();
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
        let soft = grips.holds.soft.clone();
        let problem = pulled(flat.body.clone(), &flat.start, handles, soft, model)?;
        Ok(LiveChart {
            live: Live::new(problem)?,
            is_held: false,
            chart,
            flat,
            grips,
        })
    }

    /// Rebuilds each chart at its present map under the present model.
    fn rebuilt(&self) -> Result<Vec<Live>, EditError> {
        let rebuilt = self.charts.values().map(|chart| {
            let (body, start) = (chart.flat.body.clone(), &chart.flat.start);
            let Problem { stations, soft, .. } = chart.live.problem();
            let (handles, soft) = (stations[0].clone(), soft.clone());
            let problem = pulled(body, start, handles, soft, &self.options.model)?;
            let mut live = Live::new(problem)?;
            live.put(chart.live.x().to_vec())?;
            live.check_domain()?;
            Ok(live)
        });
        rebuilt.collect()
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
