//! Options that would do nothing are refused: who gives one expects something of it.

use super::options::Options;
use super::preset::Preset;
use super::rebake::ImageFormat;
use super::settings::KeptMaps;
use crate::barrier::BarrierKind;
use crate::charts::Cut;
use crate::deform::Model;
use crate::document::{GroupBy, OutputFormat};

/// An option, what it goes with, and whether it is given in vain.
type Idle = (&'static str, &'static str, bool);

fn refused(all: impl IntoIterator<Item = Idle>) -> Result<(), String> {
    match all.into_iter().find(|(.., is_idle)| *is_idle) {
        Some((name, with, _)) => Err(format!("`{name}` goes with {with}")),
        None => Ok(()),
    }
}

/// Refuses options of unwrapping that the others leave without effect. One that has its default value cannot be told from one that
/// is absent.
pub(super) fn check(options: &Options) -> Result<(), String> {
    let default = Options::default();
    let is_auto = options.cut == Cut::Auto && options.barrier != BarrierKind::None;
    let is_kept = options.cut == Cut::Keep;
    let is_obj = options.format == OutputFormat::Obj;
    let is_of_one_material = matches!(
        options.group_by,
        Some(GroupBy::Material | GroupBy::Primitive)
    );
    check_barrier(
        options.barrier,
        ["barrier_strength", "barrier_support"],
        [
            options.barrier_strength != default.barrier_strength,
            options.barrier_support != default.barrier_support,
        ],
    )?;
    refused([
        (
            "max_charts",
            "`cut` auto and a `barrier`",
            options.max_charts.is_some() && !is_auto,
        ),
        (
            "max_distortion",
            "`cut` auto and a `barrier`",
            options.max_distortion.is_some() && !is_auto,
        ),
        (
            "max_stretch",
            "`cut` auto and a `barrier`",
            options.max_stretch.is_some() && !is_auto,
        ),
        (
            "seam_weight",
            "`cut` auto and a `barrier`",
            options.seam_weight != default.seam_weight && !is_auto,
        ),
        (
            "quality",
            "`cut` auto, keep or seams",
            options.quality != default.quality && matches!(options.cut, Cut::Fast | Cut::Disk),
        ),
        (
            "source_texcoord",
            "`cut` keep",
            options.source_texcoord.is_some() && !is_kept,
        ),
        (
            "kept_maps",
            "`cut` keep",
            options.kept_maps != KeptMaps::Optimized && !is_kept,
        ),
        (
            "bake_size",
            "`rebake`",
            options.bake_size.is_some() && !options.rebake,
        ),
        (
            "image_format",
            "`rebake`",
            options.image_format != ImageFormat::Source && !options.rebake,
        ),
        (
            "material_borders",
            "atlases of several materials: `group_by` mesh or scene",
            options.material_borders && is_of_one_material,
        ),
        (
            "texcoord",
            "glTF: an OBJ file has one set of UVs",
            options.texcoord.is_some_and(|set| set > 0) && is_obj,
        ),
        (
            "overwrite",
            "glTF: an OBJ file has one set of UVs",
            options.overwrite && is_obj,
        ),
    ])?;
    let is_one_atlas = options.preset == Preset::Lightmap || is_obj;
    match options.group_by {
        Some(by) if by != GroupBy::Scene && is_one_atlas => Err(format!(
            "`group_by` does nothing here: {} is one atlas",
            if is_obj { "an OBJ file" } else { "a lightmap" }
        )),
        _ => Ok(()),
    }
}

/// The same of what a deformation costs.
pub(super) fn check_model(model: &Model) -> Result<(), String> {
    // A bound of the conformal distortion and the boundary have barriers of their own, as strong.
    let has_others = model.bound.is_some() || model.bijective;
    check_barrier(
        model.barrier,
        ["beta", "s"],
        [
            model.beta.is_some() && !has_others,
            model.s != Model::default().s,
        ],
    )
}

/// A strength needs a barrier, a support the inverse spline.
fn check_barrier(
    barrier: BarrierKind,
    [strength, support]: [&'static str; 2],
    [is_strength_given, is_support_given]: [bool; 2],
) -> Result<(), String> {
    refused([
        (
            strength,
            "a `barrier`",
            is_strength_given && barrier == BarrierKind::None,
        ),
        (
            support,
            "`barrier` inverse-spline",
            is_support_given && barrier != BarrierKind::InverseSpline,
        ),
    ])
}
