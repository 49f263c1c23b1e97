//! UVs in the form in which files store them.

use serde::{Deserialize, Serialize};
use std::fmt;
use std::str::FromStr;

/// UVs of a face's three corners.
pub type CornerUvs = [[f64; 2]; 3];

/// Direction in which v points in the given numbers.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum VAxis {
    /// OBJ and most tools: (0, 0) is the lower left corner of the texture.
    #[default]
    Up,
    /// glTF: (0, 0) is the upper left corner of the texture.
    Down,
}

// Resolution of a texture, in texels.

/// Texels of a texture along u and along v.
///
/// Written as a number for a square, otherwise as `2048x1024`. One side is the other times a power of two up to
/// [`Resolution::MOST_ELONGATED`], so that distances on the grid of UVs are integers in texels too.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(try_from = "Notation", into = "Notation")]
pub struct Resolution {
    /// Texels along u.
    pub width: u32,
    /// Texels along v.
    pub height: u32,
}

impl Resolution {
    /// Largest ratio of the longer to the shorter side.
    pub const MOST_ELONGATED: u32 = 16;

    /// Creates a square texture.
    pub const fn square(side: u32) -> Self {
        Self {
            width: side,
            height: side,
        }
    }

    /// Returns whether one side is the other times a power of two that is not too large.
    pub fn is_regular(self) -> bool {
        let ratio = self.longer() / self.shorter().max(1);
        ratio * self.shorter() == self.longer()
            && ratio.is_power_of_two()
            && ratio <= Self::MOST_ELONGATED
    }

    /// Returns the texels along the longer side.
    pub fn longer(self) -> u32 {
        self.width.max(self.height)
    }

    /// Returns the texels along the shorter side.
    pub fn shorter(self) -> u32 {
        self.width.min(self.height)
    }

    /// Returns for u and v how often the longer side is halved to give the side along it, for a regular resolution.
    pub fn halvings(self) -> [u32; 2] {
        [self.width, self.height].map(|side| (self.longer() / side.max(1)).max(1).ilog2())
    }

    /// Returns both sides over the longer one; powers of two for a regular resolution.
    pub fn sides(self) -> [f64; 2] {
        [self.width, self.height].map(|side| f64::from(side) / f64::from(self.longer()))
    }

    /// Returns width over height.
    pub fn aspect(self) -> f64 {
        f64::from(self.width) / f64::from(self.height)
    }
}

impl fmt::Display for Resolution {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.width == self.height {
            write!(f, "{}", self.width)
        } else {
            write!(f, "{}x{}", self.width, self.height)
        }
    }
}

/// Parses the side of a square, or both sides with an `x` between.
impl FromStr for Resolution {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let side = |text: &str| {
            text.parse::<u32>()
                .map_err(|_| format!("{text:?} is not a texture size such as 1024 or 2048x1024"))
        };
        match text.split_once('x') {
            Some((width, height)) => Ok(Self {
                width: side(width)?,
                height: side(height)?,
            }),
            None => side(text).map(Self::square),
        }
    }
}

/// The form in JSON.
#[derive(Serialize, Deserialize)]
#[serde(untagged)]
enum Notation {
    Side(u32),
    Sides(String),
}

impl TryFrom<Notation> for Resolution {
    type Error = String;

    fn try_from(notation: Notation) -> Result<Self, String> {
        match notation {
            Notation::Side(side) => Ok(Self::square(side)),
            Notation::Sides(text) => text.parse(),
        }
    }
}

impl From<Resolution> for Notation {
    fn from(resolution: Resolution) -> Self {
        if resolution.width == resolution.height {
            Self::Side(resolution.width)
        } else {
            Self::Sides(resolution.to_string())
        }
    }
}

#[cfg(feature = "schema")]
impl utoipa::PartialSchema for Resolution {
    fn schema() -> utoipa::openapi::RefOr<utoipa::openapi::Schema> {
        use utoipa::openapi::schema::{ObjectBuilder, OneOfBuilder, Type};
        let side = ObjectBuilder::new()
            .schema_type(Type::Integer)
            .minimum(Some(16))
            .maximum(Some(65_536));
        let sides = ObjectBuilder::new()
            .schema_type(Type::String)
            .pattern(Some("^[0-9]{2,5}x[0-9]{2,5}$"));
        let doc = "Texels along the sides of a texture: of a square, or `2048x1024` along u and v. One side is the other times a \
                   power of two up to 16.";
        (OneOfBuilder::new().item(side).item(sides))
            .description(Some(doc))
            .into()
    }
}

#[cfg(feature = "schema")]
impl utoipa::ToSchema for Resolution {}
