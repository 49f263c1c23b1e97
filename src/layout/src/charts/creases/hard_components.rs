//! Which components of a surface are hard, and their charts.

use super::flat::seen_straight_on;
use super::joined::Joining;
use crate::charts::bound::pending_chart::Piece;
use crate::charts::bound::quality::{Bound, Bounded};
use crate::charts::bound::rounds::rounds;
use crate::charts::chart::Chart;
use crate::charts::facets::faces::Faces;
use crate::charts::facets::patches::Patches;
use crate::charts::facets::planar::Facets;
use crate::charts::give_back::given_back::some_given_back;
use crate::charts::mapped::{Folds, MappedChart, map_chart};
use crate::charts::observer::Observer;
use crate::charts::opened::charts_of_regions;
use crate::charts::symmetry::plane::MirrorPlane;
use rayon::prelude::*;
use unwrapd_maps::cut::surface_fans;
use unwrapd_maps::embed;
use unwrapd_maps::mesh::Surface;

/// The shares of a component's area that must be in facets, not in curved patches, and in facets of
/// polygons with more than three corners: a coarse model of an animal consists of triangles, each a
/// plane of its own. One of few parts may consist of triangles, as a pyramid does.
const HARD_SHARES: [f64; 2] = [0.6, 0.6];

/// Facets and patches up to which a component may consist of triangles.
const FEW_PARTS: usize = 24;

/// Facets and patches at most: a sponge of a thousand walls is no machine part.
const MOST_PARTS: usize = 4_000;

/// Curved patches of less area than this share of the surface, such as a rounded corner, are laid on their
/// neighbors, which may be bent so much for it.
const SMALL: f64 = 0.01;
const GIVEN_BACK: Bound = Bound {
    mean: 4.01,
    stretch: None,
    of: Bounded::Surface,
};

/// A surface with its hard components known.
pub struct Divided<'a> {
    surface: &'a Surface,
    faces: Faces<'a>,
    facets: Facets,
    patches: Patches,
    /// For each face whether its component is hard.
    pub is_hard: Vec<bool>,
}

impl<'a> Divided<'a> {
    /// Of a surface. O(n log n).
    pub fn new(surface: &'a Surface) -> Self {
        let faces = Faces::of_surface(surface);
        let facets = Facets::new(&faces);
        let (vertex, n_vertices) = surface_fans(surface, &faces.across);
        let patches = Patches::new(&faces, &facets, &vertex, n_vertices);
        let hard = are_hard(surface, &faces, &facets, &patches);
        let component = &surface.adjacency().component;
        Self {
            is_hard: component.iter().map(|&c| hard[c as usize]).collect(),
            surface,
            faces,
            facets,
            patches,
        }
    }

    /// The charts of the hard components, mapped and laid side by side, alike on both sides of one of
    /// some planes; `None` if they have too many facets for that.
    pub fn mapped(
        &self,
        bound: &Bound,
        seam_price: f64,
        planes: &[MirrorPlane],
        options: &embed::Options,
        observer: &dyn Observer,
    ) -> Option<Vec<MappedChart>> {
        let joining = Joining {
            surface: self.surface,
            faces: &self.faces,
            facets: &self.facets,
            seam_price,
            observer,
        };
        let charts = self.charts(None).into_par_iter().with_max_len(1);
        let flat = charts.filter(|chart| !self.is_curved(chart));
        let mut flat: Vec<MappedChart> = (flat)
            .flat_map_iter(|chart| self.laid_flat(chart, options, observer))
            .collect();
        let mirror = joining.best_plane(&flat, planes);
        let curved = self.charts(mirror).into_par_iter().with_max_len(1);
        let curved = curved.filter(|chart| self.is_curved(chart));
        flat.par_extend(curved.flat_map_iter(|chart| {
            let pieces = vec![Piece::unmapped(chart)];
            let pieces = rounds(pieces, bound, options, observer);
            pieces.into_iter().filter_map(|piece| piece.map)
        }));
        let charts = joining.joined(flat, mirror, options)?;
        let least = SMALL * self.faces.areas.iter().sum::<f64>();
        let is_given = |map: &MappedChart| map.surface_area() < least && self.is_curved(&map.chart);
        Some(some_given_back(
            self.surface,
            charts,
            &is_given,
            &GIVEN_BACK,
            options,
            observer,
        ))
    }

    /// The facets and patches of the hard components, opened to disks.
    fn charts(&self, mirror: Option<MirrorPlane>) -> Vec<Chart> {
        let Patches { of_face, is_curved } = &self.patches;
        let charts = charts_of_regions(self.surface, of_face, is_curved.len(), mirror);
        let is_hard = |chart: &Chart| self.is_hard[first_face(chart)];
        charts.into_iter().filter(is_hard).collect()
    }

    /// Whether a chart begins in a curved patch.
    fn is_curved(&self, chart: &Chart) -> bool {
        self.patches.is_curved[self.patches.of_face[first_face(chart)] as usize]
    }

    /// A facet as it lies in its plane; mapped like any chart if that is no map of it.
    fn laid_flat(
        &self,
        chart: Chart,
        options: &embed::Options,
        observer: &dyn Observer,
    ) -> Vec<MappedChart> {
        let facet = self.facets.of_face[first_face(&chart)] as usize;
        match seen_straight_on(&chart, self.facets.normals[facet]) {
            Some(uv) => vec![MappedChart::given(chart, uv)],
            None => map_chart(chart, options, Folds::Cut, observer),
        }
    }
}

fn first_face(chart: &Chart) -> usize {
    chart.corners[0][0] as usize / 3
}

/// For each component of a surface whether it is hard.
fn are_hard(surface: &Surface, faces: &Faces, facets: &Facets, patches: &Patches) -> Vec<bool> {
    let component = &surface.adjacency().component;
    let mut areas = vec![[0.0; 3]; surface.adjacency().n_components];
    let mut parts = vec![Vec::new(); areas.len()];
    for (face, &area) in faces.areas.iter().enumerate() {
        let (facet, patch) = (
            facets.of_face[face] as usize,
            patches.of_face[face] as usize,
        );
        let [all, planar, of_polygons] = &mut areas[component[face] as usize];
        *all += area;
        *planar += if patches.is_curved[patch] { 0.0 } else { area };
        *of_polygons += if facets.n_faces[facet] > 1 { area } else { 0.0 };
        parts[component[face] as usize].push(patch);
    }
    for parts in &mut parts {
        parts.sort_unstable();
        parts.dedup();
    }
    let [planar, of_polygons] = HARD_SHARES;
    (areas.iter().zip(parts))
        .map(|(of, parts)| {
            let is_of_polygons = of[2] >= of_polygons * of[0] || parts.len() <= FEW_PARTS;
            of[1] >= planar * of[0] && is_of_polygons && parts.len() <= MOST_PARTS
        })
        .collect()
}
