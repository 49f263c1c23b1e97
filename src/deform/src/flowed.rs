//! Handles that flow to their targets, each as fast as the others let it.

use super::attempt::Trial;
use super::normalized::Frame;
use unwrapd_method::energy::{Positional, Row};
use unwrapd_method::solver::{Continued, Flow, Handles, Settings, flow};

/// Most iterations.
const MOST: usize = 500;

/// Moves the map `x` until the handles come no nearer to these targets; handles that can reach their targets are then
/// close to them.
pub(super) fn flow_to(trial: &mut Trial, targets: &Handles, x: &mut [f64]) {
    let dim = trial.problem.body.dim();
    let place = |v: u32| &x[dim * v as usize..dim * (v as usize + 1)];
    let ends = targets.targets.chunks_exact(dim);
    let is_held = |pair: &(&u32, &[f64])| place(*pair.0) == pair.1;
    let (held, pulled): (Vec<_>, Vec<_>) = targets.vertices.iter().zip(ends).partition(is_held);
    let held: Vec<u32> = held.into_iter().map(|(&v, _)| v).collect();
    let of_vertices = pulled.iter().map(|(v, _)| vec![(**v, 1.0)]);
    let rows: Vec<Row> = of_vertices.chain(targets.points.iter().cloned()).collect();
    let ends: Vec<f64> = (pulled.iter().flat_map(|(_, end)| end.iter()))
        .chain(&targets.point_targets)
        .copied()
        .collect();
    let constraints = |rows, targets| Positional {
        dim,
        rows,
        targets,
        alpha: 0.0,
    };
    trial.objective.fix(&held);
    trial.objective.pull_at(constraints(rows, ends.clone()));
    let course = Flow {
        targets: &ends,
        edge: Frame::of(&trial.problem.body).squared(1.0).sqrt(),
    };
    let settings = Settings {
        max_iterations: MOST.min(trial.settings.max_iterations),
        ..trial.settings
    };
    let watch = Continued {
        watch: trial.watch,
        before: trial.total.iterations,
    };
    let done = flow(&mut trial.objective, x, &course, &settings, &watch);
    trial.objective.pull_at(constraints(
        targets.points.clone(),
        targets.point_targets.clone(),
    ));
    trial.add(&done);
}
