//! Which components of a surface are hard, and their charts.

use super::joined::joined;
use super::smooth_regions::Creases;
use crate::charts::bound::pending_chart::Piece;
use crate::charts::bound::quality::Bound;
use crate::charts::bound::rounds::rounds;
use crate::charts::chart::charts_of_regions;
use crate::charts::mapped::MappedChart;
use crate::charts::observer::Observer;
use crate::cut::Branches;
use crate::embed;
use crate::mesh::Surface;
use crate::numerics::vec3::{area_vector, norm};
use rayon::prelude::*;

/// A region is developable if the predicted excess of its map, per area, is no more than this.
const DEVELOPABLE: f64 = 5e-3;

/// The shares of a component's area that must be developable, and that must lie in polygons of more
/// than three corners: a coarse model of an animal consists of triangles, each a plane of its own.
const HARD_SHARES: [f64; 2] = [0.8, 0.6];

/// Regions at most: a sponge of a thousand walls is no machine part.
const MOST_REGIONS: usize = 2_000;

/// What developable charts may cost.
const WITHOUT_DISTORTION: Bound = Bound {
    mean: 4.0002,
    stretch: None,
};

/// A surface with its hard components divided at their creases.
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
    let creases = Creases::new(surface);
    let (region, n_regions) = creases.smooth_regions();
    if n_regions > MOST_REGIONS {
        return none;
    }
    let charts = charts_of_regions(surface, &region, n_regions, Branches::None);
    let pieces: Vec<Piece> = charts.into_par_iter().map(Piece::unmapped).collect();
    let component = &surface.adjacency().component;
    let hard = are_hard(surface, &pieces, &creases.in_planes());
    let is_hard: Vec<bool> = component.iter().map(|&c| hard[c as usize]).collect();
    Divided {
        hard: (pieces.into_iter())
            .filter(|piece| is_hard[piece.first_face() as usize])
            .collect(),
        is_hard,
    }
}

/// For each component of a surface whether it is hard.
fn are_hard(surface: &Surface, pieces: &[Piece], is_in_plane: &[bool]) -> Vec<bool> {
    let component = &surface.adjacency().component;
    let mut areas = vec![[0.0; 3]; surface.adjacency().n_components];
    for (face, &of_polygon) in is_in_plane.iter().enumerate() {
        let [a, b, c] = surface.corners(face);
        let area = norm(area_vector(a, b, c)) / 2.0;
        let of = &mut areas[component[face] as usize];
        of[0] += area;
        of[2] += if of_polygon { area } else { 0.0 };
    }
    for piece in pieces.iter().filter(|piece| is_developable(piece)) {
        areas[component[piece.first_face() as usize] as usize][1] += piece.area;
    }
    let [developable, of_polygons] = HARD_SHARES;
    (areas.iter())
        .map(|of| of[1] >= developable * of[0] && of[2] >= of_polygons * of[0])
        .collect()
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
        joined(surface, charts.flat_map_iter(mapped).collect(), observer)
    }
}
