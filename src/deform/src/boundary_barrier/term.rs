//! The sum of the barrier over pairs.

use super::gap::Gap;
use super::pairs::{Pair, near_pairs, place};
use unwrapd_maps::mesh::boundary_edges;
use unwrapd_method::barrier::InverseSpline;
use unwrapd_method::energy::{Assembly, Guard, Term};
use unwrapd_method::numerics::stencils::Stencils;
use unwrapd_method::numerics::vec2::sub;

/// Largest support, in units of the boundary's mean edge: less than the distance of ordinary vertices.
const SUPPORT: f64 = 0.25;

/// Pairs up to this many times their support apart are in the pattern, so that most pairs that come near are there
/// already.
const FORESIGHT: f64 = 2.0;

/// Σ over the pairs of a boundary vertex and a boundary edge of φ(distance): infinite where they meet.
///
/// ```text
/// φ(d) = β (1/g(y) − 1)   for y < 1, 0 above     y = d/d⁰     g(y) = y³ − 3y² + 3y
/// ```
/// [`InverseSpline`] of the distance; d⁰ is a quarter of the boundary's mean edge, or the distance of the pair at the
/// start if that is less. Minimum 0, at the start and wherever nothing is near. Domain: d > 0, connected with the
/// start. Twice continuously differentiable except where the nearest point of the edge reaches an end. Tests:
/// `bijective::taylor_*`, `bijective::no_step_passes_through`.
#[derive(Clone, Debug)]
pub struct BoundaryBarrier {
    edges: Vec<[u32; 2]>,
    start: Vec<f64>,
    support: f64,
    beta: f64,
    /// Pairs in the pattern, in increasing order.
    pairs: Vec<Pair>,
}

impl BoundaryBarrier {
    /// Creates the barrier around `triangles`, which neither overlap nor touch with their vertices at `start`.
    pub fn new(triangles: &[[u32; 3]], start: &[f64]) -> Self {
        let edges = boundary_edges(start.len() / 2, triangles);
        let length = |[a, b]: &[u32; 2]| {
            let [x, y] = sub(place(start, *a), place(start, *b));
            x.hypot(y)
        };
        let mean = edges.iter().map(length).sum::<f64>() / edges.len().max(1) as f64;
        Self {
            support: SUPPORT * mean,
            start: start.to_vec(),
            beta: 0.0,
            pairs: Vec::new(),
            edges,
        }
    }

    /// Changes the strength to β.
    #[must_use]
    pub fn with_beta(&self, beta: f64) -> Self {
        Self {
            beta,
            ..self.clone()
        }
    }

    /// Returns φ for a pair.
    fn spline(&self, pair: &Pair) -> InverseSpline {
        InverseSpline {
            beta: self.beta,
            s: self
                .support
                .min(Gap::new(pair.places(&self.start)).distance),
            epsilon: 0.0,
        }
    }

    /// Visits the pairs that are nearer at `x` than `times` their support.
    fn near(&self, x: &[f64], times: f64, mut visit: impl FnMut(Pair, &InverseSpline, Gap)) {
        near_pairs(&self.edges, x, x, times * self.support, |pair| {
            let gap = Gap::new(pair.places(x));
            if gap.distance < times * self.support {
                let spline = self.spline(&pair);
                if gap.distance < times * spline.s || gap.distance == 0.0 {
                    visit(pair, &spline, gap);
                }
            }
        });
    }
}

impl Term for BoundaryBarrier {
    fn dim(&self) -> usize {
        2
    }

    fn stencils(&self) -> Stencils {
        let vertices = self.pairs.iter().flat_map(|pair| {
            let mut vertices = pair.vertices();
            vertices.sort_unstable();
            vertices
        });
        Stencils::uniform(3, vertices)
    }

    fn renew(&mut self, x: &[f64]) -> bool {
        let mut is_missing = false;
        self.near(x, 1.0, |pair, _, _| {
            is_missing |= self.pairs.binary_search(&pair).is_err();
        });
        if is_missing {
            let mut pairs = Vec::new();
            self.near(x, FORESIGHT, |pair, _, _| pairs.push(pair));
            pairs.sort_unstable();
            self.pairs = pairs;
        }
        is_missing
    }

    fn value(&self, x: &[f64]) -> f64 {
        let mut sum = 0.0;
        self.near(x, 1.0, |_, spline, gap| {
            sum += spline.value(gap.distance, 1.0);
        });
        sum
    }

    fn barrier(&self, x: &[f64]) -> f64 {
        self.value(x)
    }

    fn add_derivatives(&self, x: &[f64], tau: f64, assembly: &mut Assembly) {
        for (stencil, pair) in self.pairs.iter().enumerate() {
            let gap = Gap::new(pair.places(x));
            let spline = self.spline(pair);
            if gap.distance < spline.s {
                let derivatives = spline.derivatives(gap.distance, 1.0);
                add(pair, stencil, &gap, derivatives, tau, assembly);
            }
        }
    }

    fn largest_step(&self, x: &[f64], direction: &[f64]) -> f64 {
        time_of_contact(&self.edges, x, direction, self.support)
    }
}

/// Adds the derivatives of one summand.
fn add(
    pair: &Pair,
    stencil: usize,
    gap: &Gap,
    derivatives: [f64; 2],
    tau: f64,
    assembly: &mut Assembly,
) {
    let vertices = pair.vertices();
    for (vertex, gradient) in vertices.iter().zip(gap.gradient(derivatives[0])) {
        assembly.add_gradient(*vertex, &gradient);
    }
    // Sum the modes to blocks; negative curvature is scaled by τ.
    let modes = gap.modes(derivatives);
    let block = |i: usize, j: usize| {
        let mut block = [[0.0; 2]; 2];
        for (lambda, u) in &modes {
            let lambda = lambda.max(tau * lambda);
            for r in 0..2 {
                for c in 0..2 {
                    block[r][c] += lambda * u[i][r] * u[j][c];
                }
            }
        }
        block
    };
    // Add the blocks in the order of the stencil, whose vertices increase.
    let mut order = [0, 1, 2];
    order.sort_unstable_by_key(|&i| vertices[i]);
    for (k, &i) in order.iter().enumerate() {
        assembly.add_diagonal(vertices[i], &block(i, i));
        for (l, &j) in order[..k].iter().enumerate() {
            assembly.add_pair(stencil, k * (k - 1) / 2 + l, &block(i, j));
        }
    }
}

// Largest step before a boundary meets itself.

/// Longest step that is ever asked for: twice a Newton step.
const LONGEST: f64 = 2.0;

/// Growth of the searched part of a step while it has no contact.
const GROWTH: f64 = 4.0;

/// Least share of a distance left at the reported contact; at most twice that.
const LEFT: f64 = 0.1;

/// Most advances. Each is safe, so a pair that slides for long only gets a shorter step.
const MOST_ADVANCES: usize = 100;

/// Returns a time t > 0 before which no pair of a boundary meets when its vertices move from `x` along `direction`; +∞
/// if none does up to [`LONGEST`]. At most a fifth short of the first contact, unless a pair slides.
///
/// Searches piece by piece, the first no longer than `reach`, so that a long direction does not sweep over everything.
fn time_of_contact(edges: &[[u32; 2]], x: &[f64], direction: &[f64], reach: f64) -> f64 {
    let motion = relative(edges, direction);
    let speeds = edges.iter().map(|e| norm(place(&motion, e[0])));
    let fastest = speeds.fold(0.0, f64::max);
    if fastest == 0.0 {
        return f64::INFINITY;
    }
    let mut horizon = (reach / fastest).min(LONGEST);
    loop {
        let to: Vec<f64> = (x.iter().zip(&motion))
            .map(|(x, d)| x + horizon * d)
            .collect();
        let mut first = horizon;
        // Enlarge the boxes a little, so that rounding hides no contact.
        near_pairs(edges, x, &to, 1e-6 * reach, |pair| {
            first = contact_before(first, pair.places(x), pair.places(&motion));
        });
        if first < horizon {
            return first;
        }
        if horizon >= LONGEST {
            return f64::INFINITY;
        }
        horizon = (GROWTH * horizon).min(LONGEST);
    }
}

/// Subtracts the mean motion of the boundary, which brings nothing nearer.
fn relative(edges: &[[u32; 2]], direction: &[f64]) -> Vec<f64> {
    let mut mean = [0.0; 2];
    for edge in edges {
        let d = place(direction, edge[0]);
        for k in 0..2 {
            mean[k] += d[k] / edges.len() as f64;
        }
    }
    let mut motion = direction.to_vec();
    for d in motion.as_chunks_mut::<2>().0 {
        *d = [d[0] - mean[0], d[1] - mean[1]];
    }
    motion
}

/// Returns a time before the vertex and the edge of a pair meet if that is less than `most`, else `most`.
///
/// In a time t the distance falls by at most t times the greatest relative speed, so each advance by what this allows
/// is safe.
fn contact_before(most: f64, places: [[f64; 2]; 3], motion: [[f64; 2]; 3]) -> f64 {
    let mean = [0, 1].map(|k| (motion[0][k] + motion[1][k] + motion[2][k]) / 3.0);
    let motion = motion.map(|d| [d[0] - mean[0], d[1] - mean[1]]);
    let speed = norm(motion[0]) + norm(motion[1]).max(norm(motion[2]));
    let distance_at = |t: f64| {
        let moved = [0, 1, 2].map(|i| [0, 1].map(|k| places[i][k] + t * motion[i][k]));
        Gap::new(moved).distance
    };
    let mut distance = distance_at(0.0);
    let left = LEFT * distance;
    let mut time = 0.0;
    for _ in 0..MOST_ADVANCES {
        let advanced = time + (distance - left) / speed;
        if advanced >= most || advanced.is_nan() {
            return most;
        }
        time = advanced;
        distance = distance_at(time);
        if distance < 2.0 * left {
            break;
        }
    }
    time
}

fn norm([x, y]: [f64; 2]) -> f64 {
    x.hypot(y)
}
