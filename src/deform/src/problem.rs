//! A body, handles and their targets, an energy and a barrier.

use super::body::{Body, BodyElements};
use super::boundary_barrier::BoundaryBarrier;
use super::handle::Handle;
use super::handles::{Aim, Bound, Turned, bind};
use super::problem_error::ProblemError;
use super::soft::SoftPull;
use super::untangle::{bad_elements, untangled, unwatched};
use serde::{Deserialize, Serialize};
use std::collections::HashMap;
use std::fmt;
use unwrapd_api::options::options;
use unwrapd_maps::mesh::UnionFind;
use unwrapd_maps::plane::are_disjoint;
use unwrapd_method::barrier::{Barrier, BarrierKind};
use unwrapd_method::energy::{EnergyKind, Term};
use unwrapd_method::numerics::vec3;
use unwrapd_method::solver::{Handles, LevenbergSettings, RigidMotions};

/// A validated problem with its mesh.
#[derive(Clone, Debug)]
pub struct Problem {
    /// Body to deform.
    pub body: Body,
    /// Start positions, coordinates one after another.
    pub start: Vec<f64>,
    /// Number of elements of the start that were inverted and had to be untangled.
    pub untangled: usize,
    /// The energy.
    pub energy: EnergyKind,
    /// The barrier.
    pub barrier: Barrier,
    /// Upper bound on the conformal distortion σ₁/σ₂ of every triangle, if any.
    pub bound: Option<f64>,
    /// Barrier that keeps the boundary from crossing itself, if any.
    pub boundary_barrier: Option<BoundaryBarrier>,
    /// Stations of the handles, the last of them their targets.
    pub stations: Vec<Handles>,
    /// Turns of discs, for [`turns`](Self::turns).
    pub turned: Vec<Turned>,
    /// Vertices and points that each handle of a user's list pulls, for [`unreached`](Self::unreached); may be empty if
    /// that is not needed.
    pub aims: Vec<Aim>,
    /// Pull of the handles with weights, part of the objective.
    pub soft: SoftPull,
    /// Tries all bent paths, for the map with the lowest energy, even if straight ones lead to the targets.
    pub search: bool,
    /// Settings of the paper's iteration.
    pub levenberg: LevenbergSettings,
    /// Units of β, ε, tolerances and energies.
    pub units: Units,
}

options! {
    /// Energy and barrier of a deformation, as users specify them.
    pub struct Model under "Energy and barrier" {
        /// Deformation energy: a name, or a formula of the signed singular values of an element, s1 and
        /// s2, in space s3, as `(s1 - 1)^2 + (s2 - 1)^2`. A formula must be symmetric, and smooth and
        /// minimal at 1.
        pub energy: EnergyKind = EnergyKind::default(), arg(value_parser = unwrapd_api::options::WordOrText::<EnergyKind>::new());
        /// Barrier that keeps elements from inverting; none is for comparison.
        pub barrier: BarrierKind = BarrierKind::InverseSpline;
        /// Barrier strength β. The default is the value of the paper: 100 for green, 0.01 for the
        /// other energies.
        pub barrier_strength: Option<f64>, value "BETA", also "beta";
        /// Support s of the inverse-spline barrier: the share of its rest size below which an
        /// element feels the barrier.
        pub barrier_support: f64 = 1.0, value "S", also "s";
        /// Upper bound on the conformal distortion σ₁/σ₂ of every triangle, greater than 1. Only in
        /// the plane.
        pub max_conformal: Option<f64>, value "K";
        /// Also keep the boundary from crossing itself, so that the map stays bijective. Only in
        /// the plane.
        pub bijective: bool;
    }
}

impl Model {
    /// Checks every number against its range, and that a formula is an energy.
    pub fn check(&self) -> Result<(), ProblemError> {
        self.energy.check()?;
        let is_positive = |x: f64| x > 0.0 && x.is_finite();
        for (name, value) in [
            ("barrier_strength", self.barrier_strength),
            ("barrier_support", Some(self.barrier_support)),
        ] {
            if !value.is_none_or(is_positive) {
                let range = "a positive number";
                return Err(ProblemError::BadParameter { name, range });
            }
        }
        if !self
            .max_conformal
            .is_none_or(|bound| is_positive(bound - 1.0))
        {
            let (name, range) = ("max_conformal", "a number greater than 1");
            return Err(ProblemError::BadParameter { name, range });
        }
        Ok(())
    }

    /// Returns the barrier with its parameters. Unless given, ε is the paper's share, 1e-4 in its authors' code, of the
    /// smallest element.
    pub(super) fn barrier(
        &self,
        body: &Body,
        epsilon: Option<f64>,
    ) -> Result<Barrier, ProblemError> {
        self.check()?;
        let smallest = body
            .determinants()
            .into_iter()
            .fold(f64::INFINITY, f64::min);
        let barrier = Barrier {
            kind: self.barrier,
            beta: (self.barrier_strength).unwrap_or(self.energy.default_beta()),
            s: self.barrier_support,
            epsilon: epsilon.unwrap_or(1e-4 * smallest),
        };
        if !(barrier.epsilon >= 0.0 && barrier.epsilon < smallest) {
            return Err(ProblemError::BadParameter {
                name: "epsilon",
                range: "at least 0 and below the smallest rest determinant",
            });
        }
        Ok(barrier)
    }
}

impl Problem {
    /// Creates the problem of a body at rest and its handles; at least one is required.
    pub fn new(body: Body, handles: &[Handle], model: &Model) -> Result<Self, ProblemError> {
        let Bound {
            stations,
            aims,
            turns,
            soft,
        } = bind(&body, handles)?;
        Ok(Self {
            stations,
            aims,
            soft,
            turned: turns,
            ..Self::at_rest(body, model)?
        })
    }

    /// Creates the problem of a body at rest, without handles: its solution minimizes from the start.
    pub fn at_rest(body: Body, model: &Model) -> Result<Self, ProblemError> {
        let problem = Self {
            start: body.rest.clone(),
            untangled: 0,
            energy: model.energy.clone(),
            barrier: model.barrier(&body, None)?,
            bound: model.max_conformal,
            boundary_barrier: None,
            stations: Vec::new(),
            aims: Vec::new(),
            soft: SoftPull::default(),
            turned: Vec::new(),
            search: false,
            levenberg: LevenbergSettings::default(),
            units: Units::Normalized,
            body,
        };
        problem.guarded(model)
    }

    /// Adds a barrier between the parts of the boundary, if the model asks for it. The start must not overlap itself,
    /// and something must keep elements from inverting: a boundary barrier alone does not make a map bijective.
    pub(super) fn guarded(mut self, model: &Model) -> Result<Self, ProblemError> {
        if !model.bijective {
            return Ok(self);
        }
        let BodyElements::Triangles { corners, .. } = &self.body.elements else {
            return Err(ProblemError::PlanarBijectivity);
        };
        if !self.forbids_inversion() {
            let (name, range) = (
                "bijective",
                "off where nothing keeps elements from inverting",
            );
            return Err(ProblemError::BadParameter { name, range });
        }
        let barrier = BoundaryBarrier::new(corners, &self.start);
        let is_apart = barrier.value(&self.start).is_finite();
        if !(is_apart && are_disjoint(self.start.as_chunks().0, corners)) {
            return Err(ProblemError::OverlappingStart);
        }
        self.boundary_barrier = Some(barrier);
        Ok(self)
    }

    /// Untangles elements of the start at or below ε, moving as little as possible; does nothing if neither the energy
    /// nor the barrier forbids inversions.
    ///
    /// Handles that are exactly at their first targets stay there; others may move, and their paths then start from
    /// there.
    ///
    /// # Errors
    /// If no start without inversions is found.
    pub fn untangle_start(&mut self) -> Result<(), ProblemError> {
        if !self.forbids_inversion() {
            return Ok(());
        }
        let epsilon = self.floor();
        let bad = bad_elements(&self.body, &self.start, epsilon);
        let Some(&element) = bad.first() else {
            return Ok(());
        };
        let held = self.arrived();
        let Ok(start) = untangled(&self.body, &self.start, &held, epsilon, &unwatched) else {
            return Err(ProblemError::InfeasibleStart {
                element,
                determinant: self.body.determinants_at(&self.start)[element],
                epsilon,
            });
        };
        self.start = start;
        self.untangled = bad.len();
        Ok(())
    }

    /// Returns the bound that determinants must exceed in a valid map.
    pub(super) fn floor(&self) -> f64 {
        match self.barrier.kind {
            BarrierKind::None => 0.0,
            _ => self.barrier.epsilon,
        }
    }

    /// Returns the held vertices that are exactly at their first targets.
    pub(super) fn arrived(&self) -> Vec<u32> {
        let Some(first) = self.stations.first() else {
            return Vec::new();
        };
        let dim = self.body.dim();
        let place = |v: u32| &self.start[dim * v as usize..dim * (v as usize + 1)];
        let targets = first.targets.chunks_exact(dim);
        let held = first.vertices.iter().zip(targets);
        held.filter(|(v, target)| place(**v) == *target)
            .map(|(v, _)| *v)
            .collect()
    }

    /// Returns whether the energy or the barrier keeps every element from inverting.
    pub fn forbids_inversion(&self) -> bool {
        let terms = self
            .body
            .terms(&self.energy, self.barrier, self.bound)
            .unwrap_or_default();
        terms.iter().any(|term| term.forbids_flips())
    }
}

// Units of a problem's numbers.

/// Unit of a problem's numbers: β, ε, tolerances and energies.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Units {
    /// The length in which the mean element has area or volume 1.
    #[default]
    Normalized,
    /// The unit of the body's positions.
    Given,
}

impl fmt::Display for Units {
    /// Writes the phrase that follows an energy.
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(match self {
            Self::Normalized => "for a mean element of size 1",
            Self::Given => "in the unit of the mesh",
        })
    }
}

// Parts of a body that no handle moves.

impl Problem {
    /// Holds at rest the parts of the body, connected by elements, that have no handle; returns their number.
    ///
    /// Nothing else would keep them in place: energies do not change when a part moves as a rigid body.
    pub fn hold_idle_parts(&mut self) -> usize {
        let (part, n_parts) = parts(&self.body);
        let mut is_idle = vec![true; n_parts];
        for handles in &self.stations {
            let points = handles.points.iter().flatten().map(|&(v, _)| v);
            for v in handles.vertices.iter().copied().chain(points) {
                is_idle[part[v as usize] as usize] = false;
            }
        }
        for v in self.soft.vertices() {
            is_idle[part[v as usize] as usize] = false;
        }
        let vertices = 0..self.body.n_vertices() as u32;
        let held: Vec<u32> = vertices
            .filter(|&v| is_idle[part[v as usize] as usize])
            .collect();
        let dim = self.body.dim();
        for handles in &mut self.stations {
            // One group is enough: it does not move.
            let group = handles.groups.iter().max().map_or(0, |g| g + 1);
            for &v in &held {
                let v_first = dim * v as usize;
                handles.vertices.push(v);
                handles
                    .targets
                    .extend(&self.body.rest[v_first..v_first + dim]);
                handles.groups.push(group);
            }
        }
        is_idle.into_iter().filter(|&idle| idle).count()
    }
}

// Rigid motions that the handles leave.

/// Least sine of the angle at which held vertices count as off a line: a part whose held vertices are nearer to one is
/// as good as free to turn about it.
const OFF_A_LINE: f64 = 1e-6;

impl Problem {
    /// Returns the rigid motions that the held vertices leave to parts of the body. Elements that share no more than a
    /// hinge, a vertex or in space an edge, belong to different parts here.
    pub(super) fn rigid_motions(&self) -> RigidMotions {
        let dim = self.body.dim();
        let mut is_held = vec![false; self.body.n_vertices()];
        for &v in self.stations.first().into_iter().flat_map(|h| &h.vertices) {
            is_held[v as usize] = true;
        }
        let (part, n_parts) = rigid_parts(&self.body);
        let mut held: Vec<Vec<[f64; 3]>> = vec![Vec::new(); n_parts];
        for (element, part) in self.body.corners().into_iter().zip(part) {
            for &v in element.iter().filter(|&&v| is_held[v as usize]) {
                let place = &self.start[dim * v as usize..dim * (v as usize + 1)];
                let in_space = std::array::from_fn(|k| place.get(k).copied().unwrap_or(0.0));
                held[part as usize].push(in_space);
            }
        }
        if held.iter().all(|places| spans(places, dim - 1)) {
            RigidMotions::Held
        } else {
            RigidMotions::Free
        }
    }
}

/// Returns for each element the number of its part, connected by common edges or in space triangles, and the number of
/// parts.
fn rigid_parts(body: &Body) -> (Vec<u32>, usize) {
    let corners = body.corners();
    let mut sets = UnionFind::new(corners.len());
    let mut first_at: HashMap<Vec<u32>, u32> = HashMap::new();
    for (element, corners) in (0..).zip(&corners) {
        for opposite in *corners {
            let mut facet: Vec<u32> = corners.iter().copied().filter(|v| v != opposite).collect();
            facet.sort_unstable();
            let first = *first_at.entry(facet).or_insert(element);
            sets.unite(first, element);
        }
    }
    sets.labels()
}

/// Returns whether places are not all on one point, or, where `rank` is 2, on one line.
fn spans(places: &[[f64; 3]], rank: usize) -> bool {
    let Some((&first, others)) = places.split_first() else {
        return false;
    };
    let arms = || others.iter().map(|&place| vec3::sub(place, first));
    let longest = arms().max_by(|a, b| vec3::norm(*a).total_cmp(&vec3::norm(*b)));
    let Some(longest) = longest.filter(|&arm| vec3::norm(arm) > 0.0) else {
        return false;
    };
    let off = |arm: [f64; 3]| vec3::norm(vec3::cross(arm, vec3::unit(longest)));
    rank < 2 || arms().any(|arm| off(arm) > OFF_A_LINE * vec3::norm(longest))
}

/// Returns the part number of each vertex, and the number of parts.
pub(super) fn parts(body: &Body) -> (Vec<u32>, usize) {
    let mut sets = UnionFind::new(body.n_vertices());
    for element in body.corners() {
        for &v in &element[1..] {
            sets.unite(element[0], v);
        }
    }
    sets.labels()
}
