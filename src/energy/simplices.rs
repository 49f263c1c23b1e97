//! The sum over a mesh.

use super::modes::Modes;
use super::simplex::{Pulled, Simplex};
use super::{Assembly, Density, Guard, RestShape, Term};
use crate::numerics::roots::smallest_root_below;
use crate::numerics::square::{Matrix, Square};
use crate::numerics::stencils::Stencils;

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
    /// The energy of maps of `triangles`, one rest shape each.
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
    /// The energy of maps of `tetrahedra`, one rest shape each.
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

    fn element_value(&self, element: &Simplex<D>, x: &[f64]) -> f64 {
        let (j, det) = element.jacobian(x);
        let sigma = j.singular_values(det);
        element.weight * self.density.value(&sigma) + self.guard.value(det, element.size)
    }

    /// Negative eigenvalues of the Hessian times `tau`; without `tau`, the gradient alone.
    fn pulled<'a>(&self, element: &'a Simplex<D>, x: &[f64], tau: Option<f64>) -> Pulled<'a, D> {
        let (j, det) = element.jacobian(x);
        let svd = j.svd(det);
        let (density, sigma) = (&*self.density, &svd.sigma);
        let mut modes = match tau {
            Some(_) => Modes::new(density, sigma, element.weight),
            None => Modes::of_slope(density, sigma, element.weight),
        };
        modes.add_guard(self.guard.derivatives(det, element.size), &svd.sigma);
        element.pull(modes, &svd, tau.unwrap_or(1.0))
    }
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
        self.elements.iter().map(|e| self.element_value(e, x)).sum()
    }

    fn add_derivatives(&self, x: &[f64], tau: f64, assembly: &mut Assembly) {
        let wants_hessian = assembly.wants_hessian();
        let tau = wants_hessian.then_some(tau);
        for (index, element) in self.elements.iter().enumerate() {
            let pulled = self.pulled(element, x, tau);
            pulled.gradients(|vertex, gradient| assembly.add_gradient(vertex, &gradient));
            if wants_hessian {
                pulled.add_blocks(index, assembly);
            }
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
