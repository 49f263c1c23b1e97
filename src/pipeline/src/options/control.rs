//! Rules for islands, as their user writes them: `SELECTOR: ACTION`.

use serde::{Deserialize, Serialize};
use std::fmt;
use std::str::FromStr;
use unwrapd_api::options::{options, within};
use unwrapd_layout::atlas::{Region, Texture};
use unwrapd_maps::mesh::VAxis;

options! {
    /// Rules for islands.
    pub struct IslandControl under "Islands" {
        /// Rule for some islands, around which the others are packed: `SELECTOR: ACTION`, as
        /// "material=Glass: lock".
        ///
        /// Selectors are all, material=NAME (or its index), color=RRGGBB (vertex color, sRGB) and
        /// faces=P/F,P/F (the islands of these faces F of primitives P, counted over the result from
        /// 0). An island is selected if one of its faces is; new charts are cut along the borders of
        /// selections. Actions are lock (stay where they are, bit for bit), group (keep their
        /// relative positions), in NAME (stay in that `rectangle`), in 1001 (stay in that UDIM
        /// tile), density T (texels per unit of length), density keep (that of the file), density
        /// equal (the mean of all selected) and scale S (S times the size that they would have beside
        /// the others). lock, group and faces require `repack`, or `cut` keep with `kept_maps`
        /// as-given. A later rule for the density, the scale or the place of an island replaces an
        /// earlier one. Repeat the option for several rules; JSON takes a list.
        pub control: Vec<IslandRule>, value "RULE", schema(value_type = Vec<String>);
        /// Rectangle that `control` can name, as those of a trim sheet: NAME=U,V,U,V, two opposite
        /// corners in the UVs of the result; in glTF, v points down.
        ///
        /// Islands keep half of the padding to its sides. Repeat the option for several rectangles;
        /// JSON takes a list.
        pub rectangle: Vec<NamedRectangle>, value "NAME=U,V,U,V", also "rectangles", schema(value_type = Vec<String>);
        /// Turn nearly straight borders of islands to the axes and straighten them, as far as the bound on
        /// the distortion allows: auto, off, or a list of selectors as in `control`, separated by
        /// semicolons.
        ///
        /// Strips, belts and open tubes become rectangles. No face flips, and `max_distortion` and
        /// `max_stretch` hold as without. With auto, an island that would make the page larger stays
        /// as it is. By default auto for new islands, off for those that are kept.
        pub straighten: Option<Straightening>, value "auto|off|SELECTOR;…", schema(value_type = Option<String>);
    }
}

/// A rule for the islands that a selector names.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct IslandRule {
    /// The islands.
    pub selector: Selector,
    /// The action on them.
    pub action: Action,
}

/// Islands that have something in common.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Selector {
    /// All.
    All,
    /// Those with a face of the material with this name, or else with this index.
    Material(String),
    /// Those with a face whose three vertices have this color, in sRGB.
    Color([u8; 3]),
    /// Those of these faces: for each its primitive and its index in that.
    Faces(Vec<[u32; 2]>),
}

/// Islands whose nearly straight borders become straight.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub enum Straightening {
    /// All.
    Auto,
    /// None.
    Off,
    /// Those that one of these selects.
    Selected(Vec<Selector>),
}

/// An action on islands.
#[derive(Clone, Debug, PartialEq)]
pub enum Action {
    /// They stay where they are.
    Lock,
    /// They keep their relative positions.
    Group,
    /// They stay in the rectangle with this name, or in the UDIM tile with this number.
    In(String),
    /// They get this number of texels per unit of length of the mesh.
    Density(f64),
    /// They keep the texel density of the file.
    KeepDensity,
    /// They get one texel density, their mean.
    EqualizeDensity,
    /// They become this many times as large.
    Scale(f64),
    /// Their nearly straight borders become straight; the option `straighten` says so, and no rule.
    Straighten,
}

/// A rectangle with a name, in the UVs of the result.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct NamedRectangle {
    /// Its name.
    pub name: String,
    /// Its least coordinates.
    pub low: [f64; 2],
    /// Its greatest coordinates.
    pub high: [f64; 2],
}

/// Number of the first UDIM tile.
const FIRST_TILE: u32 = 1001;

impl IslandControl {
    /// Returns the region that a rule names, with v up: a rectangle, or a page by its UDIM number. The error says why
    /// there is none.
    pub(crate) fn region(&self, name: &str, v_axis: VAxis) -> Result<Region, String> {
        if let Ok(tile) = name.parse::<u32>() {
            let tiles = FIRST_TILE..FIRST_TILE + Texture::MOST_PAGES;
            return if tiles.contains(&tile) {
                Ok(Region::page(tile - FIRST_TILE))
            } else {
                Err(format!("{tile} is no UDIM tile from 1001 to 1010"))
            };
        }
        let named = self.rectangle.iter().find(|known| known.name == name);
        let rectangle = named.ok_or_else(|| format!("there is no `rectangle` {name:?}"))?;
        let (low, high) = (rectangle.low, rectangle.high);
        Ok(match v_axis {
            VAxis::Up => Region { low, high },
            VAxis::Down => Region {
                low: [low[0], 1.0 - high[1]],
                high: [high[0], 1.0 - low[1]],
            },
        })
    }

    /// Returns the rules, those of `straighten` last.
    pub(crate) fn rules(&self) -> Vec<IslandRule> {
        let mut rules = self.control.clone();
        if let Some(Straightening::Selected(selectors)) = &self.straighten {
            rules.extend(selectors.iter().map(|selector| IslandRule {
                selector: selector.clone(),
                action: Action::Straighten,
            }));
        }
        rules
    }

    /// Checks the rules for `pages` pages. The error names the option.
    pub(crate) fn check(&self, pages: u32) -> Result<(), String> {
        for (index, rectangle) in self.rectangle.iter().enumerate() {
            let mut others = self.rectangle[..index].iter();
            if others.any(|other| other.name == rectangle.name) {
                return Err(format!("`rectangle` {:?} is given twice", rectangle.name));
            }
        }
        for rule in &self.control {
            let named = |text: String| format!("`control` {:?}: {text}", rule.to_string());
            match &rule.action {
                Action::In(name) => {
                    let region = self.region(name, VAxis::Up).map_err(named)?;
                    let (page, end) = (region.low[0].floor(), f64::from(pages));
                    let is_inside = page >= 0.0
                        && page < end
                        && region.high[0] <= page + 1.0
                        && region.low[1] >= 0.0
                        && region.high[1] <= 1.0;
                    if !is_inside {
                        let text = format!("{name} does not lie on one of `pages` {pages}");
                        return Err(named(text));
                    }
                }
                Action::Density(texels) => within("density", *texels, 1e-9, 1e9).map_err(named)?,
                Action::Scale(scale) => within("scale", *scale, 1e-3, 1e3).map_err(named)?,
                Action::Lock
                | Action::Group
                | Action::KeepDensity
                | Action::EqualizeDensity
                | Action::Straighten => {}
            }
        }
        Ok(())
    }
}

impl IslandRule {
    /// Returns whether the rule only makes sense for islands whose maps stay as they are given.
    pub(crate) fn needs_given_maps(&self) -> bool {
        matches!(self.action, Action::Lock | Action::Group)
            || matches!(self.selector, Selector::Faces(_))
    }

    /// Returns whether the rule only makes sense for islands of the file.
    pub(crate) fn needs_islands(&self) -> bool {
        matches!(self.action, Action::KeepDensity | Action::EqualizeDensity)
    }
}

impl FromStr for IslandRule {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let wrong = || format!("{text:?} is not a rule of the form SELECTOR: ACTION");
        // A material's name may have a colon; no action has one.
        let (selector, action) = text.rsplit_once(':').ok_or_else(wrong)?;
        Ok(Self {
            selector: selector.trim().parse()?,
            action: action.trim().parse()?,
        })
    }
}

impl FromStr for Selector {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let wrong = || {
            format!(
                "{text:?} selects nothing: use all, material=NAME, color=RRGGBB or faces=P/F,P/F"
            )
        };
        if text == "all" {
            return Ok(Self::All);
        }
        let (kind, value) = text.split_once('=').ok_or_else(wrong)?;
        match kind {
            "material" => Ok(Self::Material(value.to_owned())),
            "color" => color(value).map(Self::Color).ok_or_else(wrong),
            "faces" => {
                let faces = value.split(',').map(|face| {
                    let (primitive, face) = face.split_once('/')?;
                    Some([primitive.trim().parse().ok()?, face.trim().parse().ok()?])
                });
                let faces: Option<Vec<[u32; 2]>> = faces.collect();
                faces.map(Self::Faces).ok_or_else(wrong)
            }
            _ => Err(wrong()),
        }
    }
}

/// Parses a color of six hexadecimal digits, with or without a number sign.
fn color(text: &str) -> Option<[u8; 3]> {
    let digits = text.strip_prefix('#').unwrap_or(text);
    let is_hex = digits.len() == 6 && digits.bytes().all(|b| b.is_ascii_hexdigit());
    let [_, r, g, b] = u32::from_str_radix(digits, 16).ok()?.to_be_bytes();
    is_hex.then_some([r, g, b])
}

impl FromStr for Action {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let wrong = || {
            format!(
                "{text:?} is no action: use lock, group, in NAME, in 1001, density T, density keep, density equal or \
                 scale S"
            )
        };
        let words: Vec<&str> = text.split_whitespace().collect();
        match words[..] {
            ["lock"] => Ok(Self::Lock),
            ["group"] => Ok(Self::Group),
            ["in", name] => Ok(Self::In(name.to_owned())),
            ["density", "keep"] => Ok(Self::KeepDensity),
            ["density", "equal"] => Ok(Self::EqualizeDensity),
            ["density", texels] => texels.parse().map(Self::Density).map_err(|_| wrong()),
            ["scale", scale] => scale.parse().map(Self::Scale).map_err(|_| wrong()),
            _ => Err(wrong()),
        }
    }
}

impl FromStr for NamedRectangle {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let wrong = || format!("{text:?} is not a rectangle of the form NAME=U,V,U,V");
        let (name, numbers) = text.split_once('=').ok_or_else(wrong)?;
        let numbers = numbers.split(',').map(|x| x.trim().parse::<f64>());
        let numbers: Vec<f64> = numbers.collect::<Result<_, _>>().map_err(|_| wrong())?;
        let [u, v, s, t] = numbers[..] else {
            return Err(wrong());
        };
        let is_word = |c: char| c.is_alphanumeric() || matches!(c, '_' | '-' | '.');
        let is_name = !name.is_empty() && name.chars().all(is_word) && name.parse::<f64>().is_err();
        if !is_name {
            return Err(format!(
                "{name:?} is no name of a rectangle: use letters, digits, `_`, `-` and `.`, not a number"
            ));
        }
        let (low, high) = ([u.min(s), v.min(t)], [u.max(s), v.max(t)]);
        let is_finite = numbers.iter().all(|x| x.is_finite());
        if !is_finite || low[0] == high[0] || low[1] == high[1] {
            return Err(format!("the rectangle {text:?} has no area"));
        }
        Ok(Self {
            name: name.to_owned(),
            low,
            high,
        })
    }
}

impl fmt::Display for Selector {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::All => write!(f, "all"),
            Self::Material(name) => write!(f, "material={name}"),
            Self::Color([r, g, b]) => write!(f, "color={r:02x}{g:02x}{b:02x}"),
            Self::Faces(faces) => {
                let faces = faces.iter().map(|[p, face]| format!("{p}/{face}"));
                write!(f, "faces={}", faces.collect::<Vec<_>>().join(","))
            }
        }
    }
}

impl fmt::Display for IslandRule {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.selector)?;
        match &self.action {
            Action::Lock => write!(f, ": lock"),
            Action::Group => write!(f, ": group"),
            Action::In(name) => write!(f, ": in {name}"),
            Action::Density(texels) => write!(f, ": density {texels}"),
            Action::KeepDensity => write!(f, ": density keep"),
            Action::EqualizeDensity => write!(f, ": density equal"),
            Action::Scale(scale) => write!(f, ": scale {scale}"),
            Action::Straighten => write!(f, ": straighten"),
        }
    }
}

impl fmt::Display for NamedRectangle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ([u, v], [s, t]) = (self.low, self.high);
        write!(f, "{}={u},{v},{s},{t}", self.name)
    }
}

impl FromStr for Straightening {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "auto" => Ok(Self::Auto),
            "off" => Ok(Self::Off),
            list => {
                let selectors = list.split(';').map(|text| text.trim().parse());
                selectors
                    .collect::<Result<_, String>>()
                    .map(Self::Selected)
                    .map_err(|error| format!("{error}; or auto, or off"))
            }
        }
    }
}

impl fmt::Display for Straightening {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Auto => write!(f, "auto"),
            Self::Off => write!(f, "off"),
            Self::Selected(selectors) => {
                let texts: Vec<String> = selectors.iter().map(ToString::to_string).collect();
                write!(f, "{}", texts.join(";"))
            }
        }
    }
}

impl TryFrom<String> for Straightening {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        text.parse()
    }
}

impl From<Straightening> for String {
    fn from(straightening: Straightening) -> Self {
        straightening.to_string()
    }
}

impl TryFrom<String> for IslandRule {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        text.parse()
    }
}

impl From<IslandRule> for String {
    fn from(rule: IslandRule) -> Self {
        rule.to_string()
    }
}

impl TryFrom<String> for NamedRectangle {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        text.parse()
    }
}

impl From<NamedRectangle> for String {
    fn from(rectangle: NamedRectangle) -> Self {
        rectangle.to_string()
    }
}
