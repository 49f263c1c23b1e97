//! The record in a file of the UVs written to it: the set, and the promises about it.
//!
//! Anybody can write such a record, so it may only add to a judgment. Nothing here removes a face, a pair of faces or a
//! group from a judgment.
use super::{DocumentError, GroupBy};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use sha2::{Digest as _, Sha256};
use std::fmt;
use unwrapd_maps::mesh::{CornerUvs, Resolution};

/// Version that is written and read.
const VERSION: u32 = 1;

/// Purpose of UVs: the grouping, and the promises about the charts.
///
/// Records of version 0.1.0 may have a member `charts`, which is ignored: it named the only charts to be judged.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Terms {
    /// Grouping of UV spaces. For information only; a judgment groups by the file or by its caller.
    pub group_by: GroupBy,
    /// `true` if each node got a part of its own, in proportion to its size in the scene.
    #[serde(default, skip_serializing_if = "is_false")]
    pub separate_nodes: bool,
    /// Least distance of two charts, in texels of the coarsest relevant mip level.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub padding: Option<u32>,
    /// Texture whose texels `padding` counts.
    pub resolution: Resolution,
    /// Pages on which charts lie.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pages: Option<u32>,
    /// Mip levels beyond the first in which charts keep the padding.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub mips: u32,
    /// `true` if charts end at texel borders.
    #[serde(default, skip_serializing_if = "is_false")]
    pub aligned: bool,
    /// Bits at which the map stays bijective.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bits: Option<u32>,
    /// Allows overlaps: without it, overlaps are tested even if the caller does not ask for that.
    #[serde(default, skip_serializing_if = "is_false")]
    pub overlaps: bool,
}

/// UV set of each primitive.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Sets {
    /// One set for all primitives.
    One(u32),
    /// One entry per triangle primitive in file order; `None` for primitives that take no part.
    Each(Vec<Option<u32>>),
}

impl Sets {
    /// Returns the set of a primitive.
    pub fn of(&self, primitive: usize) -> Option<u32> {
        match self {
            Self::One(set) => Some(*set),
            Self::Each(sets) => sets.get(primitive).copied().flatten(),
        }
    }

    /// Returns the lowest set.
    pub fn lowest(&self) -> Option<u32> {
        match self {
            Self::One(set) => Some(*set),
            Self::Each(sets) => sets.iter().copied().flatten().min(),
        }
    }

    /// Creates the sets, as one number if all are equal.
    fn new(sets: Vec<Option<u32>>) -> Self {
        match sets.first() {
            Some(Some(first)) if sets.iter().all(|set| *set == Some(*first)) => Self::One(*first),
            _ => Self::Each(sets),
        }
    }
}

/// Writes `UV set 0` or `UV sets 0 and 1`.
impl fmt::Display for Sets {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::One(set) => write!(f, "UV set {set}"),
            Self::Each(sets) => {
                let mut named: Vec<u32> = sets.iter().copied().flatten().collect();
                named.sort_unstable();
                named.dedup();
                let numbers: Vec<String> = named.iter().map(u32::to_string).collect();
                match numbers.as_slice() {
                    [] => write!(f, "no UV set"),
                    [one] => write!(f, "UV set {one}"),
                    [first @ .., last] => write!(f, "UV sets {} and {last}", first.join(", ")),
                }
            }
        }
    }
}

/// A mark: UV sets, their terms, and a digest of the UVs that reveals later changes.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Mark {
    version: u32,
    /// UV sets that were written.
    #[serde(rename = "texcoord")]
    pub sets: Sets,
    /// Purpose of the UVs.
    #[serde(flatten)]
    pub terms: Terms,
    digest: String,
}

/// Writes the requirements of the record in words; nothing if there are none.
impl fmt::Display for Terms {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut required = Vec::new();
        if !self.overlaps {
            required.push("no overlaps".to_owned());
        }
        if let Some(padding) = self.padding {
            let mips = match self.mips {
                0 => String::new(),
                mips => format!(" down to mip level {mips}"),
            };
            required.push(format!(
                "padding of {padding} texels at {}{mips}",
                self.resolution
            ));
        }
        if self.aligned {
            required.push("charts aligned to texels".to_owned());
        }
        if let Some(pages) = self.pages.filter(|pages| *pages > 1) {
            required.push(format!("{pages} pages"));
        }
        if let Some(bits) = self.bits {
            required.push(format!("safe at {bits} bits"));
        }
        write!(f, "{}", required.join(", "))
    }
}

/// Presence and validity of a file's mark.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Marked {
    /// There is no mark.
    Not,
    /// There is a mark that does not fit its UVs: they were changed since.
    Stale,
    /// There is a mark that fits.
    Fits(Box<Mark>),
}

impl Mark {
    /// Creates the mark of UVs to be written: for each primitive the set and the UVs, in the numbers of the file.
    pub(super) fn new(
        terms: &Terms,
        written: impl Iterator<Item = Option<(u32, Vec<CornerUvs>)>>,
    ) -> Self {
        let mut digest = UvDigest::default();
        let sets = written.map(|primitive| {
            let (set, uvs) = primitive?;
            digest.add(set, &uvs);
            Some(set)
        });
        Self {
            version: VERSION,
            sets: Sets::new(sets.collect()),
            terms: terms.clone(),
            digest: digest.text(),
        }
    }

    /// Returns the mark in the form of the file.
    pub(super) fn value(&self) -> Value {
        serde_json::to_value(self).unwrap_or_default()
    }

    /// Parses the mark of a file; `None` if its version is unknown.
    pub(super) fn parse(value: &Value) -> Option<Self> {
        let mark = Self::deserialize(value).ok()?;
        (mark.version == VERSION).then_some(mark)
    }

    /// Returns whether the UVs of a document are those that were marked; `corner_uvs` reads a set of a primitive.
    pub(super) fn fits(
        &self,
        n_primitives: usize,
        corner_uvs: impl Fn(usize, u32) -> Result<Option<Vec<CornerUvs>>, DocumentError>,
    ) -> Result<bool, DocumentError> {
        if matches!(&self.sets, Sets::Each(sets) if sets.len() != n_primitives) {
            return Ok(false);
        }
        let mut digest = UvDigest::default();
        for primitive in 0..n_primitives {
            let Some(set) = self.sets.of(primitive) else {
                continue;
            };
            match corner_uvs(primitive, set)? {
                Some(uvs) => digest.add(set, &uvs),
                None => return Ok(false),
            }
        }
        Ok(digest.text() == self.digest)
    }
}

/// A digest of the UVs of every face corner in file order, independent of the numbering of vertices.
#[derive(Default)]
struct UvDigest(Sha256);

impl UvDigest {
    fn add(&mut self, set: u32, uvs: &[CornerUvs]) {
        self.0.update(set.to_le_bytes());
        self.0.update((uvs.len() as u64).to_le_bytes());
        for number in uvs.as_flattened().as_flattened() {
            self.0.update(number.to_le_bytes());
        }
    }

    /// Returns the first 16 bytes in hexadecimal: the digest is to reveal accidental changes, not forgeries.
    fn text(self) -> String {
        let digest = self.0.finalize();
        let bytes = std::array::from_fn(|k| digest[k]);
        format!("{:032x}", u128::from_be_bytes(bytes))
    }
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "as serde calls it")]
fn is_false(value: &bool) -> bool {
    !value
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "as serde calls it")]
fn is_zero(value: &u32) -> bool {
    *value == 0
}
