//! Ways of handles from rest to their targets.

use unwrapd_method::numerics::rotation::Rotation;
use unwrapd_method::numerics::square::{Matrix, Square, apply};
use unwrapd_method::solver::Handles;

/// From half a turn on the way is not the shortest one any more, so that it has to be prescribed; in degrees.
const HALF_TURN: f64 = 180.0;

/// A station is at most so many degrees from the next. Each is settled before the next; 15 degrees are what twisted bars were
/// measured to keep their turns with, at three or four factorizations a station.
const BETWEEN_STATIONS: f64 = 15.0;

/// What a disc of vertices turns by.
#[derive(Clone, Debug, PartialEq)]
pub struct Turned {
    /// Its handle's place in the user's list.
    pub handle: usize,
    /// The vertices.
    pub vertices: Vec<u32>,
    /// The unit vector that it turns about; in the plane it says nothing.
    pub axis: [f64; 3],
    /// Degrees, counter-clockwise seen against the axis.
    pub degrees: f64,
}

/// The way of a vertex or a point: an arm about a center that moves straight, turning at constant speed.
pub(super) struct Way<const D: usize> {
    pub from: [f64; D],
    pub to: [f64; D],
    pub arm: [f64; D],
    /// The logarithm of the turn.
    pub spin: Matrix<D>,
}

impl<const D: usize> Way<D>
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

    /// Where it leads to after a share of it.
    pub fn at(&self, share: f64) -> [f64; D] {
        let arm = apply(&Matrix::<D>::exp(&self.spin, share), &self.arm);
        std::array::from_fn(|k| (1.0 - share) * self.from[k] + share * self.to[k] + arm[k])
    }
}

/// The stations of handles on their ways, `last` with the targets at the ends: as many as turns of half a turn and more take,
/// otherwise the last one alone.
pub(super) fn stations<const D: usize>(
    last: Handles,
    of_vertex: &dyn Fn(u32) -> usize,
    (ways, point_ways): (&[Way<D>], &[Way<D>]),
    turns: &[Turned],
) -> Vec<Handles>
where
    Matrix<D>: Square<D> + Rotation<D>,
{
    let largest = turns.iter().map(|turned| turned.degrees.abs());
    let largest = largest.fold(0.0, f64::max);
    if largest < HALF_TURN {
        return vec![last];
    }
    let n_stations = (largest / BETWEEN_STATIONS).ceil();
    let between = (1..n_stations as usize).map(|k| {
        let share = k as f64 / n_stations;
        let places = last.vertices.iter().map(|&v| ways[of_vertex(v)].at(share));
        let points = point_ways.iter().map(|way| way.at(share));
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
