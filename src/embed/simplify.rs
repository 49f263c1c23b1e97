//! A disk with fewer vertices.

use super::closed::ClosedDisk;
use super::decimate::{Care, Decimation};
use crate::mesh::{Disk, UsedVertices};

/// A disk of about so many of a disk's vertices, or more where its shape would suffer, with as many holes; and for each of its vertices
/// the one of the disk. None if nothing simpler is a disk.
pub fn simplified(
    disk: &Disk,
    positions: &[[f64; 3]],
    n_vertices: usize,
) -> Option<(Disk, Vec<u32>)> {
    let closed = ClosedDisk::new(disk, positions);
    let mut decimation = Decimation::new(&closed.positions, &closed.triangles, closed.n_real);
    decimation.coarsen(n_vertices, Care::Shape);
    let is_real = |&(t, _): &(usize, [u32; 3])| t < closed.n_real;
    let triangles = decimation.triangulation.triangles().filter(is_real);
    let mut triangles: Vec<[u32; 3]> = triangles.map(|(_, triangle)| triangle).collect();
    let vertices = UsedVertices::new(triangles.iter().flatten().copied());
    vertices.renumber(triangles.as_flattened_mut());
    let disk = Disk::new(vertices.count(), triangles).ok()?;
    Some((disk, vertices.into_vec()))
}
