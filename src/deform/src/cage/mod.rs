//! Cages: tetrahedra around surfaces, which are deformed in their stead and carry them along.
//!
//! A grid of voxels is laid around the surfaces. Voxels that a surface touches, or that cannot be reached from outside,
//! are cut into six tetrahedra each, the same way everywhere, so that neighbors match. A deformed cage maps every point
//! inside piecewise linearly: [`Embedding`] carries vertices, normals and tangents; [`Cage::split`] cuts the triangles
//! at the creases of the map, so that the surface follows it exactly. A cage without inverted tetrahedra then never
//! folds the surface locally; it may pass through itself.
//!
//! A fine cage starts where a coarse one ends ([`Caged::start`]).
//!
//! Parts of a surface that are nearer to each other than a voxel share voxels and move together. A surface with holes
//! larger than a voxel has no inside; its cage is a layer around it.
mod embedding;
mod grid;
mod split;

pub use embedding::{Caged, Embedding};
pub use grid::CageError;
use grid::{Grid, ORDERS, Voxels, path_slots};
pub use split::{Added, SplitSurface};
use unwrapd_maps::mesh::{TetMesh, validate};
use unwrapd_method::numerics::bounds::bounds_of;

/// Most voxels that become tetrahedra: six million of these.
const MOST_VOXELS: usize = 1_000_000;
/// Number of a voxel or corner that is not part of the cage.
const ABSENT: u32 = u32::MAX;

/// Triangles over positions.
#[derive(Clone, Copy, Debug)]
pub struct CagedSurface<'a> {
    /// Vertex positions.
    pub positions: &'a [[f64; 3]],
    /// Three vertices per triangle.
    pub triangles: &'a [[u32; 3]],
}

/// Tetrahedra around surfaces.
#[derive(Clone, Debug)]
pub struct Cage {
    mesh: TetMesh,
    grid: Grid,
    /// For each voxel of the grid its index among those of the cage, or [`ABSENT`]; voxel v has the elements 6v to 6v +
    /// 5.
    voxel_of_cell: Vec<u32>,
}

impl Cage {
    /// Builds a cage of cubes, `n_voxels` along the longest side of the surfaces' common bounding box. Vertices that no
    /// triangle uses are ignored.
    ///
    /// Deterministic; costs time and memory in proportion to the grid's voxels (2²⁴ at most) and to the voxels that
    /// each triangle touches.
    pub fn around(surfaces: &[CagedSurface], n_voxels: u32) -> Result<Self, CageError> {
        for (surface, s) in surfaces.iter().enumerate() {
            validate(s.positions, s.triangles, "triangles")
                .map_err(|error| CageError::Surface { surface, error })?;
        }
        let used = surfaces.iter().flat_map(|s| {
            let vertices = s.triangles.as_flattened().iter();
            vertices.map(|&v| s.positions[v as usize])
        });
        let grid = Grid::around(&bounds_of(&used.collect::<Vec<_>>()), n_voxels)?;
        let mut voxels = Voxels::new(&grid);
        for surface in surfaces {
            for triangle in surface.triangles {
                voxels.touch(triangle.map(|v| surface.positions[v as usize]))?;
            }
        }
        let kept = voxels.into_kept();
        if kept.iter().filter(|&&kept| kept).count() > MOST_VOXELS {
            return Err(CageError::TooFine("a million voxels inside"));
        }
        Self::of_voxels(grid, &kept)
    }

    fn of_voxels(grid: Grid, kept: &[bool]) -> Result<Self, CageError> {
        let mut voxel_of_cell = vec![ABSENT; grid.n_cells()];
        let mut vertex_of_corner = vec![ABSENT; grid.n_corners()];
        let (mut vertices, mut tets) = (Vec::new(), Vec::new());
        for at in grid.cells().filter(|&at| kept[grid.cell(at)]) {
            // Cut the voxel into six tetrahedra: paths from its lowest corner to its highest, one for each order of the
            // axes.
            voxel_of_cell[grid.cell(at)] = (tets.len() / 6) as u32;
            for (order, axes) in ORDERS.iter().enumerate() {
                let mut tet = [0; 4];
                let mut corner = at;
                for (step, slot) in path_slots(order).into_iter().enumerate() {
                    if step > 0 {
                        corner[axes[step - 1]] += 1;
                    }
                    // Number a corner when a tetrahedron first uses it.
                    let vertex = &mut vertex_of_corner[grid.corner_number(corner)];
                    if *vertex == ABSENT {
                        *vertex = vertices.len() as u32;
                        vertices.push(grid.corner(corner));
                    }
                    tet[slot] = *vertex;
                }
                tets.push(tet);
            }
        }
        let mesh = TetMesh::new(vertices, tets).map_err(|_| CageError::Empty)?;
        Ok(Self {
            mesh,
            grid,
            voxel_of_cell,
        })
    }

    /// Returns the tetrahedra at rest; six for each voxel.
    pub fn mesh(&self) -> &TetMesh {
        &self.mesh
    }

    /// Returns the length of a voxel's side.
    pub fn voxel_side(&self) -> f64 {
        self.grid.side
    }
}
