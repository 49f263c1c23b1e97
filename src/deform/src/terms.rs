//! Energies of a body as terms for the solver.

use super::body::{Body, BodyElements};
use super::problem::Problem;
use super::problem_error::ProblemError;
use std::sync::Arc;
use unwrapd_files::io::CellData;
use unwrapd_method::barrier::{Barrier, Bounded};
use unwrapd_method::energy::{
    Density, DimensionError, EnergyKind, RestShape, Term, Tetrahedra, Triangles, Zero,
};
use unwrapd_method::numerics::square::{Matrix, Square, times};

impl Body {
    /// Returns the terms of an energy with a barrier, and with a bound on the conformal distortion if one is given. The
    /// barrier takes the determinant of an element's edges as its size: twice its area or six times its volume.
    ///
    /// # Errors
    /// If the energy or bound is not defined in the body's dimension.
    pub fn terms(
        &self,
        energy: &EnergyKind,
        barrier: Barrier,
        bound: Option<f64>,
    ) -> Result<Vec<Box<dyn Term>>, ProblemError> {
        let mut terms = Vec::new();
        match &self.elements {
            BodyElements::Triangles { corners, rest } => {
                terms.extend(self.quadratic(energy, rest));
                let mut density = planar_density(energy)?.unwrap_or_else(|| Arc::new(Zero));
                if let Some(bound) = bound {
                    let beta = barrier.beta;
                    density = Arc::new(Bounded {
                        density,
                        bound,
                        beta,
                    });
                }
                let shapes = weighted(energy, rest, 2.0);
                terms.push(Box::new(Triangles::shared(
                    corners, &shapes, density, barrier,
                )));
            }
            BodyElements::Tetrahedra { corners, rest } => {
                if bound.is_some() {
                    return Err(ProblemError::PlanarEnergy);
                }
                terms.extend(self.quadratic(energy, rest));
                let density = spatial_density(energy)?.unwrap_or_else(|| Arc::new(Zero));
                let shapes = weighted(energy, rest, 6.0);
                terms.push(Box::new(Tetrahedra::shared(
                    corners, &shapes, density, barrier,
                )));
            }
        }
        Ok(terms)
    }

    /// Returns the energy if it is a quadratic form of the displacement from the rest positions.
    fn quadratic<const D: usize>(
        &self,
        energy: &EnergyKind,
        rest: &[RestShape<D>],
    ) -> Option<Box<dyn Term>> {
        let EnergyKind::Displacement(kind) = energy else {
            return None;
        };
        let form = kind.quadratic(&self.corners(), rest, &self.masses(), self.rest.clone());
        Some(Box::new(form))
    }

    /// Returns the mean weight of an element in an energy.
    pub(super) fn mean_weight(&self, energy: &EnergyKind) -> f64 {
        if !energy.is_weighted() {
            return 1.0;
        }
        let weights: Vec<f64> = match &self.elements {
            BodyElements::Triangles { rest, .. } => rest.iter().map(|r| r.weight).collect(),
            BodyElements::Tetrahedra { rest, .. } => rest.iter().map(|r| r.weight).collect(),
        };
        weights.iter().sum::<f64>() / weights.len().max(1) as f64
    }
}

/// Returns the energy of a triangle as a function of its singular values; `None` for quadratic forms.
fn planar_density(energy: &EnergyKind) -> Result<Option<Arc<dyn Density<2>>>, ProblemError> {
    match energy {
        EnergyKind::Density(kind) => Ok(Some(kind.planar()?)),
        EnergyKind::Displacement(_) => Ok(None),
    }
}

/// Returns the energy of a tetrahedron as a function of its singular values; `None` for quadratic forms.
fn spatial_density(energy: &EnergyKind) -> Result<Option<Arc<dyn Density<3>>>, ProblemError> {
    match energy {
        EnergyKind::Density(kind) => Ok(Some(kind.spatial()?)),
        EnergyKind::Displacement(_) => Ok(None),
    }
}

/// Returns rest shapes whose sizes are determinants of their edges, `determinant` times the true ones.
fn weighted<const D: usize>(
    energy: &EnergyKind,
    rest: &[RestShape<D>],
    determinant: f64,
) -> Vec<RestShape<D>> {
    let is_weighted = energy.is_weighted();
    rest.iter()
        .map(|shape| RestShape {
            size: determinant * shape.size,
            weight: if is_weighted { shape.weight } else { 1.0 },
            ..*shape
        })
        .collect()
}

impl From<DimensionError> for ProblemError {
    fn from(error: DimensionError) -> Self {
        match error {
            DimensionError::PlanarOnly => Self::PlanarEnergy,
            DimensionError::Formula(error) => Self::Formula(error),
        }
    }
}

// Data about the deformation of each element, for visualization.

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
    cells.extend(density.map(|density| CellData {
        name: "energy_density",
        components: 1,
        values: match density.batch() {
            Some(batch) => batch.values(sigma),
            None => sigma.iter().map(|sigma| density.value(sigma)).collect(),
        },
    }));
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
