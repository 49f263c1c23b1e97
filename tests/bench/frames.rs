//! Frames of a session: a handle has moved a little, then the map follows by one iteration.
//!
//! `cargo bench --bench frames -- [CASE …]`; without arguments `plane-50` and `plane-158` (N×N
//! squares, two triangles each) and `armadillo` (55,000 tetrahedra of a file). One end is held, a ball at the other is dragged along
//! a circle, ARAP with the barrier. Prints milliseconds of the processor per frame, their median and 95th of a hundred, what the parts
//! of an iteration cost at the end, and the energy after three frames beside that of [`Problem::solve`] ended after one iteration in
//! each.

#[expect(dead_code, reason = "only seconds are wanted")]
mod clock;
#[expect(dead_code, reason = "only a path is wanted")]
mod meshes;

use std::hint::black_box;

use clock::Clock;
use unwrapd::deform::{Body, Handle, HandleId, Model, Problem, Session};
use unwrapd::io::gmsh;
use unwrapd::mesh::PlanarMesh;
use unwrapd::solver::{Control, Iterate, Objective, Settings, Stage};

/// Without arguments.
const CASES: [&str; 3] = ["plane-50", "plane-158", "armadillo"];

/// Frames of a drag.
const FRAMES: usize = 100;

/// The radii of the balls at the ends and of the circle, as shares of the length.
const BALL: f64 = 0.1;
const CIRCLE: f64 = 0.1;

fn main() {
    let mut cases: Vec<String> = std::env::args()
        .skip(1)
        .filter(|a| !a.starts_with('-'))
        .collect();
    if cases.is_empty() {
        cases = CASES.map(str::to_owned).to_vec();
    }
    for case in cases {
        report(&case);
    }
}

fn body(case: &str) -> Body {
    if let Some(n) = case.strip_prefix("plane-") {
        return Body::from(&plane(n.parse().expect("a number of squares")));
    }
    let bytes = std::fs::read(meshes::path("tet/Armadillo13K.msh")).expect("test data");
    let elements = gmsh::read(&bytes).expect("a mesh");
    Body::from(&elements.into_tet_mesh().expect("tetrahedra"))
}

/// A sheet of `n` by `n` unit squares.
fn plane(n: u32) -> PlanarMesh {
    let index = |i: u32, j: u32| i * (n + 1) + j;
    let vertices = (0..=n).flat_map(|i| (0..=n).map(move |j| [f64::from(i), f64::from(j)]));
    let squares = (0..n).flat_map(|i| (0..n).map(move |j| (i, j)));
    let triangles = squares.flat_map(|(i, j)| {
        let [a, b] = [index(i, j), index(i + 1, j)];
        [[a, b, b + 1], [a, b + 1, a + 1]]
    });
    PlanarMesh::new(vertices.collect(), triangles.collect()).expect("a sheet")
}

/// What is dragged.
struct InteractiveContinuation {
    held: Handle,
    center: Vec<f64>,
    radius: f64,
    length: f64,
}

impl InteractiveContinuation {
    /// The vertices that are first and last along the second axis.
    fn of(body: &Body) -> Self {
        let dim = body.dim();
        let along = |p: &&[f64]| p[1];
        let points = || body.rest.chunks_exact(dim);
        let by = |p: &&[f64], q: &&[f64]| along(p).total_cmp(&along(q));
        let low = points().min_by(by).expect("vertices");
        let high = points().max_by(by).expect("vertices");
        let length = high[1] - low[1];
        let radius = BALL * length;
        Self {
            held: Handle::Disc {
                center: low.to_vec(),
                radius,
                to: low.to_vec(),
                turn: 0.0,
                axis: None,
                weight: None,
            },
            center: high.to_vec(),
            radius,
            length,
        }
    }

    /// Where the dragged end is in a frame.
    fn target(&self, frame: usize) -> Vec<f64> {
        let angle = std::f64::consts::TAU * frame as f64 / FRAMES as f64;
        let mut to = self.center.clone();
        to[0] += CIRCLE * self.length * angle.sin();
        to[1] += CIRCLE * self.length * (1.0 - angle.cos());
        to
    }

    fn handles(&self, frame: usize) -> [Handle; 2] {
        let dragged = Handle::Disc {
            center: self.center.clone(),
            radius: self.radius,
            to: self.target(frame),
            turn: 0.0,
            axis: None,
            weight: None,
        };
        [self.held.clone(), dragged]
    }

    fn session(&self, body: &Body) -> (Session, HandleId) {
        let mut session = Session::new(body.clone(), &Model::default()).expect("an energy");
        let [held, dragged] = self.handles(0);
        session.add(held).expect("a handle");
        let id = session.add(dragged).expect("a handle");
        session.step_while(|_| true);
        (session, id)
    }
}

fn report(case: &str) {
    let body = body(case);
    let drag = InteractiveContinuation::of(&body);
    let (mut session, id) = drag.session(&body);
    let mut times = Vec::with_capacity(FRAMES);
    let before = *session.summary();
    for frame in 1..=FRAMES {
        let clock = Clock::start();
        let target = drag.target(frame);
        session.move_handle(id, &target).expect("a target");
        black_box(session.step());
        black_box(session.positions());
        times.push(1e3 * clock.seconds().processor);
        assert!(session.quality().smallest > 0.0, "valid at every iterate");
    }
    let of_frames = session.summary().factorizations - before.factorizations;
    let last = session.quality();
    let clock = Clock::start();
    let stage = session.step_while(|_| true);
    times.sort_by(f64::total_cmp);
    println!(
        "{case}: {} elements, {} vertices: a frame {:.1} ms, 95 of 100 {:.1} ms, worst {:.1} ms; {of_frames} factorizations in {FRAMES} \
         frames, {} analyses; energy {:.6}, {stage:?} at {:.6} {:.0} ms later",
        body.determinants().len(),
        body.n_vertices(),
        times[FRAMES / 2],
        times[FRAMES * 95 / 100],
        times[FRAMES - 1],
        session.analyses(),
        last.energy + last.barrier,
        session.quality().energy + session.quality().barrier,
        1e3 * clock.seconds().processor,
    );
    assert!(stage == Stage::Settled);
    parts(case, &body, &drag, &session);
    three_frames(case, &body, &drag);
}

/// What the parts of an iteration cost at the map of a session.
fn parts(case: &str, body: &Body, drag: &InteractiveContinuation, session: &Session) {
    let problem = Problem::new(body.clone(), &drag.handles(FRAMES), &Model::default());
    let problem = problem.expect("a problem");
    let terms = problem
        .body
        .terms(&problem.energy, problem.barrier, None)
        .expect("an energy of this dimension");
    let mut objective = Objective::of_terms(body.n_vertices(), terms);
    let handles = &problem.stations[0];
    objective.fix(&handles.vertices);
    let x = session.positions();
    let mut direction = vec![0.0; x.len()];
    let mut product = vec![0.0; x.len()];
    let true_hessian = least(|| objective.linearize(&x, 1.0));
    let assembly = least(|| objective.linearize(&x, 0.0));
    objective.prepare();
    let factor = least(|| objective.factor().expect("a definite matrix"));
    let gradient = least(|| assert!(objective.renew_gradient(&x)));
    let solve = least(|| {
        direction.copy_from_slice(objective.gradient());
        let solved = objective.precondition(&mut direction);
        solved.expect("a definite matrix");
    });
    let multiply = least(|| objective.apply_hessian(&direction, &mut product));
    let step = least(|| {
        black_box(objective.largest_step(&x, &direction));
    });
    let value = least(|| {
        black_box(objective.value(&x));
    });
    let stored = objective.work().map_or(0, |work| work.stored);
    println!(
        "{case}: assembly {assembly:.2} ms, {true_hessian:.2} without projection, gradient alone {gradient:.2}; factor {factor:.2} ({:.0} MB), solve {solve:.2}, product \
         {multiply:.2}; largest step {step:.2}, value {value:.2}",
        8e-6 * stored as f64
    );
}

/// The energy after three frames, and that of [`Problem::solve`] which is ended after one iteration in each.
fn three_frames(case: &str, body: &Body, drag: &InteractiveContinuation) {
    let (mut session, id) = drag.session(body);
    let problem = Problem::new(body.clone(), &drag.handles(0), &Model::default());
    let mut problem = problem.expect("a problem");
    let watch = |i: &Iterate| {
        if i.iteration < 1 {
            Control::Continue
        } else {
            Control::Finish
        }
    };
    let mut milliseconds = 0.0;
    for frame in 1..=3 {
        session
            .move_handle(id, &drag.target(frame))
            .expect("a target");
        session.step();
        let clock = Clock::start();
        let handles = drag.handles(frame);
        let next = Problem::new(body.clone(), &handles, &Model::default()).expect("a problem");
        problem.stations = next.stations;
        let solution = problem.solve(&Settings::follow(), &watch);
        problem.start = solution.expect("a map").x;
        milliseconds += 1e3 * clock.seconds().processor / 3.0;
    }
    let (ours, followed) = (session.quality(), problem.quality(&problem.start));
    println!(
        "{case}: after three frames energy {:.9}, residual {:.1e}; one iteration of a solve each {:.9}, {:.1e}, {milliseconds:.1} ms a frame",
        ours.energy + ours.barrier,
        ours.residual,
        followed.energy + followed.barrier,
        followed.residual,
    );
}

/// Milliseconds of the processor, least of five.
fn least(mut action: impl FnMut()) -> f64 {
    let times = (0..5).map(|_| {
        let clock = Clock::start();
        action();
        1e3 * clock.seconds().processor
    });
    times.fold(f64::INFINITY, f64::min)
}
