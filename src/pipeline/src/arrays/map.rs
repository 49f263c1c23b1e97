//! All charts mapped, from one queue.

use rayon::prelude::*;
use std::cmp::Reverse;

use super::plan::{Cones, Plan, Refinement, Start, StraightCharts};
use super::seams::Seams;
use crate::portion::Portion;
use crate::tracker::Tracker;
use unwrapd_layout::charts::{
    Bound, Chart, Cut, Folds, MappedChart, Quality, Straighten, Straightened, charts, map_chart,
    map_chart_from, straightened,
};
use unwrapd_layout::search::{
    CutProblem, SearchEffort, Terms, charts_at_cones, charts_through, from_charts, from_surface,
    maps_at_cones_under_bound,
};
use unwrapd_maps::measure::cost::GIVEN_PAGE;
use unwrapd_maps::mesh::{CornerUvs, Resolution, Surface};

/// Texture of UVs for which no texture is known.
const SQUARE: Resolution = Resolution::square(1);

/// Cuts of a surface that a caller asks for.
pub struct GivenCuts<'a> {
    /// Seams of its piece, along which it is cut already.
    pub seams: &'a Seams,
    /// Vertices of the surface at which there are cones.
    pub cones: Vec<u32>,
}

/// Cuts every surface and maps its charts.
pub fn mapped_charts(
    surfaces: &[Surface],
    cuts: &[GivenCuts],
    plan: &Plan,
    tracker: &Tracker,
) -> Vec<Vec<MappedChart>> {
    if plan.refinement == Refinement::UnderBound {
        let of_all = surfaces.iter().map(|s| s.triangles.len()).sum();
        tracker.charts(0, of_all);
        let charts = (surfaces.par_iter().enumerate())
            .map(|(index, surface)| {
                let faces = surface.triangles.len();
                let portion = Portion::of_surface(tracker, index, faces);
                let effort = SearchEffort::for_surface(faces, of_all);
                let charts = under_bound(surface, cuts[index].seams, plan, effort, &portion);
                portion.all_mapped(charts.len());
                charts
            })
            .collect();
        return charts;
    }
    let charts: Vec<Vec<Chart>> = surfaces
        .par_iter()
        .zip(cuts)
        .map(|(surface, given)| {
            let at_cones = match plan.cones {
                Some(Cones::Number(n)) => charts_at_cones(surface, n as usize),
                Some(Cones::Given) => charts_through(surface, &given.cones),
                Some(Cones::UnderBound) | None => None,
            };
            at_cones.unwrap_or_else(|| charts(surface, plan.cut))
        })
        .collect();
    let kept = |mesh: usize, chart: &Chart| {
        let seams = cuts[mesh].seams;
        let uvs = plan.reads_uvs().then_some(seams.uvs.as_ref());
        let texture = seams.texture.unwrap_or(SQUARE);
        Some(uvs_of(chart, &surfaces[mesh], (uvs.flatten()?, texture)))
    };
    let n_charts: Vec<usize> = charts.iter().map(Vec::len).collect();
    let maps = map_charts(charts, kept, plan, tracker);
    let of_all = surfaces.iter().map(|s| s.triangles.len()).sum();
    (surfaces.par_iter().zip(maps).enumerate())
        .map(|(index, (surface, mut maps))| {
            let faces = surface.triangles.len();
            let portion = Portion::of_chart(tracker, index, faces);
            let is_glued = plan.refinement == Refinement::Glued && maps.len() > n_charts[index];
            if !is_glued && plan.straighten == StraightCharts::None {
                return maps;
            }
            let problem = CutProblem::new(surface, &plan.bound, &portion);
            if is_glued {
                let terms = Terms {
                    effort: SearchEffort::for_surface(faces, of_all),
                    ..Terms::default()
                };
                maps = from_charts(&problem, maps, &terms, &plan.embedding, &portion).0;
            }
            straight(maps, &problem, cuts[index].seams, plan, &portion)
        })
        .collect()
}

/// Straightens the borders of the charts of a surface that the plan names.
fn straight(
    charts: Vec<MappedChart>,
    problem: &CutProblem,
    seams: &Seams,
    plan: &Plan,
    portion: &Portion,
) -> Vec<MappedChart> {
    let is_selected = |chart: &MappedChart| {
        let corner = chart.chart.corners.first().map(|[corner, ..]| *corner);
        let face = corner.map(|corner| problem.surface().input_corner(corner)[0]);
        let control = seams.control.as_ref().zip(face);
        control.is_some_and(|(control, face)| control.of(face).straightens)
    };
    let condition = |chart: &MappedChart| match plan.straighten {
        StraightCharts::All => Straighten::WhereCompact,
        StraightCharts::Selected if is_selected(chart) => Straighten::WhereBounded,
        StraightCharts::Selected | StraightCharts::None => Straighten::Never,
    };
    let Straightened { charts, n_bent } = straightened(
        charts,
        &condition,
        &problem.weights(),
        problem.bound(),
        &plan.embedding,
        portion,
    );
    portion.bent(n_bent);
    charts
}

/// Returns the charts of a surface under the bound, or under a looser one if they exceed the maximum number of
/// charts; finally one chart per component, if that gives fewer. Where the plan has cones, each component is one chart, unless it
/// overlaps itself.
///
/// The bound on the stretch yields first, then the one on the mean: if the number of charts decides, a bound on the
/// stretch gives the same charts as none.
fn under_bound(
    surface: &Surface,
    seams: &Seams,
    plan: &Plan,
    effort: SearchEffort,
    portion: &Portion,
) -> Vec<MappedChart> {
    let most = plan.most_charts.map_or(usize::MAX, |n| n as usize);
    let options = &plan.embedding;
    let seam_price = plan.compaction.unwrap_or(1.0);
    let under = |problem: &CutProblem| {
        let terms = Terms {
            effort,
            fill_weight: GIVEN_PAGE / seam_price,
        };
        from_surface(problem, &terms, options, plan.symmetry, portion).0
    };
    let whole_components = || -> Vec<MappedChart> {
        charts(surface, Cut::Disk)
            .into_iter()
            .flat_map(|chart| map_chart(chart, options, Folds::Cut, portion))
            .collect()
    };
    let mut problem = CutProblem::new(surface, &plan.bound, portion);
    if plan.cones == Some(Cones::UnderBound) {
        let at_cones = maps_at_cones_under_bound(&problem, options, portion);
        let maps = at_cones.unwrap_or_else(whole_components);
        return straight(maps, &problem, seams, plan, portion);
    }
    let mut fewest = under(&problem);
    while fewest.len() > most {
        let bound = *problem.bound();
        let next = match bound.stretch {
            Some(_) => Some(bound.mean),
            None => Quality::looser_than(bound.mean),
        };
        let others = match next {
            Some(mean) => {
                problem.set_bound(&Bound {
                    mean,
                    stretch: None,
                    ..bound
                });
                under(&problem)
            }
            None => whole_components(),
        };
        if others.len() < fewest.len() {
            fewest = others;
        }
        if next.is_none() {
            break;
        }
    }
    straight(fewest, &problem, seams, plan, portion)
}

/// Returns the given UVs at the vertices of a chart, along both axes in longer sides of the texture. Corners whose
/// UVs are not finite get those of another corner of their face: the face then has no area, and is counted.
fn uvs_of(
    chart: &Chart,
    surface: &Surface,
    (uvs, texture): (&[CornerUvs], Resolution),
) -> Vec<[f64; 2]> {
    let sides = texture.sides();
    let mut of_vertex = vec![[0.0; 2]; chart.disk.n_vertices];
    for (triangle, corners) in chart.disk.triangles.iter().zip(&chart.corners) {
        for (&vertex, &corner) in triangle.iter().zip(corners) {
            let [face, k] = surface.input_corner(corner).map(|x| x as usize);
            let is_finite = |uv: &&[f64; 2]| uv.iter().all(|x| x.is_finite());
            let own = Some(&uvs[face][k]).filter(is_finite);
            let another = || uvs[face].iter().find(is_finite);
            let [u, v] = own.or_else(another).copied().unwrap_or_default();
            of_vertex[vertex as usize] = [u * sides[0], v * sides[1]];
        }
    }
    of_vertex
}

/// Maps every chart of every mesh, the largest first.
fn map_charts(
    charts: Vec<Vec<Chart>>,
    kept: impl Fn(usize, &Chart) -> Option<Vec<[f64; 2]>> + Sync,
    plan: &Plan,
    tracker: &Tracker,
) -> Vec<Vec<MappedChart>> {
    let mut maps: Vec<Vec<MappedChart>> = charts
        .iter()
        .map(|of_mesh| Vec::with_capacity(of_mesh.len()))
        .collect();
    let mut queue: Vec<((usize, usize), Chart)> = (charts.into_iter().enumerate())
        .flat_map(|(mesh, of_mesh)| (0..).zip(of_mesh).map(move |(c, chart)| ((mesh, c), chart)))
        .collect();
    let n_faces = |(_, chart): &(_, Chart)| chart.disk.triangles.len();
    let faces: usize = queue.iter().map(n_faces).sum();
    let passes = 1 + usize::from(plan.refinement == Refinement::Glued);
    tracker.charts(queue.len(), passes * faces);
    queue.sort_by_key(|entry| (Reverse(n_faces(entry)), entry.0));
    let mut mapped: Vec<((usize, usize), Vec<MappedChart>)> = queue
        .into_par_iter()
        .with_max_len(1)
        .map(|(id, chart)| {
            let portion = Portion::of_chart(tracker, id.0, chart.disk.triangles.len());
            let parts = match kept(id.0, &chart) {
                Some(uv) if plan.start == Start::Final => {
                    vec![MappedChart::given(chart, uv)]
                }
                Some(uv) => map_chart_from(chart, uv, &plan.embedding, &portion),
                None => map_chart(chart, &plan.embedding, plan.folds, &portion),
            };
            tracker.charts_done(1);
            (id, parts)
        })
        .collect();
    mapped.sort_by_key(|(id, _)| *id);
    for ((mesh, _), parts) in mapped {
        maps[mesh].extend(parts);
    }
    maps
}
