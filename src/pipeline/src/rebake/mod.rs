//! Resampling of a document's textures for its new UVs.

mod format;
mod images;
mod planes;
mod surface;

use rayon::prelude::*;
use std::collections::BTreeMap;

use crate::PipelineError;
use crate::options::Options;
use crate::tracker::Tracker;
pub use format::ImageFormat;
use images::read_images;
use planes::Bake;
use surface::Surface;
use unwrapd_api::Stage;
use unwrapd_files::bake::{Coverage, MOST_TEXELS, baked, side_for};
use unwrapd_files::document::{
    BakePlan, BakedTextures, Document, DocumentError, Group, NewUvs, Warning,
};

/// Maximum side of a texture in texels.
pub(super) const MOST_SIDE: u32 = 8192;
/// Minimum distance of charts in texels at which bilinear filtering does not mix them.
const FILTER_TEXELS: f64 = 2.0;

/// Resamples all textures that can be read and are understood for `uvs`, v up. Enters the stage only if there are
/// any.
pub(super) fn rebaked(
    document: &Document,
    groups: &[Group],
    uvs: &NewUvs,
    options: &Options,
    tracker: &Tracker,
) -> Result<BakedTextures, PipelineError> {
    let Document::Gltf(document) = document else {
        let what = "new textures for another format than glTF".to_owned();
        return Err(DocumentError::UnsupportedOutput(what).into());
    };
    // Plan as if every image were readable; without anything to do, there is no stage.
    let hoped = document.bake_plan(groups, &BTreeMap::new())?;
    if hoped.planes.is_empty() && hoped.kept.is_empty() {
        return Ok(BakedTextures {
            has_colors_only: document.has_vertex_colors(),
            plan: hoped,
            files: Vec::new(),
            tangents: vec![None; document.primitives().len()],
        });
    }
    // Read the images, and plan again with those that can be read.
    tracker.stage(Stage::Bake);
    let (images, unreadable) = read_images(document, &hoped.planes)?;
    let plan = document.bake_plan(groups, &unreadable)?;
    let surfaces: Vec<Surface> = (0..document.primitives().len())
        .into_par_iter()
        .map(|index| Surface::new(document, index, uvs, plan.is_normal_mapped(index)))
        .collect::<Result<_, _>>()?;
    let bake = Bake {
        document,
        images: &images,
        surfaces: &surfaces,
    };
    let files = files(&bake, &plan, groups, options)?;
    Ok(BakedTextures {
        has_colors_only: plan.planes.is_empty() && document.has_vertex_colors(),
        plan,
        files,
        tangents: (surfaces.into_iter())
            .map(Surface::written_tangents)
            .collect(),
    })
}

/// Returns the side and the file of each texture of a plan. Resamples nothing if they would have too many texels in
/// total.
fn files(
    bake: &Bake,
    plan: &BakePlan,
    groups: &[Group],
    options: &Options,
) -> Result<Vec<(u32, Vec<u8>)>, DocumentError> {
    let sides = sides(bake, plan, groups, options)?;
    let mut files = Vec::new();
    // Textures of one group often have one size.
    let mut last: Option<((usize, u32), Coverage)> = None;
    for (wanted, side) in plan.planes.iter().zip(sides) {
        let members = &groups[wanted.group].primitives;
        let plane = bake.plane(wanted, members)?;
        let key = (wanted.group, side);
        let known = last.take().filter(|(known, _)| *known == key);
        let new = || (key, Coverage::new(&bake.faces(members), side as usize));
        let (_, coverage) = last.insert(known.unwrap_or_else(new));
        let image = baked(&plane, coverage);
        let file = options
            .baking
            .image_format
            .file(bake.document, wanted, &image)?;
        files.push((side, file));
    }
    Ok(files)
}

/// Returns the side of each texture of a plan: as requested, or fine enough for its sources.
fn sides(
    bake: &Bake,
    plan: &BakePlan,
    groups: &[Group],
    options: &Options,
) -> Result<Vec<u32>, DocumentError> {
    let least = options
        .baking
        .bake_size
        .unwrap_or(options.layout.resolution.longer().min(MOST_SIDE));
    check_texels(u64::from(least).pow(2) * plan.planes.len() as u64)?;
    if options.baking.bake_size.is_some() {
        return Ok(vec![least; plan.planes.len()]);
    }
    let (mut sides, mut texels) = (Vec::new(), 0);
    for wanted in &plan.planes {
        let members = &groups[wanted.group].primitives;
        let side = least.max(side_for(
            &bake.plane(wanted, members)?,
            &bake.faces(members),
        ));
        texels += u64::from(side).pow(2);
        check_texels(texels)?;
        sides.push(side);
    }
    Ok(sides)
}

/// Warns if there was nothing to resample, and of textures whose charts are so close that bilinear filtering at the
/// border of one reads texels of another.
pub(super) fn warnings(baked: &BakedTextures, options: &Options) -> Vec<Warning> {
    // Find the textures in which charts come too near.
    let mut sides: Vec<u32> = baked.files.iter().map(|(side, _)| *side).collect();
    sides.sort_unstable();
    sides.dedup();
    let texels = f64::from(options.settings().layout.padding)
        / f64::from(options.layout.resolution.longer());
    let gap = |side: u32| texels * f64::from(side);
    let near = sides.into_iter().filter(|side| gap(*side) < FILTER_TEXELS);
    let near = near.map(|side| {
        let gap = gap(side);
        let message = format!(
            "charts are {gap:.2} texels apart in textures of {side}, so filtering mixes them: use more padding"
        );
        Warning::new("charts_near", message)
    });
    // Say why nothing was resampled.
    let nothing = baked.plan.planes.is_empty() && baked.plan.kept.is_empty();
    let nothing = nothing.then(|| {
        if baked.has_colors_only {
            Warning::new(
                "colors_kept",
                "the model has colors at its vertices and no textures: they are not resampled",
            )
        } else {
            Warning::new(
                "nothing_to_resample",
                "the model has no textures to resample",
            )
        }
    });
    near.chain(nothing).collect()
}

fn check_texels(texels: u64) -> Result<(), DocumentError> {
    if texels <= MOST_TEXELS {
        return Ok(());
    }
    let (most, wanted) = (MOST_TEXELS >> 20, texels >> 20);
    Err(DocumentError::LimitExceeded(format!(
        "the new textures would have {wanted} Mi texels or more; the limit is {most} Mi"
    )))
}
