//! Energies of a body as terms for the solver.

use super::body::{Body, BodyElements};
use super::deformation_energy::DeformationEnergy;
use super::problem_error::ProblemError;
use unwrapd_method::barrier::{Barrier, Bounded};
use unwrapd_method::energy::{
    Amips, Arap, Density, Green, Lscm, Mips, NeoHookean, Quadratic, RestShape, StVenantKirchhoff,
    SymmetricDirichlet, Term, Tetrahedra, Triangles, Zero, biharmonic, dirichlet,
    uniform_biharmonic,
};

/// Lamé parameters λ and μ of an ordinary solid with Poisson's ratio ⅓, in its own unit.
const LAME: [f64; 2] = [1.0, 0.5];

impl DeformationEnergy {
    /// Returns the paper's β for this energy.
    pub fn default_beta(&self) -> f64 {
        match self {
            Self::Green => 100.0,
            _ => 0.01,
        }
    }

    /// Returns whether it is a sum over elements without weights.
    fn is_unweighted(&self) -> bool {
        *self == Self::Green
    }

    /// Returns the mean weight of an element.
    pub(super) fn mean_weight(&self, body: &Body) -> f64 {
        let weights: Vec<f64> = match &body.elements {
            _ if self.is_unweighted() => return 1.0,
            BodyElements::Triangles { rest, .. } => rest.iter().map(|r| r.weight).collect(),
            BodyElements::Tetrahedra { rest, .. } => rest.iter().map(|r| r.weight).collect(),
        };
        weights.iter().sum::<f64>() / weights.len().max(1) as f64
    }

    /// Returns the terms of the energy of `body` with a barrier, and with a bound on the conformal distortion if one is
    /// given. The barrier takes the determinant of an element's edges as its size: twice its area or six times its
    /// volume.
    ///
    /// # Errors
    /// If the energy or bound is not defined in the body's dimension.
    pub fn terms(
        &self,
        body: &Body,
        barrier: Barrier,
        bound: Option<f64>,
    ) -> Result<Vec<Box<dyn Term>>, ProblemError> {
        match &body.elements {
            BodyElements::Triangles { corners, rest } => {
                let (quadratic, mut density) = self.parts(body, rest, self.planar_density()?);
                if let Some(bound) = bound {
                    density = Box::new(Bounded {
                        density,
                        bound,
                        beta: barrier.beta,
                    });
                }
                let shapes = self.weighted(rest, 2.0);
                let guarded = Triangles::new(corners, &shapes, density, barrier);
                Ok(together(quadratic, guarded))
            }
            BodyElements::Tetrahedra { corners, rest } => {
                if bound.is_some() {
                    return Err(ProblemError::PlanarEnergy);
                }
                let (quadratic, density) = self.parts(body, rest, self.spatial_density()?);
                let shapes = self.weighted(rest, 6.0);
                let guarded = Tetrahedra::new(corners, &shapes, density, barrier);
                Ok(together(quadratic, guarded))
            }
        }
    }

    /// Splits the energy into a quadratic form, if it is one, and a density, which is then zero.
    fn parts<const D: usize>(
        &self,
        body: &Body,
        rest: &[RestShape<D>],
        density: Option<Box<dyn Density<D>>>,
    ) -> ModelParts<D> {
        let sizes = || -> Vec<f64> { rest.iter().map(|shape| shape.size).collect() };
        let (corners, x) = (body.corners(), || body.rest.clone());
        let quadratic = match self {
            Self::Dirichlet => Some(dirichlet(&corners, rest, &sizes(), x())),
            Self::Laplacian => Some(biharmonic(&corners, rest, &sizes(), &body.masses(), x())),
            Self::UniformLaplacian => Some(uniform_biharmonic(D, &corners, x())),
            _ => None,
        };
        (quadratic, density.unwrap_or_else(|| Box::new(Zero)))
    }

    /// Returns the energy of a triangle as a function of its singular values; `None` for quadratic forms.
    pub(super) fn planar_density(&self) -> Result<Option<Box<dyn Density<2>>>, ProblemError> {
        Ok(match self {
            Self::Lscm => Some(Box::new(Lscm)),
            Self::Formula(own) => Some(Box::new(own.planar()?)),
            _ => self.named_density(),
        })
    }

    /// Returns the energy of a tetrahedron as a function of its singular values; `None` for quadratic forms.
    pub(super) fn spatial_density(&self) -> Result<Option<Box<dyn Density<3>>>, ProblemError> {
        Ok(match self {
            Self::Lscm => return Err(ProblemError::PlanarEnergy),
            Self::Formula(own) => Some(Box::new(own.spatial()?)),
            _ => self.named_density(),
        })
    }

    /// Returns the density of a name that exists in both dimensions.
    fn named_density<const D: usize>(&self) -> Option<Box<dyn Density<D>>> {
        let [lambda, mu] = LAME;
        Some(match self {
            Self::Arap => Box::new(Arap),
            Self::Green => Box::new(Green),
            Self::SymmetricDirichlet => Box::new(SymmetricDirichlet),
            Self::Mips => Box::new(Mips),
            Self::Amips => Box::new(Amips { s: 1.0 }),
            Self::StVenantKirchhoff => Box::new(StVenantKirchhoff { lambda, mu }),
            Self::NeoHookean => Box::new(NeoHookean { lambda, mu }),
            Self::Lscm
            | Self::Dirichlet
            | Self::Laplacian
            | Self::UniformLaplacian
            | Self::Formula(_) => return None,
        })
    }

    fn weighted<const D: usize>(
        &self,
        rest: &[RestShape<D>],
        determinant: f64,
    ) -> Vec<RestShape<D>> {
        let weight = |shape: &RestShape<D>| {
            if self.is_unweighted() {
                1.0
            } else {
                shape.weight
            }
        };
        let shapes = rest.iter().map(|shape| RestShape {
            size: determinant * shape.size,
            weight: weight(shape),
            ..*shape
        });
        shapes.collect()
    }
}

/// A quadratic form, and a density.
type ModelParts<const D: usize> = (Option<Quadratic>, Box<dyn Density<D>>);

fn together(quadratic: Option<Quadratic>, guarded: impl Term + 'static) -> Vec<Box<dyn Term>> {
    let quadratic = quadratic.map(|quadratic| Box::new(quadratic) as Box<dyn Term>);
    quadratic
        .into_iter()
        .chain([Box::new(guarded) as Box<dyn Term>])
        .collect()
}
