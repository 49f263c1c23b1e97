//! Maximal planar regions.

use super::faces::Faces;
use std::cmp::Reverse;
use unwrapd_maps::mesh::{CUT, spread};
use unwrapd_method::numerics::vec3::{dot, sub};

/// The cosine of the angle within which the faces of a facet lie: 1°.
const FLAT_COS: f64 = 0.999_85;

/// How far the corners of a facet may lie from its plane, as a part of the diagonal.
const FLAT: f64 = 1e-4;

/// The least length of an edge of a thin face along which it lies, as a part of its longest.
const ALONG: f64 = 0.4;

/// The facets of a surface or of a chart.
pub struct Facets {
    /// For each face its facet.
    pub of_face: Vec<u32>,
    /// The unit normal of each; zero where none of its faces has one.
    pub normals: Vec<[f64; 3]>,
    pub areas: Vec<f64>,
    /// How many faces each has.
    pub n_faces: Vec<u32>,
}

impl Facets {
    /// Every face is in one facet.
    ///
    /// A facet grows from its largest face, which has the surest normal, over neighbors that lie in
    /// the plane of that face; a face too thin for a normal, only by where its corners are. What thin
    /// faces are left go to the facet beyond their longest edge. O(n log n).
    pub fn new(faces: &Faces) -> Self {
        let mut facets = Self {
            of_face: vec![CUT; faces.len()],
            normals: Vec::new(),
            areas: Vec::new(),
            n_faces: Vec::new(),
        };
        // The bits of numbers that are not negative have their order.
        let key = |f: u32| (Reverse(faces.areas[f as usize].to_bits()), f);
        let seeds = (0..faces.len() as u32).filter(|&f| faces.normals[f as usize].is_some());
        let mut seeds: Vec<(Reverse<u64>, u32)> = seeds.map(key).collect();
        seeds.sort_unstable();
        let reach = FLAT * faces.diagonal();
        let mut queue = Vec::new();
        for (_, seed) in seeds {
            if facets.of_face[seed as usize] == CUT {
                facets.grow(faces, seed, reach, &mut queue);
            }
        }
        facets.take_thin(faces);
        for (face, &facet) in facets.of_face.iter().enumerate() {
            facets.areas[facet as usize] += faces.areas[face];
            facets.n_faces[facet as usize] += 1;
        }
        facets
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.areas.len()
    }

    fn grow(&mut self, faces: &Faces, seed: u32, reach: f64, queue: &mut Vec<u32>) {
        let Some(normal) = faces.normals[seed as usize] else {
            return;
        };
        let [origin, ..] = faces.corners[seed as usize];
        let facet = self.add(normal);
        self.of_face[seed as usize] = facet;
        queue.clear();
        queue.push(seed);
        let of_face = &mut self.of_face;
        spread(&faces.across, queue, |_, t| {
            let face = t as usize / 3;
            let is_in = of_face[face] == CUT
                && faces.normals[face].is_none_or(|own| dot(own, normal) > FLAT_COS)
                && (faces.corners[face].iter())
                    .all(|&p| dot(sub(p, origin), normal).abs() <= reach);
            if is_in {
                of_face[face] = facet;
            }
            is_in
        });
    }

    fn add(&mut self, normal: [f64; 3]) -> u32 {
        self.normals.push(normal);
        self.areas.push(0.0);
        self.n_faces.push(0);
        self.normals.len() as u32 - 1
    }

    /// Puts faces that lie in no plane to the facet beyond their longest edge, or nearly so; those
    /// without any to a facet of their own.
    fn take_thin(&mut self, faces: &Faces) {
        let mut left: Vec<u32> = (0..faces.len() as u32)
            .filter(|&f| self.of_face[f as usize] == CUT)
            .collect();
        while !left.is_empty() {
            let n_before = left.len();
            let taken: Vec<(u32, u32)> = (left.iter())
                .filter_map(|&f| Some((f, self.beyond_longest(faces, f)?)))
                .collect();
            for (face, facet) in taken {
                self.of_face[face as usize] = facet;
            }
            left.retain(|&f| self.of_face[f as usize] == CUT);
            if left.len() == n_before {
                for face in left {
                    self.of_face[face as usize] = self.add([0.0; 3]);
                }
                return;
            }
        }
    }

    /// The facet beyond the longest edge of a face beyond which there is one; edges that are much
    /// shorter than another are none along which a thin face lies.
    fn beyond_longest(&self, faces: &Faces, face: u32) -> Option<u32> {
        let sides = 3 * face..3 * face + 3;
        let longest = sides
            .clone()
            .fold(0.0, |most: f64, h| most.max(faces.length(h)));
        sides
            .filter_map(|h| {
                let t = faces.across[h as usize];
                let facet = *self.of_face.get(t as usize / 3)?;
                let length = faces.length(h);
                (facet != CUT && length > ALONG * longest).then_some((length, facet))
            })
            .max_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1)))
            .map(|(_, facet)| facet)
    }
}
