//! Data about the deformation of each element, for visualization.

use super::body::BodyElements;
use super::problem::Problem;
use super::terms::{planar_density, spatial_density};
use std::sync::Arc;
use unwrapd_files::io::CellData;
use unwrapd_method::energy::{Density, RestShape};
use unwrapd_method::numerics::square::{Matrix, Square, times};

impl Problem {
    /// Returns for each element of the body at the positions `x`: its singular values, greatest first; its size over
    /// its rest size, which is their product; and its energy before weighting by its rest size, if that is a function
    /// of the singular values.
    pub fn cells(&self, x: &[f64]) -> Vec<CellData> {
        match &self.body.elements {
            BodyElements::Triangles { corners, rest } => {
                let density = planar_density(&self.energy).unwrap_or_default();
                cells_of(&singular_values(corners, rest, x), density)
            }
            BodyElements::Tetrahedra { corners, rest } => {
                let density = spatial_density(&self.energy).unwrap_or_default();
                cells_of(&singular_values(corners, rest, x), density)
            }
        }
    }
}

fn cells_of<const D: usize>(
    sigma: &[[f64; D]],
    density: Option<Arc<dyn Density<D>>>,
) -> Vec<CellData> {
    let values = |name, of: &dyn Fn(&[f64; D]) -> f64| CellData {
        name,
        components: 1,
        values: sigma.iter().map(of).collect(),
    };
    let mut cells = vec![
        CellData {
            name: "singular_values",
            components: D,
            values: sigma.as_flattened().to_vec(),
        },
        values("relative_size", &|sigma| sigma.iter().product()),
    ];
    cells.extend(density.map(|density| values("energy_density", &|sigma| density.value(sigma))));
    cells
}

/// Returns the singular values of each element with N = D + 1 corners; the last is negative for an inverted element.
fn singular_values<const D: usize, const N: usize>(
    corners: &[[u32; N]],
    rest: &[RestShape<D>],
    x: &[f64],
) -> Vec<[f64; D]>
where
    Matrix<D>: Square<D>,
{
    let places: &[[f64; D]] = x.as_chunks().0;
    let of = |(element, shape): (&[u32; N], &RestShape<D>)| {
        let place = |corner: usize| places[element[corner] as usize];
        let edge = |row: usize, column: usize| place(column + 1)[row] - place(0)[row];
        let edges: Matrix<D> =
            std::array::from_fn(|row| std::array::from_fn(|column| edge(row, column)));
        let jacobian = times(&edges, &shape.inverse);
        jacobian.singular_values(jacobian.det())
    };
    corners.iter().zip(rest).map(of).collect()
}
