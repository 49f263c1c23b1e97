//! The sum over a mesh.

use super::element::{Element, Pulled};
use super::{Density, Derivatives, Guard, Jacobian, Local, RestShape, Term};
use crate::numerics::block::BlockPattern;

/// Σ over triangles of weight·ψ(J) + φ(det J): a density and a guard.
#[derive(Clone, Debug)]
pub struct Triangles<D, G> {
    elements: Vec<Element>,
    density: D,
    guard: G,
}

impl<D: Density, G: Guard> Triangles<D, G> {
    /// The energy of maps of `triangles`, one rest shape each.
    ///
    /// # Panics
    /// If there are fewer or more rest shapes than triangles.
    pub fn new(triangles: &[[u32; 3]], rest: &[RestShape], density: D, guard: G) -> Self {
        assert_eq!(triangles.len(), rest.len(), "one rest shape per triangle");
        let elements = triangles
            .iter()
            .zip(rest)
            .map(|(&triangle, rest)| {
                let floor = density.floor().max(guard.floor(rest.area));
                Element::new(triangle, rest, floor)
            })
            .collect();
        Self {
            elements,
            density,
            guard,
        }
    }

    fn element_value(&self, element: &Element, x: &[f64]) -> f64 {
        let j = element.jacobian(x);
        element.weight * self.density.value(&j) + self.guard.value(j.det, element.area)
    }

    fn element_derivatives(&self, element: &Element, j: &Jacobian) -> Derivatives {
        let guard = self.guard.derivatives(j.det, element.area);
        let density = self.density.derivatives(j).times(element.weight);
        density.plus_guard(guard, j)
    }
}

impl<D: Density, G: Guard> Term for Triangles<D, G> {
    fn stencils(&self) -> Vec<[u32; 3]> {
        self.elements.iter().map(|e| e.vertices).collect()
    }

    fn scale(&self) -> f64 {
        self.elements.iter().map(|e| e.weight).sum()
    }

    fn value(&self, x: &[f64]) -> f64 {
        self.elements.iter().map(|e| self.element_value(e, x)).sum()
    }

    fn add_derivatives(
        &self,
        x: &[f64],
        tau: f64,
        pattern: &BlockPattern,
        gradient: &mut [f64],
        hessian: &mut [f64],
    ) {
        for (index, element) in self.elements.iter().enumerate() {
            let j = element.jacobian(x);
            let pulled = Pulled::new(self.element_derivatives(element, &j), &j, tau);
            let (diagonal, pairs) = element.blocks(&pulled);
            let gradients = element.gradients(&pulled);
            for (k, &vertex) in element.vertices.iter().enumerate() {
                gradient[2 * vertex as usize] += gradients[k][0];
                gradient[2 * vertex as usize + 1] += gradients[k][1];
                pattern.add_diagonal(hessian, vertex, diagonal[k]);
            }
            for (slot, block) in pattern.pairs(index).into_iter().zip(pairs) {
                pattern.add_pair(hessian, slot, block);
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

    fn forbids_flips(&self) -> bool {
        self.elements.iter().all(|e| e.floor >= 0.0)
    }

    fn value_around(&self, around: &[u32], x: &[f64]) -> f64 {
        let elements = around.iter().map(|&i| &self.elements[i as usize]);
        elements.map(|e| self.element_value(e, x)).sum()
    }

    fn derivatives_around(&self, vertex: u32, around: &[u32], x: &[f64]) -> Local {
        let mut local = Local::default();
        for &index in around {
            let element = &self.elements[index as usize];
            let Some(k) = element.vertices.iter().position(|&v| v == vertex) else {
                continue;
            };
            let j = element.jacobian(x);
            let pulled = Pulled::new(self.element_derivatives(element, &j), &j, 0.0);
            let gradient = element.gradients(&pulled)[k];
            let hessian = element.blocks(&pulled).0[k];
            local.add(gradient, hessian);
        }
        local
    }
}

/// The smallest positive root of c₀ + c₁t + c₂t² if it is below `best`, else `best`; c₀ > 0.
///
/// Most triangles are done with the first line: on (0, best) the polynomial is above the sum of its negative parts.
/// The roots are q/c₂ and c₀/q with q = −½(c₁ ± √disc), the sign that of c₁: no difference of near numbers, and no
/// special case where c₂ vanishes.
fn smallest_root_below([c0, c1, c2]: [f64; 3], best: f64) -> f64 {
    if c0 + best * (c1.min(0.0) + best * c2.min(0.0)) > 0.0 {
        return best;
    }
    let discriminant = c1 * c1 - 4.0 * c0 * c2;
    if discriminant < 0.0 {
        return best;
    }
    let q = -0.5 * (c1 + discriminant.sqrt().copysign(c1));
    [q / c2, c0 / q]
        .into_iter()
        .filter(|&t| t > 0.0)
        .fold(best, f64::min)
}
