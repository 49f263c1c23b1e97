//! Layouts that follow an island while it is dragged.
//!
//! The islands around are pushed aside where they are. If they do not all find room, the page grows, which is the same as shrinking
//! these islands, and shrinks again when it can. If they are in each other's way, they are all placed anew.
use std::sync::Arc;

use super::coarse::{FINE, RASTER};
use super::effort::UNHEARD;
use super::layout::SLACK;
use super::outline::{Outline, outlines};
use super::page::Region;
use super::plan::Plan;
use super::problem::{AtlasError, AtlasOptions, ChartMap, Rotation, Scale};
use super::squeeze::{Body, FixedBody, Pose, Squeezed};
use super::stay::Obstacle;
use super::within::Problem;

/// Distance that islands keep beside the padding, in cells: distances are looked up approximately.
const ROOM: f64 = 0.2;
/// Ratio of the sides of two pages above which the larger one is given up.
const CROWDED: f64 = 1.1;

/// Layout of islands around one that is dragged.
pub struct LiveLayout {
    options: AtlasOptions,
    plan: Plan,
    held: Outline,
    bodies: Vec<Arc<Body>>,
    squeezed: Squeezed,
    /// Cells along the longer side of a page at the start, with its borders and without.
    page: f64,
    side: f64,
    /// Side of the last page on which all islands around were placed anew.
    side_anew: f64,
}

/// Position of the islands around.
#[derive(Clone, Debug, PartialEq)]
pub struct Followers {
    /// Factor of their size; at most 1.
    pub scale: f64,
    /// Center of the bounding rectangle of each island, in longer sides of a page.
    pub middles: Vec<[f64; 2]>,
}

impl LiveLayout {
    /// Creates the layout of islands as they lie, around `held`. The unit of all maps is the longer side of a page, the origin is the
    /// lower left corner of the first page. Islands stay on the pages that contain their centers, and keep their angles.
    ///
    /// # Errors
    /// Fails if a map is faulty.
    pub fn new(
        islands: &[ChartMap],
        held: &ChartMap,
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
        let plan = Plan::largest_first(&outlines(islands)?, &options);
        let held = outlines(&[*held])?.remove(0);
        let chart = |&chart: &usize| &plan.outlines[chart];
        let bodies = plan.order.iter().map(chart);
        let bodies = bodies.map(|it| Arc::new(Body::new(it, page, padding + ROOM)));
        let pose = |outline: &Outline| {
            let middle = outline.middle().map(|x| x * page - padding / 2.0);
            Pose::new(middle, 0.0)
        };
        let width = texture.resolution.sides()[0];
        let frame = |outline: &Outline| {
            let last = f64::from(texture.pages - 1);
            let on = (outline.middle()[0] / width).floor().clamp(0.0, last);
            texture.frame(Region::page(on as u32))
        };
        Ok(Self {
            squeezed: Squeezed {
                poses: plan.order.iter().map(chart).map(pose).collect(),
                frames: plan.order.iter().map(chart).map(frame).collect(),
                side: page - padding,
                padding,
                fixed: [FixedBody::new(&held, page, padding + ROOM)].into(),
            },
            bodies: bodies.collect(),
            options,
            plan,
            held,
            page,
            side: page - padding,
            side_anew: page - padding,
        })
    }

    /// Moves the center of the held island and turns it by an angle, in radians, from where it lay at first. Returns where the other
    /// islands make room for it.
    pub fn drag(&mut self, middle: [f64; 2], angle: f64) -> Followers {
        self.squeezed.fixed = [self.squeezed.fixed[0].moved(middle, angle)].into();
        let mut pushed = self.squeezed.clone();
        let is_apart = pushed.follow(&self.bodies, self.side);
        if (!is_apart || pushed.side > CROWDED * self.side_anew)
            && let Some(anew) = self.placed_anew(middle, angle)
        {
            self.side_anew = anew.side;
            if !is_apart || CROWDED * anew.side < pushed.side {
                pushed = anew;
            }
        }
        self.squeezed = pushed;
        self.followers()
    }

    /// Returns a layout in which all islands around are placed one after the other; `None` if one finds no place.
    fn placed_anew(&self, middle: [f64; 2], angle: f64) -> Option<Squeezed> {
        let texture = self.options.texture;
        let turned = self.held.rotated(angle);
        let center = turned.place(self.held.middle());
        let last = f64::from(texture.pages - 1);
        let page = (middle[0] / texture.resolution.sides()[0]).floor();
        let obstacle = Obstacle {
            page: page.clamp(0.0, last) as u32,
            outline: turned.with_origin([0, 1].map(|k| center[k] - middle[k])),
            slack: 0.0,
        };
        let problem = Problem {
            charts: &[],
            regions: &[],
            obstacles: &[&obstacle],
        };
        let slack = vec![SLACK; self.plan.outlines.len()];
        let cells = FINE as u32 * RASTER;
        let found = problem.on_raster((&self.plan, &slack), cells, (&self.options, UNHEARD))?;
        // On this page, islands are as large as their bodies.
        let page = self.page * texture.grid_side() / found.scale;
        let fixed = self.squeezed.fixed.clone();
        let placed = problem.poses((&self.plan, &found), page, fixed, &self.options);
        let mut pushed = placed.clone();
        // The raster keeps them apart, though maybe not by the room.
        let is_apart = pushed.follow(&self.bodies, self.side);
        Some(if is_apart { pushed } else { placed })
    }

    fn followers(&self) -> Followers {
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
        }
    }
}
