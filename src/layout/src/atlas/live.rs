//! Layouts that follow islands while they are dragged.
//!
//! The islands around are pushed aside where they are. If they do not all find room, the page grows, which is the same as shrinking
//! these islands, and shrinks again when it can. If they are in each other's way, they are all placed anew, or begin again where they
//! lay at first. So they do once the islands that are held rest, if they are still too small.
use std::sync::Arc;

use super::effort::UNHEARD;
use super::gap::poses;
use super::layout::{Obstacle, Problem, SLACK};
use super::outline::{Outline, outlines};
use super::page::{FINE, RASTER, Region, Texture};
use super::plan::Plan;
use super::problem::{AtlasError, AtlasOptions, ChartMap, Rotation, Scale};
use super::squeeze::{Body, FixedBody, Pose, Squeezed};

/// Distance that islands keep beside the padding, in cells: distances are looked up approximately. Around a turned island, up to 0.23
/// cells were missing; twice that keeps the padding at any resolution of the texture, which cells do not depend on.
const ROOM: f64 = 0.5;
/// Ratio of the sides of two pages above which the larger one is given up.
const CROWDED: f64 = 1.1;

/// Layout of islands around those that are held.
pub struct LiveLayout {
    options: AtlasOptions,
    plan: Plan,
    held: Vec<Held>,
    bodies: Vec<Arc<Body>>,
    squeezed: Squeezed,
    /// Cells along the longer side of a page at full size, with its borders and without.
    page: f64,
    side: f64,
    /// Side of the last page on which all islands around were placed anew.
    side_anew: f64,
    /// Islands as they lay at first.
    first: Squeezed,
    motion: HeldState,
}

/// Motion of the islands that are held since room was made for them.
#[derive(Clone, Copy, PartialEq, Eq)]
enum HeldState {
    Moved,
    AtRest,
}

/// Island that is held.
struct Held {
    outline: Outline,
    /// Center and angle at which it is held.
    middle: [f64; 2],
    angle: f64,
}

/// Position of the islands around.
#[derive(Clone, Debug, PartialEq)]
pub struct Followers {
    /// Factor of their size; at most 1.
    pub scale: f64,
    /// Center of the bounding rectangle of each island, in longer sides of a page.
    pub middles: Vec<[f64; 2]>,
    /// Room beside the islands that are held.
    pub room: Room,
}

/// Room beside the islands that are held.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Room {
    /// No island around overlaps another island.
    Enough,
    /// Some islands around overlap others. They lie where they last had room.
    Missing,
}

impl LiveLayout {
    /// Creates the layout of islands as they lie, around those in `held`. The unit of all maps is the longer side of a page, the
    /// origin is the lower left corner of the first page. The maps of the islands around have their full size; the islands begin at
    /// `scale` times that size, with the same centers. They stay on the pages that contain their centers, and keep their angles.
    ///
    /// # Errors
    /// Fails if a map is faulty.
    pub fn new(
        around: &[ChartMap],
        held: &[ChartMap],
        scale: f64,
        options: &AtlasOptions,
    ) -> Result<Self, AtlasError> {
        let options = AtlasOptions {
            scale: Scale::Largest,
            rotation: Rotation::None,
            // Islands that are placed anew are placed once.
            patience: 0,
            ..options.clone()
        };
        let texture = options.texture;
        let page = FINE * f64::from(texture.raster(RASTER));
        let padding = options.padding_share() * page;
        let plan = Plan::of(around, &options)?;
        let held = outlines(held)?;
        let chart = |&chart: &usize| &plan.outlines[chart];
        let bodies = plan.order.iter().map(chart);
        let bodies = bodies.map(|it| Arc::new(Body::new(it, page, padding + ROOM)));
        let pose = |outline: &Outline| {
            let middle = outline.middle().map(|x| x * page / scale - padding / 2.0);
            Pose::new(middle, 0.0)
        };
        let width = texture.resolution.sides()[0];
        let frame = |outline: &Outline| {
            let last = f64::from(texture.pages - 1);
            let on = (outline.middle()[0] / width).floor().clamp(0.0, last);
            texture.frame(Region::page(on as u32))
        };
        let fixed = held.iter();
        let fixed = fixed.map(|outline| FixedBody::new(outline, page, padding + ROOM));
        let posed = plan.order.iter().map(chart);
        let posed = posed.map(|outline| (pose(outline), frame(outline)));
        let squeezed = Squeezed::new(posed, fixed.collect(), page / scale, padding, page);
        Ok(Self {
            first: squeezed.clone(),
            squeezed,
            motion: HeldState::Moved,
            bodies: bodies.collect(),
            options,
            held: held.into_iter().map(Held::new).collect(),
            plan,
            page,
            side: page - padding,
            side_anew: page - padding,
        })
    }

    /// Moves the center of a held island, named by its index, and turns it by an angle, in radians, from where it lay at first.
    pub fn drag(&mut self, island: usize, middle: [f64; 2], angle: f64) {
        let held = &mut self.held[island];
        if (held.middle, held.angle) == (middle, angle) {
            return;
        }
        (held.middle, held.angle) = (middle, angle);
        self.motion = HeldState::Moved;
        let mut fixed = self.squeezed.fixed.to_vec();
        fixed[island] = fixed[island].moved(middle, angle);
        self.squeezed.fixed = fixed.into();
    }

    /// Makes room for the islands that are held. Returns where the other islands then lie. Where they could still grow, another call
    /// makes them larger.
    pub fn make_room(&mut self) -> Followers {
        let mut pushed = self.squeezed.clone();
        let mut is_apart = pushed.follow(&self.bodies, self.side);
        let is_stuck = self.motion == HeldState::AtRest
            && pushed.side > self.side
            && pushed.side >= self.squeezed.side;
        self.motion = HeldState::AtRest;
        if (!is_apart || is_stuck || pushed.side > CROWDED * self.side_anew)
            && let Some(anew) = self.anew()
        {
            self.side_anew = anew.side;
            // At rest, islands may jump for any gain.
            let gain = if is_stuck { 1.0 } else { CROWDED };
            if !is_apart || gain * anew.side < pushed.side {
                (pushed, is_apart) = (anew, true);
            }
        }
        let room = if is_apart {
            self.squeezed = pushed;
            Room::Enough
        } else {
            Room::Missing
        };
        self.followers(room)
    }

    /// Returns the fuller of two layouts that do not begin where the islands lie: they are placed one after the other, or pushed aside
    /// from where they lay at first. Returns `None` if neither has room.
    fn anew(&self) -> Option<Squeezed> {
        let mut first = Squeezed {
            fixed: self.squeezed.fixed.clone(),
            ..self.first.clone()
        };
        let is_apart = first.follow(&self.bodies, self.side);
        let both = [is_apart.then_some(first), self.placed_anew()];
        let by_side = |a: &Squeezed, b: &Squeezed| a.side.total_cmp(&b.side);
        both.into_iter().flatten().min_by(by_side)
    }

    /// Returns a layout in which all islands around are placed one after the other; `None` if one finds no place.
    fn placed_anew(&self) -> Option<Squeezed> {
        let texture = self.options.texture;
        let held = self.held.iter().map(|held| held.obstacle(texture));
        let held: Vec<Obstacle> = held.collect();
        let problem = Problem {
            plan: &self.plan,
            regions: &[],
            obstacles: &held.iter().collect::<Vec<_>>(),
            options: &self.options,
            on_read: UNHEARD,
        };
        let slack = vec![SLACK; self.plan.outlines.len()];
        let cells = FINE as u32 * RASTER;
        let found = problem.layout(&slack, cells)?;
        // On this page, islands are as large as their bodies. On a larger one they are apart as well.
        let page = self.page * (texture.grid_side() / found.scale).max(1.0);
        let fixed = self.squeezed.fixed.clone();
        let placed = poses(&problem, &found, page, fixed);
        let mut pushed = placed.clone();
        // The raster keeps them apart, though maybe not by the room.
        let is_apart = pushed.follow(&self.bodies, self.side);
        Some(if is_apart { pushed } else { placed })
    }

    fn followers(&self, room: Room) -> Followers {
        let Squeezed {
            side,
            padding,
            poses,
            ..
        } = &self.squeezed;
        let page = side + padding;
        let mut middles: Vec<[f64; 2]> = (self.plan.outlines.iter()).map(Outline::middle).collect();
        for (&island, pose) in self.plan.order.iter().zip(poses) {
            middles[island] = pose.middle.map(|x| (x + padding / 2.0) / page);
        }
        Followers {
            scale: self.page / page,
            middles,
            room,
        }
    }
}

impl Held {
    fn new(outline: Outline) -> Self {
        Self {
            middle: outline.middle(),
            angle: 0.0,
            outline,
        }
    }

    /// Returns the island where it is held, on the page that contains its center.
    fn obstacle(&self, texture: Texture) -> Obstacle {
        let turned = self.outline.rotated(self.angle);
        let center = turned.place(self.outline.middle());
        let last = f64::from(texture.pages - 1);
        let page = (self.middle[0] / texture.resolution.sides()[0]).floor();
        Obstacle {
            page: page.clamp(0.0, last) as u32,
            outline: turned.with_origin([0, 1].map(|k| center[k] - self.middle[k])),
            slack: 0.0,
        }
    }
}
