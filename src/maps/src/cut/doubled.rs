//! Double edges between one pair of vertices.

use super::sheet::surface_fans;
use crate::mesh::{CUT, Surface, next};

/// Cuts faces out of a glued surface until no two edges join the same two vertices; returns whether any was cut.
///
/// Only a non-manifold input can have such edges: the copies of an edge with several faces may have both ends in
/// common. All copies but one are taken out together with the faces at them. The remainder has the same genus and a
/// longer boundary, so disks fall into disks.
pub fn isolate_doubled_edges(surface: &Surface, twin: &mut [u32]) -> bool {
    if surface.defects.nonmanifold_edges == 0 {
        return false;
    }
    let mut any = false;
    loop {
        let doubled = doubled_edges(surface, twin);
        if doubled.is_empty() {
            return any;
        }
        any = true;
        for h in doubled {
            let t = twin[h as usize];
            cut_face_out(twin, h);
            if t != CUT {
                cut_face_out(twin, t);
                twin[h as usize] = t;
                twin[t as usize] = h;
            }
        }
    }
}

fn cut_face_out(twin: &mut [u32], h: u32) {
    for side in [h, next(h), next(next(h))] {
        let t = std::mem::replace(&mut twin[side as usize], CUT);
        if t != CUT {
            twin[t as usize] = CUT;
        }
    }
}

/// Returns one halfedge of each edge that has an earlier copy between the same two vertices.
fn doubled_edges(surface: &Surface, twin: &[u32]) -> Vec<u32> {
    let (vertex, _) = surface_fans(surface, twin);
    let mut edges: Vec<(u32, u32, u32)> = (0u32..)
        .zip(twin)
        .filter(|&(h, &t)| t == CUT || h < t)
        .map(|(h, _)| {
            let (a, b) = (vertex[h as usize], vertex[next(h) as usize]);
            (a.min(b), a.max(b), h)
        })
        .collect();
    edges.sort_unstable();
    edges
        .windows(2)
        .filter(|w| (w[0].0, w[0].1) == (w[1].0, w[1].1))
        .map(|w| w[1].2)
        .collect()
}
