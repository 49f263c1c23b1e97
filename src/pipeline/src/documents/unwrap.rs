//! Unwrapping of documents, from bytes to bytes: read, unwrap, write, read again, judge.

use super::input::{Mapped, Merged, Prepared};
use super::pictures::Pictures;
use super::selection::{check_faces, check_selections};
use super::uv_arrays::UvArrays;
use crate::PipelineError;
use crate::arrays::placed_faces::on_border;
use crate::arrays::placement::Placement;
use crate::arrays::plan::Plan;
use crate::arrays::repeated::GridCorners;
use crate::arrays::seams::Seams;
use crate::arrays::soup::Soup;
use crate::arrays::unwrap::{Unwrapped, in_pool, unwrap_all};
use crate::arrays::whole_texels::shift_to_whole_texels;
use crate::island_error::IslandError;
use crate::judge::groups::WrittenUvs;
use crate::judge::proven::Mirrored;
use crate::judge::report::{Report, Seconds};
use crate::judge::rules::{intended_weights, rule_reports};
use crate::judge::shortfalls::{add_history, nothing_stacked, promise_kept, shortfalls};
use crate::observer::Observer;
use crate::options::{CommandOptions, Island, Options, RepackOptions};
use crate::rebake::{self, TiledTextures, rebaked};
use crate::tracker::{StopWatch, Tracker};
use unwrapd_api::Stage;
use unwrapd_files::document::{
    BakedTextures, Corners, Document, Group, GroupBy, Layout, NewUvs, OutputFormat, Upload,
    WriteOptions, Written,
};
use unwrapd_layout::atlas::GRID_BITS;
use unwrapd_maps::mesh::VAxis;

/// Result of unwrapping a document.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// Written files by relative name, the main file first.
    pub files: Vec<(String, Vec<u8>)>,
    /// Report on the files.
    pub report: Report,
    /// Source of the pictures of layout and distortion.
    pub pictures: Pictures,
    /// UVs that were written.
    pub uvs: UvArrays,
}

/// Unwraps every mesh of a document and judges the written bytes.
pub fn unwrap_document(
    upload: &Upload,
    options: &Options,
    observer: &dyn Observer,
) -> Result<Outcome, PipelineError> {
    unwrap_around(upload, options, &[], observer)
}

/// Unwraps a document like [`unwrap_document`], but with islands of kept UVs at fixed placements.
pub fn unwrap_around(
    upload: &Upload,
    options: &Options,
    islands: &[Island],
    observer: &dyn Observer,
) -> Result<Outcome, PipelineError> {
    let options = &options.resolved();
    options.check()?;
    let settings = options.settings();
    let tracker = Tracker::new(observer, settings.budget);
    in_pool(settings.workers, || {
        unwrap_in_pool(upload, options, islands, &tracker)
    })?
}

fn unwrap_in_pool(
    upload: &Upload,
    options: &Options,
    islands: &[Island],
    tracker: &Tracker,
) -> Result<Outcome, PipelineError> {
    let mut seconds = Seconds::default();
    let mut watch = StopWatch::start(tracker);

    // Read the document, and merge the meshes of each atlas.
    tracker.stage(Stage::Read);
    let (nodes, plan) = (options.nodes(), Plan::new(&options.settings())?);
    let Prepared {
        document,
        group_by,
        seams,
        origins,
        texture,
        merge,
    } = Prepared::read(upload, options, &plan)?;
    let Mapped { groups, warning } = Mapped::of(&document, options, &plan, group_by)?;
    let groups = match &merge {
        Some(merge) if group_by == GroupBy::Material => merge.united(groups, document.primitives()),
        _ => groups,
    };
    let tiled = TiledTextures::of(&document, &groups, merge.as_ref(), options)?;
    tracker.warn(&tiled.warnings);
    let primitives = nodes.primitives(&document)?;
    let placed = placements(&document, &groups, islands)?;
    let merged = |(group, placed)| {
        let mut merged = Merged::with_seams(&document, &primitives, group, &seams, &plan)?;
        merged.seams.texture = texture;
        merged.seams.placed = placed;
        Ok(merged)
    };
    let meshes: Vec<Merged> =
        (groups.iter().zip(placed).map(merged)).collect::<Result<_, PipelineError>>()?;
    let rules = options.control.rules();
    check_faces(&rules, &faces_of_file(&document))?;
    let all_seams: Vec<&Seams> = meshes.iter().map(|mesh| &mesh.seams).collect();
    check_selections(&rules, &all_seams)?;
    seconds.read = watch.lap();

    // Unwrap.
    let atlases = unwrapped(&meshes, options, tracker)?;
    seconds.unwrap = watch.lap();

    // Turn the atlases into UVs, and resample textures for them.
    let uvs = new_uvs(&document, &groups, &atlases, options)?;
    let request = tiled.request(merge.as_ref(), options);
    let bake = || rebaked(&document, &groups, &request, &uvs, options, tracker);
    let baked = options.baking.rebake.then(bake).transpose()?;
    seconds.bake = watch.lap();

    // Write the document.
    tracker.stage(Stage::Write);
    let written = write(&document, &uvs, group_by, baked.as_ref(), upload, options)?;
    let v_axis = match options.format {
        OutputFormat::Obj => VAxis::Up,
        OutputFormat::Glb | OutputFormat::Gltf => VAxis::Down,
    };
    let notes = &written.notes.primitives;
    let arrays = UvArrays::new(&document, &uvs, v_axis, notes, &origins);
    seconds.write = watch.lap();
    let noticed = [document.warnings().to_vec(), tiled.resampled()].concat();
    // Free the document before the written one is read: both would take twice the memory.
    drop(primitives);
    drop(document);

    // Judge what was written, in the bytes written.
    tracker.stage(Stage::Judge);
    let mut uvs = WrittenUvs::read(&written, group_by, nodes)?;
    if options.layout.stack_offset {
        uvs.fold();
    }
    for (group, mesh) in uvs.groups.iter_mut().zip(&meshes) {
        group.weights = intended_weights(&mesh.seams, group, &plan);
    }
    let mut groups = uvs.judge(&options.claims(), options.layout.resolution);
    add_history(&mut groups, &atlases, &uvs, &plan, options);
    for ((group, uvs), mesh) in groups.iter_mut().zip(&uvs.groups).zip(&meshes) {
        group.rules = rule_reports(&mesh.seams, uvs, options.layout.resolution);
    }
    seconds.judge = watch.lap();

    // Report.
    let judged: Vec<_> = uvs.groups.iter().zip(&groups).collect();
    let missing = shortfalls(&judged, Mirrored::of(&plan));
    promise_kept(&plan, &groups, &missing)?;
    let ended_early = tracker.warning();
    let is_ended_early = ended_early.is_some();
    let mut warnings = noticed;
    warnings.extend(written.notes.warnings.iter().cloned());
    warnings.extend(warning);
    warnings.extend(nothing_stacked(&groups, options));
    warnings.extend(tracker.bent_borders());
    warnings.extend(missing);
    warnings.extend(ended_early);
    let mut report = Report::new(groups, warnings, Mirrored::of(&plan));
    report.ended_early = is_ended_early;
    report.partly_done = baked.is_some_and(|baked| baked.is_partial());
    report.options = Some(Options {
        group_by: Some(group_by),
        ..options.clone()
    });
    report.limits = Some(options.caller.limits);
    report.written = Some(written.notes);
    report.seconds = Some(seconds);
    Ok(Outcome {
        files: written.files,
        report,
        pictures: Pictures {
            uvs,
            texture: options.layout.resolution,
            shown: options.heatmap_measure,
            workers: options.settings().workers,
        },
        uvs: arrays,
    })
}

/// Returns the atlas of each mesh.
fn unwrapped(
    meshes: &[Merged],
    options: &Options,
    tracker: &Tracker,
) -> Result<Vec<Unwrapped>, PipelineError> {
    let soups: Vec<Soup> = meshes.iter().map(Merged::soup).collect();
    let mut atlases = unwrap_all(&soups, &options.settings(), tracker)?;
    if let Some(side) = options.whole_texels() {
        for (atlas, mesh) in atlases.iter_mut().zip(meshes) {
            let uvs = mesh.seams.uvs.as_deref().unwrap_or_default();
            shift_to_whole_texels(&mut atlas.grid, uvs, side);
        }
    }
    Ok(atlases)
}

fn write(
    document: &Document,
    uvs: &NewUvs,
    group_by: GroupBy,
    baked: Option<&BakedTextures>,
    upload: &Upload,
    options: &Options,
) -> Result<Written, PipelineError> {
    let write_options = WriteOptions {
        format: options.format,
        stem: options.caller.stem(upload),
        texcoord: options.sets.texcoord,
        overwrite: options.sets.overwrite,
        terms: Some(options.terms(group_by)),
    };
    let mut written = document.write_baked(uvs, &write_options, baked)?;
    if let Some(baked) = baked {
        let warnings = rebake::warnings(baked, options);
        written.notes.warnings.extend(warnings);
    }
    Ok(written)
}

// Islands named by the user, located in the meshes of a document.

/// Returns the number of faces of each primitive, with those that are left out.
fn faces_of_file(document: &Document) -> Vec<usize> {
    let primitives = document.primitives().iter();
    let n_faces = primitives.map(|it| it.triangles.len() + document.n_left_out());
    n_faces.collect()
}

/// Returns for each group its islands with fixed placements.
pub fn placements(
    document: &Document,
    groups: &[Group],
    islands: &[Island],
) -> Result<Vec<Vec<Placement>>, IslandError> {
    let primitives = document.primitives();
    let mut placed = vec![Vec::new(); groups.len()];
    for (number, island) in islands.iter().enumerate() {
        let unknown = || IslandError::UnknownFace(number);
        let index = island.primitive as usize;
        let primitive = primitives.get(index).ok_or_else(unknown)?;
        // Islands are named by faces of the file.
        let face = match document.kept_faces() {
            Some(kept) => kept.binary_search(&island.face).map_err(|_| unknown())?,
            None => island.face as usize,
        };
        if face >= primitive.triangles.len() {
            return Err(unknown());
        }
        let group = groups
            .iter()
            .position(|group: &Group| group.primitives.contains(&index))
            .ok_or_else(unknown)?;
        let before = (groups[group].primitives.iter()).take_while(|&&own| own != index);
        let first: usize = before.map(|&own| primitives[own].triangles.len()).sum();
        let face = (first + face) as u32;
        placed[group].push(island.placement(number, face, document.v_axis()));
    }
    Ok(placed)
}

// Atlases as UVs of a document.

/// Converts the atlases to UVs of the document. Islands that stay in place keep the document's UVs.
pub fn new_uvs(
    document: &Document,
    groups: &[Group],
    atlases: &[Unwrapped],
    options: &Options,
) -> Result<NewUvs, PipelineError> {
    let primitives = document.primitives();
    let v_axis = document.v_axis();
    let mut corners = vec![None; primitives.len()];
    for (group, atlas) in groups.iter().zip(atlases) {
        let (mut rest, mut still) = (atlas.grid.as_slice(), atlas.still.as_slice());
        let mut first = 0;
        for &index in &group.primitives {
            // Take the primitive's part of the grid.
            let (own, others) = rest.split_at(primitives[index].triangles.len());
            let mut uvs: Vec<Corners> = own.iter().map(|face| from_grid(face, v_axis)).collect();
            let next = first + own.len() as u32;
            // Faces of islands that stay in place keep the UVs of the document.
            let (inside, beyond) = still.split_at(still.partition_point(|&face| face < next));
            if !inside.is_empty()
                && let Some(given) = document.corner_uvs(index, options.sets.source())?
            {
                for face in inside.iter().map(|face| (face - first) as usize) {
                    uvs[face] = given[face].map(|uv| uv.map(|x| on_border(x) as f32));
                }
            }
            corners[index] = Some(uvs);
            (rest, still, first) = (others, beyond, next);
        }
    }
    Ok(NewUvs {
        layout: Layout::New,
        v_axis,
        corners,
    })
}

/// Converts grid coordinates to UVs, exactly in f32.
fn from_grid(corners: &GridCorners, v_axis: VAxis) -> Corners {
    let side = 1 << GRID_BITS;
    let unit = |i: i32| i as f32 / side as f32;
    corners.map(|[u, v]| match v_axis {
        VAxis::Up => [unit(u), unit(v)],
        VAxis::Down => [unit(u), unit(side - v)],
    })
}

// Packing of existing UVs.

/// Packs the islands of all primitives of a group into one atlas. Islands are rotated, shifted and scaled by one
/// common factor. Those with a placement in the options stay there, and the others are packed around them. Faces that
/// are flipped or overlap within an island remain so, and the certificate counts them.
pub fn repack_document(
    upload: &Upload,
    options: &RepackOptions,
    observer: &dyn Observer,
) -> Result<Outcome, PipelineError> {
    options.check()?;
    unwrap_around(upload, &options.to_unwrap(), &options.islands, observer)
}
