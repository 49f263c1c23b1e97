//! What a deformation costs, in words and numbers.

use super::body::{Body, BodyElements};
use super::deformation_energy::DeformationEnergy;
use super::problem_error::ProblemError;
use unwrapd_method::barrier::{Barrier, Bounded};
use unwrapd_method::energy::{
    Amips, Arap, Density, Green, Lscm, Mips, NeoHookean, Quadratic, RestShape, StVenantKirchhoff,
    SymmetricDirichlet, Term, Tetrahedra, Triangles, Zero, biharmonic, dirichlet,
    uniform_biharmonic,
};

/// The Lamé parameters λ and μ of an ordinary solid, Poisson's ratio ⅓, in its own unit.
const LAME: [f64; 2] = [1.0, 0.5];

impl DeformationEnergy {
    /// The paper's β for this energy.
    pub fn default_beta(&self) -> f64 {
        match self {
            Self::Green => 100.0,
            _ => 0.01,
        }
    }

    /// Is it a sum over elements, without a weight?
    fn is_unweighted(&self) -> bool {
        *self == Self::Green
    }

    /// The mean weight of an element.
    pub(super) fn mean_weight(&self, body: &Body) -> f64 {
        let weights: Vec<f64> = match &body.elements {
            _ if self.is_unweighted() => return 1.0,
            BodyElements::Triangles { rest, .. } => rest.iter().map(|r| r.weight).collect(),
            BodyElements::Tetrahedra { rest, .. } => rest.iter().map(|r| r.weight).collect(),
        };
        weights.iter().sum::<f64>() / weights.len().max(1) as f64
    }

    /// The terms of the energy of `body` with a barrier, in which an element's size is the determinant of its edges, twice
    /// its area or six times its volume, and with a bound of the conformal distortion if one is given.
    ///
    /// # Errors
    /// If the body's dimension does not have such an energy or bound.
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

    /// The quadratic form that the energy is, if it is one, and its density, which is zero then.
    fn parts<const D: usize>(
        &self,
        body: &Body,
        rest: &[RestShape<D>],
        density: Option<Box<dyn Density<D>>>,
    ) -> Parts<D> {
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

    /// The energy of a triangle as a function of its singular values; `None` for quadratic forms.
    pub(super) fn planar_density(&self) -> Result<Option<Box<dyn Density<2>>>, ProblemError> {
        Ok(match self {
            Self::Lscm => Some(Box::new(Lscm)),
            Self::Formula(own) => Some(Box::new(own.planar()?)),
            _ => self.named_density(),
        })
    }

    /// The same of a tetrahedron.
    pub(super) fn spatial_density(&self) -> Result<Option<Box<dyn Density<3>>>, ProblemError> {
        Ok(match self {
            Self::Lscm => return Err(ProblemError::PlanarEnergy),
            Self::Formula(own) => Some(Box::new(own.spatial()?)),
            _ => self.named_density(),
        })
    }

    /// The density of a name that both dimensions have.
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
type Parts<const D: usize> = (Option<Quadratic>, Box<dyn Density<D>>);

fn together(quadratic: Option<Quadratic>, guarded: impl Term + 'static) -> Vec<Box<dyn Term>> {
    let quadratic = quadratic.map(|quadratic| Box::new(quadratic) as Box<dyn Term>);
    quadratic
        .into_iter()
        .chain([Box::new(guarded) as Box<dyn Term>])
        .collect()
}
