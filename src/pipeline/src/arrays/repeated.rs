//! Faces that name a position twice: they cannot have an area in the plane, so they lie on an edge of a neighbor.

use std::collections::HashMap;

use super::position_key::{PositionKey, position_key};

/// The corners of a face on the integer grid of 2⁻ᵏ, v up, with k =
/// [`atlas::GRID_BITS`](unwrapd_layout::atlas::GRID_BITS); on page n, u is from n to n + 1.
pub type GridCorners = [[i32; 2]; 3];

/// Gives every face that is not in `placed` (ascending) corners at which its positions lie in some placed face:
/// on one edge where a placed face has that edge, else all at one corner, else at the origin.
pub fn place(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    placed: &[u32],
    grid: &mut [GridCorners],
) {
    let mut is_placed = vec![false; triangles.len()];
    for &face in placed {
        is_placed[face as usize] = true;
    }
    let keys = |face: usize| triangles[face].map(|v| position_key(positions[v as usize]));
    let left_out: Vec<usize> = (0..triangles.len())
        .filter(|&face| !is_placed[face])
        .collect();
    // Every position a left-out face names, with a placed corner there; every pair of them, with a placed edge.
    let mut corner_at: HashMap<PositionKey, Option<[i32; 2]>> = HashMap::new();
    let mut edge_at: HashMap<[PositionKey; 2], Option<[[i32; 2]; 2]>> = HashMap::new();
    for &face in &left_out {
        let k = keys(face);
        for c in 0..3 {
            corner_at.insert(k[c], None);
            edge_at.insert([k[c], k[(c + 1) % 3]], None);
            edge_at.insert([k[(c + 1) % 3], k[c]], None);
        }
    }
    if left_out.is_empty() {
        return;
    }
    for &face in placed {
        let (k, uv) = (keys(face as usize), grid[face as usize]);
        for c in 0..3 {
            let d = (c + 1) % 3;
            corner_at
                .entry(k[c])
                .and_modify(|at| *at = at.or(Some(uv[c])));
            edge_at
                .entry([k[c], k[d]])
                .and_modify(|at| *at = at.or(Some([uv[c], uv[d]])));
            edge_at
                .entry([k[d], k[c]])
                .and_modify(|at| *at = at.or(Some([uv[d], uv[c]])));
        }
    }
    for face in left_out {
        let k = keys(face);
        let edge = (0..3).find_map(|c| {
            let [a, b] = [k[c], k[(c + 1) % 3]];
            edge_at[&[a, b]].filter(|_| a != b).map(|uv| (a, uv))
        });
        grid[face] = match edge {
            Some((first, uv)) => k.map(|position| uv[usize::from(position != first)]),
            None => {
                [k.iter()
                    .find_map(|position| corner_at[position])
                    .unwrap_or_default(); 3]
            }
        };
    }
}
