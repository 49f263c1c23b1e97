//! What a caller sees while charts are mapped, and how it ends the work early.

use super::chart::Chart;
use std::time::Duration;
use unwrapd_method::numerics::vec3::{area_vector, norm};
use unwrapd_method::solver::{Control, Iterate, Watch};

/// A map of a whole chart between two steps of the solver.
pub struct MapUnderway<'a> {
    /// What is mapped.
    pub chart: &'a Chart,
    /// Where the solver stands.
    pub iterate: &'a Iterate,
    /// Both coordinates of each vertex, where the mean area of a face at rest is 1.
    pub x: &'a [f64],
    /// Where the chart is a simplification on which seams are planned: a near face of the surface for each of its own.
    pub planned_for: Option<&'a [u32]>,
}

impl MapUnderway<'_> {
    /// The faces of the surface that the triangles of the chart are, or stand for.
    pub fn faces(&self) -> impl Iterator<Item = u32> {
        let own = self.chart.corners.iter().map(|corners| corners[0] / 3);
        own.map(|face| self.planned_for.map_or(face, |faces| faces[face as usize]))
    }

    /// The mesh's length of the map's unit.
    pub fn unit(&self) -> f64 {
        let corners = |t: &[u32; 3]| t.map(|v| self.chart.positions[v as usize]);
        let area = |[a, b, c]: [[f64; 3]; 3]| norm(area_vector(a, b, c)) / 2.0;
        let triangles = &self.chart.disk.triangles;
        let sum: f64 = triangles.iter().map(corners).map(area).sum();
        (sum / triangles.len() as f64).sqrt()
    }
}

/// Sees charts being mapped, tells the time, and may end the work early.
pub trait Observer: Sync {
    /// The map of a chart of the surface at an iterate, which [`Self::iterate`] follows.
    fn map(&self, _map: &MapUnderway) {}
    /// An iterate of a chart of so many faces.
    fn iterate(&self, faces: usize, iterate: &Iterate) -> Control;
    /// Work that no iterate shows, as long as one iteration of so many faces takes.
    fn worked(&self, _faces: usize) {}
    /// So many more charts are mapped, of so many more that are known; fewer where negative.
    fn charted(&self, _mapped: isize, _known: isize) {}
    /// Whether to go on, asked between maps.
    fn control(&self) -> Control;
    /// Time since the work began.
    fn elapsed(&self) -> Duration;
}

/// Neither listens nor interferes; its clock stands still.
pub struct Unobserved;

impl Observer for Unobserved {
    fn iterate(&self, _: usize, _: &Iterate) -> Control {
        Control::Continue
    }
    fn control(&self) -> Control {
        Control::Continue
    }
    fn elapsed(&self) -> Duration {
        Duration::ZERO
    }
}

/// Shows an observer the maps of a chart.
pub(crate) struct Watching<'a> {
    pub chart: &'a Chart,
    pub observer: &'a dyn Observer,
}

impl Watch for Watching<'_> {
    fn iterate(&self, iterate: &Iterate) -> Control {
        let faces = self.chart.disk.triangles.len();
        self.observer.iterate(faces, iterate)
    }

    fn positions(&self, iterate: &Iterate, x: &[f64]) {
        self.observer.map(&MapUnderway {
            chart: self.chart,
            iterate,
            x,
            planned_for: None,
        });
    }
}

/// Says of the maps of a simplification that they are plans for the surface.
pub(crate) struct Planning<'a> {
    pub observer: &'a dyn Observer,
    /// A face of the surface for each of the simplification.
    pub faces: Vec<u32>,
}

impl Observer for Planning<'_> {
    fn map(&self, map: &MapUnderway) {
        self.observer.map(&MapUnderway {
            planned_for: Some(&self.faces),
            ..*map
        });
    }
    fn iterate(&self, faces: usize, iterate: &Iterate) -> Control {
        self.observer.iterate(faces, iterate)
    }
    fn worked(&self, faces: usize) {
        self.observer.worked(faces);
    }
    fn charted(&self, mapped: isize, known: isize) {
        self.observer.charted(mapped, known);
    }
    fn control(&self) -> Control {
        self.observer.control()
    }
    fn elapsed(&self) -> Duration {
        self.observer.elapsed()
    }
}
