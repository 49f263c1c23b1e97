//! Paths of handles from rest to their targets.

use unwrapd_method::numerics::rotation::Rotation;
use unwrapd_method::numerics::square::{Matrix, Square, apply};
use unwrapd_method::solver::Handles;

/// Turn, in degrees, from which the path is no longer the shortest one and must be prescribed.
const HALF_TURN: f64 = 180.0;

/// Largest turn between two stations, in degrees. Each station is settled before the next; twisted bars keep their
/// turns at 15 degrees, by measurement, with three or four factorizations per station.
const BETWEEN_STATIONS: f64 = 15.0;

/// Turn of a disc of vertices.
#[derive(Clone, Debug, PartialEq)]
pub struct Turned {
    /// Index of its handle in the user's list.
    pub handle: usize,
    /// Vertices of the disc.
    pub vertices: Vec<u32>,
    /// Unit vector of the axis; ignored in the plane.
    pub axis: [f64; 3],
    /// Degrees, counter-clockwise seen against the axis.
    pub degrees: f64,
}

/// Path of a vertex or a point: an arm that turns at constant speed about a center that moves straight.
pub(super) struct TurningPath<const D: usize> {
    pub from: [f64; D],
    pub to: [f64; D],
    pub arm: [f64; D],
    /// Logarithm of the turn.
    pub spin: Matrix<D>,
}

impl<const D: usize> TurningPath<D>
where
    Matrix<D>: Square<D> + Rotation<D>,
{
    pub fn straight(from: [f64; D], to: [f64; D]) -> Self {
        Self {
            from,
            to,
            arm: [0.0; D],
            spin: [[0.0; D]; D],
        }
    }

    /// Returns the position after this share of the path.
    pub fn at(&self, share: f64) -> [f64; D] {
        let arm = apply(&Matrix::<D>::exp(&self.spin, share), &self.arm);
        std::array::from_fn(|k| (1.0 - share) * self.from[k] + share * self.to[k] + arm[k])
    }
}

/// Returns the stations of handles along their paths; the last has the targets at the ends. Only turns of half a turn
/// or more need more than the last one.
pub(super) fn stations<const D: usize>(
    last: Handles,
    of_vertex: &dyn Fn(u32) -> usize,
    paths: &[TurningPath<D>],
    point_paths: &[TurningPath<D>],
    turns: &[Turned],
) -> Vec<Handles>
where
    Matrix<D>: Square<D> + Rotation<D>,
{
    // The shortest paths make turns of less than half a turn by themselves.
    let largest = turns.iter().map(|turned| turned.degrees.abs());
    let largest = largest.fold(0.0, f64::max);
    if largest < HALF_TURN {
        return vec![last];
    }
    // Add stations in equal steps of the turn.
    let n_stations = (largest / BETWEEN_STATIONS).ceil();
    let between = (1..n_stations as usize).map(|k| {
        let share = k as f64 / n_stations;
        let places = last.vertices.iter().map(|&v| paths[of_vertex(v)].at(share));
        let points = point_paths.iter().map(|path| path.at(share));
        Handles {
            targets: places.flatten().collect(),
            point_targets: points.flatten().collect(),
            ..last.clone()
        }
    });
    let mut stations: Vec<Handles> = between.collect();
    stations.push(last);
    stations
}
