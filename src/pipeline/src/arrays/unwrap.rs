//! From plain arrays to an atlas: weld, cut, map, pack.

use rayon::prelude::*;

use super::arranged::{
    ArrangementTerms, RuledCharts, Sizes, are_constrained, arranged, at_own_sizes, resize,
};
use super::copies::{Copies, WithoutCopies};
use super::divided::Divided;
use super::packed::{ChartTerms, packed};
use super::packing::{atlas_options, expected_words, likely_words};
use super::placed_faces::PlacedFaces;
use super::plan::{Plan, Start};
use super::repeated::{self, GridCorners};
use super::same_shape::FlatTriangles;
use super::seams::Seams;
use super::settings::Settings;
use super::soup::Soup;
use super::stacks::Stacks;
use crate::PipelineError;
use crate::observer::Observer;
use crate::options::{Stacking, Workers};
use crate::portion::Portion;
use crate::tracker::Tracker;
use unwrapd_api::Stage;
use unwrapd_layout::atlas::{self, Atlas, AtlasOptions, Limit};
use unwrapd_layout::charts::MappedChart;
use unwrapd_maps::mesh::{Defects, Surface};
use unwrapd_method::solver::Summary;

/// An unwrapped mesh.
#[derive(Clone, Debug)]
pub struct Unwrapped {
    /// Corners of every face of the input, on the grid.
    pub grid: Vec<GridCorners>,
    /// Record of each chart.
    pub charts: Vec<ChartRecord>,
    /// Defects of the mesh.
    pub defects: Defects,
    /// UV length of one unit of length of the mesh, along the longer side of the texture.
    pub scale: f64,
    /// Earlier mesh of the same shape that has the same atlas, if several meshes are unwrapped.
    pub same_as: Option<usize>,
    /// Faces of islands that stay where they are: their UVs are those that were given.
    pub still: Vec<u32>,
    /// Padding that was kept, in texels; less than asked for only where the charts alone would fill the square.
    pub padding_texels: f64,
    /// Chart that alone sets the scale, if there is one.
    pub limit: Option<Limit>,
}

/// Record of mapping a chart.
#[derive(Clone, Debug)]
pub struct ChartRecord {
    /// Triangles of the chart.
    pub faces: usize,
    /// Summary of the optimization.
    pub summary: Summary,
    /// Seconds of the observer's clock from the chart's start to its end.
    pub seconds: f64,
}

impl Unwrapped {
    /// Returns the UVs of every corner of every face, v up, exact in f32.
    pub fn corner_uvs(&self) -> Vec<[[f64; 2]; 3]> {
        let unit = 1.0 / f64::from(1_u32 << atlas::GRID_BITS);
        let uv = |p: [i32; 2]| [f64::from(p[0]) * unit, f64::from(p[1]) * unit];
        self.grid.iter().map(|face| face.map(uv)).collect()
    }
}

/// Unwraps a mesh given as arrays into one atlas: every triangle with three distinct positions gets a positive area
/// in the unit square, at one texel density. Coordinates are `f32` or `f64`.
///
/// Equal input and settings give equal output, for any number of threads.
pub fn unwrap<T: Copy + Into<f64>>(
    positions: &[[T; 3]],
    triangles: &[[u32; 3]],
    settings: &Settings,
    observer: &dyn Observer,
) -> Result<Unwrapped, PipelineError> {
    unwrap_along(positions, triangles, &Seams::default(), settings, observer)
}

/// Like [`unwrap`], but cuts the mesh along `seams` in any case; with
/// [`Cut::Seams`](unwrapd_layout::charts::Cut::Seams) and [`Cut::Keep`](unwrapd_layout::charts::Cut::Keep), along no
/// other edges than are needed to open what they enclose.
pub fn unwrap_along<T: Copy + Into<f64>>(
    positions: &[[T; 3]],
    triangles: &[[u32; 3]],
    seams: &Seams,
    settings: &Settings,
    observer: &dyn Observer,
) -> Result<Unwrapped, PipelineError> {
    settings.validate().map_err(PipelineError::InvalidOptions)?;
    let tracker = Tracker::new(observer, settings.budget);
    let positions: Vec<[f64; 3]> = positions.iter().map(|p| p.map(Into::into)).collect();
    let mesh = Soup {
        positions: &positions,
        triangles,
        seams,
        parts: &[],
        originals: &[],
    };
    let mut atlases = in_pool(settings.workers, || unwrap_all(&[mesh], settings, &tracker))??;
    atlases.pop().ok_or(PipelineError::NoTriangles)
}

/// Runs `work` on a thread pool of its own; nothing of it touches rayon's global pool.
pub fn in_pool<T: Send>(
    workers: Workers,
    work: impl FnOnce() -> T + Send,
) -> Result<T, PipelineError> {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(workers.threads.unwrap_or(0))
        .build()
        .map_err(|error| PipelineError::Threads(error.to_string()))?;
    Ok(pool.install(work))
}

/// Unwraps every mesh into its own atlas; the charts of all meshes are mapped from one queue. Meshes of equal shape
/// are mapped once, and packed once if each has its own atlas. If asked for, copies of a part of a mesh are stacked on it.
pub fn unwrap_all(
    meshes: &[Soup],
    settings: &Settings,
    tracker: &Tracker,
) -> Result<Vec<Unwrapped>, PipelineError> {
    let mut plan = Plan::new(settings)?;
    if meshes.iter().any(|mesh| mesh.seams.cones.is_some()) {
        plan = plan.with_given_cones()?;
    }
    if !plan.stacks_by_shape() {
        return unwrap_each(meshes, (settings, &plan), tracker);
    }
    let defects = meshes.par_iter().map(|mesh| {
        mesh.seams.check(mesh.positions, mesh.triangles)?;
        Ok(Surface::new(mesh.positions, mesh.triangles)?.defects)
    });
    let defects: Vec<Defects> = defects.collect::<Result<_, PipelineError>>()?;
    let with_copies = |triangles: FlatTriangles| {
        let parts: Vec<WithoutCopies> = (meshes.par_iter())
            .map(|mesh| WithoutCopies::of(*mesh, plan.stacking, triangles))
            .collect();
        let soups: Vec<Soup> = parts.iter().map(WithoutCopies::soup).collect();
        let unwrapped = unwrap_each(&soups, (settings, &plan), tracker)?;
        let whole = parts.iter().zip(unwrapped).zip(&defects);
        let whole = whole.map(|((parts, unwrapped), defects)| {
            Some(Unwrapped {
                grid: parts.with_copies(&unwrapped.grid, plan.stack_shift)?,
                defects: *defects,
                ..unwrapped
            })
        });
        Ok::<_, PipelineError>(whole.collect::<Option<Vec<Unwrapped>>>())
    };
    // Seldom a flat area with other triangles in a copy is cut or bent.
    if let Some(unwrapped) = with_copies(FlatTriangles::Any)? {
        return Ok(unwrapped);
    }
    with_copies(FlatTriangles::Same)?.ok_or(PipelineError::NoTriangles)
}

fn unwrap_each(
    meshes: &[Soup],
    (settings, plan): (&Settings, &Plan),
    tracker: &Tracker,
) -> Result<Vec<Unwrapped>, PipelineError> {
    tracker.stage(Stage::Cut);
    let divided = Divided::new(meshes, plan)?;
    let same_as: Vec<Option<(usize, f64)>> = (0..meshes.len())
        .map(|mesh| divided.same_mesh(mesh, settings))
        .collect();
    let is_own: Vec<bool> = same_as.iter().map(Option::is_none).collect();
    let own = || (0..meshes.len()).filter(|&mesh| is_own[mesh]);
    let n_atlases = own().count();
    let words = |mesh| likely_words((settings, plan), n_atlases, divided.n_faces(mesh));
    let all_words = own().map(words).sum();
    tracker.expect(divided.n_mapped_faces(), all_words);
    let charts = divided.charts(&is_own, plan, tracker);
    tracker.begin(Stage::Pack, all_words as f64);
    let atlases: Vec<Option<PackedMesh>> = (charts.into_par_iter().enumerate())
        .with_max_len(1)
        .map(|(index, charts)| {
            if !is_own[index] {
                return Ok(None);
            }
            let atlas = MeshAtlas {
                mesh: &meshes[index],
                settings,
                plan,
                n_atlases,
                n_components: divided.n_components(index),
                likely_words: words(index),
                tracker,
            };
            atlas.packed(charts).map(Some)
        })
        .collect::<Result<_, PipelineError>>()?;
    (meshes.par_iter().enumerate())
        .map(|(index, mesh)| {
            let (first, size) = same_as[index].unwrap_or((index, 1.0));
            let PackedMesh {
                charts,
                atlas,
                copies,
            } = atlases[first].as_ref().ok_or(PipelineError::NoTriangles)?;
            let mut grid = chart_corners(mesh, charts, atlas);
            if let Some(copies) = copies {
                copies.place(&mut grid, plan.stack_shift);
            }
            let faces = divided.faces(index);
            repeated::place(mesh.positions, mesh.triangles, &faces, &mut grid);
            Ok(Unwrapped {
                grid,
                charts: charts.iter().map(ChartRecord::new).collect(),
                defects: divided.defects(index, mesh)?,
                scale: atlas.scale / size,
                same_as: (first != index).then_some(first),
                still: placed_faces(mesh, plan)?.map_or_else(Vec::new, |placed| placed.still()),
                padding_texels: atlas.padding_texels,
                limit: atlas.limit,
            })
        })
        .collect()
}

/// A mesh whose charts become an atlas.
struct MeshAtlas<'a> {
    mesh: &'a Soup<'a>,
    settings: &'a Settings,
    plan: &'a Plan,
    /// Number of atlases that share the effort.
    n_atlases: usize,
    n_components: usize,
    /// Words that packing was expected to read.
    likely_words: u64,
    tracker: &'a Tracker<'a>,
}

/// The charts of a mesh in their atlas.
struct PackedMesh {
    charts: Vec<MappedChart>,
    atlas: Atlas,
    /// Charts that are stacked on others of their shape, and are not among `charts`.
    copies: Option<Copies>,
}

impl MeshAtlas<'_> {
    /// Packs the charts, with those of one shape on each other if the plan says so.
    fn packed(&self, charts: Vec<MappedChart>) -> Result<PackedMesh, PipelineError> {
        let options = atlas_options((self.settings, self.plan), self.n_atlases, &charts);
        let charts = weighted(charts, self.mesh.seams);
        if !self.plan.stacks_by_shape() {
            return self.without_copies(charts, None, &options);
        }
        let charts = self.terms().prepared(charts);
        // Seldom a flat area with other triangles in a copy is cut or bent.
        let packed = self.stacked(charts.clone(), FlatTriangles::Any, &options)?;
        let mut grid = chart_corners(self.mesh, &packed.charts, &packed.atlas);
        match &packed.copies {
            Some(copies) if !copies.place(&mut grid, 0) => {
                self.stacked(charts, FlatTriangles::Same, &options)
            }
            _ => Ok(packed),
        }
    }

    fn stacked(
        &self,
        charts: Vec<MappedChart>,
        triangles: FlatTriangles,
        options: &AtlasOptions,
    ) -> Result<PackedMesh, PipelineError> {
        let faces = |chart: &MappedChart| -> Vec<u32> {
            let corners = chart.chart.corners.iter();
            corners.map(|[corner, ..]| corner / 3).collect()
        };
        let parts: Vec<Vec<u32>> = charts.iter().map(faces).collect();
        let copies = Copies::among(*self.mesh, parts.clone(), self.plan.stacking, triangles);
        let is_own = |faces: &Vec<u32>| faces.first().is_none_or(|&face| !copies.has(face));
        let own = charts.into_iter().zip(&parts);
        let own = own
            .filter(|(_, faces)| is_own(faces))
            .map(|(chart, _)| chart);
        self.without_copies(own.collect(), Some(copies), options)
    }

    fn terms(&self) -> ChartTerms<'_> {
        ChartTerms {
            plan: self.plan,
            cuts: self.plan.cut_terms(self.n_components),
            polygons: self.mesh.seams.polygons.as_deref(),
        }
    }

    fn without_copies(
        &self,
        charts: Vec<MappedChart>,
        copies: Option<Copies>,
        options: &AtlasOptions,
    ) -> Result<PackedMesh, PipelineError> {
        let (mesh, plan, settings) = (self.mesh, self.plan, self.settings);
        // Islands that stay are not packed, and others that coincide are packed as one.
        let placed = placed_faces(mesh, plan)?;
        let mut ruled = RuledCharts::new(charts, mesh, placed.as_ref(), options.texture)?;
        let charts = std::mem::take(&mut ruled.free);
        let is_stacked = plan.start == Start::Final && plan.stacking != Stacking::Off;
        let (mut charts, stacks) = if is_stacked {
            let (charts, stacks) = Stacks::of(charts, mesh.seams);
            (charts, Some(stacks))
        } else {
            (charts, None)
        };
        resize(&mut charts, mesh.seams, options.texture.resolution);
        let sizes = Sizes::of(&charts, mesh.seams);
        let expected = expected_words(plan, options, &charts);
        let portion = Portion::of_atlas(self.tracker, self.likely_words, expected);
        let on_read = |words| portion.read(words);
        let terms = self.terms();
        let is_alone = ruled.is_free() && !are_constrained(&charts, mesh.seams);
        let (charts, mut atlas) = match sizes {
            Sizes::Common if is_alone => packed(charts, terms, options, &on_read)?,
            Sizes::Own if is_alone => packed(charts, terms, &at_own_sizes(options), &on_read)?,
            Sizes::Common | Sizes::Own | Sizes::Both => {
                let terms = ArrangementTerms {
                    seams: mesh.seams,
                    charts: terms,
                    settings,
                    plan,
                    n_atlases: self.n_atlases,
                    on_read: &on_read,
                };
                arranged(charts, &ruled, placed.as_ref(), &terms)?
            }
        };
        // Add what was not packed by itself: islands of stacks, and those that stay.
        let obstacles = atlas.placed.split_off(charts.len());
        let (charts, mut atlas) = match stacks {
            None => (charts, atlas),
            Some(stacks) => stacks.restored(charts, atlas, plan.stack_shift),
        };
        atlas.placed.extend(obstacles);
        let (charts, atlas) = ruled.with_staying(charts, atlas);
        Ok(PackedMesh {
            charts,
            atlas,
            copies,
        })
    }
}

/// Returns the faces of islands that stay where they are put, if there are any.
fn placed_faces(mesh: &Soup, plan: &Plan) -> Result<Option<PlacedFaces>, PipelineError> {
    if plan.start == Start::Final {
        Ok(PlacedFaces::new(
            mesh.positions,
            mesh.triangles,
            mesh.seams,
            plan.stacking,
        )?)
    } else {
        Ok(None)
    }
}

/// Enlarges charts by the weights of their faces.
fn weighted(mut charts: Vec<MappedChart>, seams: &Seams) -> Vec<MappedChart> {
    let Some(weights) = &seams.weights else {
        return charts;
    };
    for MappedChart {
        chart, embedding, ..
    } in &mut charts
    {
        // All faces of a chart have one weight, as edges between different weights are seams.
        if let Some([corner, ..]) = chart.corners.first() {
            let weight = weights[*corner as usize / 3];
            for p in &mut embedding.uv {
                *p = p.map(|x| weight * x);
            }
        }
    }
    charts
}

impl ChartRecord {
    fn new(mapped: &MappedChart) -> Self {
        Self {
            faces: mapped.chart.disk.triangles.len(),
            summary: mapped.embedding.summary,
            seconds: mapped.seconds,
        }
    }
}

/// Returns the corners of every face that is in one of these charts.
fn chart_corners(mesh: &Soup, charts: &[MappedChart], atlas: &Atlas) -> Vec<GridCorners> {
    let mut grid = vec![[[0; 2]; 3]; mesh.triangles.len()];
    for (MappedChart { chart, .. }, placed) in charts.iter().zip(&atlas.placed) {
        for (triangle, corners) in chart.disk.triangles.iter().zip(&chart.corners) {
            for (&vertex, &corner) in triangle.iter().zip(corners) {
                grid[corner as usize / 3][corner as usize % 3] = placed.grid[vertex as usize];
            }
        }
    }
    grid
}
