//! Alignment of charts with texel borders.

use super::topology::UvTopology;
use crate::mesh::Resolution;

/// Counts the charts whose bounding rectangle does not lie on texel borders of a texture of `resolution`, exactly: f32
/// times an integer below 2²⁸ is exact in f64.
pub(super) fn unaligned_charts(topology: &UvTopology, resolution: Resolution) -> usize {
    let texels = [resolution.width, resolution.height].map(f64::from);
    let is_border = |uv: &[f64; 2]| (0..2).all(|axis| (uv[axis] * texels[axis]).fract() == 0.0);
    chart_bounds(topology)
        .filter(|bounds| !bounds.iter().all(is_border))
        .count()
}

/// Iterates over the smallest and greatest coordinates of every chart that has faces to judge.
pub(super) fn chart_bounds(topology: &UvTopology) -> impl Iterator<Item = [[f64; 2]; 2]> {
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
