//! Live arrangement of a document's islands: some are held, and the others make room for them.
//!
//! Each atlas of the document is a [`LiveLayout`] of its islands, which are those that [`repack_document`](crate::repack_document)
//! packs. An island that is held stays where its handle puts it. The others keep their angles and have one scale, at most that of the
//! file. A released island stays where it is until another one is held or moved; then it makes room like the others. Atlases without
//! a held island are not touched.
use std::collections::{BTreeMap, HashMap};
use std::f64::consts::TAU;

use crate::PipelineError;
use crate::arrays::plan::Plan;
use crate::documents::input::{Merged, Prepared};
use crate::island_error::IslandError;
use crate::options::{CommandOptions, Island, RepackOptions};
use serde::Deserialize;
use unwrapd_deform::{Editable, Editor, HandleId, Model};
use unwrapd_files::document::Upload;
use unwrapd_layout::atlas::{AtlasError, AtlasOptions, ChartMap, LiveLayout, Room, Texture};
use unwrapd_maps::certificate::chart_ids;
use unwrapd_maps::mesh::{Surface, VAxis};
use unwrapd_method::numerics::bounds::bounds_of;
use unwrapd_method::numerics::predicates::orient2d_sign;
use unwrapd_method::solver::Stage;

/// Maximum number of islands that make room for those held in their atlas. The time of a step grows faster than their number
/// (`cargo bench --bench packing -- --drag`).
const MOST_AROUND: usize = 100;
/// Maximum side of the rectangle around a held island, in longer sides of a page. Its distances are stored for each cell, and where it
/// is larger than a page, it fits nowhere.
const LARGEST: f64 = 2.0;
/// Share of the scale by which islands must grow in a step for another step to be worthwhile. A step that succeeds makes them larger
/// by 0.4 %, or as large as they may be.
const GROWTH: f64 = 1e-6;
/// Distance in longer sides of a page up to which an island may extend beyond its page: rounding brings it back.
const BEYOND: f64 = 1e-7;

/// A session in which islands are held and the others make room.
pub type IslandSession = Editor<LiveIslands>;

/// Opens a session on the islands that [`repack_document`](crate::repack_document) would pack, all where they lie. The caller adds
/// the handles.
///
/// # Errors
/// Fails like that function, if `texels_per_unit` is given, since islands that make room may shrink, or if every atlas has too many
/// islands.
pub fn open_islands(
    upload: &Upload,
    options: &RepackOptions,
) -> Result<IslandSession, PipelineError> {
    options.check()?;
    if options.layout.texels_per_unit.is_some() {
        let text = "`texels_per_unit` has no effect in a session, where islands make room";
        return Err(PipelineError::InvalidOptions(text.to_owned()));
    }
    if !options.control.control.is_empty() {
        let text = "`control` has no effect in a session, where islands make room";
        return Err(PipelineError::InvalidOptions(text.to_owned()));
    }
    let islands = LiveIslands::read(upload, options)?;
    let counts = islands.atlases.iter().map(|atlas| atlas.shapes.len());
    match counts.min() {
        None | Some(0) => Err(PipelineError::NoTriangles),
        Some(islands) if islands > MOST_AROUND + 1 => {
            let most = MOST_AROUND + 1;
            Err(IslandError::TooMany { islands, most }.into())
        }
        Some(_) => Ok(Editor::of(islands)),
    }
}

/// An island as clients name it. Members that are absent stay as they are.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct IslandHandle {
    #[serde(default)]
    primitive: u32,
    face: u32,
    #[serde(rename = "move")]
    shift: Option<[f64; 2]>,
    turn: Option<f64>,
    scale: Option<f64>,
    pivot: Option<[f64; 2]>,
}

/// Islands of a document, some of them held.
pub struct LiveIslands {
    atlases: Vec<LiveAtlas>,
    options: AtlasOptions,
    v_axis: VAxis,
    /// Vertices of each face of the UV map.
    faces: Vec<[u32; 3]>,
    vertices: Vec<Vertex>,
    /// Island of each face; `None` for one without three distinct positions in an island of such faces.
    island_of: Vec<Option<IslandId>>,
    /// Index of the first face of each primitive, and at last the number of faces.
    first_faces: Vec<usize>,
}

/// Vertex of the UV map: corners of one island at one place.
struct Vertex {
    /// Position in the file.
    uv: [f64; 2],
    island: Option<IslandId>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
struct IslandId {
    atlas: usize,
    island: usize,
}

impl LiveIslands {
    fn read(upload: &Upload, options: &RepackOptions) -> Result<Self, PipelineError> {
        let unwrap = options.to_unwrap();
        let plan = Plan::new(&unwrap.settings())?;
        let Prepared {
            document,
            group_by,
            seams,
            ..
        } = Prepared::read(upload, &unwrap, &plan)?;
        let primitives = document.primitives();
        // Islands are named by the faces of the file.
        let missing = document.n_left_out();
        if missing > 0 {
            return Err(PipelineError::PartlyNoUvs {
                group: document.groups(group_by)[0].label.clone(),
                texcoord: unwrap.sets.source(),
                missing,
                triangles: missing + primitives[0].triangles.len(),
            });
        }
        let texture = Texture {
            resolution: options.layout.resolution,
            pages: options.layout.pages,
        };
        // Number the faces as the document does.
        let mut first_faces = vec![0];
        for primitive in primitives {
            first_faces.push(first_faces[first_faces.len() - 1] + primitive.triangles.len());
        }
        let n_faces = first_faces[primitives.len()];
        // Find the islands of each atlas.
        let mut atlases = Vec::new();
        let mut island_of = vec![None; n_faces];
        let mut charts = vec![(0, 0); n_faces];
        for (atlas, group) in document.groups(group_by).iter().enumerate() {
            let merged = Merged::with_seams(&document, primitives, group, &seams, &plan)?;
            let uvs = merged.seams.uvs.as_deref().unwrap_or_default();
            let ids = chart_ids(&merged.positions, &merged.triangles, uvs);
            let has_area = Surface::new(&merged.positions, &merged.triangles)?.faces;
            let mut numbers: HashMap<u32, usize> = HashMap::new();
            for &face in &has_area {
                let next = numbers.len();
                numbers.entry(ids[face as usize]).or_insert(next);
            }
            let faces = group.primitives.iter();
            let faces = faces.flat_map(|&own| first_faces[own]..first_faces[own + 1]);
            for (face, id) in faces.zip(&ids) {
                let island = numbers.get(id);
                island_of[face] = island.map(|&island| IslandId { atlas, island });
                charts[face] = (atlas, *id);
            }
            let mut corners: Vec<Vec<[[f64; 2]; 3]>> = vec![Vec::new(); numbers.len()];
            let sides = texture.resolution.sides();
            for face in has_area.iter().map(|&face| face as usize) {
                let on_page = uvs[face].map(|[u, v]| [u * sides[0], v * sides[1]]);
                corners[numbers[&ids[face]]].push(on_page);
            }
            if let Some(chart) = corners.iter().position(|faces| !are_finite(faces)) {
                return Err(AtlasError::NonFinite { chart }.into());
            }
            atlases.push(LiveAtlas::new(&corners));
        }
        for (face, id) in island_of.iter().enumerate().rev() {
            if let Some(IslandId { atlas, island }) = *id {
                let primitive = first_faces.partition_point(|&first| first <= face) - 1;
                let face = face - first_faces[primitive];
                atlases[atlas].shapes[island].name = [primitive as u32, face as u32];
            }
        }
        // Unite the corners of a chart that lie at one place.
        let mut faces = Vec::new();
        let mut vertices = Vec::new();
        let mut numbers: HashMap<((usize, u32), [u64; 2]), u32> = HashMap::new();
        for primitive in 0..primitives.len() {
            let uvs = document.corner_uvs(primitive, options.sets.source())?;
            for corners in uvs.unwrap_or_default() {
                let face = faces.len();
                faces.push(corners.map(|uv| {
                    let next = vertices.len() as u32;
                    let key = (charts[face], uv.map(f64::to_bits));
                    *numbers.entry(key).or_insert_with(|| {
                        let island = island_of[face];
                        vertices.push(Vertex { uv, island });
                        next
                    })
                }));
            }
        }
        Ok(Self {
            atlases,
            options: AtlasOptions {
                texture,
                padding_texels: options.layout.padding,
                ..AtlasOptions::default()
            },
            v_axis: document.v_axis(),
            faces,
            vertices,
            island_of,
            first_faces,
        })
    }

    /// Returns the vertices of each face: the i-th one is that of the i-th face of the document.
    pub fn faces(&self) -> &[[u32; 3]] {
        &self.faces
    }

    /// Returns the UVs of the vertices, as in the file.
    pub fn vertex_uvs(&self) -> Vec<[f64; 2]> {
        let atlases = self.atlases.iter();
        let turns: Vec<Vec<Turned>> = atlases.map(LiveAtlas::turned).collect();
        let moved = |vertex: &Vertex| {
            let id = vertex.island.filter(|&id| !self.is_still(id));
            id.map_or(vertex.uv, |IslandId { atlas, island }| {
                let moved = turns[atlas][island].place(self.on_page(vertex.uv));
                self.off_page(moved)
            })
        };
        self.vertices.iter().map(moved).collect()
    }

    /// Returns the sign of the area of each face, which no movement changes.
    pub fn signs(&self) -> Vec<i8> {
        let sign = |face: &[u32; 3]| {
            let [a, b, c] = face.map(|v| self.vertices[v as usize].uv);
            orient2d_sign(a, b, c)
        };
        self.faces.iter().map(sign).collect()
    }

    /// Returns the smallest ratio of an island's area to its area in the file.
    pub fn smallest(&self) -> f64 {
        let places = self.atlases.iter().flat_map(|atlas| &atlas.places);
        let areas = places.map(|place| place.scale * place.scale);
        areas.fold(f64::INFINITY, f64::min)
    }

    /// Returns the placement of the island that a client names, which is `number` in errors.
    pub fn named(&self, number: usize, handle: &IslandHandle) -> Result<Island, IslandError> {
        let id = self.find(handle.primitive, handle.face);
        let id = id.ok_or(IslandError::UnknownFace(number))?;
        let present = self.placement(id);
        let shift_of = |pivot: [f64; 2]| {
            let now = self.off_page(self.turned(id).place(self.on_page(pivot)));
            [0, 1].map(|k| now[k] - pivot[k])
        };
        let now = handle.pivot.map_or(present.shift, shift_of);
        Ok(Island {
            primitive: handle.primitive,
            face: handle.face,
            shift: handle.shift.unwrap_or(now),
            turn: handle.turn.unwrap_or(present.turn),
            scale: handle.scale.unwrap_or(present.scale),
            pivot: handle.pivot.or(present.pivot),
        })
    }

    /// Returns the placements of all islands of the atlases in which an island was moved or is held.
    pub fn placements(&self) -> Vec<Island> {
        let touched = self.atlases.iter().enumerate();
        let touched = touched.filter(|(_, atlas)| atlas.is_touched());
        let ids = touched.flat_map(|(atlas, it)| {
            let islands = 0..it.shapes.len();
            islands.map(move |island| IslandId { atlas, island })
        });
        ids.map(|id| self.placement(id)).collect()
    }

    fn find(&self, primitive: u32, face: u32) -> Option<IslandId> {
        let range = self.first_faces.get(primitive as usize..)?;
        let &[first, next, ..] = range else {
            return None;
        };
        let face = first + face as usize;
        (face < next).then(|| self.island_of[face]).flatten()
    }

    fn is_still(&self, IslandId { atlas, island }: IslandId) -> bool {
        let atlas = &self.atlases[atlas];
        atlas.places[island] == Place::first(&atlas.shapes[island])
    }

    fn turned(&self, IslandId { atlas, island }: IslandId) -> Turned {
        let atlas = &self.atlases[atlas];
        Turned::new(atlas.shapes[island].middle, &atlas.places[island])
    }

    /// Returns the placement of an island in the format of the options, about its middle.
    fn placement(&self, id: IslandId) -> Island {
        let atlas = &self.atlases[id.atlas];
        let (shape, place) = (&atlas.shapes[id.island], &atlas.places[id.island]);
        let [pivot, now] = [shape.middle, place.middle].map(|point| self.off_page(point));
        let turn = place.turn.to_degrees();
        Island {
            primitive: shape.name[0],
            face: shape.name[1],
            shift: [0, 1].map(|k| now[k] - pivot[k]),
            turn: match self.v_axis {
                VAxis::Up => turn,
                VAxis::Down => -turn,
            },
            scale: place.scale,
            pivot: Some(pivot),
        }
    }

    /// Returns the place of an island with this placement, which is `number` in errors.
    fn place(&self, number: usize, island: &Island) -> Result<(IslandId, Place), IslandError> {
        let id = self.find(island.primitive, island.face);
        let id = id.ok_or(IslandError::UnknownFace(number))?;
        island.check(number).map_err(IslandError::BadTarget)?;
        let atlas = &self.atlases[id.atlas];
        let (islands, most) = (atlas.shapes.len(), MOST_AROUND + 1);
        if islands > most {
            return Err(IslandError::TooMany { islands, most });
        }
        let shape = &atlas.shapes[id.island];
        let sides = self.options.texture.resolution.sides();
        let middle = [0, 1].map(|k| shape.middle[k] / sides[k]);
        let placement = island.placement(number, island.face, self.v_axis);
        let resolution = self.options.texture.resolution;
        let place = Place {
            middle: placement.place(middle, middle, resolution),
            turn: placement.turn,
            scale: placement.scale,
        };
        if shape.extent.iter().any(|side| side * place.scale > LARGEST) {
            return Err(IslandError::OffPage(number));
        }
        Ok((id, place))
    }

    /// Converts a position in the file to longer sides of a page, v up.
    fn on_page(&self, [u, v]: [f64; 2]) -> [f64; 2] {
        let [width, height] = self.options.texture.resolution.sides();
        let up = match self.v_axis {
            VAxis::Up => v,
            VAxis::Down => 1.0 - v,
        };
        [u * width, up * height]
    }

    /// Converts a position in longer sides of a page, v up, to that in the file.
    fn off_page(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let [width, height] = self.options.texture.resolution.sides();
        let up = y / height;
        let v = match self.v_axis {
            VAxis::Up => up,
            VAxis::Down => 1.0 - up,
        };
        [x / width, v]
    }
}

fn are_finite(faces: &[[[f64; 2]; 3]]) -> bool {
    let coordinates = faces.as_flattened().as_flattened();
    coordinates.iter().all(|x| x.is_finite())
}

impl Editable for LiveIslands {
    type Handle = Island;
    /// Places of the islands of each atlas.
    type Places = Vec<Vec<Place>>;
    type Error = IslandError;

    fn retarget(island: &mut Island, target: &[f64]) {
        // Numbers that are not a pair are not a target.
        let to = <[f64; 2]>::try_from(target).unwrap_or([f64::NAN; 2]);
        let pivot = island.pivot.unwrap_or_default();
        island.shift = [0, 1].map(|k| to[k] - pivot[k]);
    }

    fn no_such_handle(_: HandleId) -> IslandError {
        IslandError::UnknownHandle
    }

    fn hold(&mut self, handles: &BTreeMap<HandleId, Island>) -> Result<(), IslandError> {
        let mut places: BTreeMap<IslandId, (usize, Place)> = BTreeMap::new();
        for (number, island) in handles.values().enumerate() {
            let (id, place) = self.place(number, island)?;
            if let Some((first, _)) = places.insert(id, (number, place)) {
                return Err(IslandError::Twice(first, number));
            }
        }
        for (index, atlas) in self.atlases.iter_mut().enumerate() {
            let own = places.iter().filter(|(id, _)| id.atlas == index);
            let held = own.map(|(id, &(_, place))| (id.island, place));
            atlas.hold(held.collect(), &self.options);
        }
        Ok(())
    }

    fn remodel(&mut self, _: &Model) -> Result<(), IslandError> {
        Err(IslandError::NoEnergy)
    }

    fn step(&mut self) -> Stage {
        for atlas in &mut self.atlases {
            atlas.step(&self.options);
        }
        self.stage()
    }

    fn stage(&self) -> Stage {
        let is_any = |stage: Stage| self.atlases.iter().any(|atlas| atlas.stage == stage);
        if is_any(Stage::Moving) {
            Stage::Moving
        } else if is_any(Stage::Unreachable) {
            Stage::Unreachable
        } else {
            Stage::Settled
        }
    }

    fn places(&self) -> Self::Places {
        let places = self.atlases.iter().map(|atlas| atlas.places.clone());
        places.collect()
    }

    fn first_places(&self) -> Self::Places {
        let shapes = self.atlases.iter().map(|atlas| atlas.shapes.iter());
        shapes
            .map(|shapes| shapes.map(Place::first).collect())
            .collect()
    }

    fn put(&mut self, places: Self::Places) -> Result<(), IslandError> {
        for (atlas, places) in self.atlases.iter_mut().zip(places) {
            atlas.put(places);
        }
        Ok(())
    }
}

// One atlas, in longer sides of a page, v up.

/// Islands that share pages.
struct LiveAtlas {
    shapes: Vec<Shape>,
    places: Vec<Place>,
    /// Islands that are held, in ascending order.
    held: Vec<usize>,
    /// Layout around these, made in the next step if absent.
    layout: Option<HeldLayout>,
    stage: Stage,
    /// Largest scale of islands that make room: that of the file, unless an island of the file is larger than a page.
    full: f64,
}

/// Shape of an island in the file.
struct Shape {
    uv: Vec<[f64; 2]>,
    triangles: Vec<[u32; 3]>,
    /// Middle of the bounding rectangle, and its sides.
    middle: [f64; 2],
    extent: [f64; 2],
    /// Primitive, and the first of the island's faces in it.
    name: [u32; 2],
}

/// Place of an island.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// Position of the middle of its bounding rectangle in the file.
    middle: [f64; 2],
    /// Angle by which it is turned about the middle, in radians.
    turn: f64,
    /// Factor of its size in the file.
    scale: f64,
}

/// Layout around islands that are held, and the places that they had when it was made.
struct HeldLayout {
    live: LiveLayout,
    first: Vec<Place>,
    /// Offset from the middle to the center of the bounding rectangle of each island, at the angle and at the scale of `first`; at
    /// scale 1 for islands that make room.
    centers: Vec<[f64; 2]>,
    /// Set once the islands have made room for the present places of those held.
    is_current: bool,
}

impl LiveAtlas {
    fn new(islands: &[Vec<[[f64; 2]; 3]>]) -> Self {
        let shapes: Vec<Shape> = islands.iter().map(|faces| Shape::new(faces)).collect();
        let sides = shapes.iter().flat_map(|shape| shape.extent);
        let longest = sides.fold(0.0, f64::max);
        Self {
            places: shapes.iter().map(Place::first).collect(),
            shapes,
            held: Vec::new(),
            layout: None,
            stage: Stage::Settled,
            full: 1.0_f64.min(1.0 / longest),
        }
    }

    fn is_touched(&self) -> bool {
        let mut places = self.places.iter().zip(&self.shapes);
        !self.held.is_empty() || places.any(|(place, shape)| *place != Place::first(shape))
    }

    fn turned(&self) -> Vec<Turned> {
        let places = self.shapes.iter().zip(&self.places);
        places
            .map(|(shape, place)| Turned::new(shape.middle, place))
            .collect()
    }

    /// Holds these islands, and no others, in ascending order.
    fn hold(&mut self, held: Vec<(usize, Place)>, options: &AtlasOptions) {
        let islands: Vec<usize> = held.iter().map(|&(island, _)| island).collect();
        let is_release = self.held.iter().any(|island| !islands.contains(island));
        // An island that is moved and released at once stays where it was moved, with room around it.
        if is_release {
            self.step(options);
        }
        let is_hold = islands.iter().any(|island| !self.held.contains(island));
        if is_hold || is_release {
            self.layout = None;
            self.stage = Stage::Settled;
            self.held = islands;
        }
        for (island, place) in held {
            let is_moved = self.places[island] != place;
            if self.places[island].scale != place.scale {
                self.layout = None;
            }
            self.places[island] = place;
            if is_moved || is_hold {
                self.stage = Stage::Moving;
                if let Some(layout) = &mut self.layout {
                    layout.is_current = false;
                }
            }
        }
    }

    /// Puts all islands somewhere; nothing moves until an island is held or moved.
    fn put(&mut self, places: Vec<Place>) {
        self.places = places;
        self.layout = None;
        self.stage = Stage::Settled;
    }

    /// Makes room for the islands that are held, or lets the others grow where they have room.
    fn step(&mut self, options: &AtlasOptions) {
        if self.stage != Stage::Moving {
            return;
        }
        if self.held.len() == self.shapes.len() {
            self.stage = self.stage_of_held(options);
            return;
        }
        let layout = match self.layout.take() {
            Some(layout) => Ok(layout),
            None => HeldLayout::new(self, options),
        };
        let Ok(mut layout) = layout else {
            // Coordinates are finite, and indices in range.
            self.stage = Stage::Unreachable;
            return;
        };
        // Move the islands that are held.
        for (index, &island) in self.held.iter().enumerate() {
            let (place, first) = (&self.places[island], &layout.first[island]);
            let turn = (place.turn - first.turn) % TAU;
            let center = rotated(layout.centers[island], turn);
            let middle = [0, 1].map(|k| place.middle[k] + center[k]);
            layout.live.drag(index, middle, turn);
        }
        // Move the others.
        let followers = layout.live.make_room();
        let scale = self.full * followers.scale;
        let mut before = scale;
        let around = (0..self.shapes.len()).filter(|island| !self.held.contains(island));
        for (island, center) in around.zip(followers.middles) {
            let place = &mut self.places[island];
            before = place.scale;
            place.scale = scale;
            place.middle = [0, 1].map(|k| center[k] - scale * layout.centers[island][k]);
        }
        // Go on while they grow.
        let is_grown = scale > (1.0 + GROWTH) * before || !layout.is_current;
        let may_grow = scale < (1.0 - GROWTH) * self.full;
        self.stage = match followers.room {
            Room::Missing => Stage::Unreachable,
            Room::Enough if is_grown && may_grow => Stage::Moving,
            Room::Enough => self.stage_of_held(options),
        };
        layout.is_current = true;
        self.layout = Some(layout);
    }

    /// Returns the stage of islands for which there is room: whether all lie on a page.
    fn stage_of_held(&self, options: &AtlasOptions) -> Stage {
        let Texture { resolution, pages } = options.texture;
        let [width, height] = resolution.sides();
        let is_inside = |&island: &usize| {
            let turned = Turned::new(self.shapes[island].middle, &self.places[island]);
            let uv = self.shapes[island].uv.iter().map(|&uv| turned.place(uv));
            let [low, high] = bounds_of(&uv.collect::<Vec<_>>());
            let page = (f64::midpoint(low[0], high[0]) / width).floor();
            let left = page * width;
            (0.0..f64::from(pages)).contains(&page)
                && low[0] >= left - BEYOND
                && high[0] <= left + width + BEYOND
                && low[1] >= -BEYOND
                && high[1] <= height + BEYOND
        };
        if self.held.iter().all(is_inside) {
            Stage::Settled
        } else {
            Stage::Unreachable
        }
    }

    /// Returns the scale of the islands around those that are held: the median of their scales, so that an island that was released at
    /// another scale has theirs from then on.
    fn common_scale(&self, around: &[usize]) -> f64 {
        let mut scales: Vec<f64> = around.iter().map(|&i| self.places[i].scale).collect();
        scales.sort_by(f64::total_cmp);
        let median = scales.get(scales.len().saturating_sub(1) / 2);
        median.map_or(self.full, |scale| scale.min(self.full))
    }
}

impl HeldLayout {
    fn new(atlas: &LiveAtlas, options: &AtlasOptions) -> Result<Self, AtlasError> {
        let is_held = |island: &usize| atlas.held.contains(island);
        let all = 0..atlas.shapes.len();
        let (held, around): (Vec<usize>, Vec<usize>) = all.partition(is_held);
        // Make the maps, at their angles, with the centers of their rectangles where they are.
        let mut uvs = Vec::new();
        let mut centers = Vec::new();
        for (island, (shape, place)) in atlas.shapes.iter().zip(&atlas.places).enumerate() {
            let size = if is_held(&island) {
                place.scale
            } else {
                atlas.full
            };
            let about = Place {
                middle: [0.0; 2],
                scale: 1.0,
                ..*place
            };
            let turned = Turned::new(shape.middle, &about);
            let mut uv: Vec<[f64; 2]> = shape.uv.iter().map(|&p| turned.place(p)).collect();
            let [low, high] = bounds_of(&uv);
            let center = [0, 1].map(|k| f64::midpoint(low[k], high[k]));
            for p in &mut uv {
                let on_page = |k: usize| {
                    place.middle[k] + place.scale * center[k] + size * (p[k] - center[k])
                };
                *p = [0, 1].map(on_page);
            }
            uvs.push(uv);
            let unit = if is_held(&island) { place.scale } else { 1.0 };
            centers.push(center.map(|x| unit * x));
        }
        let map = |&island: &usize| ChartMap {
            uv: &uvs[island],
            triangles: &atlas.shapes[island].triangles,
        };
        let maps = |islands: &[usize]| islands.iter().map(map).collect::<Vec<_>>();
        let scale = atlas.common_scale(&around) / atlas.full;
        Ok(Self {
            live: LiveLayout::new(&maps(&around), &maps(&held), scale, options)?,
            first: atlas.places.clone(),
            centers,
            is_current: false,
        })
    }
}

impl Shape {
    fn new(faces: &[[[f64; 2]; 3]]) -> Self {
        let mut numbers: HashMap<[u64; 2], u32> = HashMap::new();
        let mut uv = Vec::new();
        let mut number = |p: [f64; 2]| {
            *numbers.entry(p.map(f64::to_bits)).or_insert_with(|| {
                uv.push(p);
                uv.len() as u32 - 1
            })
        };
        let triangles = faces.iter().map(|face| face.map(&mut number)).collect();
        let [low, high] = bounds_of(&uv);
        Self {
            middle: [0, 1].map(|k| f64::midpoint(low[k], high[k])),
            extent: [0, 1].map(|k| high[k] - low[k]),
            name: [0; 2],
            uv,
            triangles,
        }
    }
}

impl Place {
    fn first(shape: &Shape) -> Self {
        Self {
            middle: shape.middle,
            turn: 0.0,
            scale: 1.0,
        }
    }
}

/// Similarity that takes an island from the file to its place.
struct Turned {
    from: [f64; 2],
    to: [f64; 2],
    /// Scale times the cosine and the sine of the angle.
    axis: [f64; 2],
}

impl Turned {
    fn new(from: [f64; 2], place: &Place) -> Self {
        let (sin, cos) = place.turn.sin_cos();
        Self {
            from,
            to: place.middle,
            axis: [cos, sin].map(|x| place.scale * x),
        }
    }

    fn place(&self, p: [f64; 2]) -> [f64; 2] {
        let [x, y] = [0, 1].map(|k| p[k] - self.from[k]);
        let [c, s] = self.axis;
        [self.to[0] + c * x - s * y, self.to[1] + s * x + c * y]
    }
}

fn rotated([x, y]: [f64; 2], angle: f64) -> [f64; 2] {
    let (sin, cos) = angle.sin_cos();
    [cos * x - sin * y, sin * x + cos * y]
}
