//! The options of `unwrapd unwrap`, in the groups that its help shows. Those without a heading matter first.

use std::path::{Path, PathBuf};

use super::failure::Failure;
use super::format::output_format;
use super::input::read_file;
use super::output::{OutputArgs, Outputs, stem};
use super::words::{
    BARRIERS, CUTS, ENERGIES, FORMATS, GROUPS, HEATMAPS, IMAGE_FORMATS, PACKINGS, PRESETS,
    QUALITIES, word,
};
use crate::barrier::BarrierKind;
use crate::charts::{Cut, Quality};
use crate::document::{GroupBy, OutputFormat};
use crate::energy::EnergyKind;
use crate::mesh::Resolution;
use crate::picture::HeatmapMeasure;
use crate::pipeline::{
    GivenSeams, ImageFormat, KeptMaps, Limits, NamedSeams, Options, PackingMode, Preset,
    TexelWeight,
};

/// Gives a mesh UVs in which no triangle is flipped or degenerate, proven on the bytes written.
///
/// Exit status 0 means certified: that no triangle is flipped, without area or overlapping another, that no chart is mirrored, and
/// that padding, pages and bits are as asked, is proven on the bytes written. Otherwise it is 4, and a line says what is
/// missing; OUT is written nevertheless, unless a triangle is flipped that should not be. More stretch than `--quality` allows
/// is a warning.
#[derive(clap::Args)]
pub(super) struct Args {
    /// Mesh: .glb, .gltf, .obj, .off, .ply or .stl; `-` is standard input
    #[arg(value_name = "IN")]
    pub(super) input: PathBuf,
    /// Where to write: .glb, .gltf or .obj decides the format; `-` is standard output
    #[arg(short, long, value_name = "OUT")]
    pub(super) output: PathBuf,
    /// Few charts under a bound on their distortion, more charts in less time, one per component, the islands of the present UVs, or
    /// along `--seams`
    #[arg(long, default_value = "auto", value_parser = word::<Cut>(CUTS))]
    cut: Cut,
    /// How distorted the atlas may be with `--cut auto`: mean symmetric Dirichlet energy up to 4.05, 4.1 or 4.5
    #[arg(long, default_value = "balanced", value_parser = word::<Quality>(QUALITIES))]
    quality: Quality,
    /// Texels along the side of the texture, or along both: one is the other times a power of two
    #[arg(long, default_value = "1024", value_name = "N|WxH")]
    resolution: Resolution,
    /// Least distance of two charts in texels
    #[arg(long, default_value_t = 2, value_name = "TEXELS")]
    padding: u32,
    /// Resample the textures for the new UVs, which then replace set 0 unless `--texcoord` names another
    #[arg(long)]
    rebake: bool,
    #[command(flatten)]
    pub(super) files: Files,
    #[command(flatten)]
    cuts: Cuts,
    #[command(flatten)]
    layout: Layout,
    #[command(flatten)]
    sets: Sets,
    #[command(flatten)]
    map: Map,
    #[command(flatten)]
    run: Run,
}

#[derive(clap::Args)]
#[command(next_help_heading = "Files and messages")]
pub(super) struct Files {
    /// Format of OUT where its name does not tell
    #[arg(long, value_parser = word::<OutputFormat>(FORMATS))]
    format: Option<OutputFormat>,
    /// Write the report as JSON
    #[arg(long, value_name = "R.json")]
    pub(super) report: Option<PathBuf>,
    /// Draw the UV layout
    #[arg(long, value_name = "L.png")]
    pub(super) layout: Option<PathBuf>,
    /// Draw the distortion
    #[arg(long, value_name = "H.png")]
    pub(super) heatmap: Option<PathBuf>,
    /// What the heat map shows
    #[arg(long, requires = "heatmap", default_value = "symmetric-dirichlet", value_parser = word::<HeatmapMeasure>(HEATMAPS))]
    heatmap_measure: HeatmapMeasure,
    #[command(flatten)]
    pub(super) output: OutputArgs,
}

#[derive(clap::Args)]
#[command(next_help_heading = "Where to cut")]
struct Cuts {
    /// Edges to cut in any case: `normals` for those with hard normals, or a file [[v, w], …] of pairs of vertices, counted over the
    /// triangle primitives as they follow each other in the file
    #[arg(long, value_name = "normals|S.json")]
    seams: Option<PathBuf>,
    /// Cut along the borders of materials too
    #[arg(long)]
    material_borders: bool,
    /// UV set whose islands `--cut keep` takes [default: 0]
    #[arg(long, value_name = "N")]
    source_texcoord: Option<u32>,
    /// Charts that `--cut auto` may make for an atlas; where it needs more it allows more distortion
    #[arg(long, value_name = "N")]
    max_charts: Option<u32>,
    /// The bound on the mean symmetric Dirichlet energy in the place of `--quality`'s; 4 is an isometry
    #[arg(long, value_name = "E")]
    max_distortion: Option<f64>,
    /// Bound on the stretch max(σ₁, 1/σ₂) that all but a hundredth of the area keeps; more is cut until it does
    #[arg(long, value_name = "S")]
    max_stretch: Option<f64>,
    /// Price of a seam where charts are cut for a fuller atlas: 0 cuts wherever that gains anything, a large number never
    #[arg(long, default_value_t = 1.0, value_name = "W")]
    seam_weight: f64,
}

#[derive(clap::Args)]
#[command(next_help_heading = "Atlas")]
struct Layout {
    /// What the UVs are for; `lightmap`: one atlas of the scene in set 1, a part of it for each node, charts that end at texels
    #[arg(long, default_value = "material", value_parser = word::<Preset>(PRESETS))]
    preset: Preset,
    /// What shares one atlas [default: mesh; of a lightmap, an .obj and any other file than glTF: scene]
    #[arg(long, value_parser = word::<GroupBy>(GROUPS))]
    group_by: Option<GroupBy>,
    /// Pages that charts may lie on, the tiles of UDIM from 1001 on; all get one density
    #[arg(long, default_value_t = 1, value_name = "N")]
    pages: u32,
    /// Texels along one unit of length of the mesh [default: as many as fit]
    #[arg(long, value_name = "T")]
    texels_per_unit: Option<f64>,
    /// Material, by name or index, that gets W times as many texels along a line as the others; may be given again
    #[arg(long, value_name = "MATERIAL=W")]
    texel_weight: Vec<TexelWeight>,
    /// Mip levels beyond the first in which charts keep the padding, in texels of each [default: 0; lightmap: 2]
    #[arg(long, value_name = "N")]
    mips: Option<u32>,
    /// Search the fullest layout for about a second, or ten times as long
    #[arg(long, default_value = "fast", value_parser = word::<PackingMode>(PACKINGS))]
    packing: PackingMode,
    /// Keep the map bijective when tools round texture coordinates to 12, 14 or 16 bits: opens thin triangles and narrow gaps
    #[arg(long, value_name = "BITS")]
    quantization_safe: Option<u32>,
}

#[derive(clap::Args)]
#[command(next_help_heading = "UV sets and textures")]
struct Sets {
    /// UV set to write [default: 0 where no texture samples it, else the next free one]
    #[arg(long, value_name = "N")]
    texcoord: Option<u32>,
    /// Replace the UV set even if textures sample it
    #[arg(long)]
    overwrite: bool,
    /// Side of the resampled textures in texels [default: `--resolution`, or more where the surface would have fewer texels]
    #[arg(long, value_name = "TEXELS")]
    bake_size: Option<u32>,
    /// Format of the resampled textures; `source` is that of the images they are made of
    #[arg(long, default_value = "source", value_parser = word::<ImageFormat>(IMAGE_FORMATS))]
    image_format: ImageFormat,
}

#[derive(clap::Args)]
#[command(next_help_heading = "Energy and barrier")]
struct Map {
    /// Distortion energy to minimize
    #[arg(long, default_value = "symmetric-dirichlet", value_parser = word::<EnergyKind>(ENERGIES))]
    energy: EnergyKind,
    /// Barrier against inversion; `none` is for comparison: what flips without it is written, and is not certified
    #[arg(long, default_value = "inverse-spline", value_parser = word::<BarrierKind>(BARRIERS))]
    barrier: BarrierKind,
    /// Weight β of the barrier
    #[arg(long, default_value_t = 0.01, value_name = "BETA")]
    barrier_strength: f64,
    /// Support s of the inverse spline, relative to an element's rest area
    #[arg(long, default_value_t = 1.0, value_name = "S")]
    barrier_support: f64,
    /// Vertices of each chart's boundary that are held, far from each other: 0, or with `--cut disk` 2, as `--energy lscm` needs
    #[arg(long, default_value_t = 0, value_name = "N")]
    pin: u32,
}

#[derive(clap::Args)]
#[command(next_help_heading = "Time")]
struct Run {
    /// Threads [default: all cores]; the result does not depend on it
    #[arg(long, value_name = "N")]
    threads: Option<usize>,
    /// End with the current valid map after this many seconds
    #[arg(long, value_name = "SECONDS")]
    time_budget: Option<f64>,
}

impl Args {
    /// The options, of which a file of seams is read.
    pub(super) fn options(&self) -> Result<Options, Failure> {
        Ok(Options {
            preset: self.layout.preset,
            energy: self.map.energy,
            barrier: self.map.barrier,
            barrier_strength: self.map.barrier_strength,
            barrier_support: self.map.barrier_support,
            cut: self.cut,
            seams: self.cuts.seams.as_deref().map(given_seams).transpose()?,
            material_borders: self.cuts.material_borders,
            source_texcoord: self.cuts.source_texcoord,
            kept_maps: KeptMaps::Optimized,
            max_charts: self.cuts.max_charts,
            pin: self.map.pin,
            quality: self.quality,
            max_distortion: self.cuts.max_distortion,
            max_stretch: self.cuts.max_stretch,
            packing: self.layout.packing,
            seam_weight: self.cuts.seam_weight,
            group_by: self.layout.group_by,
            texcoord: self.sets.texcoord,
            overwrite: self.sets.overwrite,
            rebake: self.rebake,
            bake_size: self.sets.bake_size,
            image_format: self.sets.image_format,
            resolution: self.resolution,
            pages: self.layout.pages,
            texels_per_unit: self.layout.texels_per_unit,
            texel_weights: self.layout.texel_weight.clone(),
            padding: self.padding,
            mips: self.layout.mips,
            quantization_safe: self.layout.quantization_safe,
            threads: self.run.threads,
            time_budget: self.run.time_budget,
            heatmap_measure: self.files.heatmap_measure,
            format: output_format(&self.output, self.files.format)?,
            stem: stem(&self.output),
            limits: Limits::default(),
        })
    }

    /// Where everything goes.
    pub(super) fn outputs(&self) -> Result<Outputs, Failure> {
        let Files {
            report,
            layout,
            heatmap,
            output,
            ..
        } = &self.files;
        let seams = self.cuts.seams.as_deref().filter(|path| !is_word(path));
        let inputs: Vec<&Path> = [self.input.as_path()].into_iter().chain(seams).collect();
        Outputs::check(&self.output, &[report, layout, heatmap], &inputs, output)
    }
}

fn is_word(path: &Path) -> bool {
    path.as_os_str() == "normals"
}

/// The word, or the pairs in a file.
fn given_seams(path: &Path) -> Result<GivenSeams, Failure> {
    if is_word(path) {
        return Ok(GivenSeams::Named(NamedSeams::Normals));
    }
    let edges = serde_json::from_slice(&read_file(path)?);
    let edges = edges.map_err(|error| Failure::input(format!("{}: {error}", path.display())))?;
    Ok(GivenSeams::Edges(edges))
}
