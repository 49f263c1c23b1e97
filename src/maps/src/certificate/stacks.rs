//! Charts that cover the same points of the plane.
//!
//! Stacked charts share their texels on purpose: copies of a screw, or both halves of a face. They overlap, so whether a
//! caller accepts them is a claim of its own ([`Stacks`](super::Stacks)), and only charts that coincide are accepted.
//!
//! **Coincidence.** The faces of a chart are taken counter-clockwise, and edges that run both ways cancel. What is left
//! is the chart's outline, a set of directed edges. How often a point is covered is the sum of its winding numbers in
//! all faces, which is its winding number in the outline. So charts with equal outlines cover every point equally
//! often: those that overlap one of them overlap all, and if one covers no point twice, none does. Nothing else is
//! assumed of the charts, and ends of edges are equal if their numbers are.

use super::overlap::OrientedFaces;
use super::topology::UvTopology;
use crate::mesh::CornerUvs;
use std::collections::HashMap;
use unwrapd_method::numerics::predicates::orient2d_sign;

/// Directed edge by the bits of its ends.
pub type EdgeKey = [u64; 4];

/// Charts that coincide.
pub(super) struct StackedCharts {
    /// For each chart the first that coincides with it, which is itself unless it is stacked on an earlier one.
    pub first: Vec<u32>,
}

impl StackedCharts {
    /// Takes no charts to coincide.
    pub fn none(topology: &UvTopology) -> Self {
        let n_charts = topology.charts.nonorientable.len() as u32;
        Self {
            first: (0..n_charts).collect(),
        }
    }

    /// Finds the charts that coincide. Charts without an outline do not.
    pub fn find(topology: &UvTopology) -> Self {
        let mut found = Self::none(topology);
        let mut first_with: HashMap<Vec<EdgeKey>, u32> = HashMap::new();
        for (chart, outline) in (0..).zip(outlines(topology)) {
            if !outline.is_empty() {
                let first = first_with.entry(outline).or_insert(chart);
                found.first[chart as usize] = *first;
            }
        }
        found
    }

    /// Returns whether a face is in the first chart of its stack, or in a chart that is not stacked.
    pub fn is_first(&self, topology: &UvTopology, face: u32) -> bool {
        let chart = topology.charts.of_face[face as usize];
        self.first[chart as usize] == chart
    }

    /// Returns the charts of each stack.
    pub fn stacks(&self) -> Vec<Vec<u32>> {
        let mut members: Vec<Vec<u32>> = vec![Vec::new(); self.first.len()];
        for (chart, &first) in (0..).zip(&self.first) {
            members[first as usize].push(chart);
        }
        members.retain(|members| members.len() > 1);
        members
    }
}

/// Returns the outline of some faces, in a fixed order: the directed edges around what they cover, by the bits of their ends. Faces
/// without area do not count. Charts coincide if their outlines are equal.
pub fn outline(faces: &[CornerUvs]) -> Vec<EdgeKey> {
    let sign = |&[a, b, c]: &CornerUvs| orient2d_sign(a, b, c);
    let orientation: Vec<i8> = faces.iter().map(sign).collect();
    OrientedFaces::of(faces, &orientation).outline()
}

/// Returns the outline of each chart, in a fixed order.
fn outlines(topology: &UvTopology) -> Vec<Vec<EdgeKey>> {
    let n_charts = topology.charts.nonorientable.len();
    let mut faces = vec![Vec::new(); n_charts];
    for (face, &chart) in topology.charts.of_face.iter().enumerate() {
        faces[chart as usize].push(face as u32);
    }
    let outline = |faces: Vec<u32>| OrientedFaces::among(topology, faces).outline();
    faces.into_iter().map(outline).collect()
}
