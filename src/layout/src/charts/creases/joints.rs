//! Where charts could be joined, and what seam that would save.

use crate::charts::crease::cost_between_planes;
use crate::charts::facets::faces::Faces;
use crate::charts::facets::planar::Facets;
use crate::charts::give_back::border::{Borders, Run};
use crate::charts::mapped::MappedChart;
use crate::charts::symmetry::plane::MirrorPlane;
use std::cmp::Reverse;
use std::collections::BTreeMap;
use unwrapd_maps::mesh::Surface;
use unwrapd_method::numerics::vec2::{cross, dot, sub};
use unwrapd_method::numerics::vec3 as space;

/// How far the two sides of a border may differ, as a part of its length: a facet that is laid flat
/// by the ten-thousandth part by which it is not one loses less.
const SAME: f64 = 1e-3;

/// How far a border may turn at a vertex: the sine of the angle.
const STRAIGHT: f64 = 0.02;

/// Costs that differ by less, as a part of the largest, are equal.
const EQUAL: f64 = 1e-6;

/// How far a border may leave the mirror plane that it lies in, as a part of its length.
const IN_PLANE: f64 = 1e-3;

/// A straight border of two charts whose sides have the same length.
pub struct Joint {
    /// The chart whose run it is.
    pub chart: u32,
    pub run: Run,
    /// What a seam there costs, in units in which equal costs are equal numbers.
    pub cost: u64,
    /// The same by which joints are compared.
    pub rank: u64,
    /// Where it begins and ends on the surface.
    pub ends: [[f64; 3]; 2],
}

/// The joints of some charts: those that save most come first, of equals those of small charts.
///
/// One in a mirror plane counts half as much as elsewhere: it stands against two.
pub fn joints(
    surface: &Surface,
    (faces, facets): (&Faces, &Facets),
    charts: &BTreeMap<u32, MappedChart>,
    mirror: Option<&MirrorPlane>,
) -> Vec<Joint> {
    let borders = Borders::new(surface, charts.iter().map(|(&n, map)| (n, &map.chart)));
    let cos = |h: u32| {
        let sides = [h, faces.across[h as usize]].map(|h| facets.of_face.get(h as usize / 3));
        let [Some(&here), Some(&there)] = sides else {
            return 0.0;
        };
        let [a, b] = [here, there].map(|facet| facets.normals[facet as usize]);
        space::dot(a, b)
    };
    let cost = |run: &Run| -> f64 {
        let costs = run.halfedges.iter();
        let costs = costs.map(|&h| faces.length(h) * cost_between_planes(cos(h)));
        costs.sum()
    };
    let ends = |number: u32, run: &Run| {
        let [first, last] = [0, run.vertices.len() - 1].map(|i| run.vertices[i][0]);
        [first, last].map(|v| charts[&number].chart.positions[v as usize])
    };
    let mut joints: Vec<(f64, u32, Run)> = Vec::new();
    for (&number, map) in charts {
        let runs = borders.runs(number, charts).into_iter();
        for run in runs.filter(|run| run.neighbor > number) {
            let (uv, of_neighbor) = (&map.embedding.uv, &charts[&run.neighbor].embedding.uv);
            let parts = straight_parts(&run, uv).into_iter();
            let parts = parts.filter(|part| is_same(part, uv, of_neighbor));
            joints.extend(parts.map(|part| (cost(&part), number, part)));
        }
    }
    let most = joints
        .iter()
        .fold(0.0, |most: f64, joint| most.max(joint.0));
    let unit = (EQUAL * most).max(f64::MIN_POSITIVE);
    let area: BTreeMap<u32, f64> = charts.iter().map(|(&n, map)| (n, map.area())).collect();
    let of_both = |joint: &Joint| area[&joint.chart] + area[&joint.run.neighbor];
    let joint = |(cost, chart, run): (f64, u32, Run)| {
        let ends = ends(chart, &run);
        let share = if mirror.is_some_and(|plane| lies_in(plane, ends)) {
            0.5
        } else {
            1.0
        };
        Joint {
            chart,
            run,
            ends,
            cost: (cost / unit).round() as u64,
            rank: (share * cost / unit).round() as u64,
        }
    };
    let mut joints: Vec<Joint> = joints.into_iter().map(joint).collect();
    joints.sort_by(|a, b| {
        (Reverse(a.rank).cmp(&Reverse(b.rank)))
            .then(of_both(a).total_cmp(&of_both(b)))
            .then(a.run.halfedges.cmp(&b.run.halfedges))
    });
    joints
}

fn lies_in(plane: &MirrorPlane, [a, b]: [[f64; 3]; 2]) -> bool {
    let reach = IN_PLANE * space::distance(a, b);
    [a, b].iter().all(|&p| plane.height(p).abs() <= reach)
}

/// The parts of a run that are straight in a map.
fn straight_parts(run: &Run, uv: &[[f64; 2]]) -> Vec<Run> {
    let at = |i: usize| uv[run.vertices[i][0] as usize];
    let turns = |i: usize| {
        let (before, after) = (sub(at(i), at(i - 1)), sub(at(i + 1), at(i)));
        let sine = cross(before, after).abs();
        sine > STRAIGHT * norm(before) * norm(after) || dot(before, after) < 0.0
    };
    let last = run.vertices.len() - 1;
    let mut ends: Vec<usize> = vec![0];
    ends.extend((1..last).filter(|&i| turns(i)));
    ends.push(last);
    let parts = ends.windows(2);
    parts.map(|ends| run.part(ends[0]..ends[1])).collect()
}

/// Whether the two sides of a run have the same shape.
fn is_same(run: &Run, uv: &[[f64; 2]], of_neighbor: &[[f64; 2]]) -> bool {
    let first = run.vertices[0];
    let length = run.length(uv);
    run.vertices.iter().all(|&[v, w]| {
        let here = norm(sub(uv[v as usize], uv[first[0] as usize]));
        let there = norm(sub(of_neighbor[w as usize], of_neighbor[first[1] as usize]));
        (here - there).abs() <= SAME * length
    })
}

fn norm(v: [f64; 2]) -> f64 {
    v[0].hypot(v[1])
}
