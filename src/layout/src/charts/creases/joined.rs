//! Charts joined as rigid pieces.

use super::images::images;
use super::joints::joints;
use super::layout::Layout;
use super::mirrored::Joined;
use crate::charts::facets::faces::Faces;
use crate::charts::facets::planar::Facets;
use crate::charts::mapped::{Folds, MappedChart, map_chart};
use crate::charts::observer::Observer;
use crate::charts::opened::glued_charts;
use crate::charts::symmetry::plane::MirrorPlane;
use crate::charts::unfold::overlaps::overlaps;
use rayon::prelude::*;
use std::collections::BTreeMap;
use unwrapd_maps::embed;
use unwrapd_maps::mesh::{CUT, Surface};
use unwrapd_maps::plane::search_budget;
use unwrapd_method::solver::Control;

/// Equal joints among which the one is sought whose pieces were joined most often; of more, the first
/// is taken.
const COMPARED: usize = 64;

/// How charts of a surface are joined.
pub struct Joining<'a> {
    pub surface: &'a Surface,
    pub faces: &'a Faces<'a>,
    pub facets: &'a Facets,
    /// What a seam costs, over its usual price: the higher, the shorter the borders that count.
    pub seam_price: f64,
    pub observer: &'a dyn Observer,
}

impl Joining<'_> {
    /// Charts joined along straight borders where none covers another: a spanning tree of which the
    /// seams that are left cost least, or nearly.
    ///
    /// From: Kruskal 1956. The joint that saves most comes first; once it is refused it stays refused,
    /// since pieces only grow. Both sides of a mirror plane are joined alike; at last what that leaves out,
    /// such as a part of a ring, on one. Maps stay as they are but for their place.
    ///
    /// Ends early when the observer wants the work to end. Returns `None` if the work exceeds its budget, as for a fine fan, in
    /// which every facet meets all others at one vertex.
    pub fn joined(
        &self,
        charts: Vec<MappedChart>,
        mirror: Option<MirrorPlane>,
        options: &embed::Options,
    ) -> Option<Vec<MappedChart>> {
        let charts: BTreeMap<u32, MappedChart> = (0..).zip(charts).collect();
        let (layout, _) = self.laid_out(&charts, mirror.as_ref());
        if layout.work > self.most_work() {
            return None;
        }
        let n_faces = |map: &MappedChart| map.chart.disk.triangles.len();
        self.observer.worked(charts.values().map(n_faces).sum());
        let of = (self.surface, mirror);
        let how = (options, self.observer);
        Some(as_charts(of, &charts, &layout, how))
    }

    /// The work that a layout may take: some seconds.
    fn most_work(&self) -> u64 {
        search_budget(self.surface.triangles.len())
    }

    /// The plane of which both sides can be joined alike at the least cost of the seams that are left;
    /// the first of equals.
    pub fn best_plane(
        &self,
        charts: &[MappedChart],
        planes: &[MirrorPlane],
    ) -> Option<MirrorPlane> {
        if planes.len() < 2 {
            return planes.first().copied();
        }
        let charts: BTreeMap<u32, MappedChart> = (0..).zip(charts.iter().cloned()).collect();
        let saving = |plane: &MirrorPlane| (self.laid_out(&charts, Some(plane)).1, *plane);
        let savings: Vec<(u64, MirrorPlane)> = planes.par_iter().map(saving).collect();
        let best = savings.into_iter().rev().max_by_key(|(saving, _)| *saving);
        best.map(|(_, plane)| plane)
    }

    /// The charts joined, and what the seams would cost that are saved on both sides of the plane alike.
    fn laid_out<'b>(
        &'b self,
        charts: &'b BTreeMap<u32, MappedChart>,
        mirror: Option<&MirrorPlane>,
    ) -> (Layout<'b>, u64) {
        let joints = joints(self.surface, (self.faces, self.facets), charts, mirror);
        let image = mirror.map_or_else(|| vec![None; joints.len()], |of| images(&joints, of));
        let twin = &self.surface.adjacency().twin;
        let mut layout = Layout::new(twin, charts.values().collect(), self.seam_price);
        let (mut saved, mut single) = (0, Vec::new());
        let places: Vec<usize> = (0..joints.len()).collect();
        for equal in places.chunk_by(|&a, &b| joints[a].rank == joints[b].rank) {
            let mut open = equal.to_vec();
            while !open.is_empty()
                && layout.work <= self.most_work()
                && self.observer.control() == Control::Continue
            {
                let compared = open[..open.len().min(COMPARED)].iter().enumerate();
                let most = (compared.rev()).max_by_key(|&(_, &i)| layout.n_joins(&joints[i]));
                let place = open.remove(most.map_or(0, |(i, _)| i));
                let other = image[place];
                let joined = layout.join_alike(&joints[place], other.map(|other| &joints[other]));
                saved += joined.alike() * joints[place].cost;
                if joined == Joined::OneAtMost {
                    single.push(place);
                }
                if let Some(other) = other {
                    open.retain(|&i| i != other);
                }
            }
        }
        for place in single {
            layout.join(&joints[place]);
        }
        (layout, saved)
    }
}

/// The pieces of a layout as charts; one that is not valid is mapped anew.
fn as_charts(
    (surface, mirror): (&Surface, Option<MirrorPlane>),
    charts: &BTreeMap<u32, MappedChart>,
    layout: &Layout,
    (options, observer): (&embed::Options, &dyn Observer),
) -> Vec<MappedChart> {
    let of_surface = &surface.adjacency().twin;
    let mut twin = vec![CUT; of_surface.len()];
    let mut is_ours = vec![false; surface.triangles.len()];
    for MappedChart { chart, .. } in charts.values() {
        let corners = chart.corners.as_flattened();
        for &corner in corners {
            is_ours[corner as usize / 3] = true;
        }
        for (h, t) in (0u32..).zip(chart.disk.twins()).filter(|&(_, t)| t != CUT) {
            let [h, t] = [h, t].map(|h| chart.surface_halfedge(h) as usize);
            twin[h] = t as u32;
        }
    }
    for &h in &layout.joined {
        let t = of_surface[h as usize];
        (twin[h as usize], twin[t as usize]) = (t, h);
    }
    let mut place = vec![[0.0; 2]; of_surface.len()];
    for (corner, at) in layout.corners() {
        place[corner as usize] = at;
    }
    let mapped = glued_charts(surface, &mut twin, mirror, |face| is_ours[face]).into_iter();
    let placed = mapped.map(|chart| {
        let mut uv = vec![[0.0; 2]; chart.disk.n_vertices];
        let corners = chart.corners.as_flattened().iter();
        for (&v, &corner) in chart.disk.triangles.as_flattened().iter().zip(corners) {
            uv[v as usize] = place[corner as usize];
        }
        MappedChart::given(chart, uv)
    });
    let valid = |map: MappedChart| {
        let (disk, uv) = (&map.chart.disk, &map.embedding.uv);
        if embed::is_positive(&disk.triangles, uv) && overlaps(disk, uv).is_empty() {
            vec![map.facing_front()]
        } else {
            map_chart(map.chart, options, Folds::Cut, observer)
        }
    };
    placed.flat_map(valid).collect()
}
