//! From plain arrays to an atlas: weld, cut, map, pack.

use rayon::prelude::*;

use super::observer::{Observer, Stage, Tracker};
use super::options::Settings;
use super::{PipelineError, repeated};
use crate::atlas::{self, Atlas, AtlasOptions, ChartMap};
use crate::charts::{self, Chart};
use crate::embed::{self, Embedding};
use crate::mesh::{Defects, Surface};
use crate::solver::{self, Iterate, Summary};

/// The corner of a face on the integer grid of 2⁻ᵏ, v up, with k = [`atlas::GRID_BITS`].
pub type GridCorners = [[i32; 2]; 3];

/// An unwrapped mesh.
#[derive(Clone, Debug)]
pub struct Unwrapped {
    /// For every face of the input its corners on the grid.
    pub grid: Vec<GridCorners>,
    /// What happened to each chart.
    pub charts: Vec<ChartRecord>,
    /// What was found to be wrong with the mesh.
    pub defects: Defects,
    /// UV length of one unit of length of the mesh.
    pub scale: f64,
    /// Padding that was kept, in texels; less than asked for only where the charts alone would fill the square.
    pub padding_texels: f64,
}

/// How a chart was mapped.
#[derive(Clone, Debug)]
pub struct ChartRecord {
    /// Triangles of the chart.
    pub faces: usize,
    /// How the optimization went.
    pub summary: Summary,
    /// Seconds of the observer's clock from the chart's start to its end.
    pub seconds: f64,
}

impl Unwrapped {
    /// The UVs of every corner of every face, v up, exact in f32.
    pub fn corner_uvs(&self) -> Vec<[[f64; 2]; 3]> {
        let unit = 1.0 / f64::from(1_u32 << atlas::GRID_BITS);
        let uv = |p: [i32; 2]| [f64::from(p[0]) * unit, f64::from(p[1]) * unit];
        self.grid.iter().map(|face| face.map(uv)).collect()
    }
}

/// Unwraps a mesh given as arrays into one atlas: every triangle with three distinct positions gets a positive area
/// in the unit square, at one texel density.
///
/// Equal input and settings give equal output, for any number of threads.
pub fn unwrap(
    positions: &[[f32; 3]],
    triangles: &[[u32; 3]],
    settings: &Settings,
    observer: &dyn Observer,
) -> Result<Unwrapped, PipelineError> {
    settings.validate().map_err(PipelineError::InvalidOptions)?;
    let tracker = Tracker::new(observer, settings.time_budget);
    let mesh = Soup {
        positions,
        triangles,
    };
    let mut atlases = in_pool(settings.threads, || unwrap_all(&[mesh], settings, &tracker))??;
    atlases.pop().ok_or(PipelineError::NoTriangles)
}

/// A mesh as arrays.
#[derive(Clone, Copy)]
pub(super) struct Soup<'a> {
    pub(super) positions: &'a [[f32; 3]],
    pub(super) triangles: &'a [[u32; 3]],
}

/// Runs `work` with the given number of threads; nothing of it touches rayon's global pool.
pub(super) fn in_pool<T: Send>(
    threads: Option<usize>,
    work: impl FnOnce() -> T + Send,
) -> Result<T, PipelineError> {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads.unwrap_or(0))
        .build()
        .map_err(|error| PipelineError::Threads(error.to_string()))?;
    Ok(pool.install(work))
}

/// Unwraps every mesh into its own atlas; the charts of all of them are mapped from one queue.
pub(super) fn unwrap_all(
    meshes: &[Soup],
    settings: &Settings,
    tracker: &Tracker,
) -> Result<Vec<Unwrapped>, PipelineError> {
    tracker.stage(Stage::Cut);
    let surfaces: Vec<Surface> = meshes
        .par_iter()
        .map(|mesh| Surface::new(mesh.positions, mesh.triangles))
        .collect::<Result<_, _>>()?;
    if surfaces.iter().all(|surface| surface.triangles.is_empty()) {
        return Err(PipelineError::NoTriangles);
    }
    let charts: Vec<Vec<Chart>> = surfaces
        .par_iter()
        .map(|surface| charts::charts(surface, settings.cut))
        .collect();
    let maps = map_charts(&charts, settings, tracker);
    tracker.stage(Stage::Pack);
    let jobs: Vec<_> = meshes
        .iter()
        .zip(&surfaces)
        .zip(charts.iter().zip(maps))
        .collect();
    jobs.into_par_iter()
        .map(|((mesh, surface), (charts, maps))| assemble(*mesh, surface, charts, &maps, settings))
        .collect()
}

/// A mapped chart and the seconds it took.
struct Mapped {
    embedding: Embedding,
    seconds: f64,
}

/// Maps every chart of every mesh, the largest first.
fn map_charts(charts: &[Vec<Chart>], settings: &Settings, tracker: &Tracker) -> Vec<Vec<Mapped>> {
    let mut queue: Vec<(usize, usize)> = charts
        .iter()
        .enumerate()
        .flat_map(|(m, of_mesh)| (0..of_mesh.len()).map(move |c| (m, c)))
        .collect();
    let n_faces = |&(m, c): &(usize, usize)| charts[m][c].disk.triangles.len();
    tracker.charts(queue.len(), queue.iter().map(n_faces).sum());
    queue.sort_by_key(|id| (std::cmp::Reverse(n_faces(id)), *id));
    let mut mapped: Vec<((usize, usize), Mapped)> = queue
        .into_par_iter()
        .with_max_len(1)
        .map(|id| (id, map_chart(&charts[id.0][id.1], settings, tracker)))
        .collect();
    mapped.sort_by_key(|(id, _)| *id);
    let mut maps: Vec<Vec<Mapped>> = charts
        .iter()
        .map(|of_mesh| Vec::with_capacity(of_mesh.len()))
        .collect();
    for ((mesh, _), map) in mapped {
        maps[mesh].push(map);
    }
    maps
}

fn map_chart(chart: &Chart, settings: &Settings, tracker: &Tracker) -> Mapped {
    let begin = tracker.elapsed();
    let faces = chart.disk.triangles.len();
    let options = embed::Options {
        energy: settings.energy,
        barrier: settings.barrier,
        beta: settings.barrier_strength,
        s: settings.barrier_support,
        solver: solver::Settings::default(),
    };
    let watch = |iterate: &Iterate| tracker.iterate(faces, iterate);
    let embedding = embed::parameterize(&chart.disk, &chart.positions, &options, &watch);
    tracker.chart_done(faces);
    Mapped {
        embedding,
        seconds: tracker.elapsed().saturating_sub(begin).as_secs_f64(),
    }
}

/// Packs the charts of one mesh and hands every face of the input its corners.
fn assemble(
    mesh: Soup,
    surface: &Surface,
    charts: &[Chart],
    maps: &[Mapped],
    settings: &Settings,
) -> Result<Unwrapped, PipelineError> {
    let chart_maps: Vec<ChartMap> = charts
        .iter()
        .zip(maps)
        .map(|(chart, map)| ChartMap {
            uv: &map.embedding.uv,
            triangles: &chart.disk.triangles,
        })
        .collect();
    let options = AtlasOptions {
        resolution: settings.resolution,
        padding_texels: settings.padding,
    };
    let atlas = atlas::pack(&chart_maps, &options)?;
    let records = charts.iter().zip(maps).map(|(chart, map)| ChartRecord {
        faces: chart.disk.triangles.len(),
        summary: map.embedding.summary,
        seconds: map.seconds,
    });
    Ok(Unwrapped {
        grid: face_corners(mesh, surface, charts, &atlas),
        charts: records.collect(),
        defects: surface.defects,
        scale: atlas.scale,
        padding_texels: atlas.padding_texels,
    })
}

fn face_corners(
    mesh: Soup,
    surface: &Surface,
    charts: &[Chart],
    atlas: &Atlas,
) -> Vec<GridCorners> {
    let mut grid = vec![[[0; 2]; 3]; mesh.triangles.len()];
    for (chart, placed) in charts.iter().zip(&atlas.placed) {
        for (triangle, corners) in chart.disk.triangles.iter().zip(&chart.corners) {
            for (&vertex, &corner) in triangle.iter().zip(corners) {
                let face = surface.faces[corner as usize / 3] as usize;
                grid[face][corner as usize % 3] = placed.grid[vertex as usize];
            }
        }
    }
    repeated::place(mesh.positions, mesh.triangles, &surface.faces, &mut grid);
    grid
}
