//! Charts cut into pieces that fill their convex hulls better, so that they leave less of a square empty.

use super::chord::{Chord, chords};
use super::clusters::Clusters;
use crate::charts::MappedChart;
use crate::charts::chart::connected_faces;
use crate::charts::crease::edge_costs;
use crate::charts::min_cut::min_cut;
use crate::charts::parts::{parted, parts, twins_among};
use crate::charts::unfold::overlaps::capacities;
use crate::cut::Sheet;
use crate::mesh::CUT;
use crate::numerics::support::{Directions, Support};
use crate::numerics::vec2::{dot, doubled_area};
use crate::numerics::vec3::distance;
use crate::solver::Control;

/// How far a seam may leave its chord, in square roots of the chart's area; clusters are narrower.
const BAND: f64 = 0.04;
/// The least area of a part, as a share of the atlas'.
const CRUMB: f64 = 0.005;
/// What a seam costs beside its length, in the unit of the price.
const PER_SEAM: f64 = 0.05;
/// Seams along chords of which the best counts, and chords at most that are tried for them: near some there is none.
const REFINED: usize = 4;
const TRIED: usize = 32;
/// What a cut is worth beside the room it gains, as a share of the smaller part's area: small charts leave less of a square
/// empty than large ones.
const SMALLER: f64 = 0.05;
/// The share of its square that an atlas should fill: no square around one chart should be larger.
const HOPE: f64 = 0.85;

/// A seam that parts a chart in two.
#[derive(Clone, Debug)]
pub struct Split {
    /// For each face whether it belongs to the one part.
    is_piece: Vec<bool>,
    /// Length of the seam on the surface; where it crosses a plane it counts several times.
    pub length: f64,
    /// How much the atlas may be expected to gain from it, for its length.
    pub worth: f64,
}

impl MappedChart {
    /// The seam that makes the chart's parts most compact and small for its length; none if no cut leaves two parts of some size.
    ///
    /// Candidates are straight chords of the map; the best are moved within a narrow band to where a seam costs least, a minimum
    /// cut, which prefers creases. `unit` is the square root of the area on a page. None either once `control` says to end.
    pub fn best_split(&self, unit: f64, control: &dyn Fn() -> Control) -> Option<Split> {
        let goes_on = || control() == Control::Continue;
        if !goes_on() {
            return None;
        }
        let disk = &self.chart.disk;
        let mesh = (&*disk.triangles, &*self.chart.positions);
        let labels = vec![0; disk.triangles.len()];
        let sheet = Sheet::divide(mesh, &disk.twins(), &labels, 1).pop()?;
        let splitter = Splitter::new(self, &sheet, unit);
        let mut chords = chords(&splitter.clusters, splitter.crumb, splitter.square);
        let worth = |chord: &Chord| splitter.worth(chord.gain, chord.area, chord.length);
        chords.sort_by(|a, b| worth(b).total_cmp(&worth(a)));
        let tried = chords.iter().take(TRIED).take_while(|_| goes_on());
        let splits = tried.filter_map(|chord| splitter.split(chord, control));
        let best = splits
            .take(REFINED)
            .max_by(|a, b| a.worth.total_cmp(&b.worth));
        best.filter(|_| goes_on())
    }

    /// The two parts, mapped as the whole is, each seen from its front.
    pub fn parted(&self, split: &Split) -> Vec<Self> {
        let twin = parted(&self.chart.disk.twins(), &split.is_piece);
        parts(&self.chart, &twin)
            .into_iter()
            .map(|(chart, faces)| self.restricted(chart, &faces).facing_front())
            .collect()
    }
}

/// Length on the surface of the seams of some charts: the edges at which their boundaries have two sides.
pub fn seam_length(charts: &[MappedChart]) -> f64 {
    let mut lengths: Vec<([[u64; 3]; 2], f64)> = Vec::new();
    for MappedChart { chart, .. } in charts {
        let loops = chart.disk.loops.iter();
        let edges = loops.flat_map(|of| of.iter().zip(of.iter().cycle().skip(1)));
        lengths.extend(edges.map(|(&a, &b)| {
            let [p, q] = [a, b].map(|v| chart.positions[v as usize]);
            let mut ends = [p, q].map(|p| p.map(f64::to_bits));
            ends.sort_unstable();
            (ends, distance(p, q))
        }));
    }
    lengths.sort_unstable_by_key(|&(ends, _)| ends);
    let sides = lengths.chunk_by(|a, b| a.0 == b.0);
    sides.filter(|of| of.len() > 1).map(|of| of[0].1).sum()
}

/// A chart whose chords become seams.
struct Splitter<'a> {
    sheet: &'a Sheet,
    uv: Vec<[f64; 2]>,
    clusters: Clusters,
    /// For each halfedge what a seam along it costs.
    cost: Vec<f64>,
    area: f64,
    /// The room that it takes up, and the square that should be enough for the atlas.
    room: f64,
    square: f64,
    /// The least area of a part, and what a seam costs beside its length.
    crumb: f64,
    per_seam: f64,
    directions: Directions,
}

impl<'a> Splitter<'a> {
    /// The vertices of the sheet are numbered anew.
    fn new(mapped: &MappedChart, sheet: &'a Sheet, unit: f64) -> Self {
        let mut uv = vec![[0.0; 2]; sheet.positions.len()];
        let corners = mapped.chart.disk.triangles.as_flattened();
        for (&v, &of_chart) in sheet.vertex.iter().zip(corners) {
            uv[v as usize] = mapped.embedding.uv[of_chart as usize];
        }
        let cost = edge_costs(sheet);
        let clusters = Clusters::new(sheet, &uv, &cost);
        let mut splitter = Self {
            cost,
            area: clusters.area.iter().sum(),
            room: 0.0,
            square: unit * unit / HOPE,
            crumb: CRUMB * unit * unit,
            per_seam: PER_SEAM * unit,
            directions: Directions::default(),
            sheet,
            uv,
            clusters,
        };
        splitter.room = splitter.room_of(|_| true);
        splitter
    }

    /// The seam near a chord, if it leaves two parts of some size.
    fn split(&self, chord: &Chord, control: &dyn Fn() -> Control) -> Option<Split> {
        let is_piece = self.refined(&self.beyond(chord), chord, control);
        let twin = &self.sheet.twin;
        let area: f64 = (0..is_piece.len())
            .filter(|&f| is_piece[f])
            .map(|f| self.face_area(f))
            .sum();
        if area < self.crumb || area > self.area - self.crumb {
            return None;
        }
        let (_, n_parts) = connected_faces(&parted(twin, &is_piece));
        let seam = (0u32..).zip(twin).filter(|&(h, &t)| {
            t != CUT && h < t && is_piece[h as usize / 3] != is_piece[t as usize / 3]
        });
        let length = seam.map(|(h, _)| self.cost[h as usize].max(self.sheet.length(h)));
        let length = length.sum();
        let gain = self.room - self.room_of(|f| is_piece[f]) - self.room_of(|f| !is_piece[f]);
        (n_parts == 2).then(|| Split {
            is_piece,
            length,
            worth: self.worth(gain, area, length),
        })
    }

    /// What a cut is worth that gains so much room and of which the one part has some.
    fn worth(&self, gain: f64, area: f64, length: f64) -> f64 {
        (gain + SMALLER * area.min(self.area - area)) / (length + self.per_seam)
    }

    /// The faces of the clusters that the chord cuts off.
    fn beyond(&self, chord: &Chord) -> Vec<bool> {
        let Clusters {
            centre,
            neighbors,
            of_face,
            ..
        } = &self.clusters;
        let mut is_in = vec![false; centre.len()];
        is_in[chord.cluster as usize] = true;
        let mut open = vec![chord.cluster];
        while let Some(cluster) = open.pop() {
            for &(next, _) in &neighbors[cluster as usize] {
                let is_beyond = dot(centre[next as usize], chord.direction) > chord.offset;
                if is_beyond && !std::mem::replace(&mut is_in[next as usize], true) {
                    open.push(next);
                }
            }
        }
        of_face
            .iter()
            .map(|&cluster| is_in[cluster as usize])
            .collect()
    }

    /// The piece with the cheapest border within a band around the chord.
    fn refined(
        &self,
        is_piece: &[bool],
        chord: &Chord,
        control: &dyn Fn() -> Control,
    ) -> Vec<bool> {
        let band = BAND * self.area.sqrt();
        let is_near = |f: u32| (self.reach(f, chord.direction) - chord.offset).abs() < band;
        let sheet = self.sheet;
        let touches = |f: u32, what: &dyn Fn(u32) -> bool| {
            (3 * f..3 * f + 3)
                .any(|h| sheet.twin[h as usize] != CUT && what(sheet.twin[h as usize] / 3))
        };
        // The band and the faces beside it.
        let faces: Vec<u32> = (0..is_piece.len() as u32)
            .filter(|&f| is_near(f) || touches(f, &is_near))
            .collect();
        let twin = twins_among(&sheet.twin, &faces);
        let halfedges = faces.iter().flat_map(|&f| 3 * f..3 * f + 3);
        let cost: Vec<f64> = halfedges.map(|h| self.cost[h as usize]).collect();
        let beside = |side: bool| -> Vec<u32> {
            let far = (0..)
                .zip(&faces)
                .filter(|&(_, &f)| !is_near(f) && is_piece[f as usize] == side);
            far.map(|(i, _)| i).collect()
        };
        let stays = min_cut(
            &twin,
            &capacities(&twin, &cost),
            (&beside(true), &beside(false)),
            control,
        );
        let mut refined = is_piece.to_vec();
        for (&f, stays) in faces.iter().zip(stays) {
            refined[f as usize] = stays;
        }
        refined
    }

    fn corners(&self, face: usize) -> [[f64; 2]; 3] {
        [3 * face, 3 * face + 1, 3 * face + 2].map(|c| self.uv[self.sheet.vertex[c] as usize])
    }

    fn face_area(&self, face: usize) -> f64 {
        let [a, b, c] = self.corners(face);
        doubled_area(a, b, c) / 2.0
    }

    /// How far a face's center lies in a direction.
    fn reach(&self, face: u32, direction: [f64; 2]) -> f64 {
        let corners = self.corners(face as usize);
        corners.iter().map(|&p| dot(p, direction)).sum::<f64>() / 3.0
    }

    /// The room that some faces take up, from the edges at which they end.
    fn room_of(&self, is_in: impl Fn(usize) -> bool) -> f64 {
        let mut hull = Support::EMPTY;
        for (h, &t) in (0u32..).zip(&self.sheet.twin) {
            if is_in(h as usize / 3) && (t == CUT || !is_in(t as usize / 3)) {
                for v in self.sheet.ends(h) {
                    hull.add(self.uv[v as usize], &self.directions);
                }
            }
        }
        hull.room(self.square)
    }
}
