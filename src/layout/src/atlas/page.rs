//! Pages of a texture: their number and shape, in texels, cells and grid units.
use unwrapd_maps::mesh::Resolution;
use unwrapd_method::numerics::bounds::Bounds;

/// Bits of the side of a page. Atlas coordinates are integers up to 2^GRID_BITS, the steps of `f32` in the unit square.
pub const GRID_BITS: u32 = 23;
/// Side of a page in grid units.
pub(super) const GRID_SIDE: f64 = (1 << GRID_BITS) as f64;

/// Cells along the side of the square page that the charts are expected to need. With 64, worse cuts are chosen. With 256, a trial
/// costs four times as much, and less is found in the same time.
pub(super) const RASTER: u32 = 96;
/// Value that replaces [`RASTER`] with more than [`SEARCHED`] charts per page, as each of them then has fewer cells.
const FINE_RASTER: u32 = 256;
/// Maximum number of charts per page on the raster of [`RASTER`] cells, and of those whose order is searched, where several small
/// charts count as one. With more charts, a trial takes too long, and a layout on the raster that keeps the padding
/// is squeezed.
const SEARCHED: usize = 64;
/// Factor by which the raster of the final layout is finer along each side.
pub(super) const FINE: f64 = 2.0;

/// Texture of an atlas: pages of one size, side by side along u.
///
/// Page k covers u from k to k + 1 and v from 0 to 1. It is tile 1001 + k in UDIM numbering. There is only one row of pages, the
/// tiles up to 1010, so v is as fine as with one page.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Texture {
    /// Resolution of each page.
    pub resolution: Resolution,
    /// Number of pages that charts may lie on, 1 to [`Texture::MOST_PAGES`].
    pub pages: u32,
}

impl Texture {
    /// Maximum number of pages: the tiles of one row.
    pub const MOST_PAGES: u32 = 10;

    /// Creates a texture with one square page.
    pub const fn square(side: u32) -> Self {
        Self {
            resolution: Resolution::square(side),
            pages: 1,
        }
    }

    /// Returns the area of a page relative to that of the square on its longer side.
    pub(super) fn share(self) -> f64 {
        let shrunk: u32 = self.resolution.halvings().iter().sum();
        1.0 / f64::from(1_u32 << shrunk)
    }

    /// Returns the number of cells along the longer side of a page that has about as many cells as a square with `cells` along each
    /// side.
    pub(super) fn raster(self, cells: u32) -> u32 {
        let shrunk: u32 = self.resolution.halvings().iter().sum();
        cells << shrunk.div_ceil(2)
    }

    /// Returns whether there are too many charts to search their order.
    pub(super) fn is_crowded(self, n_charts: usize) -> bool {
        n_charts > SEARCHED * self.pages as usize
    }

    /// Returns the cells along the side of a square page with this many charts.
    pub(super) fn coarse_cells(self, n_charts: usize) -> u32 {
        if self.is_crowded(n_charts) {
            FINE_RASTER
        } else {
            RASTER
        }
    }

    /// Returns for u and v the exponent of the step of the grid on which charts are rounded: the step is 2^exponent units of
    /// 2^-[`GRID_BITS`].
    ///
    /// Both steps are equally long on the surface, and no finer than `f32` at the right end of the last page: numbers from 2ᵏ to
    /// 2ᵏ⁺¹ are multiples of 2ᵏ⁻²³.
    pub(super) fn steps(self) -> [u32; 2] {
        let [u, v] = self.resolution.halvings();
        let coarse = self.pages.next_power_of_two().ilog2().saturating_sub(1);
        let finer = coarse.saturating_sub(u);
        [u + finer, v + finer]
    }

    /// Returns the frame of a region.
    pub(super) fn frame(self, region: Region) -> Frame {
        let sides = self.resolution.sides();
        let scaled = |end: [f64; 2]| [end[0] * sides[0], end[1] * sides[1]];
        let page = region.low[0].floor();
        Frame {
            page: page as u32,
            left: page * sides[0],
            low: scaled(region.low),
            high: scaled(region.high),
        }
    }

    /// Returns the number of grid steps along the longer side of a page.
    pub(super) fn grid_side(self) -> f64 {
        let [u, v] = self.steps();
        f64::from(1_u32 << (GRID_BITS - u.min(v)))
    }

    /// Converts a point on a page from grid steps to units of 2^-[`GRID_BITS`] in the atlas.
    pub(super) fn on_page(self, page: u32, [x, y]: [i32; 2]) -> [i32; 2] {
        let [u, v] = self.steps();
        [((page as i32) << GRID_BITS) + (x << u), y << v]
    }
}

/// Shape of the used part of each page, in cells.
///
/// All pages grow together and keep their shape. One number tells how far they are used: the longer side without its borders.
#[derive(Clone, Copy, Debug)]
pub(super) struct Form {
    pub pages: u32,
    /// Number of times that the longer side is halved to give the sides along u and v.
    halvings: [u32; 2],
    /// Cells of the longer side that are lost along u and v because borders are not halved along with a side.
    inset: [u32; 2],
}

impl Form {
    /// Creates the form of pages with `border` cells kept free at each border.
    pub(super) fn new(texture: Texture, border: f64) -> Self {
        let halvings = texture.resolution.halvings();
        Self {
            pages: texture.pages,
            halvings,
            inset: halvings
                .map(|times| (2.0 * border * f64::from((1_u32 << times) - 1)).ceil() as u32),
        }
    }

    /// Returns the longer side of the smallest page on which charts may extend to `reach`, to the right and up.
    pub(super) fn side(self, reach: [u32; 2]) -> u32 {
        let of = |axis: usize| (reach[axis] << self.halvings[axis]) + self.inset[axis];
        of(0).max(of(1))
    }

    /// Returns the distances to which charts may extend to the right and up on a page with this longer side.
    pub(super) fn reach(self, side: u32) -> [u32; 2] {
        [0, 1].map(|axis| side.saturating_sub(self.inset[axis]) >> self.halvings[axis])
    }

    /// Returns the longer side of the smallest page, without borders, around a rectangle that is upright or on its side.
    pub(super) fn around(self, [width, height]: [f64; 2]) -> f64 {
        let side = |extent| page_side(extent, self.halvings);
        side([width, height]).min(side([height, width]))
    }

    /// Returns the maximum number of cells of the longer side that are lost to borders along u or v.
    pub(super) fn most_inset(self) -> f64 {
        f64::from(self.inset[0].max(self.inset[1]))
    }
}

/// Rectangle of the atlas that a chart must not leave, in units of u and v: page k covers u from k to k + 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Region {
    /// Lower left corner.
    pub low: [f64; 2],
    /// Upper right corner.
    pub high: [f64; 2],
}

impl Region {
    /// Returns the region that covers a page.
    pub fn page(page: u32) -> Self {
        let left = f64::from(page);
        Self {
            low: [left, 0.0],
            high: [left + 1.0, 1.0],
        }
    }

    /// Returns the page that contains the region; `None` if it leaves its page or is empty.
    pub(super) fn on_page(self, pages: u32) -> Option<u32> {
        let page = self.low[0].floor();
        let is_inside = page >= 0.0
            && page < f64::from(pages)
            && self.high[0] <= page + 1.0
            && self.low[1] >= 0.0
            && self.high[1] <= 1.0
            && (0..2).all(|k| self.low[k] < self.high[k]);
        is_inside.then_some(page as u32)
    }
}

/// Region that a chart must not leave, in longer sides of a page.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    /// Page that contains the region.
    pub page: u32,
    /// Longer sides of a page from the first page to this one.
    pub left: f64,
    low: [f64; 2],
    high: [f64; 2],
}

impl Frame {
    /// Returns the bounds of a chart in cells, on pages whose longer side is `side` without borders. Half of `padding` is kept to each
    /// side of the region. The origin is the lower left corner of the first page without borders.
    pub(super) fn bounds(self, side: f64, padding: f64) -> Bounds {
        let cells = side + padding;
        let end = |end: [f64; 2], inset: f64| end.map(|x| x * cells - inset);
        [end(self.low, 0.0), end(self.high, padding)]
    }

    /// Returns the area, in squares on the longer side of a page.
    pub(super) fn area(self) -> f64 {
        (self.high[0] - self.low[0]) * (self.high[1] - self.low[1])
    }

    /// Returns the smallest longer side without borders of pages on which charts may extend to `reach`, to the right and up. The padding
    /// is `least`, plus `per_side` times that side.
    pub(super) fn side(self, reach: [f64; 2], [least, per_side]: [f64; 2]) -> f64 {
        // (reach + padding) / high - padding = side
        let of = |axis: usize| {
            let lost = 1.0 - self.high[axis];
            (reach[axis] + lost * least) / (self.high[axis] - lost * per_side)
        };
        of(0).max(of(1))
    }
}

/// Returns the longer side of the smallest page around a rectangle. Its sides along u and v are the longer side halved this many times.
pub(super) fn page_side(extent: [f64; 2], halvings: [u32; 2]) -> f64 {
    let [u, v] = [0, 1].map(|axis| extent[axis] * f64::from(1_u32 << halvings[axis]));
    u.max(v)
}
