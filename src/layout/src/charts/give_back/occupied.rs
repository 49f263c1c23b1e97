//! The faces of a map, to be asked which of them others would cover.

use crate::charts::MappedChart;
use unwrapd_maps::mesh::CornerUvs;
use unwrapd_maps::plane::{BoxIndex, interiors_intersect, search_budget};
use unwrapd_method::numerics::bounds::bounds_of;

/// The faces of a map.
pub struct Ground {
    corners: Vec<CornerUvs>,
    index: BoxIndex,
}

impl Ground {
    /// Of a map without flips. O(n log n).
    pub fn new(map: &MappedChart) -> Self {
        Self::of(corners(&map.chart.disk.triangles, &map.embedding.uv))
    }

    /// Of faces, each counter-clockwise. O(n log n).
    pub fn of(corners: Vec<CornerUvs>) -> Self {
        let boxes: Vec<_> = corners.iter().map(|c| bounds_of(c)).collect();
        Self {
            index: BoxIndex::new(&boxes),
            corners,
        }
    }

    /// How many faces there are.
    pub fn len(&self) -> usize {
        self.corners.len()
    }

    /// Counts the pairs of a face here and one of these that overlap, decided exactly. Ends after the first face with which they are
    /// more than `most`; where faces lie in heaps, so that the search exceeds its [budget](search_budget), returns more than `most`.
    pub fn n_overlaps(&self, triangles: &[[u32; 3]], uv: &[[f64; 2]], most: usize) -> usize {
        let budget = search_budget(self.len() + triangles.len());
        let (mut n, mut n_compared) = (0, 0);
        for face in corners(triangles, uv) {
            self.index.meeting(&bounds_of(&face), |f| {
                n_compared += 1;
                n += usize::from(interiors_intersect(&face, &self.corners[f as usize]));
            });
            if n > most {
                break;
            }
            if n_compared > budget {
                return most + 1;
            }
        }
        n
    }
}

fn corners(triangles: &[[u32; 3]], uv: &[[f64; 2]]) -> Vec<CornerUvs> {
    let corners = triangles.iter().map(|t| t.map(|v| uv[v as usize]));
    corners.collect()
}
