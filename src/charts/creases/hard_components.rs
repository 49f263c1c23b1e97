//! Which components of a surface are hard, and their charts.

use super::joined::joined;
use super::smooth_regions::smooth_regions;
use crate::charts::bound::pending_chart::Piece;
use crate::charts::bound::quality::Bound;
use crate::charts::bound::rounds::rounds;
use crate::charts::chart::charts_of_regions;
use crate::charts::mapped::{MappedChart, Observer};
use crate::cut::Branches;
use crate::embed;
use crate::mesh::Surface;
use rayon::prelude::*;

/// A region is developable if the predicted excess of its map over the area is no more than this;
/// a sheet with dents of a degree has 1e-4.
const DEVELOPABLE: f64 = 5e-3;

/// The share of a component's area that must be developable.
const HARD_SHARE: f64 = 0.8;

/// Regions at most, and faces at least for each of them on average: a sponge of a thousand walls is
/// no machine part.
const MOST_REGIONS: usize = 2_000;

/// What developable charts may cost.
const WITHOUT_DISTORTION: Bound = Bound {
    mean: 4.0002,
    stretch: None,
};

/// Some charts of a surface, opened along creases, and the label of its other faces.
pub struct Divided {
    /// The charts of hard components.
    pub hard: Vec<Piece>,
    /// For each face whether its component is hard.
    pub is_hard: Vec<bool>,
}

/// The charts of the hard components of a surface before they are mapped.
pub fn hard_components(surface: &Surface) -> Divided {
    let none = Divided {
        hard: Vec::new(),
        is_hard: vec![false; surface.triangles.len()],
    };
    let (region, n_regions) = smooth_regions(surface);
    if n_regions > MOST_REGIONS {
        return none;
    }
    let charts = charts_of_regions(surface, &region, n_regions, Branches::None);
    let pieces: Vec<Piece> = charts.into_par_iter().map(Piece::unmapped).collect();
    let component = &surface.adjacency().component;
    let n_components = surface.adjacency().n_components;
    let mut areas = vec![[0.0; 2]; n_components];
    for piece in &pieces {
        let of = &mut areas[component[piece.first_face() as usize] as usize];
        of[0] += piece.area;
        of[1] += if is_developable(piece) {
            piece.area
        } else {
            0.0
        };
    }
    let hard: Vec<bool> = areas
        .iter()
        .map(|[all, developable]| *developable >= HARD_SHARE * all)
        .collect();
    let is_hard: Vec<bool> = component.iter().map(|&c| hard[c as usize]).collect();
    Divided {
        hard: (pieces.into_iter())
            .filter(|piece| is_hard[piece.first_face() as usize])
            .collect(),
        is_hard,
    }
}

fn is_developable(piece: &Piece) -> bool {
    piece.predicted_excess() <= DEVELOPABLE * piece.area
}

impl Divided {
    /// The charts of the hard components, mapped and laid side by side.
    pub fn mapped(
        self,
        surface: &Surface,
        bound: &Bound,
        options: &embed::Options,
        observer: &dyn Observer,
    ) -> Vec<MappedChart> {
        let mapped = |piece: Piece| {
            let bound = if is_developable(&piece) {
                &WITHOUT_DISTORTION
            } else {
                bound
            };
            let pieces = rounds(vec![piece], bound, options, observer, |_| ());
            pieces.into_iter().filter_map(|piece| piece.map)
        };
        let charts = self.hard.into_par_iter().with_max_len(1);
        joined(surface, charts.flat_map_iter(mapped).collect())
    }
}
