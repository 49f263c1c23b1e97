//! Targets whose straight ways are blocked: bent ways lead there, and what cannot be reached holds back nothing else.

use unwrapd_deform::{Body, Handle, Model, Problem, Solution, Units};
use unwrapd_method::solver::{
    Continuation, Control, Handles, Iterate, LeastProgress, Objective, Settings, Status,
};

use crate::bodies::{block, sheet};

fn go_on(_: &Iterate) -> Control {
    Control::Continue
}

fn vertex(vertex: u32, to: &[f64]) -> Handle {
    Handle::Vertex {
        vertex,
        to: to.to_vec(),
        weight: None,
    }
}

fn solved(problem: &Problem) -> Solution {
    let solution = problem
        .solve(&Settings::follow(), &go_on)
        .expect("a solution");
    assert_eq!(solution.quality.inverted, 0);
    solution
}

/// Two places of a sheet of 12 × 12 cells, by their row and column, that change with each other.
fn swapped() -> Problem {
    let body = Body::from(&sheet(12));
    let id = |row: u32, column: u32| 13 * row + column;
    let at = |v: u32| body.rest[2 * v as usize..2 * v as usize + 2].to_vec();
    let [left, right] = [id(6, 4), id(6, 8)];
    let handles = [vertex(left, &at(right)), vertex(right, &at(left))];
    Problem::new(body, &handles, &Model::default()).expect("a problem")
}

#[test]
fn vertices_that_change_places_pass_each_other() {
    let problem = swapped();
    let solution = solved(&problem);
    assert_eq!(solution.summary.status, Status::Converged);
    assert!(solution.quality.residual < 1e-16, "{:?}", solution.quality);
    assert_eq!(problem.unreached(&solution), []);
}

#[test]
fn a_search_ends_no_higher_and_counts_all_its_work() {
    let first = solved(&swapped());
    let search = Problem {
        search: true,
        ..swapped()
    };
    let best = solved(&search);
    assert_eq!(best.summary.status, Status::Converged);
    let [low, high] = [&best, &first].map(|s| s.quality.energy + s.quality.barrier);
    assert!(low <= high * (1.0 + 1e-6), "{low} {high}");
    assert!(best.summary.iterations > first.summary.iterations);
}

/// A sheet of which so many places on a circle each go to the next but one.
fn carousel() -> Problem {
    const CELLS: u32 = 24;
    let sheet = sheet(CELLS);
    let near = |[x, y]: [f64; 2]| {
        let away = |v: &[f64; 2]| (v[0] - x).hypot(v[1] - y);
        let all = sheet.vertices().iter().enumerate();
        all.min_by(|a, b| away(a.1).total_cmp(&away(b.1)))
            .map_or(0, |(v, _)| v as u32)
    };
    let size = sheet.vertices().last().expect("vertices")[0];
    let on_circle = |k: u32| {
        let angle = std::f64::consts::TAU * f64::from(k) / 6.0;
        near([
            size * (0.5 + 0.25 * angle.cos()),
            size * (0.5 + 0.25 * angle.sin()),
        ])
    };
    let handles = (0..6).map(|k| {
        let target = sheet.vertices()[on_circle(k + 2) as usize];
        vertex(on_circle(k), &target)
    });
    let handles: Vec<Handle> = handles.collect();
    Problem::new(Body::from(&sheet), &handles, &Model::default()).expect("a problem")
}

#[test]
fn places_that_all_meet_on_straight_ways_arrive() {
    let problem = carousel();
    let solution = solved(&problem);
    assert_eq!(problem.unreached(&solution), []);
    assert_eq!(solution.summary.status, Status::Converged);
    assert!(solution.quality.residual < 1e-16, "{:?}", solution.quality);
    assert!(solution.summary.iterations < 1000, "{:?}", solution.summary);
}

#[test]
fn a_journey_that_pauses_arrives_when_it_goes_on() {
    let problem = Problem {
        units: Units::Given,
        ..swapped()
    };
    let station = Handles {
        bends: vec![[0.0, -0.5, 0.0], [0.0, 0.5, 0.0]],
        ..problem.stations[0].clone()
    };
    let barrier = problem.barrier;
    let terms = (problem.body.terms(&problem.energy, barrier, None)).expect("an energy");
    let mut objective = Objective::of_terms(problem.body.n_vertices(), terms);
    let (mut x, settings) = (problem.start.clone(), Settings::follow());
    let stations = vec![station.clone()];
    let continuation = Continuation::<2>::new(&mut objective, &x, stations, &settings);
    let mut continuation = continuation.expect("fitting handles");
    // Nothing is fast enough for this pace.
    let least_progress = LeastProgress {
        window: 1,
        gain: 1.0,
    };
    (continuation.go_on(&mut objective, &mut x, &settings, least_progress, &go_on))
        .expect("fitting handles");
    assert!(continuation.is_paused());
    assert!(0.0 < continuation.share() && continuation.share() < 1.0);
    assert_eq!(continuation.summary().status, Status::TargetsUnreachable);
    let before = continuation.summary().iterations;
    (continuation.go_on(
        &mut objective,
        &mut x,
        &settings,
        LeastProgress::ANY,
        &go_on,
    ))
    .expect("fitting handles");
    assert!(!continuation.is_paused());
    assert_eq!(continuation.share(), 1.0);
    assert!(continuation.summary().iterations > before);
    for (&v, to) in station.vertices.iter().zip(station.targets.chunks(2)) {
        assert_eq!(&x[2 * v as usize..2 * v as usize + 2], to);
    }
}

#[test]
fn the_result_does_not_depend_on_the_number_of_threads() {
    let of = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        let pool = pool.build().expect("threads");
        pool.install(|| solved(&swapped())).x
    };
    assert_eq!(of(1), of(3));
}

#[test]
fn in_space_ways_bend_too() {
    // Two vertices inside a block change places.
    let block = block(CELLS);
    let body = Body::from(&block);
    let [left, right] = [id([1, 2, 2]), id([3, 2, 2])];
    let at = |v: u32| block.vertices()[v as usize].to_vec();
    let mut handles = vec![vertex(left, &at(right)), vertex(right, &at(left))];
    handles.extend(corners().map(|v| vertex(v, &at(v))));
    let problem = Problem::new(body, &handles, &Model::default()).expect("a problem");
    let solution = solved(&problem);
    assert_eq!(solution.summary.status, Status::Converged);
    assert!(solution.quality.residual < 1e-16, "{:?}", solution.quality);
}

const CELLS: u32 = 4;

fn id([x, y, z]: [u32; 3]) -> u32 {
    ((CELLS + 1) * z + y) * (CELLS + 1) + x
}

fn place(v: u32) -> [u32; 3] {
    let n = CELLS + 1;
    [v % n, v / n % n, v / n / n]
}

fn corners() -> impl Iterator<Item = u32> {
    (0..8).map(|k| id([k % 2, k / 2 % 2, k / 4].map(|side| CELLS * side)))
}

/// Of these handles, beside a border that is held, only the first is not reached.
fn assert_only_the_first_is_not_reached(body: Body, mut handles: Vec<Handle>, border: &[u32]) {
    let dim = body.dim();
    let at = |v: u32| body.rest[dim * v as usize..dim * (v as usize + 1)].to_vec();
    handles.extend(border.iter().map(|&v| vertex(v, &at(v))));
    let problem = Problem::new(body, &handles, &Model::default()).expect("a problem");
    let solution = solved(&problem);
    assert_eq!(solution.summary.status, Status::TargetsUnreachable);
    assert!(solution.summary.iterations < 1000, "{:?}", solution.summary);
    let unreached = problem.unreached(&solution);
    assert_eq!(unreached.len(), 1, "{unreached:?}");
    assert_eq!(unreached[0].handle, 0);
    let gap = solution.quality.residual.sqrt();
    assert!((unreached[0].distance - gap).abs() < 1e-6 * gap, "{gap}");
}

#[test]
fn one_target_beyond_a_wall_holds_back_nothing_else() {
    let mesh = sheet(12);
    let size = mesh.vertices()[168][0];
    let cell = size / 12.0;
    let is_border = |v: &u32| [v % 13, v / 13].iter().any(|&x| x.is_multiple_of(12));
    let border: Vec<u32> = (0..169).filter(is_border).collect();
    let moved = |v: u32, by: [f64; 2]| {
        let at = mesh.vertices()[v as usize];
        vertex(v, &[at[0] + cell * by[0], at[1] + cell * by[1]])
    };
    let handles = vec![
        moved(13 * 2 + 6, [0.0, -4.0]),
        moved(13 * 4 + 3, [1.0, 1.0]),
        moved(13 * 4 + 9, [-1.0, 1.5]),
        moved(13 * 9 + 3, [1.5, 0.0]),
        moved(13 * 9 + 9, [-0.5, -1.0]),
    ];
    assert_only_the_first_is_not_reached(Body::from(&mesh), handles, &border);
}

#[test]
fn nor_does_it_in_space() {
    let mesh = block(CELLS);
    let is_border = |&v: &u32| place(v).iter().any(|x| x.is_multiple_of(CELLS));
    let border: Vec<u32> = (0..(CELLS + 1).pow(3)).filter(is_border).collect();
    let handles = vec![
        vertex(id([2, 2, 1]), &[2.0, 2.0, -2.0]),
        vertex(id([1, 1, 3]), &[1.2, 1.3, 3.1]),
        vertex(id([3, 2, 3]), &[2.8, 2.2, 2.9]),
    ];
    assert_only_the_first_is_not_reached(Body::from(&mesh), handles, &border);
}
