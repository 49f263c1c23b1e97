//! Slits alike on both sides of a mirror plane.

use super::cut_mesh::CutMesh;
use crate::charts::{SheetMirror, Way, along, vertices_at};
use unwrapd_maps::cut::{Neighbors, opposite_end};
use unwrapd_method::numerics::vec3::distance;

/// Distance of the tip of a slit from the plane, over the length of the slit, up to which it is moved into the plane: two slits side by
/// side would part a strip. Not tuned.
const BESIDE: f64 = 0.25;
/// Length of a slit in the plane, over that of the slit beside it, up to which it takes its place. Not tuned.
const DETOUR: f64 = 2.0;
/// Distance of the mirror image of a tip from the nearest vertex, in mean lengths of the edges, up to which it is there. Not tuned.
const ASTRAY: f64 = 3.0;

/// Returns a path from the outer boundary, or slits from it, with its mirror image, or a path in the plane if it runs beside that.
///
/// The mirror image is left out where the mesh has no vertex near its tip.
pub fn with_image(
    mesh: &CutMesh,
    neighbors: &Neighbors,
    mirror: &SheetMirror,
    path: Vec<u32>,
    is_outside: impl Fn(u32) -> bool,
) -> Vec<u32> {
    let line = vertices(mesh, &path);
    let Some((&tip, &root)) = line.first().zip(line.last()) else {
        return path;
    };
    let (tip, line) = if is_outside(root) {
        (tip, line)
    } else {
        (root, line.into_iter().rev().collect())
    };
    let sheet = &mesh.sheet;
    let length = |h: u32| sheet.length(h);
    let length_of_path: f64 = path.iter().map(|&h| length(h)).sum();
    let height = |v: u32| mirror.plane.height(sheet.positions[v as usize]).abs();
    // A hole stays a hole, so the other tip is on it as well.
    let is_tip =
        |v: u32| mesh.is_inner[v as usize] == mesh.is_inner[tip as usize] && !is_outside(v);
    let near = BESIDE * length_of_path;
    if height(tip) <= near {
        let is_start = |v: u32| is_tip(v) && mirror.has(sheet, v);
        let to_plane = Way::cheapest(sheet, neighbors, [tip], length, is_start);
        let in_plane = to_plane.filter(|way| way.cost <= near).and_then(|way| {
            let is_goal = |v: u32| is_outside(v) && mirror.has(sheet, v);
            let is_barred = |v: u32| is_outside(v) && !mirror.has(sheet, v);
            let cost = |h: u32| {
                let is_barred = sheet.ends(h).into_iter().any(is_barred);
                if is_barred { f64::INFINITY } else { length(h) }
            };
            let cost = mirror.within(sheet, cost);
            Way::cheapest(sheet, neighbors, [way.end()], cost, is_goal)
        });
        let is_short = |way: &Way| way.length(sheet) <= DETOUR * length_of_path;
        if let Some(way) = in_plane.filter(is_short) {
            return way.edges;
        }
    }
    if mirror.has(sheet, tip) {
        return path;
    }
    let image: Vec<[f64; 3]> = (line.iter().rev())
        .map(|&v| mirror.plane.mirrored(sheet.positions[v as usize]))
        .collect();
    let other = image[image.len() - 1];
    let from = vertices_at(sheet, other, is_tip);
    let is_there = from
        .first()
        .is_some_and(|&v| distance(sheet.positions[v as usize], other) <= ASTRAY * mirror.edge);
    let way = is_there
        .then(|| Way::cheapest(sheet, neighbors, from, along(sheet, &image), &is_outside))
        .flatten();
    match way {
        Some(way) => [path, way.edges].concat(),
        None => path,
    }
}

/// Returns the vertices along a path of halfedges.
fn vertices(mesh: &CutMesh, path: &[u32]) -> Vec<u32> {
    let Some(&first) = path.first() else {
        return Vec::new();
    };
    let [a, b] = mesh.sheet.ends(first);
    let is_next = |v: u32| {
        path.get(1)
            .is_some_and(|&h| mesh.sheet.ends(h).contains(&v))
    };
    let mut line = vec![if is_next(a) { b } else { a }];
    for &h in path {
        line.push(opposite_end(&mesh.sheet, h, line[line.len() - 1]));
    }
    line
}
