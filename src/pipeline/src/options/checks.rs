//! Checks of options: ranges, and rejection of options that would have no effect, contrary to their user's expectation.

use super::{Baking, ImageFormat};
use super::{KeptMaps, Options, Preset, Straightening};
use crate::Caller;
use crate::CommandOptions;
use crate::PipelineError;
use crate::TexelWeight;
use crate::settings::check_mips;
use unwrapd_api::options::OptionSet;
use unwrapd_deform::Model;
use unwrapd_files::document::{GroupBy, OutputFormat};
use unwrapd_layout::charts::Cut;
use unwrapd_method::barrier::BarrierKind;

impl Options {
    fn validate(&self) -> Result<(), String> {
        // Before the ranges: that of the padding depends on the resolution.
        self.layout.check()?;
        self.check_ranges()?;
        check_mips(self.layout.padding, self.mips(), self.layout.resolution)?;
        self.settings().validate()?;
        check(self)?;
        self.check_control()?;
        self.texel_weight.iter().try_for_each(TexelWeight::check)?;
        if self.cutting.cut == Cut::Seams && self.seams.is_none() {
            return Err("`cut` seams requires `seams`".to_owned());
        }
        if self.rebakes() && self.layout.stack_offset {
            return Err(
                "`rebake` requires no `stack_offset`: its textures do not repeat".to_owned(),
            );
        }
        let is_one_square = self.layout.pages == 1 && self.layout.resolution.aspect() == 1.0;
        if self.rebakes() && !is_one_square {
            return Err(
                "`rebake` makes one square texture: it requires `pages` 1 and a square `resolution`"
                    .to_owned(),
            );
        }
        Ok(())
    }
}

impl Options {
    /// Checks the rules for islands.
    fn check_control(&self) -> Result<(), String> {
        let rules = &self.control.control;
        if rules.is_empty() {
            return Ok(());
        }
        self.control.check(self.layout.pages)?;
        let is_kept = self.cutting.cut == Cut::Keep;
        let is_given = is_kept && self.cutting.kept_maps == KeptMaps::AsGiven;
        for rule in rules {
            let requires =
                |what: &str| Err(format!("`control` {:?} requires {what}", rule.to_string()));
            if rule.needs_given_maps() && !is_given {
                return requires("`repack`, or `cut` keep with `kept_maps` as-given");
            }
            if rule.needs_islands() && !is_kept {
                return requires("`repack` or `cut` keep");
            }
        }
        refused([
            (
                "control",
                "`preset` material",
                self.preset == Preset::Lightmap,
            ),
            (
                "quantization_safe",
                "no `control`",
                self.mapping.quantization_safe.is_some(),
            ),
        ])
    }
}

impl CommandOptions for Options {
    fn check(&self) -> Result<(), PipelineError> {
        self.validate().map_err(PipelineError::InvalidOptions)
    }

    fn caller_mut(&mut self) -> &mut Caller {
        &mut self.caller
    }
}

/// Name of an option, its requirement, and whether it is given without effect.
pub(super) type Idle = (&'static str, &'static str, bool);

pub(super) fn refused(all: impl IntoIterator<Item = Idle>) -> Result<(), String> {
    match all.into_iter().find(|(.., is_idle)| *is_idle) {
        Some((name, with, _)) => Err(format!("`{name}` requires {with}")),
        None => Ok(()),
    }
}

/// Rejects options of unwrapping that the other options leave without effect. An option with its default value counts
/// as absent.
fn check(options: &Options) -> Result<(), String> {
    let default = Options::default();
    let is_auto = options.cutting.cut == Cut::Auto && options.mapping.barrier != BarrierKind::None;
    let is_kept = options.cutting.cut == Cut::Keep;
    let is_obj = options.format == OutputFormat::Obj;
    check_barrier(
        options.mapping.barrier,
        [
            options.mapping.barrier_strength.is_some(),
            options.mapping.barrier_support != default.mapping.barrier_support,
        ],
    )?;
    let of_auto = [
        ("max_charts", options.cutting.max_charts.is_some()),
        ("max_stretch", options.cutting.max_stretch.is_some()),
        (
            "seam_weight",
            options.cutting.seam_weight != default.cutting.seam_weight,
        ),
        (
            "symmetry",
            options.cutting.symmetry != default.cutting.symmetry,
        ),
    ];
    refused(
        of_auto.map(|(name, is_given)| (name, "`cut` auto and a `barrier`", is_given && !is_auto)),
    )?;
    check_cones(options)?;
    refused([
        (
            "barrier_continuation",
            "a `barrier`",
            options.mapping.barrier_continuation && options.mapping.barrier == BarrierKind::None,
        ),
        (
            "straighten",
            "a `barrier`",
            (options.control.straighten.as_ref()).is_some_and(|it| *it != Straightening::Off)
                && options.mapping.barrier == BarrierKind::None,
        ),
        (
            "quality",
            "`cut` auto, keep or seams",
            options.cutting.quality != default.cutting.quality
                && matches!(options.cutting.cut, Cut::Fast | Cut::Disk),
        ),
        (
            "source_texcoord",
            "`cut` keep",
            options.sets.source_texcoord.is_some() && !is_kept,
        ),
        (
            "kept_maps",
            "`cut` keep",
            options.cutting.kept_maps != KeptMaps::Optimized && !is_kept,
        ),
        (
            "merge_materials",
            "`group_by` material or scene: a material has one atlas",
            !options.merge_materials.is_empty()
                && matches!(options.group_by, Some(GroupBy::Mesh | GroupBy::Primitive)),
        ),
        (
            "merge_materials",
            "a glTF result",
            !options.merge_materials.is_empty() && is_obj,
        ),
        (
            "texcoord",
            "a glTF result: an OBJ file has one UV set",
            options.sets.texcoord.is_some_and(|set| set > 0) && is_obj,
        ),
        (
            "overwrite",
            "a glTF result: an OBJ file has one UV set",
            options.sets.overwrite && is_obj,
        ),
    ])?;
    if !options.rebakes() {
        check_baking(&options.baking)?;
    }
    check_grouping(options, options.group_by)?;
    let is_one_atlas = options.preset == Preset::Lightmap || is_obj;
    match options.group_by {
        Some(by) if by != GroupBy::Scene && is_one_atlas => Err(format!(
            "`group_by` has no effect here: {} always has one atlas",
            if is_obj { "an OBJ file" } else { "a lightmap" }
        )),
        _ => Ok(()),
    }
}

/// Rejects cones, and a bound for them, with cuts that have none.
fn check_cones(options: &Options) -> Result<(), String> {
    refused([
        (
            "cones",
            "`cut` disk",
            options.cutting.cones.is_some() && options.cutting.cut != Cut::Disk,
        ),
        (
            "cone_vertices",
            "`cut` disk without `cones` and `max_distortion`",
            options.cone_vertices.is_some()
                && (options.cutting.cut != Cut::Disk
                    || options.cutting.cones.is_some()
                    || options.cutting.max_distortion.is_some()),
        ),
        (
            "max_distortion",
            "`cut` auto or disk, and a `barrier`",
            options.cutting.max_distortion.is_some()
                && !(matches!(options.cutting.cut, Cut::Auto | Cut::Disk)
                    && options.mapping.barrier != BarrierKind::None),
        ),
    ])
}

/// Rejects options of resampling without it.
fn check_baking(baking: &Baking) -> Result<(), String> {
    const WITH: &str = "`rebake`";
    refused([
        ("bake_tiled", WITH, baking.bake_tiled),
        ("bake_size", WITH, baking.bake_size.is_some()),
        (
            "image_format",
            WITH,
            baking.image_format != ImageFormat::Source,
        ),
    ])
}

/// Rejects options that distinguish materials within an atlas if each material has its own. The grouping may be
/// unknown before the file is read.
pub(crate) fn check_grouping(options: &Options, group_by: Option<GroupBy>) -> Result<(), String> {
    const WITH: &str = "an atlas with several materials: `group_by` mesh or scene";
    let is_merged = group_by == Some(GroupBy::Material) && !options.merge_materials.is_empty();
    if is_merged || !matches!(group_by, Some(GroupBy::Material | GroupBy::Primitive)) {
        return Ok(());
    }
    let is_density_given = options.layout.texels_per_unit.is_some();
    refused([
        ("material_borders", WITH, options.material_borders),
        (
            "texel_weight",
            WITH,
            !options.texel_weight.is_empty() && !is_density_given,
        ),
    ])
}

/// Rejects barrier options of a deformation that have no effect.
pub(crate) fn check_model(model: &Model) -> Result<(), String> {
    // A bound of the conformal distortion and the boundary have barriers of their own, as strong.
    let has_others = model.max_conformal.is_some() || model.bijective;
    check_barrier(
        model.barrier,
        [
            model.barrier_strength.is_some() && !has_others,
            model.barrier_support != Model::default().barrier_support,
        ],
    )
}

/// Checks that a strength has a barrier, and a support the inverse spline.
fn check_barrier(
    barrier: BarrierKind,
    [is_strength_given, is_support_given]: [bool; 2],
) -> Result<(), String> {
    refused([
        (
            "barrier_strength",
            "a `barrier`",
            is_strength_given && barrier == BarrierKind::None,
        ),
        (
            "barrier_support",
            "`barrier` inverse-spline",
            is_support_given && barrier != BarrierKind::InverseSpline,
        ),
    ])
}
