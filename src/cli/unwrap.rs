//! `unwrapd unwrap`: a mesh file in, the same with certified UVs out.

use std::path::{Path, PathBuf};

use super::failure::Failure;
use super::files::{
    json, output_format, read_file, read_upload, say, warn, write_atomically, write_outputs,
};
use super::progress::Display;
use super::words::{
    BARRIERS, CUTS, ENERGIES, GROUPS, HEATMAPS, IMAGE_FORMATS, PACKINGS, PRESETS, QUALITIES, word,
};
use crate::barrier::BarrierKind;
use crate::certificate::{Overlap, Resolution};
use crate::charts::{Cut, Quality};
use crate::document::{GroupBy, WriteNotes};
use crate::energy::EnergyKind;
use crate::picture::HeatmapMeasure;
use crate::pipeline::{
    self, GivenSeams, ImageFormat, KeptMaps, Limits, Mirrored, NamedSeams, Options, Outcome,
    PackingMode, Preset, TexelWeight,
};

/// Gives a mesh UVs in which no triangle is flipped or degenerate, proven on the bytes written.
///
/// Exit status 0 means certified: that no triangle is flipped, without area or overlapping another, that no chart is mirrored, and
/// that padding, pages and bits are as asked, is proven on the bytes written. Otherwise it is 4, and a line says what is
/// missing; OUT is written nevertheless, unless a triangle is flipped that should not be. More stretch than `--quality` allows
/// is a warning.
#[derive(clap::Args)]
pub(super) struct Args {
    /// Mesh: .glb, .gltf, .obj, .off, .ply or .stl
    input: PathBuf,
    /// Where to write; .glb, .gltf or .obj decides the format
    #[arg(short, long, value_name = "OUT")]
    output: PathBuf,
    /// What the UVs are for; `lightmap`: one atlas of the scene in set 1, a part of it for each node, charts that end at texels
    #[arg(long, default_value = "material", value_parser = word::<Preset>(PRESETS))]
    preset: Preset,
    /// Distortion energy to minimize
    #[arg(long, default_value = "symmetric-dirichlet", value_parser = word::<EnergyKind>(ENERGIES))]
    energy: EnergyKind,
    /// Barrier against inversion; `none` is for comparison: what flips without it is written, and is not certified
    #[arg(long, default_value = "inverse-spline", value_parser = word::<BarrierKind>(BARRIERS))]
    barrier: BarrierKind,
    /// Weight β of the barrier
    #[arg(long, default_value_t = 0.01, value_name = "BETA")]
    barrier_strength: f64,
    /// Support s of the barrier, relative to an element's rest area
    #[arg(long, default_value_t = 1.0, value_name = "S")]
    barrier_support: f64,
    /// Few charts under a bound on their distortion, more charts in less time, one per component, the islands of the present UVs, or
    /// along `--seams`
    #[arg(long, default_value = "auto", value_parser = word::<Cut>(CUTS))]
    cut: Cut,
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
    /// Vertices of each chart's boundary that are held, far from each other: 0, or with `--cut disk` 2, as `--energy lscm` needs
    #[arg(long, default_value_t = 0, value_name = "N")]
    pin: u32,
    /// How distorted the atlas may be with `--cut auto`: mean symmetric Dirichlet energy up to 4.05, 4.1 or 4.5
    #[arg(long, default_value = "balanced", value_parser = word::<Quality>(QUALITIES))]
    quality: Quality,
    /// The bound on the mean symmetric Dirichlet energy in the place of `--quality`'s; 4 is an isometry
    #[arg(long, value_name = "E")]
    max_distortion: Option<f64>,
    /// Bound on the stretch max(σ₁, 1/σ₂) that all but a hundredth of the area keeps; more is cut until it does
    #[arg(long, value_name = "S")]
    max_stretch: Option<f64>,
    /// Search the fullest layout for about a second, or ten times as long
    #[arg(long, default_value = "fast", value_parser = word::<PackingMode>(PACKINGS))]
    packing: PackingMode,
    /// Price of a seam where charts are cut for a fuller atlas: 0 cuts wherever that gains anything, a large number never
    #[arg(long, default_value_t = 1.0, value_name = "W")]
    seam_weight: f64,
    /// What shares one atlas [default: mesh; of another file than glTF: scene]
    #[arg(long, value_parser = word::<GroupBy>(GROUPS))]
    group_by: Option<GroupBy>,
    /// UV set to write [default: 0 where no texture samples it, else the next free one]
    #[arg(long, value_name = "N")]
    texcoord: Option<u32>,
    /// Replace the UV set even if textures sample it
    #[arg(long)]
    overwrite: bool,
    /// Resample the textures for the new UVs, which then replace set 0 unless `--texcoord` names another
    #[arg(long)]
    rebake: bool,
    /// Side of the resampled textures in texels [default: `--resolution`, or more where the surface would have fewer texels]
    #[arg(long, value_name = "TEXELS")]
    bake_size: Option<u32>,
    /// Format of the resampled textures; `source` is that of the images they are made of
    #[arg(long, default_value = "source", value_parser = word::<ImageFormat>(IMAGE_FORMATS))]
    image_format: ImageFormat,
    /// Texels along the side of the texture, or along both: one is the other times a power of two
    #[arg(long, default_value = "1024", value_name = "N|WxH")]
    resolution: Resolution,
    /// Pages that charts may lie on, the tiles of UDIM from 1001 on; all get one density
    #[arg(long, default_value_t = 1, value_name = "N")]
    pages: u32,
    /// Texels along one unit of length of the mesh [default: as many as fit]
    #[arg(long, value_name = "T")]
    texels_per_unit: Option<f64>,
    /// Material, by name or index, that gets W times as many texels along a line as the others; may be given again
    #[arg(long, value_name = "MATERIAL=W")]
    texel_weight: Vec<TexelWeight>,
    /// Least distance of two charts in texels
    #[arg(long, default_value_t = 2, value_name = "TEXELS")]
    padding: u32,
    /// Mip levels beyond the first in which charts keep the padding, in texels of each [default: 0; lightmap: 2]
    #[arg(long, default_value_t = 0, hide_default_value = true, value_name = "N")]
    mips: u32,
    /// Keep the map bijective when tools round texture coordinates to 12, 14 or 16 bits: opens thin triangles and narrow gaps
    #[arg(long, value_name = "BITS")]
    quantization_safe: Option<u32>,
    /// Threads [default: all cores]; the result does not depend on it
    #[arg(long, value_name = "N")]
    threads: Option<usize>,
    /// End with the current valid map after this many seconds
    #[arg(long, value_name = "SECONDS")]
    time_budget: Option<f64>,
    /// Write the report as JSON
    #[arg(long, value_name = "R.json")]
    report: Option<PathBuf>,
    /// Draw the UV layout
    #[arg(long, value_name = "L.png")]
    layout: Option<PathBuf>,
    /// Draw the distortion
    #[arg(long, value_name = "H.png")]
    heatmap: Option<PathBuf>,
    /// What the heat map shows
    #[arg(long, default_value = "symmetric-dirichlet", value_parser = word::<HeatmapMeasure>(HEATMAPS))]
    heatmap_measure: HeatmapMeasure,
}

impl Args {
    fn options(&self) -> Result<Options, Failure> {
        Ok(Options {
            preset: self.preset,
            energy: self.energy,
            barrier: self.barrier,
            barrier_strength: self.barrier_strength,
            barrier_support: self.barrier_support,
            cut: self.cut,
            seams: self.seams.as_deref().map(given_seams).transpose()?,
            material_borders: self.material_borders,
            source_texcoord: self.source_texcoord,
            kept_maps: KeptMaps::Optimized,
            max_charts: self.max_charts,
            pin: self.pin,
            quality: self.quality,
            max_distortion: self.max_distortion,
            max_stretch: self.max_stretch,
            packing: self.packing,
            seam_weight: self.seam_weight,
            group_by: self.group_by,
            texcoord: self.texcoord,
            overwrite: self.overwrite,
            rebake: self.rebake,
            bake_size: self.bake_size,
            image_format: self.image_format,
            resolution: self.resolution,
            pages: self.pages,
            texels_per_unit: self.texels_per_unit,
            texel_weights: self.texel_weight.clone(),
            padding: self.padding,
            mips: self.mips,
            quantization_safe: self.quantization_safe,
            threads: self.threads,
            time_budget: self.time_budget,
            heatmap_measure: self.heatmap_measure,
            format: output_format(&self.output)?,
            stem: self
                .output
                .file_stem()
                .map(|stem| stem.to_string_lossy().into_owned()),
            limits: Limits::default(),
        })
    }
}

/// The word, or the pairs in a file.
fn given_seams(path: &Path) -> Result<GivenSeams, Failure> {
    if path.as_os_str() == "normals" {
        return Ok(GivenSeams::Named(NamedSeams::Normals));
    }
    let edges = serde_json::from_slice(&read_file(path)?);
    let edges = edges.map_err(|error| Failure::input(format!("{}: {error}", path.display())))?;
    Ok(GivenSeams::Edges(edges))
}

/// Runs the command.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let options = args.options()?;
    options.check()?;
    let upload = read_upload(&args.input)?;
    let display = Display::new();
    let outcome = pipeline::unwrap_document(&upload, &options, &display);
    display.finish()?;
    let outcome = outcome?;
    write_outputs(&args.output, &outcome.files)?;
    if let Some(path) = &args.report {
        write_atomically(path, &json(&outcome.report)?)?;
    }
    if args.layout.is_some() || args.heatmap.is_some() {
        let drawn = outcome.pictures.draw()?;
        for (path, png) in [
            (&args.layout, &drawn.layout_png),
            (&args.heatmap, &drawn.heatmap_png),
        ] {
            if let Some(path) = path {
                write_atomically(path, png)?;
            }
        }
    }
    summarize(&outcome)
}

/// A line per texture that is not right any more, or could not be resampled.
fn warn_of_textures(written: &WriteNotes) {
    let of = |material: Option<usize>| {
        material.map_or("a primitive".into(), |m| format!("material {m}"))
    };
    for texture in &written.textures_affected {
        let (of, slot) = (of(texture.material), &texture.slot);
        say(format_args!(
            "warning: {slot} of {of} shows the old layout; see --rebake"
        ));
    }
    for kept in &written.textures_kept {
        let (of, slot, reason) = (of(kept.material), &kept.slot, &kept.reason);
        say(format_args!(
            "warning: {slot} of {of} stays with its UVs: {reason}"
        ));
    }
}

/// The atlases, the warnings, and what is certified; where something that was asked for is not proven, a failure after all is said.
pub(super) fn summarize(outcome: &Outcome) -> Result<(), Failure> {
    let report = &outcome.report;
    super::table::print(&report.groups);
    warn(&report.warnings);
    if let Some(written) = &report.written {
        warn_of_textures(written);
    }
    if report.certified {
        say(format_args!("certified: {}", report.proven));
        return Ok(());
    }
    let missing = report.proven.lacks(Overlap::Test, Mirrored::Refused);
    Err(Failure::uncertified(format!(
        "written, but not certified: {} (not_certified)",
        missing.join(", ")
    )))
}
