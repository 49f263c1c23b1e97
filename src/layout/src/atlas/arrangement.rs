//! One way to arrange charts.
use std::ops::Range;
use std::sync::Arc;

use super::poses::Poses;
use super::sheet::Sheet;
use super::spot::{Corner, Window};
use unwrapd_method::numerics::random::Random;

/// How many poses are tried to fit a chart to its place.
const FITTED: usize = 12;

/// An order and a pose for every chart, and what comes of it.
#[derive(Clone)]
pub(super) struct Arrangement {
    pub order: Vec<usize>,
    pub pose: Vec<usize>,
    /// For each chart its lower left corner.
    pub corners: Vec<Corner>,
    pub side: u32,
    /// The side, and below one cell how far the charts reach on average.
    pub cost: f64,
}

impl Arrangement {
    /// Takes the cells of the charts of some places in the order.
    pub(super) fn take(&self, poses: &[Arc<Poses>], sheet: &mut Sheet, places: Range<usize>) {
        for &chart in &self.order[places] {
            sheet.take(poses[chart].mask(self.pose[chart]), self.corners[chart]);
        }
    }

    /// Places the charts of some places in the order on a sheet that holds those before; those behind do not count. None if that takes
    /// more than a page of side `largest`.
    pub(super) fn lay_out(
        &mut self,
        poses: &[Arc<Poses>],
        sheet: &mut Sheet,
        places: Range<usize>,
        largest: u32,
    ) -> Option<()> {
        sheet.capacity = largest;
        let form = sheet.form;
        let (mut reach, mut side) = (0, 0);
        for (place, &chart) in self.order[..places.end].iter().enumerate() {
            let mask = poses[chart].mask(self.pose[chart]);
            if place >= places.start {
                let (_, spot) = sheet.find(std::slice::from_ref(mask), Window::ALL)?;
                self.corners[chart] = spot.corner;
                if place + 1 < places.end {
                    sheet.take(mask, spot.corner);
                }
            }
            let corner = self.corners[chart];
            let [width, height] = mask.size;
            let far = form.side([corner.x + width, corner.y + height]);
            reach += far;
            side = side.max(far);
        }
        if side > largest {
            return None;
        }
        self.side = side;
        let most = f64::from(side) * places.end as f64 + 1.0;
        self.cost = f64::from(side) + f64::from(reach) / most;
        Some(())
    }

    /// Turns the chart at a place of the order to the pose, of a few, in which it reaches least far on a sheet that holds the
    /// charts before it.
    pub(super) fn fit(
        &mut self,
        place: usize,
        poses: &[Arc<Poses>],
        sheet: &mut Sheet,
        random: &mut Random,
    ) {
        let chart = self.order[place];
        let distinct = poses[chart].distinct();
        let mut least = u64::MAX;
        for _ in 0..FITTED {
            let pose = distinct[random.below(distinct.len())];
            let mask = poses[chart].mask(pose);
            let Some((_, spot)) = sheet.find(std::slice::from_ref(mask), Window::ALL) else {
                continue;
            };
            let [width, height] = mask.size;
            let far = [spot.corner.x + width, spot.corner.y + height];
            let side = sheet.form.side(far).max(sheet.side());
            let reach = u64::from(side) << 32 | u64::from(far[0] + far[1]);
            if reach < least {
                (least, self.pose[chart]) = (reach, pose);
            }
        }
    }

    /// Gives the pose of the chart at a place to its copies; returns the first place that changed.
    pub(super) fn copy_pose(&mut self, place: usize, kind: &[usize]) -> usize {
        let chart = self.order[place];
        let pose = self.pose[chart];
        let mut first = place;
        for (other, &copy) in self.order.iter().enumerate() {
            if kind[copy] == kind[chart] && self.pose[copy] != pose {
                self.pose[copy] = pose;
                first = first.min(other);
            }
        }
        first
    }

    /// Another place among the first `n` of the order, or another pose, for one chart; returns the first place that is concerned,
    /// and whether the chart there is to be [fitted](Self::fit).
    pub(super) fn change(
        &mut self,
        n: usize,
        poses: &[Arc<Poses>],
        random: &mut Random,
    ) -> (usize, bool) {
        let [i, j] = [random.below(n), random.below(n)];
        let chart = self.order[i];
        let of_chart = &poses[chart];
        let pose = &mut self.pose[chart];
        match random.below(5) {
            0 => self.order.swap(i, j),
            1 => {
                self.order.remove(i);
                self.order.insert(j, chart);
            }
            2 => {
                *pose = of_chart.next_angle(*pose, random.below(2) == 0);
                return (i, false);
            }
            3 => return (i, true),
            _ => {
                let distinct = of_chart.distinct();
                *pose = distinct[random.below(distinct.len())];
                return (i, false);
            }
        }
        (i.min(j), false)
    }

    /// A number that differs, as good as surely, where arrangements look different, given for each chart the first that looks like
    /// it in each pose.
    ///
    /// From: Fowler, Noll, Vo 1991 (FNV-1a), over words.
    pub(super) fn key(&self, kind: &[usize]) -> u64 {
        let looks = |&chart: &usize| (kind[chart] as u64) << 8 | self.pose[chart] as u64;
        let mixed = |key: u64, look: u64| (key ^ look).wrapping_mul(0x0000_0100_0000_01b3);
        let looks = self.order.iter().map(looks);
        looks.fold(0xcbf2_9ce4_8422_2325, |key, look| {
            let key = mixed(key, look);
            key ^ key >> 29
        })
    }
}
