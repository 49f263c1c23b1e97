//! Pages of a texture: their number and shape, in texels, cells and grid units.
use super::GRID_BITS;
use unwrapd_maps::mesh::Resolution;

/// The texture of an atlas: pages of one size, side by side along u.
///
/// Page k covers u from k to k + 1 and v from 0 to 1, the tile 1001 + k in the numbers of UDIM. There is one row of them: those are
/// the tiles up to 1010, and v is as fine as with one page.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Texture {
    /// Texels of each page.
    pub resolution: Resolution,
    /// Pages that charts may lie on, 1 to [`Texture::MOST_PAGES`].
    pub pages: u32,
}

impl Texture {
    /// The tiles of one row.
    pub const MOST_PAGES: u32 = 10;

    /// One square page.
    pub const fn square(side: u32) -> Self {
        Self {
            resolution: Resolution::square(side),
            pages: 1,
        }
    }

    /// The page's area over that of the square of its longer side.
    pub(super) fn share(self) -> f64 {
        let shrunk: u32 = self.resolution.halvings().iter().sum();
        1.0 / f64::from(1_u32 << shrunk)
    }

    /// Cells along the longer side for about as many in a page as a square has with so many along each.
    pub(super) fn raster(self, cells: u32) -> u32 {
        let shrunk: u32 = self.resolution.halvings().iter().sum();
        cells << shrunk.div_ceil(2)
    }

    /// For u and v the step of the grid on which charts are rounded, as a power of two of 2^-[`GRID_BITS`].
    ///
    /// Both are equally long on the surface, and no finer than `f32` is at the right end of the last page: numbers from 2ᵏ to
    /// 2ᵏ⁺¹ are multiples of 2ᵏ⁻²³.
    pub(super) fn steps(self) -> [u32; 2] {
        let [u, v] = self.resolution.halvings();
        let coarse = self.pages.next_power_of_two().ilog2().saturating_sub(1);
        let finer = coarse.saturating_sub(u);
        [u + finer, v + finer]
    }

    /// The shape of what charts may use of a page, to whose borders half of the padding is kept.
    pub(super) fn shape(self, padding: f64) -> Shape {
        Shape {
            halvings: self.resolution.halvings(),
            padding,
        }
    }

    /// Steps along the longer side of a page.
    pub(super) fn grid_side(self) -> f64 {
        let [u, v] = self.steps();
        f64::from(1_u32 << (GRID_BITS - u.min(v)))
    }

    /// A point in steps on a page, in units of 2^-[`GRID_BITS`].
    pub(super) fn on_page(self, page: u32, [x, y]: [i32; 2]) -> [i32; 2] {
        let [u, v] = self.steps();
        [((page as i32) << GRID_BITS) + (x << u), y << v]
    }
}

/// The shape of the used part of each page, in cells.
///
/// All pages grow together and keep their shape: how far they are used is told by one number, the longer side without its borders.
#[derive(Clone, Copy, Debug)]
pub(super) struct Form {
    pub pages: u32,
    /// For the sides along u and v how often the longer is halved.
    halvings: [u32; 2],
    /// What a side's borders are too long for its shape, in cells of the longer side.
    inset: [u32; 2],
}

impl Form {
    /// With so many cells kept free at each border.
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

    /// The longer side of the least page that reaches so far to the right and up.
    pub(super) fn side(self, reach: [u32; 2]) -> u32 {
        let of = |axis: usize| (reach[axis] << self.halvings[axis]) + self.inset[axis];
        of(0).max(of(1))
    }

    /// How far a page with this longer side reaches to the right and up.
    pub(super) fn reach(self, side: u32) -> [u32; 2] {
        [0, 1].map(|axis| side.saturating_sub(self.inset[axis]) >> self.halvings[axis])
    }

    /// The longer side of the least page without borders around a rectangle, upright or on its side.
    pub(super) fn around(self, [width, height]: [f64; 2]) -> f64 {
        let [u, v] = self.halvings.map(|times| f64::from(1_u32 << times));
        let (upright, on_side) = ((u * width).max(v * height), (u * height).max(v * width));
        upright.min(on_side)
    }

    /// What borders are too long for the shape of a page at most, in cells of the longer side.
    pub(super) fn most_inset(self) -> f64 {
        f64::from(self.inset[0].max(self.inset[1]))
    }
}

/// The shape of what charts may use of a page, in parts of cells.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shape {
    /// For the sides along u and v how often the longer is halved.
    halvings: [u32; 2],
    /// What is kept between charts, and to both borders together.
    padding: f64,
}

impl Shape {
    /// How far a page whose longer side without its borders is this reaches to the right and up.
    pub(super) fn reach(self, side: f64) -> [f64; 2] {
        self.halvings
            .map(|times| (side + self.padding) / f64::from(1_u32 << times) - self.padding)
    }

    /// The longer side of the least page that reaches so far to the right and up.
    pub(super) fn side(self, reach: [f64; 2]) -> f64 {
        let of = |axis: usize| {
            (reach[axis] + self.padding) * f64::from(1_u32 << self.halvings[axis]) - self.padding
        };
        of(0).max(of(1))
    }

    /// The same on a raster so many times as fine.
    pub(super) fn scaled(self, by: f64) -> Self {
        Self {
            padding: by * self.padding,
            ..self
        }
    }
}
