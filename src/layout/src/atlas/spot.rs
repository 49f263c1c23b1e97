//! Places on the pages of a sheet.

use super::turned::Turned;

/// Where a body's lower left cell lies.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Corner {
    pub page: u32,
    /// Column and row.
    pub x: u32,
    pub y: u32,
}

/// A place for one mask.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Spot {
    pub corner: Corner,
    /// Quarter turns, counter-clockwise.
    pub turns: u32,
    /// Size of the body *before* it is turned, in cells.
    pub width: u32,
    pub height: u32,
}

impl Spot {
    pub(super) fn new(mask: &Turned, corner: Corner) -> Self {
        let [width, height] = mask.size;
        let is_upright = mask.turns.is_multiple_of(2);
        let (width, height) = if is_upright {
            (width, height)
        } else {
            (height, width)
        };
        Self {
            corner,
            turns: mask.turns,
            width,
            height,
        }
    }
}

/// Where a place is looked for: pages, columns and rows from `lowest` to `highest`, both included.
#[derive(Clone, Copy, Debug)]
pub(super) struct Window {
    pub lowest: Corner,
    pub highest: Corner,
}

impl Window {
    /// Everywhere.
    pub(super) const ALL: Self = Self::from(Corner {
        page: 0,
        x: 0,
        y: 0,
    });

    /// To the right and up, and anywhere on later pages.
    pub(super) const fn from(lowest: Corner) -> Self {
        Self {
            lowest,
            highest: Corner {
                page: u32::MAX,
                x: u32::MAX - 1,
                y: u32::MAX - 1,
            },
        }
    }
}
