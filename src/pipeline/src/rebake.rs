//! Resampling of a document's textures for its new UVs.

use crate::PipelineError;
use crate::options::{MOST_SIDE, Options};
use crate::tracker::Tracker;
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::LazyLock;
use unwrapd_api::Stage;
use unwrapd_files::bake::{
    CornerColors, Coverage, Frames, MOST_TEXELS, Plane, Sampled, Texture, baked, side_for,
    side_of_length, stacks_agree,
};
use unwrapd_files::document::gltf::{GltfDocument, TiledTexture, tangents};
use unwrapd_files::document::{
    BakePlan, BakePlane, BakeRequest, BakedTextures, CornerTangents, Document, DocumentError,
    Encoding, Group, KeptTexture, MaterialMerge, MergePlan, MergedMaterial, NewUvs, PlaneSource,
    TextureSource, Warning, Wrap,
};
use unwrapd_files::picture::{Image, Picture, picture_size};
use unwrapd_maps::mesh::VAxis;

/// Picture of surfaces without a texture.
static WHITE: LazyLock<Picture> = LazyLock::new(|| {
    Picture::Eight(Image {
        width: 1,
        height: 1,
        pixels: vec![[u8::MAX; 4]],
    })
});

/// Corners of faces without vertex colors.
const WHITE_CORNERS: CornerColors = [[1.0; 4]; 3];

/// Minimum distance of charts in texels at which bilinear filtering does not mix them.
const FILTER_TEXELS: f64 = 2.0;

/// Resolves which materials become one. Reads the images, as those that cannot be read keep their materials apart.
/// `None` if that was not requested.
pub(super) fn merge_plan(
    document: &Document,
    options: &Options,
) -> Result<Option<MergePlan>, PipelineError> {
    let Document::Gltf(document) = document else {
        return Ok(None);
    };
    if options.merge_materials.is_empty() {
        return Ok(None);
    }
    let requested = requested(document, &options.merge_materials)?;
    let whole = Group {
        name: String::new(),
        label: String::new(),
        primitives: (0..document.primitives().len()).collect(),
    };
    let hoped = document.bake_plan(&[whole], &HOPED)?;
    let (_, unreadable) = read_images(document, &hoped.planes)?;
    Ok(Some(document.merge_plan(&requested, &unreadable)?))
}

/// Request as if every image were readable.
const HOPED: BakeRequest = BakeRequest {
    merge: None,
    unreadable: &BTreeMap::new(),
    kept: &[],
    draws_colors: false,
};

/// Name of the material that replaces all.
const MERGED: &str = "merged";

/// Resolves the names of materials to merge. Refuses unknown ones, and those with several targets.
fn requested(
    document: &GltfDocument,
    merges: &[MaterialMerge],
) -> Result<Vec<MergedMaterial>, PipelineError> {
    let mut requested: Vec<MergedMaterial> = Vec::new();
    let mut claimed = BTreeSet::new();
    for merge in merges {
        let MaterialMerge::Named { name, materials } = merge else {
            continue;
        };
        let mut members = BTreeSet::new();
        for material in materials {
            let index = (document.material(material))
                .ok_or_else(|| PipelineError::UnknownMaterial(material.clone()))?;
            members.insert(index);
            if !claimed.insert(index) {
                let text = format!("`merge_materials` names {material:?} twice");
                return Err(PipelineError::InvalidOptions(text));
            }
        }
        requested.push(MergedMaterial {
            name: name.clone(),
            members: members.into_iter().collect(),
        });
    }
    if merges.contains(&MaterialMerge::All) {
        let others = (0..document.n_materials()).filter(|index| !claimed.contains(index));
        requested.push(MergedMaterial {
            name: MERGED.to_owned(),
            members: others.collect(),
        });
    }
    Ok(requested)
}

// Textures that repeat on the surface.

/// Code of the warning about a texture that is resampled although it repeats.
const TILED: &str = "textures_tiled";

/// Textures that repeat on the surface: those that stay for this reason, and warnings about all.
#[derive(Default)]
pub(super) struct TiledTextures {
    kept: Vec<KeptTexture>,
    /// Warnings about the textures, in the order of the materials.
    pub warnings: Vec<Warning>,
}

impl TiledTextures {
    /// Returns the warnings about those that are resampled; the document warns of the others when it is written.
    pub fn resampled(&self) -> Vec<Warning> {
        let warnings = self.warnings.iter();
        let resampled = warnings.filter(|warning| warning.code == TILED);
        resampled.cloned().collect()
    }

    /// Returns the request for new textures, as if every image were readable.
    pub fn request<'a>(
        &'a self,
        merge: Option<&'a MergePlan>,
        options: &Options,
    ) -> BakeRequest<'a> {
        BakeRequest {
            merge,
            kept: &self.kept,
            draws_colors: options.baking.bake_colors,
            ..HOPED
        }
    }

    /// Finds the textures of `groups` that repeat, if textures are resampled: those of merged materials always, the
    /// others on request.
    pub fn of(
        document: &Document,
        groups: &[Group],
        merge: Option<&MergePlan>,
        options: &Options,
    ) -> Result<Self, PipelineError> {
        let document = match document {
            Document::Gltf(document) if options.rebakes() => document,
            _ => return Ok(Self::default()),
        };
        let merged = merge.map_or(&[][..], |merge| &merge.merged).iter();
        let merged: BTreeSet<usize> = merged.flat_map(|it| it.members.iter().copied()).collect();
        let mut found = Self::default();
        for tiled in document.tiled_textures(groups)? {
            let file = document.image(tiled.image);
            let size = file.ok().and_then(|file| picture_size(&file).ok());
            // An image that cannot be read stays for that reason.
            let Some(size) = size else { continue };
            let loss = loss(&tiled, size, options);
            if options.baking.bake_tiled || merged.contains(&tiled.material) {
                let name = document.texture_name(&tiled.slot, tiled.material);
                let text = format!("{name} is resampled, although {loss}");
                found.warnings.push(Warning::new(TILED, text));
            } else {
                let kept = KeptTexture {
                    material: Some(tiled.material),
                    slot: tiled.slot,
                    reason: format!("{loss}; `--bake-tiled` resamples it"),
                };
                found.warnings.push(document.kept_warning(&kept));
                found.kept.push(kept);
            }
        }
        Ok(found)
    }
}

/// Describes how often a texture repeats, and how much of it a new texture can keep.
fn loss(tiled: &TiledTexture, [width, height]: [u32; 2], options: &Options) -> String {
    let texels = f64::from(width) * f64::from(height);
    let needed = (tiled.atlas * texels).sqrt();
    let side = f64::from(match options.baking.bake_size {
        Some(side) => side,
        None => least_side(options).max(side_of_length(needed)),
    });
    let share = side / needed;
    let outcome = if share < 1.0 {
        let percent = (100.0 * share).floor().max(1.0);
        format!("keeps at most {percent} % of its texels along each side")
    } else {
        "has room for its texels".to_owned()
    };
    let [across, down] = tiled.repeats;
    format!(
        "it repeats {across:.1} × {down:.1} times on an island and is shown {:.1} times over; a texture of {side} × {side} {outcome}",
        tiled.area
    )
}

// Resampling.

/// Resamples all textures that can be read and are understood for `uvs`, v up. Enters the stage only if there are
/// any.
pub(super) fn rebaked(
    document: &Document,
    groups: &[Group],
    request: &BakeRequest,
    uvs: &NewUvs,
    options: &Options,
    tracker: &Tracker,
) -> Result<BakedTextures, PipelineError> {
    let Document::Gltf(document) = document else {
        let what = "new textures for another format than glTF".to_owned();
        return Err(DocumentError::UnsupportedOutput(what).into());
    };
    // Plan as if every image were readable; without anything to do, there is no stage.
    let hoped = document.bake_plan(groups, request)?;
    if hoped.planes.is_empty() && hoped.kept.is_empty() {
        return Ok(BakedTextures {
            has_colors_only: hoped.is_empty() && document.has_vertex_colors(),
            plan: hoped,
            files: Vec::new(),
            tangents: vec![None; document.primitives().len()],
        });
    }
    // Read the images, and plan again with those that can be read.
    tracker.stage(Stage::Bake);
    let (images, unreadable) = read_images(document, &hoped.planes)?;
    let request = BakeRequest {
        unreadable: &unreadable,
        ..*request
    };
    let plan = document.bake_plan(groups, &request)?;
    let surfaces: Vec<RebakedSurface> = (0..document.primitives().len())
        .into_par_iter()
        .map(|index| RebakedSurface::new(document, index, uvs, plan.is_normal_mapped(index)))
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
            .map(RebakedSurface::written_tangents)
            .collect(),
    })
}

/// Returns the side and the file of each texture of a plan. Resamples nothing if they would have too many texels in
/// total. Fails if stacked islands need different texels.
fn files(
    bake: &Bake,
    plan: &BakePlan,
    groups: &[Group],
    options: &Options,
) -> Result<Vec<(u32, Vec<u8>)>, PipelineError> {
    let sides = sides(bake, plan, groups, options)?;
    let mut files = Vec::new();
    // Textures of one group often have one size.
    let mut last: Option<((usize, u32), Coverage)> = None;
    for (wanted, side) in plan.planes.iter().zip(sides) {
        let members = &groups[wanted.group].primitives;
        let plane = bake.plane(wanted, members)?;
        let key = (wanted.group, side);
        let known = last.take().filter(|(known, _)| *known == key);
        let (_, coverage) = last.insert(
            known.unwrap_or_else(|| (key, Coverage::new(&bake.faces(members), side as usize))),
        );
        if options.stacks() && !stacks_agree(&plane, coverage) {
            return Err(PipelineError::StacksDiffer {
                group: groups[wanted.group].label.clone(),
                texture: wanted.name.clone(),
            });
        }
        let picture = if options.baking.image_format.keeps_16_bits() && plane.is_deep() {
            Picture::Sixteen(baked(&plane, coverage))
        } else {
            Picture::Eight(baked(&plane, coverage))
        };
        let format = options.baking.image_format;
        let file = format.file(bake.document, wanted, &picture)?;
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
    let least = options.baking.bake_size.unwrap_or(least_side(options));
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

/// Returns the smallest side of a texture unless another is given.
fn least_side(options: &Options) -> u32 {
    options.layout.resolution.longer().min(MOST_SIDE)
}

/// Warns if there was nothing to resample, and of textures whose charts are so close that bilinear filtering at the
/// border of one reads texels of another.
pub(super) fn warnings(baked: &BakedTextures, options: &Options) -> Vec<Warning> {
    // Find the textures in which charts come too near.
    let mut sides: Vec<u32> = baked.files.iter().map(|(side, _)| *side).collect();
    sides.sort_unstable();
    sides.dedup();
    let texels = f64::from(options.padding()) / f64::from(options.layout.resolution.longer());
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
    let nothing = baked.plan.is_empty().then(|| {
        if baked.has_colors_only {
            Warning::new(
                "colors_kept",
                "the model has colors at its vertices and no textures; `--bake-colors` draws them into one",
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

// Sampling planes: sources of the texels of each group.

/// Inputs of resampling.
pub(super) struct Bake<'a> {
    pub document: &'a GltfDocument,
    pub images: &'a Images,
    pub surfaces: &'a [RebakedSurface],
}

impl<'a> Bake<'a> {
    /// Returns the new UVs of a group, v down.
    pub fn faces(&self, members: &[usize]) -> Vec<[[f64; 2]; 3]> {
        let all = members.iter().flat_map(|&index| &self.surfaces[index].uvs);
        all.copied().collect()
    }

    /// Returns the sources of a group in one texture.
    pub fn plane(&self, wanted: &BakePlane, members: &[usize]) -> Result<Plane<'a>, DocumentError> {
        let mut plane = Plane {
            encoding: wanted.encoding,
            textures: Vec::new(),
            faces: Vec::new(),
            frames: None,
            colors: None,
        };
        let mut colors: Vec<CornerColors> = Vec::new();
        let mut frames = Frames {
            normals: Vec::new(),
            from: Vec::new(),
            to: Vec::new(),
        };
        for &index in members {
            let n_faces = self.surfaces[index].uvs.len();
            // Primitives without this texture have empty faces.
            let Some(source) = wanted.sources.get(&index) else {
                plane.faces.extend(std::iter::repeat_n(None, n_faces));
                frames.skip(n_faces);
                colors.resize(colors.len() + n_faces, WHITE_CORNERS);
                continue;
            };
            // Without a texture, all corners are at the same place of a white one.
            let (picture, wrap) = match &source.texture {
                Some(source) => (&self.images[&source.image], source.wrap),
                None => (&*WHITE, [Wrap::Clamp; 2]),
            };
            let texture = Texture {
                picture,
                encoding: wanted.encoding,
                wrap,
                is_nearest: wanted.is_nearest(),
                tint: source.tint,
            };
            // Append the places of its faces, with frames for a normal map.
            let places = match &source.texture {
                Some(source) => self.places(index, source)?,
                None => vec![[[0.5; 2]; 3]; n_faces],
            };
            if wanted.encoding == Encoding::Normal {
                self.extend_frames(&mut frames, index, &places)?;
            }
            match self.colors(index, source)? {
                Some(own) => colors.extend(own),
                None => colors.resize(colors.len() + n_faces, WHITE_CORNERS),
            }
            let (size, number) = (texture.size(), plane.textures.len() as u32);
            plane.textures.push(texture);
            plane.faces.extend(places.iter().map(|face| {
                Some(Sampled {
                    texture: number,
                    corners: face.map(|[u, v]| [u * size[0], v * size[1]]),
                })
            }));
        }
        plane.frames = (wanted.encoding == Encoding::Normal).then_some(frames);
        let mut sources = members.iter().filter_map(|index| wanted.sources.get(index));
        plane.colors = sources.any(|source| source.is_colored).then_some(colors);
        Ok(plane)
    }

    /// Returns the colors of the corners of a primitive, if its source is to be multiplied by them.
    fn colors(
        &self,
        index: usize,
        source: &PlaneSource,
    ) -> Result<Option<Vec<CornerColors>>, DocumentError> {
        if !source.is_colored {
            return Ok(None);
        }
        let Some(colors) = self.document.vertex_colors(index)? else {
            return Ok(None);
        };
        let faces = self.document.primitives()[index].triangles.iter();
        Ok(Some(
            faces
                .map(|face| face.map(|vertex: u32| colors[vertex as usize]))
                .collect(),
        ))
    }

    /// Returns the places of a primitive's corners in its image. Without UVs all are at (0, 0), as in renderers.
    fn places(
        &self,
        index: usize,
        source: &TextureSource,
    ) -> Result<Vec<[[f64; 2]; 3]>, DocumentError> {
        let uvs = self.document.corner_uvs(index, source.set)?;
        let uvs = uvs.unwrap_or_else(|| vec![[[0.0; 2]; 3]; self.surfaces[index].uvs.len()]);
        Ok(uvs
            .iter()
            .map(|face| face.map(|uv| source.place(uv)))
            .collect())
    }

    fn extend_frames(
        &self,
        frames: &mut Frames,
        index: usize,
        places: &[[[f64; 2]; 3]],
    ) -> Result<(), DocumentError> {
        let Some(directions) = &self.surfaces[index].directions else {
            return Ok(());
        };
        let from = if let Some(tangents) = self.document.corner_tangents(index)? {
            tangents
        } else {
            let uvs: Vec<_> = places
                .iter()
                .map(|face| face.map(|[u, v]: [f64; 2]| [u as f32, (1.0 - v) as f32]))
                .collect();
            let primitive = &self.document.primitives()[index];
            let found = tangents(primitive, &directions.normals, &uvs);
            found.unwrap_or_else(|| directions.tangents.clone())
        };
        frames.from.extend(from);
        frames.normals.extend(&directions.normals);
        frames.to.extend(&directions.tangents);
        Ok(())
    }
}

// Primitives with their new UVs.

/// A primitive with its new UVs.
pub(super) struct RebakedSurface {
    /// New UVs, v down.
    pub uvs: Vec<[[f64; 2]; 3]>,
    pub directions: Option<NormalFrames>,
}

/// Reference frames of normal maps.
pub(super) struct NormalFrames {
    pub normals: Vec<[[f32; 3]; 3]>,
    pub tangents: Vec<CornerTangents>,
    /// Set if the document has these normals. Otherwise they are those of the flat faces, and tangents are not
    /// written.
    are_given: bool,
}

impl RebakedSurface {
    pub fn new(
        document: &GltfDocument,
        index: usize,
        uvs: &NewUvs,
        is_normal_mapped: bool,
    ) -> Result<Self, DocumentError> {
        let upward = uvs.toward(index, VAxis::Up).unwrap_or_default();
        let directions = if is_normal_mapped {
            Some(NormalFrames::new(document, index, &upward)?)
        } else {
            None
        };
        Ok(Self {
            uvs: upward
                .iter()
                .map(|face| face.map(|[u, v]: [f32; 2]| [f64::from(u), 1.0 - f64::from(v)]))
                .collect(),
            directions,
        })
    }

    /// Returns the tangents to write to the document.
    pub fn written_tangents(self) -> Option<Vec<CornerTangents>> {
        let directions = self.directions.filter(|directions| directions.are_given);
        directions.map(|directions| directions.tangents)
    }
}

impl NormalFrames {
    fn new(
        document: &GltfDocument,
        index: usize,
        uvs: &[[[f32; 2]; 3]],
    ) -> Result<Self, DocumentError> {
        let primitive = &document.primitives()[index];
        let given = document.corner_normals(index)?;
        let are_given = given.is_some();
        let normals: Vec<_> = match given {
            Some(normals) => normals
                .into_iter()
                .map(|face: [[f64; 3]; 3]| face.map(|n| n.map(|x| x as f32)))
                .collect(),
            None => (primitive.triangles.iter())
                .map(|face| [flat_normal(face.map(|v| primitive.positions[v as usize])); 3])
                .collect(),
        };
        let tangents = tangents(primitive, &normals, uvs);
        Ok(Self {
            tangents: tangents.unwrap_or_else(|| vec![[[1.0, 0.0, 0.0, 1.0]; 3]; uvs.len()]),
            normals,
            are_given,
        })
    }
}

/// Returns the unit normal of a flat face; zero if the face is degenerate.
fn flat_normal([a, b, c]: [[f32; 3]; 3]) -> [f32; 3] {
    let (e, f) = (
        [0, 1, 2].map(|k| b[k] - a[k]),
        [0, 1, 2].map(|k| c[k] - a[k]),
    );
    let normal = [
        e[1] * f[2] - e[2] * f[1],
        e[2] * f[0] - e[0] * f[2],
        e[0] * f[1] - e[1] * f[0],
    ];
    let length = normal.iter().map(|x| x * x).sum::<f32>().sqrt();
    normal.map(|x| x / length.max(f32::MIN_POSITIVE))
}

// Source images of textures.

/// Maximum number of bytes of all images together, decoded: 268 million pixels of 8 bits per channel.
const MOST_BYTES: usize = 1 << 30;

/// Images by index.
type Images = BTreeMap<usize, Picture>;

/// Decodes the images that are sampled. Returns them, and the reasons why others cannot be read.
fn read_images(
    document: &GltfDocument,
    planes: &[BakePlane],
) -> Result<(Images, BTreeMap<usize, String>), DocumentError> {
    // List the images that are sampled, each once.
    let sources = planes.iter().flat_map(BakePlane::textures);
    let mut indices: Vec<usize> = sources.map(|source| source.image).collect();
    indices.sort_unstable();
    indices.dedup();
    let (mut images, mut unreadable) = (Images::new(), BTreeMap::new());
    let mut n_bytes = 0;
    // Decode them; stop once they have too many bytes together.
    for index in indices {
        let decoded = match document.image(index) {
            Ok(bytes) => Picture::decode(&bytes).map_err(|error| error.to_string()),
            Err(error) => Err(error.to_string()),
        };
        match decoded {
            Ok(picture) => {
                n_bytes += picture.n_bytes();
                images.insert(index, picture);
            }
            Err(reason) => drop(unreadable.insert(index, format!("image {index}: {reason}"))),
        }
        if n_bytes > MOST_BYTES {
            let most = MOST_BYTES >> 20;
            return Err(DocumentError::LimitExceeded(format!(
                "the images have more than {most} MiB of pixels"
            )));
        }
    }
    Ok((images, unreadable))
}
