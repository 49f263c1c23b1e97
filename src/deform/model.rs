//! What a deformation costs, in words and numbers.

use serde::{Deserialize, Serialize};

use super::body::{Body, BodyElements};
use crate::barrier::{Barrier, Bounded};
use crate::energy::{
    Amips, Arap, Density, Green, Lscm, Mips, NeoHookean, Quadratic, RestShape, StVenantKirchhoff,
    SymmetricDirichlet, Term, Tetrahedra, Triangles, Zero, biharmonic, dirichlet,
    uniform_biharmonic,
};

/// Which deformation energy is minimized.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema, clap::ValueEnum))]
#[serde(rename_all = "kebab-case")]
pub enum DeformationEnergy {
    /// As rigid as possible.
    #[default]
    Arap,
    /// Squared norm of Green's strain, not weighted by size.
    Green,
    /// Dirichlet energy of the displacement.
    Dirichlet,
    /// Biharmonic energy of the displacement, cotangent weights.
    Laplacian,
    /// Biharmonic energy of the displacement, uniform weights.
    #[serde(alias = "uniform_laplacian")]
    UniformLaplacian,
    /// Least-squares conformal; in the plane only.
    Lscm,
    /// Symmetric Dirichlet.
    #[serde(alias = "symmetric_dirichlet")]
    SymmetricDirichlet,
    /// Most isometric parameterizations (MIPS): conformal distortion.
    Mips,
    /// Advanced MIPS with exponent factor 1.
    Amips,
    /// St. Venant–Kirchhoff with Lamé parameters λ = 1, μ = ½.
    StVenantKirchhoff,
    /// Neo-Hookean with Lamé parameters λ = 1, μ = ½.
    NeoHookean,
}

/// The Lamé parameters λ and μ of an ordinary solid, Poisson's ratio ⅓, in its own unit.
const LAME: [f64; 2] = [1.0, 0.5];

impl DeformationEnergy {
    /// The paper's β for this energy.
    pub fn default_beta(self) -> f64 {
        match self {
            Self::Green => 100.0,
            _ => 0.01,
        }
    }

    /// Is it a sum over elements, without a weight?
    fn is_unweighted(self) -> bool {
        self == Self::Green
    }

    /// The mean weight of an element.
    pub(super) fn mean_weight(self, body: &Body) -> f64 {
        let weights: Vec<f64> = match &body.elements {
            _ if self.is_unweighted() => return 1.0,
            BodyElements::Triangles { rest, .. } => rest.iter().map(|r| r.weight).collect(),
            BodyElements::Tetrahedra { rest, .. } => rest.iter().map(|r| r.weight).collect(),
        };
        weights.iter().sum::<f64>() / weights.len().max(1) as f64
    }

    /// The terms of the energy of `body` with a barrier, in which an element's size is the determinant of its edges, twice
    /// its area or six times its volume, and with a bound of the conformal distortion if one is given. `None` for an energy or
    /// a bound that the body's dimension does not have.
    pub fn terms(
        self,
        body: &Body,
        barrier: Barrier,
        bound: Option<f64>,
    ) -> Option<Vec<Box<dyn Term>>> {
        match &body.elements {
            BodyElements::Triangles { corners, rest } => {
                let (quadratic, mut density) = match self.planar_density() {
                    Some(density) => (None, density),
                    None => self.parts(body, rest)?,
                };
                if let Some(bound) = bound {
                    density = Box::new(Bounded {
                        density,
                        bound,
                        beta: barrier.beta,
                    });
                }
                let shapes = self.weighted(rest, 2.0);
                let guarded = Triangles::new(corners, &shapes, density, barrier);
                Some(together(quadratic, guarded))
            }
            BodyElements::Tetrahedra { corners, rest } => {
                if bound.is_some() {
                    return None;
                }
                let (quadratic, density) = self.parts(body, rest)?;
                let shapes = self.weighted(rest, 6.0);
                let guarded = Tetrahedra::new(corners, &shapes, density, barrier);
                Some(together(quadratic, guarded))
            }
        }
    }

    /// The quadratic form that the energy is, or its density, which is zero beside one; `None` for [`Self::Lscm`], which not every
    /// dimension has.
    fn parts<const D: usize>(self, body: &Body, rest: &[RestShape<D>]) -> Option<Parts<D>> {
        let sizes = || -> Vec<f64> { rest.iter().map(|shape| shape.size).collect() };
        let (corners, x) = (body.corners(), || body.rest.clone());
        let quadratic = match self {
            Self::Dirichlet => dirichlet(&corners, rest, &sizes(), x()),
            Self::Laplacian => biharmonic(&corners, rest, &sizes(), &body.masses(), x()),
            Self::UniformLaplacian => uniform_biharmonic(D, &corners, x()),
            _ => return Some((None, self.density()?)),
        };
        Some((Some(quadratic), Box::new(Zero)))
    }

    /// [`density`](Self::density), that of [`Self::Lscm`] too.
    pub(super) fn planar_density(self) -> Option<Box<dyn Density<2>>> {
        match self {
            Self::Lscm => Some(Box::new(Lscm)),
            _ => self.density(),
        }
    }

    /// The energy of an element as a function of its singular values; `None` for quadratic forms and for [`Self::Lscm`].
    pub(super) fn density<const D: usize>(self) -> Option<Box<dyn Density<D>>> {
        let [lambda, mu] = LAME;
        Some(match self {
            Self::Arap => Box::new(Arap),
            Self::Green => Box::new(Green),
            Self::SymmetricDirichlet => Box::new(SymmetricDirichlet),
            Self::Mips => Box::new(Mips),
            Self::Amips => Box::new(Amips { s: 1.0 }),
            Self::StVenantKirchhoff => Box::new(StVenantKirchhoff { lambda, mu }),
            Self::NeoHookean => Box::new(NeoHookean { lambda, mu }),
            Self::Lscm | Self::Dirichlet | Self::Laplacian | Self::UniformLaplacian => return None,
        })
    }

    fn weighted<const D: usize>(
        self,
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
