//! How charts are packed, from the settings.

use super::clearance::texels_apart;
use super::compact::MOST_CHARTS;
use super::plan::{Plan, Search};
use super::settings::Settings;
use crate::atlas::{AtlasOptions, Scale, Texture};
use crate::charts::MappedChart;

/// Words that packing all meshes of a document may read, those of one mesh for each of its faces, and the least and most of one: a
/// hundred meshes shall not take a hundred times as long, nor small ones as long as large ones.
const SEARCH_WORDS: u64 = 1_500_000_000;
const SEARCH_WORDS_PER_FACE: u64 = 125_000;
const SEARCH_WORDS_OF_MESH: [u64; 2] = [20_000_000, 600_000_000];
/// The same of a mesh that is cut fast.
const SEARCH_WORDS_IF_FAST: u64 = 10_000_000;
/// All meshes together read so many at most: those of crowds are placed once, and on the coarser a raster the more there are.
const SEARCH_WORDS_OF_ALL: u64 = 16_000_000_000;
const WORDS_PER_CELL: u64 = 16;
const LEAST_CELLS: u32 = 128;

/// How to pack the charts of one of so many meshes, which has so many faces.
pub fn atlas_options(
    (settings, plan): (&Settings, &Plan),
    n_meshes: usize,
    n_faces: usize,
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
        turns: plan.turns,
        borders: settings.borders,
        search_words: search_words((settings, plan), n_meshes, n_faces),
        most_cells: cells.next_power_of_two().max(LEAST_CELLS),
    }
}

/// Words that packing one of so many meshes may read, which has so many faces.
pub fn search_words((settings, plan): (&Settings, &Plan), n_meshes: usize, n_faces: usize) -> u64 {
    let [least, most] = SEARCH_WORDS_OF_MESH;
    let words = (SEARCH_WORDS / n_meshes as u64).min(SEARCH_WORDS_PER_FACE * n_faces as u64);
    let words = match plan.search {
        Search::Brief => SEARCH_WORDS_IF_FAST,
        Search::Full => words.clamp(least, most),
    };
    settings.layout.packing.passes() * words.min(SEARCH_WORDS_OF_ALL / n_meshes as u64)
}

/// About how many words packing reads: looking for cuts takes most, and where charts are not cut the rest is all.
pub fn expected_words(plan: &Plan, options: &AtlasOptions, n_charts: usize) -> u64 {
    let words = options.search_words;
    if plan.compaction.is_some() && n_charts <= MOST_CHARTS {
        words + words / 8
    } else {
        words / 4 + words / 16
    }
}

/// The padding asked for, or what keeps charts apart when UVs are rounded.
fn padding_texels(settings: &Settings, plan: &Plan) -> u32 {
    let least = plan.safe_bits.map_or(0, |bits| {
        texels_apart(bits, settings.layout.resolution.longer())
    });
    settings.layout.padding.max(least)
}

/// Length in the maps over length on the surface: the root of the ratio of the areas.
fn density(charts: &[MappedChart]) -> f64 {
    let total = |area: fn(&MappedChart) -> f64| charts.iter().map(area).sum::<f64>();
    let density = (total(MappedChart::area) / total(MappedChart::surface_area)).sqrt();
    if density.is_normal() { density } else { 1.0 }
}
