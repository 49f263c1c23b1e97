//! Nearest neighbors among points of space.

/// Largest number of points that are compared one by one. Fewer make the tree deeper, more are compared in vain.
const LEAF: usize = 8;
/// Capacity for ranges that wait to be searched: one per level of the tree, and `u32` indices give at most 32 levels.
const DEPTH: usize = 32;

/// A k-d tree over points of space.
#[derive(Clone, Debug)]
pub struct PointTree {
    points: Vec<[f64; 3]>,
    /// Points in the order of the tree: the median of a range is in its middle, with the lower side on the left.
    order: Vec<u32>,
    /// Positions in the order of the tree, so that those of a leaf are read together.
    sorted: Vec<[f64; 3]>,
    /// Axis along which the range around each place is divided.
    axis: Vec<u8>,
}

impl PointTree {
    /// Builds the tree of these points, in any order. O(n log n).
    pub fn new(points: Vec<[f64; 3]>) -> Self {
        let mut tree = Self {
            order: (0..points.len() as u32).collect(),
            sorted: Vec::new(),
            axis: vec![0; points.len()],
            points,
        };
        let mut open = vec![(0, tree.points.len())];
        while let Some((start, end)) = open.pop() {
            let range = start..end;
            if range.len() <= LEAF {
                continue;
            }
            let middle = usize::midpoint(start, end);
            let axis = tree.widest_axis(&tree.order[range.clone()]);
            let points = &tree.points;
            let key = |v: &u32| points[*v as usize][axis];
            tree.order[range.clone()].select_nth_unstable_by(middle - start, |a, b| {
                key(a).total_cmp(&key(b)).then(a.cmp(b))
            });
            tree.axis[middle] = axis as u8;
            open.push((start, middle));
            open.push((middle + 1, end));
        }
        let sorted = tree.order.iter().map(|&v| tree.points[v as usize]);
        tree.sorted = sorted.collect();
        tree
    }

    /// Returns the points.
    pub fn points(&self) -> &[[f64; 3]] {
        &self.points
    }

    /// Returns the nearest point for which `accepts` holds and its distance; `None` if there is none closer than
    /// `reach`. Among equals returns the lowest index.
    pub fn nearest(
        &self,
        to: [f64; 3],
        reach: f64,
        accepts: impl Fn(u32) -> bool,
    ) -> Option<(u32, f64)> {
        let mut best = (reach * reach, u32::MAX);
        let mut open = Vec::with_capacity(DEPTH);
        open.push((0, self.order.len(), [0.0; 3]));
        while let Some((start, end, away)) = open.pop() {
            // Skip a range whose box is farther than the best point. `compare` adds up squares in the same order, so rounding cannot
            // make a box farther than its points.
            if away.iter().map(|x: &f64| x * x).sum::<f64>() > best.0 {
                continue;
            }
            // Compare the points of a leaf one by one.
            if end - start <= LEAF {
                for place in start..end {
                    self.compare(place, to, &accepts, &mut best);
                }
                continue;
            }
            // Compare the median, then search the near side before the far one.
            let middle = usize::midpoint(start, end);
            let axis = usize::from(self.axis[middle]);
            self.compare(middle, to, &accepts, &mut best);
            let beyond = to[axis] - self.sorted[middle][axis];
            let (near, far) = if beyond < 0.0 {
                ((start, middle), (middle + 1, end))
            } else {
                ((middle + 1, end), (start, middle))
            };
            let mut beyond_plane = away;
            beyond_plane[axis] = beyond;
            open.push((far.0, far.1, beyond_plane));
            open.push((near.0, near.1, away));
        }
        (best.1 != u32::MAX).then(|| (best.1, best.0.sqrt()))
    }

    fn compare(
        &self,
        place: usize,
        to: [f64; 3],
        accepts: &impl Fn(u32) -> bool,
        best: &mut (f64, u32),
    ) {
        let (v, p) = (self.order[place], self.sorted[place]);
        let squared = (0..3).map(|k| (p[k] - to[k]).powi(2)).sum::<f64>();
        if (squared < best.0 || (squared == best.0 && v < best.1)) && accepts(v) {
            *best = (squared, v);
        }
    }

    fn widest_axis(&self, order: &[u32]) -> usize {
        let mut low = [f64::INFINITY; 3];
        let mut high = [f64::NEG_INFINITY; 3];
        for &v in order {
            let p = self.points[v as usize];
            for k in 0..3 {
                low[k] = low[k].min(p[k]);
                high[k] = high[k].max(p[k]);
            }
        }
        let width = |k: usize| high[k] - low[k];
        (1..3).fold(
            0,
            |widest, k| if width(k) > width(widest) { k } else { widest },
        )
    }
}
