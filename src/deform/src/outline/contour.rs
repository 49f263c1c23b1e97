//! The outline of a picture's opaque part.

use super::{MOST_VERTICES, Outline, OutlineError};
use std::collections::HashMap;
use unwrapd_files::picture::Image;
use unwrapd_maps::plane::doubled_polygon_area;
use unwrapd_method::numerics::vec2::{dot, squared_distance, sub};

/// Settings for outlining a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImageSettings {
    /// Least alpha of a pixel that belongs to the shape; at least 1.
    pub threshold: u8,
    /// Largest distance of the outline from the contour of the alpha, in pixels; 0 keeps every step.
    pub tolerance_pixels: f64,
    /// Least area of pieces and holes, in square pixels; smaller ones are specks and left out.
    pub smallest_area: f64,
}

impl Default for ImageSettings {
    fn default() -> Self {
        Self {
            threshold: 128,
            tolerance_pixels: 0.5, // a staircase of whole pixels becomes straight
            smallest_area: 16.0,
        }
    }
}

/// Computes the outline of the pixels that are opaque enough, in pixels, with (0, 0) at the picture's upper left
/// corner.
///
/// Follows the contour of the alpha between pixel centers (marching squares with interpolation), so that anti-aliased
/// edges are met to a fraction of a pixel; everything outside the picture is transparent. Where the tolerance would
/// make the outline cross itself, a smaller one is used.
pub fn of_image(image: &Image, settings: &ImageSettings) -> Result<Outline, OutlineError> {
    let contours: Vec<Vec<[f64; 2]>> = Alpha::new(image, settings.threshold)
        .contours()?
        .into_iter()
        .filter(|contour| doubled_polygon_area(contour).abs() >= 2.0 * settings.smallest_area)
        .collect();
    let mut tolerance = settings.tolerance_pixels.max(0.0);
    loop {
        let loops = contours.iter().map(|c| simplified(c, tolerance)).collect();
        match Outline::new(loops) {
            Err(OutlineError::SelfIntersecting { .. }) if tolerance > 0.0 => {
                tolerance = if tolerance > 0.1 {
                    0.5 * tolerance
                } else {
                    0.0
                };
            }
            outline => return outline,
        }
    }
}

/// The alpha of a picture with a margin of one transparent pixel. Samples are counted from the upper left of that
/// margin.
struct Alpha<'a> {
    image: &'a Image,
    threshold: u8,
}

/// Contour steps: from the cell edge at which the step begins to the one at which it ends.
type Steps = HashMap<u64, u64>;

impl<'a> Alpha<'a> {
    fn new(image: &'a Image, threshold: u8) -> Self {
        Self {
            image,
            threshold: threshold.max(1),
        }
    }

    fn at(&self, x: usize, y: usize) -> u8 {
        let inside = (1..=self.image.width).contains(&x) && (1..=self.image.height).contains(&y);
        if inside {
            self.image.pixels[(y - 1) * self.image.width + x - 1][3]
        } else {
            0
        }
    }

    /// Returns closed polygons with the shape on their left; no two of them touch.
    fn contours(&self) -> Result<Vec<Vec<[f64; 2]>>, OutlineError> {
        let mut steps = Steps::new();
        let mut starts = Vec::new();
        for y in 0..=self.image.height {
            for x in 0..=self.image.width {
                self.cross_cell(x, y, |from, to| {
                    steps.insert(from, to);
                    starts.push(from);
                });
            }
            if starts.len() > 4 * MOST_VERTICES {
                return Err(OutlineError::TooDetailed);
            }
        }
        let mut contours = Vec::new();
        for start in starts {
            let mut contour = Vec::new();
            let mut edge = start;
            while let Some(next) = steps.remove(&edge) {
                contour.push(self.crossing(edge));
                edge = next;
            }
            if !contour.is_empty() {
                contours.push(contour);
            }
        }
        Ok(contours)
    }

    /// Calls `step` for the steps of the contour through the cell whose upper left sample is (x, y).
    fn cross_cell(&self, x: usize, y: usize, mut step: impl FnMut(u64, u64)) {
        // Counter-clockwise in these coordinates; edge k runs from corner k to the next.
        let corners = [(x, y), (x + 1, y), (x + 1, y + 1), (x, y + 1)].map(|(x, y)| self.at(x, y));
        let inside = corners.map(|alpha| alpha >= self.threshold);
        if inside == [true; 4] || inside == [false; 4] {
            return;
        }
        let leaves = |k: usize| inside[k % 4] && !inside[(k + 1) % 4];
        let enters = |k: usize| !inside[k % 4] && inside[(k + 1) % 4];
        // With opposite corners inside, the center tells whether they are one piece.
        let sum: u32 = corners.into_iter().map(u32::from).sum();
        let is_joined = sum >= 4 * u32::from(self.threshold);
        for from in (0..4).filter(|&k| leaves(k)) {
            let others = if is_joined { [1, 2, 3] } else { [3, 2, 1] };
            for to in others
                .into_iter()
                .map(|d| from + d)
                .filter(|&k| enters(k))
                .take(1)
            {
                step(self.edge(x, y, from), self.edge(x, y, to % 4));
            }
        }
    }

    /// Returns the number of a cell's edge, equal for both of its cells: 2·sample, plus 1 for edges that run down.
    fn edge(&self, x: usize, y: usize, k: usize) -> u64 {
        let (x, y, down) = match k {
            0 => (x, y, 0),
            1 => (x + 1, y, 1),
            2 => (x, y + 1, 0),
            _ => (x, y, 1),
        };
        let sample = y as u64 * (self.image.width as u64 + 2) + x as u64;
        2 * sample + down
    }

    /// Returns the point where the contour crosses an edge, strictly between its ends.
    fn crossing(&self, edge: u64) -> [f64; 2] {
        let columns = self.image.width as u64 + 2;
        let (x, y) = ((edge / 2 % columns) as usize, (edge / 2 / columns) as usize);
        let (dx, dy) = if edge.is_multiple_of(2) {
            (1, 0)
        } else {
            (0, 1)
        };
        let [a, b] = [self.at(x, y), self.at(x + dx, y + dy)].map(f64::from);
        let t = (f64::from(self.threshold) - 0.5 - a) / (b - a);
        // Sample 1 is pixel 0, whose center is at 0.5.
        [
            x as f64 - 0.5 + t * dx as f64,
            y as f64 - 0.5 + t * dy as f64,
        ]
    }
}

// Simplification of polygons within a tolerance.

/// Returns a closed polygon through some of the vertices; every other vertex is within `tolerance` of the edge that
/// replaces it (Douglas, Peucker 1973).
///
/// The result may cross itself where the polygon passes itself within the tolerance. Begins at the smallest vertex and
/// its most distant one, which are likely to be corners of the shape.
fn simplified(vertices: &[[f64; 2]], tolerance: f64) -> Vec<[f64; 2]> {
    let n = vertices.len();
    // Start with the smallest vertex and the one farthest from it.
    let Some(first) = (0..n).min_by(|&a, &b| {
        let order = vertices[a][0].total_cmp(&vertices[b][0]);
        order.then(vertices[a][1].total_cmp(&vertices[b][1]))
    }) else {
        return Vec::new();
    };
    let at = |k: usize| vertices[(first + k) % n];
    let far = (0..n)
        .max_by(|&a, &b| distance_squared(at(a), at(0)).total_cmp(&distance_squared(at(b), at(0))));
    let mut kept = vec![false; n + 1];
    kept[0] = true;
    let mut open = Vec::new();
    if let Some(far) = far.filter(|&far| far > 0) {
        kept[far] = true;
        open.extend([(0, far), (far, n)]);
    }
    // Divide each segment at the vertex farthest from it, unless that is within the tolerance.
    while let Some((from, to)) = open.pop() {
        let segment = [at(from), at(to)];
        let worst = (from + 1..to)
            .map(|k| (squared_distance(at(k), segment), k))
            .max_by(|a, b| a.0.total_cmp(&b.0));
        if let Some((distance, k)) = worst
            && distance > tolerance * tolerance
        {
            kept[k] = true;
            open.extend([(from, k), (k, to)]);
        }
    }
    (0..n).filter(|&k| kept[k]).map(at).collect()
}

fn distance_squared(p: [f64; 2], q: [f64; 2]) -> f64 {
    let d = sub(p, q);
    dot(d, d)
}
