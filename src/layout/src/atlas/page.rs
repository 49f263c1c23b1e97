//! Pages of a texture: their number and shape, in texels, cells and grid units.
use unwrapd_maps::mesh::Resolution;

/// Bits of the side of a page. Atlas coordinates are integers up to 2^GRID_BITS, the steps of `f32` in the unit square.
pub const GRID_BITS: u32 = 23;
/// Side of a page in grid units.
pub(super) const GRID_SIDE: f64 = (1 << GRID_BITS) as f64;

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

    /// Returns the shape of the part of a page that charts may use, with half of `padding` kept to its borders.
    pub(super) fn shape(self, padding: f64) -> PageShape {
        PageShape {
            halvings: self.resolution.halvings(),
            padding,
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

/// PageShape of the used part of each page, in cells.
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

    pub(super) fn is_square(self) -> bool {
        self.halvings == [0; 2]
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

/// PageShape of the part of a page that charts may use, in fractions of cells.
#[derive(Clone, Copy, Debug)]
pub(super) struct PageShape {
    /// Number of times that the longer side is halved to give the sides along u and v.
    halvings: [u32; 2],
    /// Distance kept between charts, and to two opposite borders together, in cells.
    padding: f64,
}

impl PageShape {
    /// Returns the distances to which charts may extend to the right and up on a page whose longer side, without borders, is
    /// `side`.
    pub(super) fn reach(self, side: f64) -> [f64; 2] {
        self.halvings
            .map(|times| (side + self.padding) / f64::from(1_u32 << times) - self.padding)
    }

    /// Returns the longer side, without borders, of the smallest page on which charts may extend to `reach`, to the right and up.
    pub(super) fn side(self, reach: [f64; 2]) -> f64 {
        let of = |axis: usize| {
            (reach[axis] + self.padding) * f64::from(1_u32 << self.halvings[axis]) - self.padding
        };
        of(0).max(of(1))
    }

    /// Returns the shape on a raster that is `by` times as fine.
    pub(super) fn scaled(self, by: f64) -> Self {
        Self {
            padding: by * self.padding,
            ..self
        }
    }
}

/// Returns the longer side of the smallest page around a rectangle. Its sides along u and v are the longer side halved this many times.
pub(super) fn page_side(extent: [f64; 2], halvings: [u32; 2]) -> f64 {
    let [u, v] = [0, 1].map(|axis| extent[axis] * f64::from(1_u32 << halvings[axis]));
    u.max(v)
}
