//! Barriers that go to infinity as an element degenerates.
//!
//! A barrier makes a map locally injective. It is a function of an element's size that is zero for elements of ordinary
//! size, so that it does not disturb the energy there, and grows to infinity as the size falls to ε. With a line search
//! that never steps past a root of an element's area, no element ever inverts: every iterate is a valid map. (Schüller,
//! Kavan, Panozzo, Sorkine-Hornung 2013, Locally Injective Mappings.)
//!
//! As a function of det J a barrier is isotropic too: it joins a density as a [`Guard`], with one
//! projection for both. Users choose a barrier by name ([`BarrierKind`]).

use crate::energy::{Density, Guard};
use crate::numerics::square::Matrix;
use std::sync::Arc;

/// Returns the paper's ε = 1e-5·(smallest rest area), or a tenth of the start's smallest area if that is less, so that
/// the start is inside the domain.
pub fn epsilon(smallest_rest_area: f64, smallest_start_area: f64) -> f64 {
    (1e-5 * smallest_rest_area).min(0.1 * smallest_start_area)
}

// Continuation to weaker barriers.

/// Factor of β per step. A larger one takes more minimizations for the same range.
const STEP: f64 = 0.1;

/// Most steps: β is then 1e-10 of its start.
const MAX_STEPS: i32 = 10;

/// Least decrease of the energy without the barrier that makes another step worthwhile, as a share of that energy.
pub const LEAST_GAIN: f64 = 1e-3;

/// Iterates over ever weaker strengths below `beta`, for minimizations that each start from the last map.
pub fn weaker_strengths(beta: f64) -> impl Iterator<Item = f64> {
    (1..=MAX_STEPS).map(move |step| beta * STEP.powi(step))
}

// Choice and parameters of a barrier.

/// Barrier that is added to the energy.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema, clap::ValueEnum))]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum BarrierKind {
    /// The inverse spline of the paper. No element inverts, and elements of ordinary size do not feel it.
    #[default]
    #[serde(alias = "spline", alias = "inverse_spline")]
    #[cfg_attr(feature = "schema", value(aliases = ["inverse_spline", "spline"]))]
    InverseSpline,
    /// The augmented logarithm.
    #[serde(alias = "auglog", alias = "augmented_log")]
    #[cfg_attr(feature = "schema", value(alias = "augmented_log"))]
    AugmentedLog,
    /// The logarithm.
    Log,
    /// The volume term of a neo-Hookean material.
    #[serde(alias = "neohookean", alias = "neo_hookean")]
    #[cfg_attr(feature = "schema", value(alias = "neo_hookean"))]
    NeoHookean,
    /// No barrier, for comparison. An energy that is finite everywhere may invert elements.
    None,
}

/// A barrier with its parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Barrier {
    /// Kind of barrier.
    pub kind: BarrierKind,
    /// β, the barrier's factor.
    pub beta: f64,
    /// s, the share of the rest size below which the inverse spline is nonzero.
    pub s: f64,
    /// ε, the size at which the barrier is infinite; see [`epsilon`].
    pub epsilon: f64,
}

impl Barrier {
    /// No barrier.
    pub const NONE: Self = Self {
        kind: BarrierKind::None,
        beta: 0.0,
        s: 1.0,
        epsilon: 0.0,
    };

    /// Calls `action` with the guard of this kind.
    fn with<R>(&self, action: impl FnOnce(&dyn Guard) -> R) -> R {
        let &Self {
            kind,
            beta,
            s,
            epsilon,
        } = self;
        match kind {
            BarrierKind::InverseSpline => action(&InverseSpline { beta, s, epsilon }),
            BarrierKind::AugmentedLog => action(&AugmentedLog { beta, epsilon }),
            BarrierKind::Log => action(&Log { beta, epsilon }),
            BarrierKind::NeoHookean => action(&NeoHookean { beta, epsilon }),
            BarrierKind::None => action(&NoBarrier),
        }
    }
}

impl Guard for Barrier {
    fn floor(&self, rest_size: f64) -> f64 {
        self.with(|guard| guard.floor(rest_size))
    }

    fn value(&self, det: f64, rest_size: f64) -> f64 {
        self.with(|guard| guard.value(det, rest_size))
    }

    fn derivatives(&self, det: f64, rest_size: f64) -> [f64; 2] {
        self.with(|guard| guard.derivatives(det, rest_size))
    }
}

// Logarithmic barriers.

/// The plain logarithm: nonzero at every size, without a minimum.
///
/// ```text
/// φ = −β log(λ − ε)
/// ```
/// λ is the element's size. Not weighted; β and ε are absolute. Unbounded below as λ grows, which pulls elements open.
/// Domain λ > ε, +∞ outside. From: Schüller et al. 2013, equation 7. Tests: `barrier::taylor_guards`.
#[derive(Clone, Copy, Debug)]
pub struct Log {
    /// β, the strength.
    pub beta: f64,
    /// ε, the smallest size.
    pub epsilon: f64,
}

impl Guard for Log {
    fn floor(&self, rest_size: f64) -> f64 {
        self.epsilon / rest_size
    }

    fn value(&self, det: f64, rest_size: f64) -> f64 {
        let c = det * rest_size - self.epsilon;
        if c > 0.0 {
            -self.beta * c.ln()
        } else {
            f64::INFINITY
        }
    }

    fn derivatives(&self, det: f64, rest_size: f64) -> [f64; 2] {
        let slope = 1.0 / (det - self.floor(rest_size));
        [-self.beta * slope, self.beta * slope * slope]
    }
}

/// The logarithm minus its slope at rest.
///
/// ```text
/// φ = β (−log(λ − ε) + (λ − λ⁰)/r + log r)     r = λ⁰ − ε
/// ```
/// Zero with zero slope at λ = λ⁰, which is its minimum. Not weighted; β and ε are absolute. Domain λ > ε, +∞ outside.
/// From: Schüller et al. 2013, section 3.1. Tests: `barrier::taylor_guards`, `barrier::guards_rest_at_rest`.
#[derive(Clone, Copy, Debug)]
pub struct AugmentedLog {
    /// β, the strength.
    pub beta: f64,
    /// ε, the smallest size.
    pub epsilon: f64,
}

impl Guard for AugmentedLog {
    fn floor(&self, rest_size: f64) -> f64 {
        self.epsilon / rest_size
    }

    fn value(&self, det: f64, rest_size: f64) -> f64 {
        let floor = self.floor(rest_size);
        let y = (det - floor) / (1.0 - floor);
        if y > 0.0 {
            self.beta * (y - 1.0 - y.ln())
        } else {
            f64::INFINITY
        }
    }

    fn derivatives(&self, det: f64, rest_size: f64) -> [f64; 2] {
        let floor = self.floor(rest_size);
        let slope = 1.0 / (det - floor);
        [
            self.beta * (1.0 / (1.0 - floor) - slope),
            self.beta * slope * slope,
        ]
    }
}

// The volume part of a Neo-Hookean material as a barrier.

/// The squared logarithm of the relative size.
///
/// ```text
/// φ = β log²((λ − ε)/(λ⁰ − 2ε))
/// ```
/// λ is the element's size, λ⁰ at rest. Minimum 0, where λ = λ⁰ − ε (the authors take ε off twice). Grows so slowly toward
/// ε that it often fails to hold. Not weighted; β and ε are absolute. Domain λ > ε, +∞ outside. From: Schüller et al. 2013,
/// equation 8. Tests: `barrier::taylor_guards`.
#[derive(Clone, Copy, Debug)]
pub struct NeoHookean {
    /// β, the strength.
    pub beta: f64,
    /// ε, the smallest size.
    pub epsilon: f64,
}

impl Guard for NeoHookean {
    fn floor(&self, rest_size: f64) -> f64 {
        self.epsilon / rest_size
    }

    fn value(&self, det: f64, rest_size: f64) -> f64 {
        let floor = self.floor(rest_size);
        let y = (det - floor) / (1.0 - 2.0 * floor);
        if y > 0.0 {
            self.beta * y.ln().powi(2)
        } else {
            f64::INFINITY
        }
    }

    fn derivatives(&self, det: f64, rest_size: f64) -> [f64; 2] {
        let floor = self.floor(rest_size);
        let c = det - floor;
        let log = (c / (1.0 - 2.0 * floor)).ln();
        [
            2.0 * self.beta * log / c,
            2.0 * self.beta * (1.0 - log) / (c * c),
        ]
    }
}

// The paper's barrier.

/// The reciprocal of a cubic spline of the element's size, zero for elements of ordinary size.
///
/// ```text
/// φ = β (1/g(y) − 1)   for y < 1, 0 above     y = (λ − ε)/(s (λ⁰ − ε))     g(y) = y³ − 3y² + 3y
/// ```
/// λ is the element's size, area or volume, λ⁰ at rest. Minimum 0, at y ≥ 1: with s = 1 from the rest size on; twice
/// continuously differentiable there. The paper has sλ⁰, its authors' code s(λ⁰ − ε), which is zero at rest. Not
/// weighted; β and ε are absolute, so scale a mesh to a mean size of 1 first. Domain λ > ε, +∞ outside. From: Schüller
/// et al. 2013, equations 2 to 6. Tests: `barrier::taylor_*`, `barrier::spline_is_infinite_at_epsilon`.
#[derive(Clone, Copy, Debug)]
pub struct InverseSpline {
    /// β, the strength.
    pub beta: f64,
    /// s, the support as a share of the rest size.
    pub s: f64,
    /// ε, the smallest size.
    pub epsilon: f64,
}

impl InverseSpline {
    /// Returns s(1 − ε/λ⁰): the det J above the floor at which the support ends.
    fn support(&self, rest_size: f64) -> f64 {
        self.s * (1.0 - self.floor(rest_size))
    }

    fn y(&self, det: f64, rest_size: f64) -> f64 {
        (det - self.floor(rest_size)) / self.support(rest_size)
    }
}

/// Returns 1/g(y) − 1 and its first two derivatives, 0 for y ≥ 1; y > 0.
///
/// g is y³ − 3y² + 3y, not written as 1 − (1 − y)³, which would cancel near 0, where accuracy matters.
pub(super) fn reciprocal(y: f64) -> [f64; 3] {
    if y >= 1.0 {
        return [0.0; 3];
    }
    let left = 1.0 - y;
    let inverse = 1.0 / (y * (3.0 - 3.0 * y + y * y));
    let slope = 3.0 * left * left * inverse;
    [
        inverse - 1.0,
        -slope * inverse,
        (2.0 * slope * slope + 6.0 * left * inverse) * inverse,
    ]
}

impl Guard for InverseSpline {
    fn floor(&self, rest_size: f64) -> f64 {
        self.epsilon / rest_size
    }

    fn value(&self, det: f64, rest_size: f64) -> f64 {
        let y = self.y(det, rest_size);
        if y > 0.0 {
            self.beta * reciprocal(y)[0]
        } else {
            f64::INFINITY
        }
    }

    fn derivatives(&self, det: f64, rest_size: f64) -> [f64; 2] {
        let support = self.support(rest_size);
        let [_, first, second] = reciprocal(self.y(det, rest_size));
        [
            self.beta / support * first,
            self.beta / (support * support) * second,
        ]
    }
}

// No barrier.

/// Zero everywhere: the density alone decides what is in the domain.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoBarrier;

impl Guard for NoBarrier {
    fn floor(&self, _: f64) -> f64 {
        f64::NEG_INFINITY
    }

    fn value(&self, _: f64, _: f64) -> f64 {
        0.0
    }

    fn derivatives(&self, _: f64, _: f64) -> [f64; 2] {
        [0.0; 2]
    }
}

// Conformal distortion bounded from above.

/// A density of the plane with a barrier that keeps the conformal distortion q = σ₁/σ₂ below a bound K.
///
/// ```text
/// ψ + β (1/g(y) − 1)   for y < 1, ψ above     y = (K − q)/((1 − a) K)     g(y) = y³ − 3y² + 3y
/// ```
/// The barrier is zero for q ≤ aK, so it does not affect ordinary triangles, and infinite at q = K: as the inverse
/// spline keeps triangles from inverting, it keeps them from degenerating to needles. Weighted like ψ. Domain: that of
/// ψ with det J > 0 and q < K, +∞ outside; the start must be inside. From: Schüller et al. 2013, section 6 (future
/// work). Tests: `barrier::taylor_bounded`, `deform::conformal_distortion_stays_below_its_bound`.
#[derive(Clone, Debug)]
pub struct Bounded {
    /// ψ.
    pub density: Arc<dyn Density<2>>,
    /// K > 1.
    pub bound: f64,
    /// β, the strength.
    pub beta: f64,
}

/// a: the share of the bound above which the barrier is nonzero.
const ONSET: f64 = 0.7;

impl Bounded {
    /// Returns the barrier and its first two derivatives in q; zero for q ≤ aK.
    fn barrier(&self, q: f64) -> [f64; 3] {
        let support = (1.0 - ONSET) * self.bound;
        let [value, first, second] = reciprocal((self.bound - q) / support);
        [
            self.beta * value,
            -self.beta / support * first,
            self.beta / (support * support) * second,
        ]
    }
}

impl Density<2> for Bounded {
    fn floor(&self) -> f64 {
        self.density.floor().max(0.0)
    }

    fn value(&self, sigma: &[f64; 2]) -> f64 {
        let [a, b] = *sigma;
        if b <= 0.0 || a >= self.bound * b {
            return f64::INFINITY;
        }
        self.density.value(sigma) + self.barrier(a / b)[0]
    }

    fn gradient(&self, sigma: &[f64; 2]) -> [f64; 2] {
        let mut gradient = self.density.gradient(sigma);
        let [a, b] = *sigma;
        let [_, first, _] = self.barrier(a / b);
        gradient[0] += first / b;
        gradient[1] -= first * a / (b * b);
        gradient
    }

    fn hessian(&self, sigma: &[f64; 2]) -> Matrix<2> {
        let mut hessian = self.density.hessian(sigma);
        let [a, b] = *sigma;
        let [_, first, second] = self.barrier(a / b);
        let slope = [1.0 / b, -a / (b * b)];
        let mixed = -1.0 / (b * b);
        let curvature = [[0.0, mixed], [mixed, 2.0 * a / (b * b * b)]];
        for i in 0..2 {
            for j in 0..2 {
                hessian[i][j] += second * slope[i] * slope[j] + first * curvature[i][j];
            }
        }
        hessian
    }

    fn twist(&self, sigma: &[f64; 2], gradient: &[f64; 2], i: usize, j: usize) -> f64 {
        self.density.twist(sigma, gradient, i, j)
    }
}
