//! The sum over a mesh.

use super::{Assembly, Density, DensityBatch, Guard, RestShape, Term};
use crate::numerics::roots::smallest_root_below;
use crate::numerics::square::{Matrix, Square, apply, apply_transposed, times, transposed};
use crate::numerics::stencils::Stencils;
use crate::numerics::svd::Svd;
use crate::numerics::symmetric::relax_negative;
use std::array;
use std::sync::Arc;

/// Number of elements decomposed at once.
const LANES: usize = 8;

/// Σ over elements of weight·ψ(σ(J)) + φ(det J): a density and a guard on triangles (D = 2) or tetrahedra (D = 3).
pub struct Simplices<const D: usize> {
    elements: Vec<Simplex<D>>,
    density: Arc<dyn Density<D>>,
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
        Self::shared(triangles, rest, Arc::new(density), guard)
    }

    /// Like [`new`](Self::new), for a density that was chosen at run time, as by a
    /// [`DensityKind`](super::DensityKind).
    pub fn shared(
        triangles: &[[u32; 3]],
        rest: &[RestShape<2>],
        density: Arc<dyn Density<2>>,
        guard: impl Guard + 'static,
    ) -> Self {
        let split = triangles.iter().map(|&[a, b, c]| (a, [b, c]));
        Self::of(split, rest, density, Box::new(guard))
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
        Self::shared(tetrahedra, rest, Arc::new(density), guard)
    }

    /// Like [`new`](Self::new), for a density that was chosen at run time, as by a
    /// [`DensityKind`](super::DensityKind).
    pub fn shared(
        tetrahedra: &[[u32; 4]],
        rest: &[RestShape<3>],
        density: Arc<dyn Density<3>>,
        guard: impl Guard + 'static,
    ) -> Self {
        let split = tetrahedra.iter().map(|&[a, b, c, d]| (a, [b, c, d]));
        Self::of(split, rest, density, Box::new(guard))
    }
}

impl<const D: usize> Simplices<D>
where
    Matrix<D>: Square<D>,
{
    fn of(
        vertices: impl ExactSizeIterator<Item = (u32, [u32; D])>,
        rest: &[RestShape<D>],
        density: Arc<dyn Density<D>>,
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
        let density = &*self.density;
        for (k, element) in elements.iter().enumerate() {
            let (sigma, weight) = (&svds[k].sigma, element.weight);
            let modes = if assembly.wants_hessian() {
                Modes::new(density, sigma, weight)
            } else {
                Modes::of_slope(density.gradient(sigma), weight)
            };
            let pulled = self.pulled(element, modes, &svds[k], dets[k], tau);
            pulled.distribute(first + k, assembly);
        }
    }

    /// Adds the guard to the derivatives of an element's density. The negative eigenvalues of the Hessian are multiplied
    /// by `tau`.
    fn pulled<'a>(
        &self,
        element: &'a Simplex<D>,
        mut modes: Modes<D>,
        svd: &Svd<D>,
        det: f64,
        tau: f64,
    ) -> Pulled<'a, D> {
        modes.add_guard(self.guard.derivatives(det, element.size), &svd.sigma);
        element.pull(modes, svd, tau)
    }
}

// A density that takes all elements in one call.

impl<const D: usize> Simplices<D>
where
    Matrix<D>: Square<D>,
{
    /// Returns the sum.
    fn value_of_batch(&self, batch: &dyn DensityBatch<D>, x: &[f64]) -> f64 {
        let (mut sigmas, mut dets) = (Vec::new(), Vec::new());
        for element in &self.elements {
            let (matrix, det) = element.jacobian(x);
            sigmas.push(matrix.singular_values(det));
            dets.push(det);
        }
        let parts = self.elements.iter().zip(batch.values(&sigmas)).zip(dets);
        let shares = parts.map(|((element, density), det)| {
            element.weight * density + self.guard.value(det, element.size)
        });
        shares.sum()
    }

    /// Adds the derivatives.
    fn add_derivatives_of_batch(
        &self,
        batch: &dyn DensityBatch<D>,
        x: &[f64],
        tau: f64,
        assembly: &mut Assembly,
    ) {
        let (mut svds, mut dets) = (Vec::new(), Vec::new());
        for element in &self.elements {
            let (matrix, det) = element.jacobian(x);
            svds.push(matrix.svd(det));
            dets.push(det);
        }
        let sigmas: Vec<[f64; D]> = svds.iter().map(|svd| svd.sigma).collect();
        let gradients = batch.gradients(&sigmas);
        let hessians = (assembly.wants_hessian()).then(|| batch.hessians(&sigmas));
        for (k, element) in self.elements.iter().enumerate() {
            let (gradient, weight) = (gradients[k], element.weight);
            let modes = match &hessians {
                Some(hessians) => {
                    let derivatives = (gradient, hessians[k]);
                    Modes::of_derivatives(&*self.density, &sigmas[k], derivatives, weight)
                }
                None => Modes::of_slope(gradient, weight),
            };
            let pulled = self.pulled(element, modes, &svds[k], dets[k], tau);
            pulled.distribute(k, assembly);
        }
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
        if let Some(batch) = self.density.batch() {
            return self.value_of_batch(batch, x);
        }
        let (blocks, rest) = self.elements.as_chunks::<LANES>();
        let sum = blocks.iter().fold(0.0, |sum, b| self.add_values(sum, b, x));
        rest.iter()
            .fold(sum, |sum, e| self.add_values(sum, array::from_ref(e), x))
    }

    fn add_derivatives(&self, x: &[f64], tau: f64, assembly: &mut Assembly) {
        // Without a Hessian there is nothing to project.
        let tau = if assembly.wants_hessian() { tau } else { 1.0 };
        if let Some(batch) = self.density.batch() {
            return self.add_derivatives_of_batch(batch, x, tau, assembly);
        }
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
        self.elements
            .iter()
            .map(|e: &Simplex<D>| self.guard.value(e.det(x), e.size))
            .sum()
    }

    fn forbids_flips(&self) -> bool {
        self.elements.iter().all(|e| e.floor >= 0.0)
    }
}

// One triangle or tetrahedron: from vertex positions to its Jacobian, and from derivatives in J back to the vertices.

/// An element in the form that sums over a mesh need. Its vertices are in increasing order, so that the blocks of its
/// Hessian lie in the lower triangle of the matrix. Its orientation is in the order of `gradients`.
#[derive(Clone, Copy, Debug)]
pub struct Simplex<const D: usize> {
    first: u32,
    others: [u32; D],
    /// Gradients of the barycentric coordinates of the other vertices.
    gradients: Matrix<D>,
    /// Determinant of the gradients: one over the determinant of the rest edges, with the sign of the reordering.
    orientation: f64,
    pub size: f64,
    pub weight: f64,
    /// Lower bound of det J.
    pub floor: f64,
}

/// Gradient and Hessian of one element's energy, to be distributed to the vertices.
pub struct Pulled<'a, const D: usize> {
    simplex: &'a Simplex<D>,
    modes: Modes<D>,
    u: Matrix<D>,
    u_transposed: Matrix<D>,
    /// Gradients of the barycentric coordinates in the frame of V.
    framed: Matrix<D>,
}

impl<const D: usize> Simplex<D>
where
    Matrix<D>: Square<D>,
{
    /// Creates the element with D + 1 vertices `first` and `others`, in the order of its rest shape.
    pub fn new(first: u32, others: [u32; D], rest: &RestShape<D>, floor: f64) -> Self {
        let mut opposite = [0.0; D];
        for gradient in &rest.inverse {
            for (sum, g) in opposite.iter_mut().zip(gradient) {
                *sum -= g;
            }
        }
        let mut simplex = Self {
            first,
            others,
            gradients: rest.inverse,
            orientation: 0.0,
            size: rest.size,
            weight: rest.weight,
            floor,
        };
        if let Some(k) = (0..D)
            .filter(|&k| others[k] < first)
            .min_by_key(|&k| others[k])
        {
            std::mem::swap(&mut simplex.first, &mut simplex.others[k]);
            simplex.gradients[k] = opposite;
        }
        let mut order: [usize; D] = array::from_fn(|k| k);
        order.sort_unstable_by_key(|&k| simplex.others[k]);
        simplex.others = order.map(|k| simplex.others[k]);
        simplex.gradients = order.map(|k| simplex.gradients[k]);
        simplex.orientation = simplex.gradients.det();
        simplex
    }

    /// Returns the vertices in increasing order.
    pub fn vertices(&self) -> impl Iterator<Item = u32> {
        std::iter::once(self.first).chain(self.others)
    }

    fn edges(&self, x: &[f64]) -> Matrix<D> {
        let position = |v: u32| -> [f64; D] { array::from_fn(|k| x[D * v as usize + k]) };
        let origin = position(self.first);
        self.others.map(|v| {
            let p = position(v);
            array::from_fn(|k| p[k] - origin[k])
        })
    }

    /// Returns det J: the present size over the rest size, signed.
    pub fn det(&self, x: &[f64]) -> f64 {
        self.edges(x).det() * self.orientation
    }

    /// Returns J and its determinant; computed from the edges it has a smaller rounding error than from J.
    pub fn jacobian(&self, x: &[f64]) -> (Matrix<D>, f64) {
        let edges = self.edges(x);
        (
            times(&transposed(&edges), &self.gradients),
            edges.det() * self.orientation,
        )
    }

    /// Returns the coefficients of det J(x + t d) − floor in powers of t.
    pub fn margin_polynomial(&self, x: &[f64], d: &[f64]) -> [f64; 4] {
        let mut margin = self
            .edges(x)
            .det_along(&self.edges(d))
            .map(|c| c * self.orientation);
        margin[0] -= self.floor;
        margin
    }

    /// Prepares derivatives in J for the vertices and multiplies the negative eigenvalues of the Hessian by `tau`.
    pub fn pull(&self, modes: Modes<D>, svd: &Svd<D>, tau: f64) -> Pulled<'_, D> {
        Pulled {
            simplex: self,
            modes: modes.project(tau),
            u: svd.u,
            u_transposed: transposed(&svd.u),
            framed: self.gradients.map(|g| apply_transposed(&svd.v, &g)),
        }
    }
}

impl<const D: usize> Pulled<'_, D> {
    /// Adds gradient and, if it is assembled, Hessian of the element with this stencil.
    fn distribute(&self, stencil: usize, assembly: &mut Assembly) {
        self.gradients(|vertex, gradient| assembly.add_gradient(vertex, &gradient));
        if assembly.wants_hessian() {
            self.add_blocks(stencil, assembly);
        }
    }

    /// Calls `add` with each vertex and its gradient.
    pub fn gradients(&self, mut add: impl FnMut(u32, [f64; D])) {
        let mut first = [0.0; D];
        for (&vertex, g) in self.simplex.others.iter().zip(&self.framed) {
            let scaled = array::from_fn(|k| self.modes.slope[k] * g[k]);
            let gradient = apply(&self.u, &scaled);
            for (sum, g) in first.iter_mut().zip(gradient) {
                *sum -= g;
            }
            add(vertex, gradient);
        }
        add(self.simplex.first, first);
    }

    /// Returns the block of the `k`-th and `l`-th of the other vertices, rows those of the `k`-th.
    fn block(&self, k: usize, l: usize) -> Matrix<D> {
        let framed = self.modes.block(&self.framed[k], &self.framed[l]);
        times(&times(&self.u, &framed), &self.u_transposed)
    }

    /// Adds the Hessian's blocks of every vertex and pair of vertices.
    ///
    /// The blocks of the first vertex follow from the others, because a common translation changes nothing.
    pub fn add_blocks(&self, stencil: usize, assembly: &mut Assembly) {
        // Row sums: minus the blocks of each of the other vertices with the first.
        let mut sums = [[[0.0; D]; D]; D];
        for k in 0..D {
            for l in 0..k {
                let block = self.block(k, l);
                add_to(&mut sums[k], &block);
                add_to(&mut sums[l], &transposed(&block));
                assembly.add_pair(stencil, k * (k + 1) / 2 + l + 1, &block);
            }
            let block = self.block(k, k);
            add_to(&mut sums[k], &block);
            assembly.add_diagonal(self.simplex.others[k], &block);
        }
        let mut first = [[0.0; D]; D];
        for (k, sum) in sums.iter().enumerate() {
            add_to(&mut first, sum);
            let negative = sum.map(|row| row.map(|x| -x));
            assembly.add_pair(stencil, k * (k + 1) / 2, &negative);
        }
        assembly.add_diagonal(self.simplex.first, &first);
    }
}

fn add_to<const D: usize>(sum: &mut Matrix<D>, share: &Matrix<D>) {
    for (sum, share) in sum.as_flattened_mut().iter_mut().zip(share.as_flattened()) {
        *sum += share;
    }
}

// First and second derivatives of an isotropic function of J, in the frame of its singular vectors.

/// Singular values that differ by less than this share of the largest count as equal before a division by their
/// difference.
const EQUAL: f64 = 1e-6;

/// Gradient and Hessian of ψ(σ(J)) with J = U diag(σ) Vᵀ:
///
/// ```text
/// ∇ψ = U diag(slope) Vᵀ
/// ∇²ψ has the eigenvectors U (eᵢeⱼᵀ − eⱼeᵢᵀ) Vᵀ/√2 with eigenvalues twist = (ψᵢ + ψⱼ)/(σᵢ + σⱼ),
///                          U (eᵢeⱼᵀ + eⱼeᵢᵀ) Vᵀ/√2 with eigenvalues flip = (ψᵢ − ψⱼ)/(σᵢ − σⱼ),
/// and on the span of the U eᵢeᵢᵀ Vᵀ the D×D block scaling = ∂²ψ/∂σ².
/// ```
/// Twist and flip of a pair are stored at `[i][j]` for i < j. From: Smith, de Goes, Kim 2019, Analytic Eigensystems for
/// Isotropic Distortion Energies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Modes<const D: usize> {
    /// ∂ψ/∂σᵢ.
    pub slope: [f64; D],
    /// ∂²ψ/∂σᵢ∂σⱼ.
    pub scaling: Matrix<D>,
    /// Curvature against rotations.
    pub twist: Matrix<D>,
    /// Curvature against turns of the directions of stretch.
    pub flip: Matrix<D>,
}

impl<const D: usize> Modes<D> {
    /// Computes the derivatives of `weight`·ψ.
    pub fn new(density: &dyn Density<D>, sigma: &[f64; D], weight: f64) -> Self {
        Self::of_derivatives(density, sigma, density.derivatives(sigma), weight)
    }

    /// Like [`new`](Self::new), given gradient and Hessian of ψ.
    fn of_derivatives(
        density: &dyn Density<D>,
        sigma: &[f64; D],
        (gradient, hessian): ([f64; D], Matrix<D>),
        weight: f64,
    ) -> Self {
        let (mut twist, mut flip) = ([[0.0; D]; D], [[0.0; D]; D]);
        for i in 0..D {
            for j in i + 1..D {
                twist[i][j] = weight * density.twist(sigma, &gradient, i, j);
                let difference = sigma[i] - sigma[j];
                flip[i][j] = weight
                    * if difference > EQUAL * sigma[0] {
                        (gradient[i] - gradient[j]) / difference
                    } else {
                        hessian[i][i] - hessian[i][j]
                    };
            }
        }
        Self {
            slope: gradient.map(|g| weight * g),
            scaling: hessian.map(|row| row.map(|h| weight * h)),
            twist,
            flip,
        }
    }

    /// Computes only the first derivatives of `weight`·ψ, given its gradient; the second are 0.
    pub fn of_slope(gradient: [f64; D], weight: f64) -> Self {
        Self {
            slope: gradient.map(|g| weight * g),
            scaling: [[0.0; D]; D],
            twist: [[0.0; D]; D],
            flip: [[0.0; D]; D],
        }
    }

    /// Adds the derivatives of a function φ(det J), given φ′ and φ″. With κᵢ = Π_{j≠i} σⱼ and κᵢⱼ = Π_{k≠i,j} σₖ:
    ///
    /// ```text
    /// slopeᵢ = φ′κᵢ    scalingᵢⱼ = φ″κᵢκⱼ + φ′κᵢⱼ (i ≠ j)    twistᵢⱼ = φ′κᵢⱼ    flipᵢⱼ = −φ′κᵢⱼ
    /// ```
    pub fn add_guard(&mut self, [first, second]: [f64; 2], sigma: &[f64; D]) {
        let without = |i: usize, j: usize| -> f64 {
            (0..D)
                .filter(|&k| k != i && k != j)
                .map(|k| sigma[k])
                .product()
        };
        let cofactors: [f64; D] = array::from_fn(|i| without(i, i));
        for i in 0..D {
            self.slope[i] += first * cofactors[i];
            self.scaling[i][i] += second * cofactors[i] * cofactors[i];
            for j in i + 1..D {
                let mixed = first * without(i, j);
                self.twist[i][j] += mixed;
                self.flip[i][j] -= mixed;
                let entry = second * cofactors[i] * cofactors[j] + mixed;
                self.scaling[i][j] += entry;
                self.scaling[j][i] += entry;
            }
        }
    }

    /// Replaces the negative eigenvalues λ of the Hessian by τλ: τ = 0 gives the nearest positive semidefinite Hessian,
    /// τ = 1 the true one. The slope does not change.
    #[must_use]
    pub fn project(mut self, tau: f64) -> Self {
        let relax = |lambda: f64| lambda.max(tau * lambda);
        self.twist = self.twist.map(|row| row.map(relax));
        self.flip = self.flip.map(|row| row.map(relax));
        self.scaling = relax_negative(&self.scaling, tau);
        self
    }

    /// Returns the coefficients of dFᵢⱼ² and dFᵢⱼ·dFⱼᵢ in the frame for a pair i, j: twist and flip as matrix entries.
    fn shear(&self, i: usize, j: usize) -> [f64; 2] {
        let (i, j) = (i.min(j), i.max(j));
        [
            0.5 * (self.flip[i][j] + self.twist[i][j]),
            0.5 * (self.flip[i][j] - self.twist[i][j]),
        ]
    }

    /// Returns the block of two vertices in the frame, given the gradients g and h of their barycentric coordinates
    /// there: entry `[r][s]` is the second derivative in coordinate r of the first vertex and s of the second.
    pub fn block(&self, g: &[f64; D], h: &[f64; D]) -> Matrix<D> {
        let mut block = [[0.0; D]; D];
        for r in 0..D {
            block[r][r] += self.scaling[r][r] * g[r] * h[r];
            for s in (0..D).filter(|&s| s != r) {
                let [straight, crossed] = self.shear(r, s);
                block[r][r] += straight * g[s] * h[s];
                block[r][s] += self.scaling[r][s] * g[r] * h[s] + crossed * g[s] * h[r];
            }
        }
        block
    }
}
