//! The sum over a mesh.

use std::array;

use super::modes::Modes;
use super::simplex::{Pulled, Simplex};
use super::{Assembly, Density, Guard, RestShape, Term};
use crate::numerics::roots::smallest_root_below;
use crate::numerics::square::{Matrix, Square};
use crate::numerics::stencils::Stencils;
use crate::numerics::svd::Svd;

/// Number of elements decomposed at once.
const LANES: usize = 8;

/// Σ over elements of weight·ψ(σ(J)) + φ(det J): a density and a guard on triangles (D = 2) or tetrahedra (D = 3).
pub struct Simplices<const D: usize> {
    elements: Vec<Simplex<D>>,
    density: Box<dyn Density<D>>,
    guard: Box<dyn Guard>,
}

/// A sum over triangles in the plane.
pub type Triangles = Simplices<2>;

/// A sum over tetrahedra.
pub type Tetrahedra = Simplices<3>;

impl Simplices<2> {
    /// Creates the energy of maps of `triangles`, one rest shape each.
    ///
    /// # Panics
    /// If there are fewer or more rest shapes than triangles.
    pub fn new(
        triangles: &[[u32; 3]],
        rest: &[RestShape<2>],
        density: impl Density<2> + 'static,
        guard: impl Guard + 'static,
    ) -> Self {
        let split = triangles.iter().map(|&[a, b, c]| (a, [b, c]));
        Self::of(split, rest, Box::new(density), Box::new(guard))
    }
}

impl Simplices<3> {
    /// Creates the energy of maps of `tetrahedra`, one rest shape each.
    ///
    /// # Panics
    /// If there are fewer or more rest shapes than tetrahedra.
    pub fn new(
        tetrahedra: &[[u32; 4]],
        rest: &[RestShape<3>],
        density: impl Density<3> + 'static,
        guard: impl Guard + 'static,
    ) -> Self {
        let split = tetrahedra.iter().map(|&[a, b, c, d]| (a, [b, c, d]));
        Self::of(split, rest, Box::new(density), Box::new(guard))
    }
}

impl<const D: usize> Simplices<D>
where
    Matrix<D>: Square<D>,
{
    fn of(
        vertices: impl ExactSizeIterator<Item = (u32, [u32; D])>,
        rest: &[RestShape<D>],
        density: Box<dyn Density<D>>,
        guard: Box<dyn Guard>,
    ) -> Self {
        assert_eq!(vertices.len(), rest.len(), "one rest shape per element");
        let elements = vertices
            .zip(rest)
            .map(|((first, others), rest)| {
                let floor = density.floor().max(guard.floor(rest.size));
                Simplex::new(first, others, rest, floor)
            })
            .collect();
        Self {
            elements,
            density,
            guard,
        }
    }

    /// Returns `sum` plus the values of some elements.
    fn add_values<const N: usize>(&self, sum: f64, elements: &[Simplex<D>; N], x: &[f64]) -> f64 {
        let (matrices, dets) = jacobians(elements, x);
        let sigmas = Matrix::all_singular_values(&matrices, &dets);
        let parts = elements.iter().zip(sigmas).zip(dets);
        parts.fold(sum, |sum, ((element, sigma), det)| {
            let density = element.weight * self.density.value(&sigma);
            sum + (density + self.guard.value(det, element.size))
        })
    }

    /// Adds the derivatives of some elements; their stencils are numbered from `first`.
    fn add_derivatives_of<const N: usize>(
        &self,
        first: usize,
        elements: &[Simplex<D>; N],
        x: &[f64],
        tau: f64,
        assembly: &mut Assembly,
    ) {
        let (matrices, dets) = jacobians(elements, x);
        let svds = Matrix::svds(&matrices, &dets);
        let tau = assembly.wants_hessian().then_some(tau);
        for (k, element) in elements.iter().enumerate() {
            let pulled = self.pulled(element, &svds[k], dets[k], tau);
            pulled.gradients(|vertex, gradient| assembly.add_gradient(vertex, &gradient));
            if tau.is_some() {
                pulled.add_blocks(first + k, assembly);
            }
        }
    }

    /// Computes the derivatives of an element. The negative eigenvalues of the Hessian are multiplied by `tau`; without
    /// `tau`, only the gradient is computed.
    fn pulled<'a>(
        &self,
        element: &'a Simplex<D>,
        svd: &Svd<D>,
        det: f64,
        tau: Option<f64>,
    ) -> Pulled<'a, D> {
        let (density, sigma) = (&*self.density, &svd.sigma);
        let mut modes = match tau {
            Some(_) => Modes::new(density, sigma, element.weight),
            None => Modes::of_slope(density, sigma, element.weight),
        };
        modes.add_guard(self.guard.derivatives(det, element.size), &svd.sigma);
        element.pull(modes, svd, tau.unwrap_or(1.0))
    }
}

/// Returns the Jacobians of some elements, and their determinants.
fn jacobians<const D: usize, const N: usize>(
    elements: &[Simplex<D>; N],
    x: &[f64],
) -> ([Matrix<D>; N], [f64; N])
where
    Matrix<D>: Square<D>,
{
    let (mut matrices, mut dets) = ([[[0.0; D]; D]; N], [0.0; N]);
    for (k, element) in elements.iter().enumerate() {
        (matrices[k], dets[k]) = element.jacobian(x);
    }
    (matrices, dets)
}

impl<const D: usize> Term for Simplices<D>
where
    Matrix<D>: Square<D>,
{
    fn dim(&self) -> usize {
        D
    }

    fn stencils(&self) -> Stencils {
        Stencils::uniform(D + 1, self.elements.iter().flat_map(Simplex::vertices))
    }

    fn scale(&self) -> f64 {
        self.elements.iter().map(|e| e.weight).sum()
    }

    fn value(&self, x: &[f64]) -> f64 {
        let (blocks, rest) = self.elements.as_chunks::<LANES>();
        let sum = blocks.iter().fold(0.0, |sum, b| self.add_values(sum, b, x));
        rest.iter()
            .fold(sum, |sum, e| self.add_values(sum, array::from_ref(e), x))
    }

    fn add_derivatives(&self, x: &[f64], tau: f64, assembly: &mut Assembly) {
        let (blocks, rest) = self.elements.as_chunks::<LANES>();
        for (k, block) in blocks.iter().enumerate() {
            self.add_derivatives_of(LANES * k, block, x, tau, assembly);
        }
        let done = self.elements.len() - rest.len();
        for (k, element) in rest.iter().enumerate() {
            self.add_derivatives_of(done + k, array::from_ref(element), x, tau, assembly);
        }
    }

    fn largest_step(&self, x: &[f64], direction: &[f64]) -> f64 {
        let mut largest = f64::INFINITY;
        for element in &self.elements {
            if element.floor > f64::NEG_INFINITY {
                let margin = element.margin_polynomial(x, direction);
                largest = smallest_root_below(margin, largest);
            }
        }
        largest
    }

    fn smallest(&self, x: &[f64]) -> f64 {
        let dets = self.elements.iter().map(|e| e.det(x));
        dets.fold(f64::INFINITY, f64::min)
    }

    fn barrier(&self, x: &[f64]) -> f64 {
        let guard = |e: &Simplex<D>| self.guard.value(e.det(x), e.size);
        self.elements.iter().map(guard).sum()
    }

    fn forbids_flips(&self) -> bool {
        self.elements.iter().all(|e| e.floor >= 0.0)
    }
}
