//! Combined certificates.

use std::fmt;

use crate::arrays::plan::{Plan, Start};
use serde::Serialize;

use unwrapd_maps::certificate::{Certificate, Overlap};
use unwrapd_maps::mesh::Resolution;

/// Proven properties of the UVs of all groups, next to the requested ones.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct Proven {
    /// No face is flipped or degenerate.
    pub locally_injective: bool,
    /// In addition, no two faces of a group overlap.
    pub bijective: bool,
    /// Stacks of charts that coincide, if they were accepted.
    pub stacks: Option<ProvenStacks>,
    /// No chart is mirrored.
    pub unmirrored: bool,
    /// The distance between charts; null if none was requested.
    pub padding: Option<ProvenPadding>,
    /// `true` if charts end on texel borders; null if not requested.
    pub aligned: Option<bool>,
    /// Pages, requested and used; null if not requested.
    pub pages: Option<ProvenPages>,
    /// The coarsest of 16, 14 and 12 bits b at which every group stays bijective if each coordinate moves by
    /// up to 1/(2(2ᵇ−1)) + 2⁻¹⁶. Null if there is none.
    pub safe_bits: Option<u32>,
    /// The requested bits; null if none were requested.
    pub bits: Option<ProvenBits>,
}

/// Accepted stacks: charts that coincide.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct ProvenStacks {
    /// Number of stacks.
    pub stacks: usize,
    /// Charts in them.
    pub charts: usize,
    /// `true` if no two faces of a group overlap except in charts of one stack.
    pub kept: bool,
    /// `true` if no chart outside of them is mirrored.
    pub unmirrored: bool,
}

/// Distance between charts, requested and reached.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct ProvenPadding {
    /// The requested distance, in texels.
    pub asked_texels: u32,
    /// The texture of the unit square.
    pub resolution: Resolution,
    /// `true` if no two charts of a group are closer.
    pub kept: bool,
    /// The smallest distance between two charts, rounded; null if each group has one chart.
    pub reached_texels: Option<f64>,
}

/// Pages, requested and used.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct ProvenPages {
    /// The requested number of pages.
    pub asked: u32,
    /// The most pages that the charts of a group lie on.
    pub used: usize,
    /// `true` if every chart lies on one of the requested pages.
    pub kept: bool,
}

/// Requested bits, and whether the map holds at them.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct ProvenBits {
    /// The requested bits.
    pub asked: u32,
    /// `true` if every group holds at them.
    pub hold: bool,
    /// Faces whose orientation is in doubt, plus pairs of chart edges whose separation is.
    pub in_doubt: u64,
}

impl Proven {
    /// Combines the certificates of groups that were judged by the same claims.
    pub(crate) fn of<'a>(certificates: impl Iterator<Item = &'a Certificate> + Clone) -> Self {
        let all = |holds: fn(&Certificate) -> bool| certificates.clone().all(holds);
        Self {
            locally_injective: all(Certificate::is_valid),
            bijective: all(Certificate::is_bijective),
            stacks: stacks(certificates.clone()),
            unmirrored: all(|certificate| certificate.mirrored_charts == 0),
            padding: padding(certificates.clone()),
            aligned: (certificates.clone())
                .map(|certificate| certificate.unaligned_charts.map(|n| n == 0))
                .reduce(|a, b| Some(a? && b?))
                .flatten(),
            pages: pages(certificates.clone()),
            safe_bits: all(|certificate| certificate.safe_bits.is_some())
                .then(|| certificates.clone().filter_map(|c| c.safe_bits).max())
                .flatten(),
            bits: bits(certificates),
        }
    }
}

fn stacks<'a>(certificates: impl Iterator<Item = &'a Certificate>) -> Option<ProvenStacks> {
    let all = certificates.map(|certificate| {
        certificate.stacks.as_ref().map(|stacks| ProvenStacks {
            stacks: stacks.len(),
            charts: stacks.iter().map(Vec::len).sum(),
            kept: certificate.is_bijective_but_for_stacks(),
            unmirrored: certificate.mirrored_charts == certificate.mirrored_in_stacks,
        })
    });
    let sum = all.reduce(|a, b| {
        let (a, b) = (a?, b?);
        Some(ProvenStacks {
            stacks: a.stacks + b.stacks,
            charts: a.charts + b.charts,
            kept: a.kept && b.kept,
            unmirrored: a.unmirrored && b.unmirrored,
        })
    });
    sum.flatten()
}

fn padding<'a>(certificates: impl Iterator<Item = &'a Certificate>) -> Option<ProvenPadding> {
    let verdicts = certificates.filter_map(|certificate| certificate.padding.as_ref());
    verdicts
        .map(|verdict| ProvenPadding {
            asked_texels: verdict.asked_texels,
            resolution: verdict.resolution,
            kept: verdict.kept,
            reached_texels: verdict.reached_texels,
        })
        .reduce(|a, b| ProvenPadding {
            kept: a.kept && b.kept,
            reached_texels: [a.reached_texels, b.reached_texels]
                .into_iter()
                .flatten()
                .reduce(f64::min),
            ..a
        })
}

fn pages<'a>(certificates: impl Iterator<Item = &'a Certificate>) -> Option<ProvenPages> {
    let verdicts = certificates.filter_map(|certificate| certificate.pages.as_ref());
    verdicts
        .map(|verdict| ProvenPages {
            asked: verdict.asked,
            used: verdict.used,
            kept: verdict.kept,
        })
        .reduce(|a, b| ProvenPages {
            used: a.used.max(b.used),
            kept: a.kept && b.kept,
            ..a
        })
}

fn bits<'a>(certificates: impl Iterator<Item = &'a Certificate>) -> Option<ProvenBits> {
    let verdicts = certificates.filter_map(|certificate| certificate.bits.as_ref());
    verdicts
        .map(|verdict| ProvenBits {
            asked: verdict.asked,
            hold: verdict.hold,
            in_doubt: verdict.faces_in_doubt as u64 + verdict.pairs_in_doubt,
        })
        .reduce(|a, b| ProvenBits {
            hold: a.hold && b.hold,
            in_doubt: a.in_doubt + b.in_doubt,
            ..a
        })
}

impl Proven {
    /// Returns the requested properties that do not hold, in words. With [`Overlap::Skip`] faces may overlap.
    pub fn lacks(&self, overlap: Overlap, mirrored: Mirrored) -> Vec<&'static str> {
        let is_apart = self.bijective || self.stacks.as_ref().is_some_and(|stacks| stacks.kept);
        let overlaps = overlap == Overlap::Test && self.locally_injective && !is_apart;
        let stacked = self.stacks.as_ref().is_some_and(|stacks| stacks.unmirrored);
        let is_mirrored = match mirrored {
            Mirrored::Allowed => false,
            Mirrored::InStacks => !self.unmirrored && !stacked,
            Mirrored::Refused => !self.unmirrored,
        };
        let missing = [
            (!self.locally_injective, "triangles flipped or without area"),
            (overlaps, "triangles overlapping"),
            (is_mirrored, "charts mirrored"),
            (
                self.padding.as_ref().is_some_and(|p| !p.kept),
                "charts closer than the padding",
            ),
            (self.aligned == Some(false), "charts not aligned to texels"),
            (
                self.pages.as_ref().is_some_and(|p| !p.kept),
                "charts not on one page each",
            ),
            (
                self.bits.as_ref().is_some_and(|b| !b.hold),
                "not safe at the bits asked for",
            ),
        ];
        let missing = missing.into_iter().filter(|(is_missing, _)| *is_missing);
        missing.map(|(_, words)| words).collect()
    }
}

/// Permission of mirrored charts, which show the surface from behind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mirrored {
    /// Mirrored charts are permitted.
    Allowed,
    /// Mirrored charts are permitted in accepted stacks alone.
    InStacks,
    /// Mirrored charts are rejected.
    Refused,
}

impl Mirrored {
    /// Returns what a plan permits: islands that keep their shapes may be mirrored on purpose, so that both sides share
    /// a texture.
    pub(crate) fn of(plan: &Plan) -> Self {
        match plan.start {
            Start::New | Start::Present => Self::InStacks,
            Start::Final => Self::Allowed,
        }
    }
}

/// Describes the stacks in words.
impl fmt::Display for ProvenStacks {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let plural = if self.stacks == 1 { "" } else { "s" };
        write!(
            f,
            "{} stack{plural} of {} charts that coincide",
            self.stacks, self.charts
        )
    }
}

/// Describes the properties in words, including requested ones that do not hold.
impl fmt::Display for Proven {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let not = |holds: bool| if holds { "" } else { "not " };
        let stacked = self
            .stacks
            .as_ref()
            .filter(|stacks| stacks.kept && stacks.stacks > 0);
        match (self.locally_injective, self.bijective) {
            (true, false) if let Some(stacked) = stacked => write!(
                f,
                "no triangle flipped or without area, none overlapping except in {stacked}"
            )?,
            (true, true) => write!(
                f,
                "no triangle flipped, without area or overlapping (bijective)"
            )?,
            (true, false) => write!(f, "no triangle flipped or without area (locally injective)")?,
            (false, _) => write!(
                f,
                "triangles flipped or without area (not locally injective)"
            )?,
        }
        if !self.unmirrored {
            write!(f, ", charts mirrored")?;
        }
        if let Some(padding) = &self.padding {
            let (asked, resolution) = (padding.asked_texels, padding.resolution);
            let not = not(padding.kept);
            write!(f, ", charts {not}{asked} texels apart at {resolution}")?;
            if let Some(reached) = padding.reached_texels {
                write!(f, " (nearest {reached:.3})")?;
            }
        }
        if let Some(aligned) = self.aligned {
            write!(f, ", charts {}aligned to texels", not(aligned))?;
        }
        match &self.pages {
            Some(pages) if pages.asked > 1 || !pages.kept => {
                let (asked, used) = (pages.asked, pages.used);
                let not = not(pages.kept);
                write!(f, ", each chart {not}on one of {asked} pages ({used} used)")?;
            }
            _ => {}
        }
        match (&self.bits, self.safe_bits) {
            (Some(bits), _) if !bits.hold => {
                let (asked, in_doubt) = (bits.asked, bits.in_doubt);
                write!(f, ", not safe at {asked} bits ({in_doubt} places in doubt)")
            }
            (Some(bits), None) => write!(f, ", safe at {} bits", bits.asked),
            (_, Some(bits)) => write!(f, ", safe at {bits} bits"),
            (None, None) => Ok(()),
        }
    }
}
