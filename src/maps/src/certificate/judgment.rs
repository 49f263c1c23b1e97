//! The certificate and the rules by which it is given.

use super::NAMED;
use super::boundary::ChartBoundary;
use super::box_tree::BoxVisit;
use super::claims::{Claims, Overlap, Stacks};
use super::islands::{Islands, judge_islands};
use super::overlap::OrientedFaces;
use super::padding::{PaddingVerdict, judge_padding};
use super::rounding::{BitsVerdict, coarsest_bits, coarsest_safe_bits, judge_bits};
use super::stacks::StackedCharts;
use super::topology::UvTopology;
use crate::mesh::{CornerUvs, Resolution};
use serde::Serialize;
use std::collections::HashSet;

/// Certificate of the UVs of a mesh: facts proven by exact predicates on the numbers of the file.
#[derive(Clone, PartialEq, Debug, Default, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct Certificate {
    /// Number of faces judged, including all those below.
    pub faces: usize,
    /// Faces that name a position twice. They need no UV area, but must not be flipped.
    pub exempt_faces: usize,
    /// Faces that cannot be judged: a UV or a position is not finite or missing.
    pub nonfinite_faces: usize,
    /// Charts found from the UVs, except those of exempt faces only.
    pub charts: usize,
    /// Charts that are not orientable, such as an uncut Möbius strip; no map of them is injective.
    pub nonorientable_charts: usize,
    /// Mirrored charts: most of their UV area is clockwise with v up, as the file winds it. They may be valid.
    pub mirrored_charts: usize,
    /// Those of them that lie in accepted stacks.
    pub mirrored_in_stacks: usize,
    /// Faces oriented against the rest of their chart.
    pub flipped: usize,
    /// Faces of exactly zero UV area, except exempt ones.
    pub degenerate: usize,
    /// Pairs of faces whose interiors intersect; null when not tested. Of accepted stacks, one chart each is tested.
    pub overlapping_pairs: Option<u64>,
    /// Those of them that lie in one chart.
    pub overlapping_pairs_same_chart: Option<u64>,
    /// Those of them that lie in two charts.
    pub overlapping_pairs_between_charts: Option<u64>,
    /// `true` if the search for pairs stopped at its limit, so that there may be more.
    pub overlap_truncated: bool,
    /// Charts of each stack that was accepted: they coincide, and one of them is tested against the others. Null when
    /// stacks are not accepted, or overlaps were not tested.
    pub stacks: Option<Vec<Vec<u32>>>,
    /// The coarsest of 23, 16, 14 and 12 bits at which every orientation is kept; null when the map is not locally injective, or
    /// only its full precision is. 23: UVs rounded to multiples of 2⁻²³ (the grid written here) keep it. 16, 14, 12: it
    /// survives any move of each coordinate by 1/(2(2ᵇ−1)) + 2⁻¹⁶. Overlaps after rounding are not included.
    pub grid_bits: Option<u32>,
    /// The coarsest of 16, 14 and 12 bits b at which the map provably stays bijective: each coordinate may
    /// move by up to 1/(2(2ᵇ−1)) + 2⁻¹⁶. Null if there is none, or overlaps were not tested.
    pub safe_bits: Option<u32>,
    /// Verdict on the requested distance between charts; null if not requested or overlaps were not tested.
    pub padding: Option<PaddingVerdict>,
    /// Charts whose bounding rectangle does not end on texel borders; null if not requested.
    pub unaligned_charts: Option<usize>,
    /// Verdict on the requested pages; null if not requested.
    pub pages: Option<PagesVerdict>,
    /// Verdict on the requested bits; null if not requested or overlaps were not tested.
    pub bits: Option<BitsVerdict>,
    /// Charts by their faults.
    pub islands: Islands,
    /// The first few mirrored charts; charts are numbered in the order of their first faces.
    pub mirrored: Vec<u32>,
    /// The first few faces that are flipped, degenerate or cannot be judged.
    pub offending_faces: Vec<u32>,
    /// The first few pairs found to overlap.
    pub offending_pairs: Vec<[u32; 2]>,
}

impl Certificate {
    /// Returns whether the map is proven locally injective: every non-exempt face has positive area relative to its
    /// chart.
    pub fn is_valid(&self) -> bool {
        self.flipped == 0
            && self.degenerate == 0
            && self.nonfinite_faces == 0
            && self.nonorientable_charts == 0
    }

    /// Returns whether the map is proven bijective: locally injective, and no two faces overlap.
    pub fn is_bijective(&self) -> bool {
        self.is_bijective_but_for_stacks() && self.stacks.as_ref().is_none_or(Vec::is_empty)
    }

    /// Returns whether the map is proven locally injective, and two faces overlap only if their charts coincide and that
    /// was accepted.
    pub fn is_bijective_but_for_stacks(&self) -> bool {
        self.is_valid() && self.overlapping_pairs == Some(0) && !self.overlap_truncated
    }
}

/// Judges the UVs of every face's corners.
///
/// `uvs[f][c]` belongs to `positions[triangles[f][c]]` and is the number in the file, converted to f64 without rounding
/// (f32 or normalized integers). Faces are judged relative to their chart (see the [module](super)), so their
/// orientation does not depend on the direction of v. Costs a sort of the vertices and, with [`Overlap::Test`],
/// searches over trees of boxes.
pub fn certify(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    uvs: &[CornerUvs],
    claims: &Claims,
) -> Certificate {
    let topology = UvTopology::new(positions, triangles, uvs);
    let mut certificate = judge_faces(&topology);
    let mirrored = topology.mirrored_charts(claims.v_axis);
    certificate.mirrored_charts = mirrored.len();
    certificate.unaligned_charts =
        (claims.aligned).map(|texels| unaligned_charts(&topology, texels));
    certificate.pages = claims.pages.map(|pages| judge_pages(&topology, pages));
    let mut stacked = StackedCharts::none(&topology);
    let mut overlapping = HashSet::new();
    if claims.overlap == Overlap::Test {
        if claims.stacks == Stacks::Accepted {
            stacked = StackedCharts::find(&topology);
        }
        if claims.stacks == Stacks::Accepted {
            let stacks = stacked.stacks();
            let charts: HashSet<u32> = stacks.iter().flatten().copied().collect();
            let inside = mirrored.iter().filter(|&chart| charts.contains(chart));
            certificate.mirrored_in_stacks = inside.count();
            certificate.stacks = Some(stacks);
        }
        overlapping = judge_pairs(&topology, &stacked, &mut certificate);
        judge_distances(&topology, &stacked, claims, &mut certificate);
    }
    certificate.islands = judge_islands(&topology, &stacked, &overlapping);
    certificate.mirrored = mirrored.into_iter().take(NAMED).collect();
    certificate
}

fn judge_faces(topology: &UvTopology) -> Certificate {
    let n_faces = topology.faces.len();
    let n_charts = topology.charts.nonorientable.len();
    let is_exempt = |f: usize| topology.repeats_position(f);
    let is_judged = |f: usize| topology.is_judged(f);
    let positive = topology.chart_orientations(is_judged);
    // Charts that have faces to judge.
    let mut has_judged = vec![false; n_charts];
    for face in (0..n_faces).filter(|&f| is_judged(f)) {
        has_judged[topology.charts.of_face[face] as usize] = true;
    }
    let mut certificate = Certificate {
        faces: n_faces,
        exempt_faces: (0..n_faces).filter(|&f| is_exempt(f)).count(),
        ..Certificate::default()
    };
    for face in 0..n_faces {
        let chart = topology.charts.of_face[face] as usize;
        let sign = topology.orientation_in_chart(face);
        // Each face has at most one fault, the first of these.
        let offence = if topology.unusable[face] {
            &mut certificate.nonfinite_faces
        } else if sign == 0 && !is_exempt(face) {
            &mut certificate.degenerate
        } else if sign != 0 && sign != positive[chart] && has_judged[chart] {
            &mut certificate.flipped
        } else {
            continue;
        };
        *offence += 1;
        if certificate.offending_faces.len() < NAMED {
            certificate.offending_faces.push(face as u32);
        }
    }
    // Counts of charts, and the rounding that every orientation survives.
    let charts = || (0..n_charts).filter(|&chart| has_judged[chart]);
    certificate.charts = charts().count();
    certificate.nonorientable_charts = charts()
        .filter(|&chart| topology.charts.nonorientable[chart])
        .count();
    if certificate.is_valid() {
        certificate.grid_bits = coarsest_bits(topology);
    }
    certificate
}

/// Returns the charts that overlap themselves or others, one of each stack.
fn judge_pairs(
    topology: &UvTopology,
    stacked: &StackedCharts,
    certificate: &mut Certificate,
) -> HashSet<u32> {
    let (mut same, mut between) = (0, 0);
    let mut charts = HashSet::new();
    let faces = 0..topology.faces.len() as u32;
    let firsts = faces.filter(|&face| stacked.is_first(topology, face));
    let visit = OrientedFaces::among(topology, firsts).overlaps(|pair| {
        let [a, b] = pair.faces.map(|f| topology.charts.of_face[f as usize]);
        *if a == b { &mut same } else { &mut between } += 1;
        charts.extend([a, b]);
        if certificate.offending_pairs.len() < NAMED {
            certificate.offending_pairs.push(pair.faces);
        }
    });
    certificate.overlapping_pairs = Some(same + between);
    certificate.overlapping_pairs_same_chart = Some(same);
    certificate.overlapping_pairs_between_charts = Some(between);
    certificate.overlap_truncated = visit == BoxVisit::Truncated;
    charts
}

/// Judges boundary edges of charts against each other.
fn judge_distances(
    topology: &UvTopology,
    stacked: &StackedCharts,
    claims: &Claims,
    certificate: &mut Certificate,
) {
    let boundary = ChartBoundary::new(topology, |face| {
        topology.is_judged(face as usize) && stacked.is_first(topology, face)
    });
    if certificate.is_bijective()
        && let Some(grid_bits) = certificate.grid_bits
    {
        certificate.safe_bits = coarsest_safe_bits(&boundary, grid_bits);
    }
    let are_disjoint = certificate.overlapping_pairs_between_charts == Some(0);
    certificate.padding = claims.padding.map(|padding| {
        let mut verdict = judge_padding(&boundary, padding);
        verdict.kept &= are_disjoint && !certificate.overlap_truncated;
        verdict
    });
    let is_bijective = certificate.is_bijective();
    certificate.bits =
        (claims.bits).map(|bits| judge_bits(topology, &boundary, bits, is_bijective));
}

// Alignment of charts with texel borders.

/// Counts the charts whose bounding rectangle does not lie on texel borders of a texture of `resolution`, exactly: f32
/// times an integer below 2²⁸ is exact in f64.
fn unaligned_charts(topology: &UvTopology, resolution: Resolution) -> usize {
    let texels = [resolution.width, resolution.height].map(f64::from);
    chart_bounds(topology)
        .filter(|bounds| {
            !bounds
                .iter()
                .all(|uv: &[f64; 2]| (0..2).all(|axis| (uv[axis] * texels[axis]).fract() == 0.0))
        })
        .count()
}

/// Iterates over the smallest and greatest coordinates of every chart that has faces to judge.
fn chart_bounds(topology: &UvTopology) -> impl Iterator<Item = [[f64; 2]; 2]> {
    let n_charts = topology.charts.nonorientable.len();
    let mut bounds: Vec<Option<[[f64; 2]; 2]>> = vec![None; n_charts];
    for (face, corners) in topology.uvs.iter().enumerate() {
        if !topology.is_judged(face) {
            continue;
        }
        let bounds = &mut bounds[topology.charts.of_face[face] as usize];
        for uv in corners {
            let [low, high] = bounds.get_or_insert([*uv, *uv]);
            for axis in 0..2 {
                low[axis] = low[axis].min(uv[axis]);
                high[axis] = high[axis].max(uv[axis]);
            }
        }
    }
    bounds.into_iter().flatten()
}

// Placement of each chart on one page.

/// Verdict on the placement of every chart on one of the pages, decided exactly. Page k covers u from k to k + 1 and
/// v from 0 to 1, borders included.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct PagesVerdict {
    /// The requested number of pages.
    pub asked: u32,
    /// `true` if every chart lies on one of them.
    pub kept: bool,
    /// Pages that hold a chart.
    pub used: usize,
    /// Charts that cross a page border or lie outside all pages.
    pub charts_across: usize,
}

fn judge_pages(topology: &UvTopology, asked: u32) -> PagesVerdict {
    let mut is_used = vec![false; asked as usize];
    let mut charts_across = 0;
    for [low, high] in chart_bounds(topology) {
        // The left border of the page in question; a chart without width on a border lies on the page to its right.
        let page = low[0].floor();
        let is_across = high[0] > page + 1.0 || low[1] < 0.0 || high[1] > 1.0;
        match is_used.get_mut(page as usize) {
            Some(used) if page >= 0.0 && !is_across => *used = true,
            _ => charts_across += 1,
        }
    }
    PagesVerdict {
        asked,
        kept: charts_across == 0,
        used: is_used.iter().filter(|used| **used).count(),
        charts_across,
    }
}
