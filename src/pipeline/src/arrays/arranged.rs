//! Packing of the charts of one mesh by rules: around islands that stay, in groups, in rectangles and at given densities.

use super::chart_maps::chart_maps;
use super::control::{DensityRule, FaceRules};
use super::packed::{ChartTerms, PACKINGS, unfolded};
use super::packing::atlas_options;
use super::placed_faces::PlacedFaces;
use super::placement::Placement;
use super::plan::Plan;
use super::seams::Seams;
use super::settings::Settings;
use super::soup::Soup;
use crate::PipelineError;
use crate::island_error::IslandError;
use std::collections::{BTreeMap, HashMap};
use unwrapd_layout::atlas::{
    Atlas, AtlasOptions, ChartMap, ConstraintError, Constraints, GRID_BITS, OnRead, Placed, Region,
    Rotation, Scale, Stay, Texture, pack_within,
};
use unwrapd_layout::charts::{Folds, MappedChart};
use unwrapd_maps::mesh::{CornerUvs, Resolution};
use unwrapd_method::numerics::bounds::bounds_of;
use unwrapd_method::numerics::vec2::doubled_area;

/// Charts of a mesh with the rules for them.
pub struct RuledCharts {
    /// Charts that are packed.
    pub free: Vec<MappedChart>,
    /// Charts that stay.
    staying: Vec<MappedChart>,
    /// For each of these the index of its placement.
    owners: Vec<usize>,
    /// For each of these whether others keep clear of it.
    is_obstacle: Vec<bool>,
}

impl RuledCharts {
    /// Separates the charts that stay, which `placed` names, and puts them where they stay.
    pub fn new(
        charts: Vec<MappedChart>,
        mesh: &Soup,
        placed: Option<&PlacedFaces>,
        texture: Texture,
    ) -> Result<Self, PipelineError> {
        let mut ruled = Self {
            free: Vec::new(),
            staying: Vec::new(),
            owners: Vec::new(),
            is_obstacle: Vec::new(),
        };
        let Some(placed) = placed else {
            ruled.free = charts;
            return Ok(ruled);
        };
        let uvs = mesh.seams.uvs.as_deref().unwrap_or_default();
        let mut islands: Vec<Vec<MappedChart>> = vec![Vec::new(); placed.placements().len()];
        for chart in charts {
            let face = chart.chart.corners.first().map(|[corner, ..]| corner / 3);
            match face.and_then(|face| placed.index_of(face)) {
                Some(index) => islands[index].push(chart),
                None => ruled.free.push(chart),
            }
        }
        for ((index, placement), mut island) in placed.placements().iter().enumerate().zip(islands)
        {
            if island.is_empty() {
                return Err(IslandError::UnknownFace(placement.number).into());
            }
            put(&mut island, placement, uvs, texture.resolution);
            let is_locked = placed.is_locked(index);
            for chart in &island {
                ruled
                    .is_obstacle
                    .push(!is_locked || is_on_page(chart, texture)?);
            }
            ruled
                .owners
                .resize(ruled.owners.len() + island.len(), index);
            ruled.staying.extend(island);
        }
        Ok(ruled)
    }

    /// Returns whether nothing stays.
    pub fn is_free(&self) -> bool {
        self.staying.is_empty()
    }

    /// Adds the charts that stay to packed charts, whose atlas has the obstacles already.
    pub fn with_staying(
        self,
        mut charts: Vec<MappedChart>,
        atlas: Atlas,
    ) -> (Vec<MappedChart>, Atlas) {
        let mut placed = atlas.placed;
        let mut obstacles = placed.split_off(charts.len()).into_iter();
        for (chart, is_obstacle) in self.staying.into_iter().zip(self.is_obstacle) {
            // The UVs of a chart beyond the pages are those of the file.
            let beyond = || Placed {
                grid: vec![[0; 2]; chart.embedding.uv.len()],
            };
            let own = is_obstacle.then(|| obstacles.next()).flatten();
            placed.push(own.unwrap_or_else(beyond));
            charts.push(chart);
        }
        (charts, Atlas { placed, ..atlas })
    }

    fn stays(&self) -> Vec<Stay<'_>> {
        let maps = chart_maps(&self.staying).into_iter().zip(&self.owners);
        let stays = maps.zip(&self.is_obstacle).filter(|(_, is)| **is);
        stays
            .map(|((map, &island), _)| Stay { map, island })
            .collect()
    }
}

/// Distance beyond a page, in longer sides of it, that rounding brings back: a step of the grid.
const BEYOND: f64 = 1.0 / (1 << GRID_BITS) as f64;

/// Returns whether a locked chart lies on a page: `false` if it lies beyond all pages.
///
/// # Errors
/// Fails if it crosses the border of a page.
fn is_on_page(chart: &MappedChart, texture: Texture) -> Result<bool, IslandError> {
    let [width, height] = texture.resolution.sides();
    let [low, high] = bounds_of(&chart.embedding.uv);
    let end = f64::from(texture.pages) * width;
    if high[0] <= BEYOND || low[0] >= end - BEYOND || high[1] <= BEYOND || low[1] >= height - BEYOND
    {
        return Ok(false);
    }
    let left = (f64::midpoint(low[0], high[0]) / width).floor() * width;
    let is_inside = low[0] >= left - BEYOND
        && high[0] <= left + width + BEYOND
        && low[1] >= -BEYOND
        && high[1] <= height + BEYOND;
    let faces = chart.chart.corners.iter().map(|corners| corners[0] / 3);
    let face = faces.min().unwrap_or(0);
    is_inside
        .then_some(true)
        .ok_or(IslandError::LockedOffPage { face })
}

/// Moves the charts of an island from their position in the file to their placement.
fn put(island: &mut [MappedChart], placement: &Placement, uvs: &[CornerUvs], texture: Resolution) {
    for chart in island.iter_mut() {
        let of_chart = chart.chart.disk.triangles.iter().zip(&chart.chart.corners);
        for (triangle, corners) in of_chart {
            for (&vertex, &corner) in triangle.iter().zip(corners) {
                let uv = uvs[corner as usize / 3][corner as usize % 3];
                chart.embedding.uv[vertex as usize] = uv;
            }
        }
    }
    let points = island.iter().flat_map(|chart| &chart.embedding.uv);
    let [low, high] = bounds_of(&points.copied().collect::<Vec<_>>());
    let middle = [0, 1].map(|k| f64::midpoint(low[k], high[k]));
    for chart in island {
        for uv in &mut chart.embedding.uv {
            *uv = placement.place(*uv, middle, texture);
        }
    }
}

// Sizes of charts.

/// Returns the rules of a chart, if its mesh has any.
fn rules_of<'a>(chart: &MappedChart, seams: &'a Seams) -> Option<&'a FaceRules> {
    let [corner, ..] = chart.chart.corners.first()?;
    Some(seams.control.as_ref()?.of(corner / 3))
}

/// Areas of charts that are scaled by one factor: of their maps, of the surface, and of their given UVs in texels.
#[derive(Clone, Copy, Default)]
struct ChartAreas {
    map: f64,
    surface: f64,
    given_texels: f64,
}

impl ChartAreas {
    fn add(&mut self, chart: &MappedChart, seams: &Seams, texture: Resolution) {
        self.map += chart.area().abs();
        self.surface += chart.surface_area();
        let texels = f64::from(texture.width) * f64::from(texture.height);
        for [corner, ..] in &chart.chart.corners {
            let uvs = seams.uvs.as_ref().map(|uvs| uvs[*corner as usize / 3]);
            let [a, b, c] = uvs.unwrap_or_default();
            self.given_texels += texels * doubled_area(a, b, c).abs() / 2.0;
        }
    }

    /// Returns the length of the map of a unit of length.
    fn density(&self) -> f64 {
        (self.map / self.surface).sqrt()
    }
}

/// Returns for each chart the first chart of its group, which is itself without a group.
fn first_of_group(charts: &[MappedChart], seams: &Seams) -> Vec<usize> {
    let mut firsts: HashMap<u32, usize> = HashMap::new();
    let first = |(index, chart): (usize, &MappedChart)| {
        let group = rules_of(chart, seams).and_then(|rules| rules.group);
        group.map_or(index, |group| *firsts.entry(group).or_insert(index))
    };
    charts.iter().enumerate().map(first).collect()
}

/// Scales charts as their rules say. The unit of those with a density of their own is then the longer side of a page.
pub fn resize(charts: &mut [MappedChart], seams: &Seams, texture: Resolution) {
    let first = first_of_group(charts, seams);
    let mut areas: Vec<ChartAreas> = vec![ChartAreas::default(); charts.len()];
    let mut of_rule: BTreeMap<u32, ChartAreas> = BTreeMap::new();
    for (chart, &first) in charts.iter().zip(&first) {
        areas[first].add(chart, seams, texture);
        if let Some(DensityRule::Equal(rule)) = rules_of(chart, seams).and_then(|it| it.density) {
            of_rule.entry(rule).or_default().add(chart, seams, texture);
        }
    }
    let longer = f64::from(texture.longer());
    for (chart, &first) in charts.iter_mut().zip(&first) {
        let areas = areas[first];
        let factor = match rules_of(chart, seams).and_then(|rules| rules.density) {
            None => 1.0,
            Some(DensityRule::Texels(texels)) => texels / (longer * areas.density()),
            Some(DensityRule::Kept) => (areas.given_texels / areas.map).sqrt() / longer,
            Some(DensityRule::Equal(rule)) => of_rule[&rule].density() / areas.density(),
        };
        // A chart without area has no density.
        if factor.is_normal() {
            for p in &mut chart.embedding.uv {
                *p = p.map(|x| factor * x);
            }
        }
    }
}

/// Kinds of sizes among the charts of a mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sizes {
    /// All follow from the room that there is, or from the density of the atlas.
    Common,
    /// All have a density of their own.
    Own,
    /// Some have.
    Both,
}

impl Sizes {
    /// Returns the kinds of the sizes of charts.
    pub fn of(charts: &[MappedChart], seams: &Seams) -> Self {
        let n_own = charts.iter().filter(|chart| is_sized(chart, seams)).count();
        match n_own {
            0 => Self::Common,
            n if n == charts.len() => Self::Own,
            _ => Self::Both,
        }
    }
}

fn is_sized(chart: &MappedChart, seams: &Seams) -> bool {
    rules_of(chart, seams).is_some_and(FaceRules::is_sized)
}

/// Returns the options for charts that have densities of their own, after [`resize`].
pub fn at_own_sizes(options: &AtlasOptions) -> AtlasOptions {
    AtlasOptions {
        scale: Scale::TexelsPerUnit(f64::from(options.texture.resolution.longer())),
        ..options.clone()
    }
}

/// Returns whether charts have groups or rectangles.
pub fn are_constrained(charts: &[MappedChart], seams: &Seams) -> bool {
    let mut rules = charts.iter().filter_map(|chart| rules_of(chart, seams));
    rules.any(|rules| rules.group.is_some() || rules.region.is_some())
}

// Packing.

/// Terms on which charts are packed.
pub struct ArrangementTerms<'a> {
    pub seams: &'a Seams,
    pub charts: ChartTerms<'a>,
    pub settings: &'a Settings,
    pub plan: &'a Plan,
    /// Number of atlases that share the effort.
    pub n_atlases: usize,
    pub on_read: &'a OnRead<'a>,
}

/// Packs charts by their rules around those that stay. Charts with a density of their own are packed first, and the others
/// around them. Returns the charts, some of them cut where rounding made them overlap themselves, and the atlas of these
/// and of the obstacles.
pub fn arranged(
    charts: Vec<MappedChart>,
    around: &RuledCharts,
    placed: Option<&PlacedFaces>,
    terms: &ArrangementTerms,
) -> Result<(Vec<MappedChart>, Atlas), PipelineError> {
    let mut charts = terms.charts.prepared(charts);
    let named = |error| named(error, placed, terms.settings);
    let mut rounds = 0;
    loop {
        rounds += 1;
        let atlas = packed_by_rules(&charts, around, terms).map_err(named)?;
        if terms.plan.folds == Folds::Keep || rounds == PACKINGS {
            return Ok((charts, atlas));
        }
        let n_before = charts.len();
        charts = unfolded(charts, &atlas.placed, terms.on_read);
        if charts.len() == n_before {
            return Ok((charts, atlas));
        }
    }
}

/// Reason why charts cannot be packed by their rules.
enum Unpacked {
    Constraint(ConstraintError),
    /// A rectangle has no room for its charts alone.
    Rectangle(String),
}

impl From<ConstraintError> for Unpacked {
    fn from(error: ConstraintError) -> Self {
        Self::Constraint(error)
    }
}

fn packed_by_rules(
    charts: &[MappedChart],
    around: &RuledCharts,
    terms: &ArrangementTerms,
) -> Result<Atlas, Unpacked> {
    let (sized, others): (Vec<usize>, Vec<usize>) =
        (0..charts.len()).partition(|&chart| is_sized(&charts[chart], terms.seams));
    let mut stays = around.stays();
    let n_given = stays.len();
    let mut placed = vec![Placed { grid: Vec::new() }; charts.len()];
    // Pack the charts with densities of their own.
    if !sized.is_empty() || others.is_empty() {
        let of = Subset::new(charts, &sized, terms);
        let mut atlas = of.packed(&stays, &at_own_sizes(&of.options(terms)), terms)?;
        for (&chart, own) in sized.iter().zip(&atlas.placed) {
            placed[chart] = own.clone();
        }
        if others.is_empty() {
            placed.extend(atlas.placed.drain(sized.len()..));
            return Ok(Atlas { placed, ..atlas });
        }
    }
    // Pack the others around them.
    let resolution = terms.settings.layout.resolution;
    let positions: Vec<Vec<[f64; 2]>> = sized
        .iter()
        .map(|&chart| on_page(&placed[chart], resolution))
        .collect();
    // They keep the distance from each other that they have.
    let island = around.owners.iter().max().map_or(0, |last| last + 1);
    stays.extend(sized.iter().zip(&positions).map(|(&chart, uv)| Stay {
        map: ChartMap {
            uv,
            triangles: &charts[chart].chart.disk.triangles,
        },
        island,
    }));
    let of = Subset::new(charts, &others, terms);
    let mut second = of.packed(&stays, &of.options(terms), terms)?;
    for (&chart, placed_chart) in others.iter().zip(&second.placed) {
        placed[chart] = placed_chart.clone();
    }
    let given = second.placed.drain(others.len()..).take(n_given);
    placed.extend(given);
    Ok(Atlas { placed, ..second })
}

/// Converts the place of a chart to longer sides of a page.
fn on_page(placed: &Placed, resolution: Resolution) -> Vec<[f64; 2]> {
    let unit = 1.0 / f64::from(1_u32 << GRID_BITS);
    let sides = resolution.sides();
    let point = |p: &[i32; 2]| [0, 1].map(|k| f64::from(p[k]) * unit * sides[k]);
    placed.grid.iter().map(point).collect()
}

/// Some charts of a mesh, and their rules.
struct Subset<'a> {
    charts: Vec<&'a MappedChart>,
    groups: Vec<usize>,
    regions: Vec<Option<Region>>,
    /// Name of each region.
    names: Vec<Option<&'a str>>,
}

impl<'a> Subset<'a> {
    fn new(charts: &'a [MappedChart], of: &[usize], terms: &ArrangementTerms<'a>) -> Self {
        let groups = first_of_group(charts, terms.seams);
        let region = |&chart: &usize| rules_of(&charts[chart], terms.seams)?.region.as_ref();
        let regions: Vec<_> = of.iter().map(region).collect();
        Self {
            charts: of.iter().map(|&chart| &charts[chart]).collect(),
            groups: of.iter().map(|&chart| groups[chart]).collect(),
            regions: regions
                .iter()
                .map(|region| region.map(|(_, region)| *region))
                .collect(),
            names: regions
                .iter()
                .map(|region| region.map(|(name, _)| name.as_str()))
                .collect(),
        }
    }

    fn options(&self, terms: &ArrangementTerms) -> AtlasOptions {
        let charts: Vec<MappedChart> = self.charts.iter().copied().cloned().collect();
        let mut options = atlas_options((terms.settings, terms.plan), terms.n_atlases, &charts);
        // Islands keep their angles, up to quarter turns, beside others that are arranged by hand.
        let is_by_hand = !terms.seams.placed.is_empty();
        if is_by_hand && options.rotation == Rotation::Any {
            options.rotation = Rotation::Quarter;
        }
        options
    }

    fn packed(
        &self,
        stays: &[Stay],
        options: &AtlasOptions,
        terms: &ArrangementTerms,
    ) -> Result<Atlas, Unpacked> {
        let maps = chart_maps(self.charts.iter().copied());
        let within = |regions: &[Option<Region>], stays: &[Stay]| {
            let constraints = Constraints {
                groups: &self.groups,
                regions,
                stays,
            };
            pack_within(&maps, &constraints, options, terms.on_read)
        };
        let packed = within(&self.regions, stays);
        if !matches!(packed, Err(ConstraintError::NoRoom)) {
            return Ok(packed?);
        }
        // Name a rectangle that is too small in any case.
        let names: BTreeMap<&str, Region> = self
            .names
            .iter()
            .zip(&self.regions)
            .filter_map(|(name, region)| Some(((*name)?, (*region)?)))
            .collect();
        for (name, region) in names {
            let inside: Vec<usize> = (0..maps.len())
                .filter(|&chart| self.regions[chart] == Some(region))
                .collect();
            let own: Vec<ChartMap> = inside.iter().map(|&chart| maps[chart]).collect();
            let constraints = Constraints {
                groups: &inside
                    .iter()
                    .map(|&chart| self.groups[chart])
                    .collect::<Vec<_>>(),
                regions: &vec![Some(region); inside.len()],
                stays: &[],
            };
            if pack_within(&own, &constraints, options, terms.on_read).is_err() {
                return Err(Unpacked::Rectangle(name.to_owned()));
            }
        }
        Err(ConstraintError::NoRoom.into())
    }
}

/// Names the islands of an error.
fn named(error: Unpacked, placed: Option<&PlacedFaces>, settings: &Settings) -> PipelineError {
    let number = |island: usize| {
        let placement = placed.filter(|placed| !placed.is_locked(island));
        placement.and_then(|placed| Some(placed.placements().get(island)?.number))
    };
    let padding = settings.layout.padding;
    let error = match error {
        Unpacked::Rectangle(name) => IslandError::RectangleTooSmall(name),
        Unpacked::Constraint(error) => match error {
            ConstraintError::OffPage { island } => {
                IslandError::OffPage(number(island).unwrap_or_default())
            }
            ConstraintError::TooNear { islands, texels } => match islands.map(number) {
                [Some(a), Some(b)] => IslandError::TooNear {
                    islands: [a, b],
                    texels,
                    padding,
                },
                [a, b] => IslandError::NearLocked {
                    island: a.or(b).unwrap_or_default(),
                    texels,
                    padding,
                },
            },
            ConstraintError::NoRoom | ConstraintError::Region { .. } => IslandError::NoRoom,
            ConstraintError::Atlas(error) => return PipelineError::Atlas(error),
        },
    };
    error.into()
}
