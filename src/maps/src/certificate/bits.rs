//! Stability of a map under rounding to a number of bits.

use super::NAMED;
use super::boundary::ChartBoundary;
use super::box_tree::Visit;
use super::rounding::{LEVELS, doubtful_faces};
use super::separation::doubtful_pairs;
use super::topology::UvTopology;
use serde::Serialize;

/// Verdict on the bijectivity of a map whose coordinates move by up to 1/(2(2ᵇ−1)) + 2⁻¹⁶ each, decided in integers.
///
/// This covers every quantizer that rounds to i/(2ᵇ−1) and stores 16 bits, over the unit square or a
/// smaller box.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct BitsVerdict {
    /// The requested bits b.
    pub asked: u32,
    /// `true` if it is proven that the map is bijective and that every orientation and separation is kept.
    pub hold: bool,
    /// Faces whose orientation is in doubt.
    pub faces_in_doubt: usize,
    /// Pairs of chart edges that may touch.
    pub pairs_in_doubt: u64,
    /// The first few faces in doubt.
    pub offending_faces: Vec<u32>,
    /// The faces of the first few pairs in doubt.
    pub offending_pairs: Vec<[u32; 2]>,
}

pub(super) fn judge_bits(
    topology: &UvTopology,
    boundary: &ChartBoundary,
    asked: u32,
    is_bijective: bool,
) -> BitsVerdict {
    let faces: Vec<u32> = doubtful_faces(topology, asked).collect();
    let (mut pairs_in_doubt, mut offending_pairs) = (0, Vec::new());
    let visit = doubtful_pairs(boundary, asked, |pair| {
        pairs_in_doubt += 1;
        if offending_pairs.len() < NAMED {
            offending_pairs.push(pair);
        }
    });
    let is_separate = pairs_in_doubt == 0 && visit == Visit::Complete;
    BitsVerdict {
        asked,
        hold: is_bijective && is_separate && faces.is_empty(),
        faces_in_doubt: faces.len(),
        pairs_in_doubt,
        offending_faces: faces.into_iter().take(NAMED).collect(),
        offending_pairs,
    }
}

/// Returns the coarsest of 16, 14 and 12 bits at which a bijective map stays so, given that its orientations are kept
/// at `grid_bits`.
pub(super) fn coarsest_safe_bits(boundary: &ChartBoundary, grid_bits: u32) -> Option<u32> {
    let levels = LEVELS.into_iter().filter(|&bits| bits >= grid_bits);
    levels.into_iter().find(|&bits| {
        let mut is_separate = true;
        let visit = doubtful_pairs(boundary, bits, |_| is_separate = false);
        is_separate && visit == Visit::Complete
    })
}
