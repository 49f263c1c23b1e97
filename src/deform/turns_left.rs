//! How many of the turns that handles make a map holds.
//!
//! Where a body is turned at one end and held at another, its elements share the turns. Those that they cannot hold go into a
//! coil, or are lost where the body passes through itself: its elements stay valid, and the ends do not show it. So turns are
//! counted on the way from one end to the other: the body is cut into thin slices, of each the rotation is taken that best fits
//! its vertices, and what its neighbor is turned by beside it, at most half a turn, is added up about the axis. Slices, not
//! elements, because those away from the axis are sheared and so turned aside.

use serde::{Deserialize, Serialize};

use super::bound::Turned;
use super::problem::Problem;
use super::slices::Slices;
use crate::numerics::rotation::{Rotation, best_rotation};
use crate::numerics::square::{Matrix, Square, times, transposed};

/// Turns that a handle asks for, and those that the map holds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema))]
pub struct Turns {
    /// The handle's place in the list.
    pub handle: usize,
    /// By how many turns its disc is turned beside the nearest other handle.
    pub asked: f64,
    /// How many of them the body between the two holds, as its twist. What is missing is in a coil, or lost.
    pub left: f64,
}

/// Less than half a turn the ends show themselves, and a bar that bends a little lacks it in its twist.
const HALF: f64 = 0.5;

impl Turns {
    /// Is half a turn or more missing?
    pub fn are_lost(&self) -> bool {
        (self.asked - self.left).abs() >= HALF
    }
}

impl Problem {
    /// The turns that a map holds, for each disc that makes half a turn or more beside the nearest other handle, on the way
    /// between them; costs some sweeps over the elements. Nothing is said of discs of too few vertices to have a direction, and
    /// where no other handle holds vertices.
    pub fn turns(&self, x: &[f64]) -> Vec<Turns> {
        let turns = self.turned.iter().filter_map(|turned| {
            if self.body.dim() == 2 {
                self.turns_of::<2>(turned, x)
            } else {
                self.turns_of::<3>(turned, x)
            }
        });
        turns.filter(|t| t.asked.abs() >= HALF).collect()
    }

    fn turns_of<const D: usize>(&self, turned: &Turned, x: &[f64]) -> Option<Turns>
    where
        Matrix<D>: Square<D> + Rotation<D>,
    {
        let Slices { slices, end } = self.slices(&turned.vertices, 2 * D)?;
        let place = |x: &[f64], v: u32| std::array::from_fn(|k| x[D * v as usize + k]);
        let rotation = |slice: &Vec<u32>| {
            let pairs = slice
                .iter()
                .map(|&v| (place(&self.body.rest, v), place(x, v)));
            best_rotation::<D>(&pairs.collect::<Vec<_>>())
        };
        let mut last = rotation(slices.first()?)?;
        let mut angle = 0.0;
        // Slices that have no direction are passed over.
        for next in slices[1..].iter().filter_map(rotation) {
            let between = times(&transposed(&next), &last).log();
            angle += Matrix::<D>::angle(&between, turned.axis);
            last = next;
        }
        Some(Turns {
            handle: turned.handle,
            asked: (turned.degrees - self.degrees_of(end, turned)) / 360.0,
            left: angle / std::f64::consts::TAU,
        })
    }

    /// By how much a vertex that another disc holds is turned about the axis of `turned`.
    fn degrees_of(&self, vertex: u32, turned: &Turned) -> f64 {
        let other = self
            .turned
            .iter()
            .find(|other| other.vertices.contains(&vertex));
        other.map_or(0.0, |other| {
            let cosine: f64 = (other.axis.iter().zip(turned.axis))
                .map(|(a, b)| a * b)
                .sum();
            other.degrees * if self.body.dim() == 2 { 1.0 } else { cosine }
        })
    }
}
