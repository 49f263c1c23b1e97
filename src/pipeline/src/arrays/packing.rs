//! Packing options, from the settings.

use super::clearance::texels_apart;
use super::compact::{self, MOST_CHARTS};
use super::plan::{Plan, Search, Start};
use super::settings::Settings;
use unwrapd_layout::atlas::{self, AtlasOptions, Positions, Scale, Texture};
use unwrapd_layout::charts::MappedChart;

/// Number of words that packing all meshes of a document may read, and the least and most for one mesh: a hundred
/// meshes must not take a hundred times as long.
const SEARCH_WORDS: u64 = 1_500_000_000;
const SEARCH_WORDS_OF_MESH: [u64; 2] = [20_000_000, 600_000_000];
/// Number of words that packing a mesh may read if it is cut fast.
const SEARCH_WORDS_IF_FAST: u64 = 10_000_000;
/// Estimate of the words that packing reads per face while the charts are not known, and its minimum and maximum per
/// mesh.
const LIKELY_WORDS_PER_FACE: u64 = 25_000;
const LIKELY_WORDS: [u64; 2] = [1_000_000, 100_000_000];
/// Maximum number of words for all meshes together: meshes of crowds are placed once, on a raster that is coarser the
/// more there are.
const SEARCH_WORDS_OF_ALL: u64 = 16_000_000_000;
const WORDS_PER_CELL: u64 = 16;
const LEAST_CELLS: u32 = 128;

/// Returns the options for packing the charts of one of `n_meshes` meshes.
pub fn atlas_options(
    (settings, plan): (&Settings, &Plan),
    n_meshes: usize,
    charts: &[MappedChart],
) -> AtlasOptions {
    let of_each = SEARCH_WORDS_OF_ALL / n_meshes as u64;
    let cells = (of_each / WORDS_PER_CELL).isqrt() as u32;
    AtlasOptions {
        texture: Texture {
            resolution: settings.layout.resolution,
            pages: settings.layout.pages,
        },
        scale: settings
            .layout
            .texels_per_unit
            .map_or(Scale::Largest, |texels| {
                Scale::TexelsPerUnit(texels / density(charts))
            }),
        padding_texels: padding_texels(settings, plan),
        rotation: plan.rotation,
        borders: settings.borders,
        positions: match plan.start {
            Start::Final => Positions::Layout,
            Start::New | Start::Present => Positions::Unrelated,
        },
        patience: settings.layout.packing.passes(),
        budget_words: search_words((settings, plan), n_meshes),
        most_cells: cells.next_power_of_two().max(LEAST_CELLS),
    }
}

/// Returns the number of words that packing one of `n_meshes` meshes may read.
fn search_words((settings, plan): (&Settings, &Plan), n_meshes: usize) -> u64 {
    let [least, most] = SEARCH_WORDS_OF_MESH;
    let words = match plan.search {
        Search::Brief => SEARCH_WORDS_IF_FAST,
        Search::Full => (SEARCH_WORDS / n_meshes as u64).clamp(least, most),
    };
    settings.layout.packing.passes() * words.min(SEARCH_WORDS_OF_ALL / n_meshes as u64)
}

/// Returns the number of words that packing one of `n_meshes` meshes with `n_faces` faces is likely to read.
pub fn likely_words(of: (&Settings, &Plan), n_meshes: usize, n_faces: usize) -> u64 {
    let [least, most] = LIKELY_WORDS;
    let words = (LIKELY_WORDS_PER_FACE * n_faces as u64).clamp(least, most);
    (of.0.layout.packing.passes() * words).min(search_words(of, n_meshes))
}

/// Returns the approximate number of words that packing the charts reads.
pub fn expected_words(plan: &Plan, options: &AtlasOptions, charts: &[MappedChart]) -> u64 {
    let n_charts = charts.len();
    let mut of_page = atlas::expected_words(n_charts, options);
    if plan.compaction.is_some() && n_charts <= MOST_CHARTS {
        of_page += compact::expected_words(n_charts, options);
    }
    // On all numbers of pages, one after the other.
    u64::from(options.texture.pages) * of_page
}

/// Returns the requested padding, or the least padding that keeps charts apart when UVs are rounded, if that is
/// larger.
fn padding_texels(settings: &Settings, plan: &Plan) -> u32 {
    let least = plan.safe_bits.map_or(0, |bits| {
        texels_apart(bits, settings.layout.resolution.longer())
    });
    settings.layout.padding.max(least)
}

/// Returns the ratio of lengths in the maps to lengths on the surface: the root of the ratio of the areas.
fn density(charts: &[MappedChart]) -> f64 {
    let total = |area: fn(&MappedChart) -> f64| charts.iter().map(area).sum::<f64>();
    let density = (total(MappedChart::area) / total(MappedChart::surface_area)).sqrt();
    if density.is_normal() { density } else { 1.0 }
}
