//! Boundaries that may not cross themselves: derivatives, steps, a horseshoe whose ends are dragged through one another.

use std::cell::Cell;

use faer::Side;
use unwrapd_deform::boundary_barrier::BoundaryBarrier;
use unwrapd_deform::{Body, Handle, Model, Problem, ProblemError, Solution};
use unwrapd_maps::certificate::{Claims, Padding, boundary_crossings, certify, certify_planar};
use unwrapd_maps::mesh::{PlanarMesh, Resolution};
use unwrapd_method::barrier::BarrierKind;
use unwrapd_method::energy::Term;
use unwrapd_method::solver::{Control, Iterate, Settings, Status, Watch};

use crate::random::Random;
use crate::terms::{assert_term_taylor, derivatives};
use crate::uv_meshes::UvMesh;

const TWO: [[u32; 3]; 2] = [[0, 1, 2], [5, 3, 4]];
/// Two triangles well apart.
const APART: [f64; 12] = [0.0, 0.0, 2.0, 0.1, 1.1, 1.0, 0.9, 3.0, 2.8, 3.1, 2.0, 4.0];
const WAY: [f64; 12] = [
    0.3, -0.2, 0.15, 0.4, -0.35, 0.2, 0.1, -0.3, 0.25, -0.15, 0.05, 0.3,
];

/// The barrier of the two triangles, the second one moved, with the pairs that are near then.
fn moved(by: [f64; 2]) -> (BoundaryBarrier, Vec<f64>) {
    let mut barrier = BoundaryBarrier::new(&TWO, &APART).with_beta(0.7);
    let mut x = APART.to_vec();
    for p in x[6..].chunks_exact_mut(2) {
        p[0] += by[0];
        p[1] += by[1];
    }
    assert!(barrier.renew(&x) && !barrier.renew(&x));
    (barrier, x)
}

#[test]
fn taylor_of_a_vertex_at_an_edge_and_at_a_vertex() {
    for by in [[-0.8, -1.8], [0.15, -1.85], [-2.0, -1.9]] {
        let (barrier, x) = moved(by);
        assert_term_taylor(&barrier, &x, &WAY);
    }
}

#[test]
fn negative_curvature_is_removed() {
    for by in [[-0.8, -1.8], [0.15, -1.85], [-2.0, -1.9]] {
        let (barrier, x) = moved(by);
        let least = |tau: f64| {
            let (_, hessian) = derivatives(&barrier, &x, tau);
            let values = hessian.self_adjoint_eigenvalues(Side::Lower);
            let values = values.expect("eigenvalues");
            (values[0], values[values.len() - 1])
        };
        let (least_true, most) = least(1.0);
        assert!(least_true < -1e-3 * most, "{by:?}: {least_true:e}");
        assert!(least(0.0).0 > -1e-12 * most, "{by:?}");
    }
}

#[test]
fn nothing_is_felt_at_the_start_and_contact_is_infinite() {
    let barrier = BoundaryBarrier::new(&TWO, &APART).with_beta(1.0);
    assert_eq!(barrier.value(&APART), 0.0);
    let mut x = APART;
    // Vertex 3 comes upon vertex 2.
    (x[6], x[7]) = (x[4], x[5]);
    assert_eq!(barrier.value(&x), f64::INFINITY);
}

#[test]
fn what_lies_beside_is_felt_at_the_distance_that_the_judge_measures() {
    let triangles = [[0, 1, 2], [3, 4, 5]];
    let at = |x: f64| {
        let left = [[0.0, 0.0], [0.25, 0.0], [0.25, 0.25]];
        let right = [[x, 0.0], [x + 0.25, 0.0], [x, 0.25]];
        [left, right].concat()
    };
    let barrier = BoundaryBarrier::new(&triangles, at(0.75).as_flattened()).with_beta(1.0);
    let support = 0.25 * 0.25 * (2.0 + 2.0_f64.sqrt()) / 3.0;
    for gap in [0.05, 0.01, 0.001] {
        let vertices = at(0.25 + gap);
        let mesh = UvMesh::planar(&vertices, &triangles);
        let claims = Claims {
            padding: Some(Padding {
                texels: 1,
                resolution: Resolution::square(1024),
            }),
            ..Claims::default()
        };
        let verdict = certify(&mesh.positions, &mesh.triangles, &mesh.uvs, &claims).padding;
        let reached = verdict.and_then(|verdict| verdict.reached_texels);
        let y = reached.expect("two charts") / 1024.0 / support;
        // Each end of the two sides is as near to the other side and to the edge that goes on there.
        let expected = 8.0 * (1.0 / (y * y * y - 3.0 * y * y + 3.0 * y) - 1.0);
        let value = barrier.value(vertices.as_flattened());
        assert!((value / expected - 1.0).abs() < 1e-6, "{value} {expected}");
    }
}

#[test]
fn no_step_passes_through() {
    let barrier = BoundaryBarrier::new(&TWO, &APART).with_beta(1.0);
    let down = |speed: f64| {
        let mut direction = [0.0; 12];
        for k in [7, 9, 11] {
            direction[k] = -speed;
        }
        direction
    };
    // The apex at height 1 is met by the edge between heights 3 and 3.1.
    for speed in [1.5, 40.0] {
        let met = (3.0 + 0.1 * 0.2 / 1.9 - 1.0) / speed;
        let step = barrier.largest_step(&APART, &down(speed));
        assert!((0.8 * met..met).contains(&step), "{step} of {met}");
    }
    assert_eq!(barrier.largest_step(&APART, &down(-3.0)), f64::INFINITY);
    assert_eq!(barrier.largest_step(&APART, &[1e3; 12]), f64::INFINITY);

    let horseshoe = horseshoe();
    let start = horseshoe.vertices().as_flattened();
    let barrier = BoundaryBarrier::new(horseshoe.triangles(), start).with_beta(1.0);
    let mut random = Random::new(7);
    let mut n_met = 0;
    for _ in 0..60 {
        let direction: Vec<f64> = start.iter().map(|_| 4.0 * random.next() - 2.0).collect();
        let step = barrier.largest_step(start, &direction);
        n_met += u32::from(step < 1.0);
        for part in 0..=20 {
            let t = 0.05 * f64::from(part) * step.min(1.0);
            let x: Vec<f64> = (start.iter().zip(&direction))
                .map(|(x, d)| x + t * d)
                .collect();
            let crossings = boundary_crossings(x.as_chunks().0, horseshoe.triangles());
            assert_eq!(crossings, 0, "at {t} of {step}");
        }
    }
    assert!(n_met > 50, "{n_met}");
}

const SECTIONS: u32 = 30;

/// A strip two cells wide along five sixths of a circle, its gap on the right.
fn horseshoe() -> PlanarMesh {
    let vertex = |v: u32| {
        let turn = f64::from(v / 3) / f64::from(SECTIONS) * 300.0 + 30.0;
        let radius = 3.0 + 0.5 * f64::from(v % 3);
        let (sin, cos) = turn.to_radians().sin_cos();
        [radius * cos, radius * sin]
    };
    let triangles = (0..2 * SECTIONS).flat_map(|cell| {
        let a = cell / 2 * 3 + cell % 2;
        [[a, a + 1, a + 4], [a, a + 4, a + 3]]
    });
    let vertices = (0..3 * (SECTIONS + 1)).map(vertex).collect();
    PlanarMesh::new(vertices, triangles.collect()).expect("a horseshoe")
}

/// Watches that no iterate crosses itself.
struct Uncrossed<'a> {
    mesh: &'a PlanarMesh,
    seen: Cell<usize>,
}

impl Watch for Uncrossed<'_> {
    fn iterate(&self, iterate: &Iterate) -> Control {
        assert!(iterate.smallest > 0.0);
        Control::Continue
    }

    fn positions(&self, _: &Iterate, x: &[f64]) {
        let crossings = boundary_crossings(x.as_chunks().0, self.mesh.triangles());
        assert_eq!(crossings, 0, "iterate {}", self.seen.get());
        self.seen.set(self.seen.get() + 1);
    }
}

/// The middles of the horseshoe's ends, pulled to these places.
fn ends(to: [[f64; 2]; 2]) -> [Handle; 2] {
    let vertex = |vertex: u32, to: [f64; 2]| Handle::Vertex {
        vertex,
        to: to.to_vec(),
        weight: None,
    };
    [vertex(1, to[0]), vertex(3 * SECTIONS + 1, to[1])]
}

/// How often the boundary of a deformed mesh meets itself.
fn crossings(mesh: &PlanarMesh, solution: &Solution) -> u64 {
    boundary_crossings(solution.x.as_chunks().0, mesh.triangles())
}

/// The back of the horseshoe held and its ends pulled.
fn pulled(mesh: &PlanarMesh, [first, second]: [Handle; 2], bijective: bool) -> Solution {
    let back = 3 * (SECTIONS / 2) + 1;
    let held = Handle::Vertex {
        vertex: back,
        to: mesh.vertices()[back as usize].to_vec(),
        weight: None,
    };
    let handles = [held, first, second];
    let model = Model {
        bijective,
        ..Model::default()
    };
    let problem = Problem::new(Body::from(mesh), &handles, &model).expect("a problem");
    let uncrossed = Uncrossed {
        mesh,
        seen: Cell::new(0),
    };
    let unwatched = |_: &Iterate| Control::Continue;
    let watch: &dyn Watch = if bijective { &uncrossed } else { &unwatched };
    let solution = problem
        .solve(&Settings::follow(), watch)
        .expect("a solution");
    assert_eq!(solution.quality.inverted, 0);
    assert!(!bijective || uncrossed.seen.get() > solution.summary.iterations);
    solution
}

#[test]
fn ends_of_a_horseshoe_are_dragged_through_one_another() {
    let mesh = horseshoe();
    // Each to where the other was: vertices, and points inside the first and the last triangle.
    let vertices = ends([3 * SECTIONS + 1, 1].map(|v| mesh.vertices()[v as usize]));
    let middle = |triangle: &[u32; 3]| {
        let sum = |k: usize| {
            triangle
                .iter()
                .map(|&v| mesh.vertices()[v as usize][k])
                .sum::<f64>()
        };
        vec![sum(0) / 3.0, sum(1) / 3.0]
    };
    let [a, b] = [0, mesh.triangles().len() - 1].map(|t| middle(&mesh.triangles()[t]));
    let point = |at: &[f64], to: &[f64]| Handle::Point {
        at: at.to_vec(),
        to: to.to_vec(),
        weight: None,
    };
    for ends in [vertices, [point(&a, &b), point(&b, &a)]] {
        let free = pulled(&mesh, ends.clone(), false);
        assert_eq!(free.summary.status, Status::Converged);
        assert!(crossings(&mesh, &free) > 0, "{:?}", free.quality);

        let kept = pulled(&mesh, ends, true);
        assert_eq!(crossings(&mesh, &kept), 0);
        assert_eq!(kept.summary.status, Status::Converged, "{:?}", kept.quality);
        assert!(kept.quality.residual < 1e-16 && kept.quality.energy > free.quality.energy);
    }
}

#[test]
fn targets_in_one_place_are_not_reached() {
    let mesh = horseshoe();
    let kept = pulled(&mesh, ends([[3.4, 0.01]; 2]), true);
    assert_eq!(kept.summary.status, Status::TargetsUnreachable);
    assert_eq!(crossings(&mesh, &kept), 0);
    // They come as near as the barrier lets them.
    assert!(
        0.0 < kept.quality.residual && kept.quality.residual < 0.2,
        "{:?}",
        kept.quality
    );
}

#[test]
fn what_cannot_be_kept_bijective_is_refused() {
    let model = Model {
        bijective: true,
        ..Model::default()
    };
    let held = Handle::Vertex {
        vertex: 0,
        to: vec![0.0, 0.0],
        weight: None,
    };
    let of = |vertices: Vec<[f64; 2]>, model: &Model| {
        let mesh = PlanarMesh::new(vertices, vec![[0, 1, 2], [3, 4, 5]]).expect("triangles");
        Problem::new(Body::from(&mesh), std::slice::from_ref(&held), model).map(|_| ())
    };
    let corner = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
    let beside = |by: f64| [&corner[..], &corner.map(|p| [p[0] + by, p[1]])].concat();
    assert_eq!(of(beside(1.1), &model), Ok(()));
    // The tip of one touches the other, and one overlaps the other.
    for by in [1.0, 0.5] {
        assert_eq!(of(beside(by), &model), Err(ProblemError::OverlappingStart));
    }
    // One lies within the other: no boundary is near.
    let within = corner.map(|p| p.map(|x| 0.25 + 0.25 * x));
    let nested = [corner, within].concat();
    let judged = certify_planar(&nested, &[[0, 1, 2], [3, 4, 5]]);
    assert!(judged.is_valid() && !judged.is_bijective());
    assert_eq!(of(nested, &model), Err(ProblemError::OverlappingStart));
    let free = Model {
        barrier: BarrierKind::None,
        ..model
    };
    let refused = of(beside(1.1), &free);
    assert!(matches!(
        refused,
        Err(ProblemError::BadParameter {
            name: "bijective",
            ..
        })
    ));
}
