//! Warnings about requested properties that are not proven of a group: what, where and by how much.

use super::bound_report::BoundReport;
use super::group_uvs::GroupUvs;
use super::groups::WrittenUvs;
use super::proven::{Mirrored, Proven};
use super::report::{AtlasReport, GroupReport};
use crate::PipelineError;
use crate::arrays::plan::Plan;
use crate::arrays::unwrap::Unwrapped;
use crate::options::{Options, Stacking};
use unwrapd_files::document::Warning;
use unwrapd_maps::certificate::{Certificate, Overlap, PaddingVerdict, chart_ids};

/// Maximum number of warnings per code; the last one counts the rest.
const MOST_OF_A_CODE: usize = 8;

/// Returns warnings about everything that prevents certification, missed bounds and faces wound against their chart.
pub fn shortfalls(groups: &[(&GroupUvs, &GroupReport)], mirrored: Mirrored) -> Vec<Warning> {
    let found = groups.iter().flat_map(|(uvs, report)| {
        let name = &uvs.label;
        let bound = report.atlas.as_ref().and_then(|atlas| atlas.bound.as_ref());
        let distorted = bound
            .filter(|bound| !bound.kept)
            .map(|bound| Warning::new("too_distorted", format!("{name}: {}", bound.shortfall())));
        let rough = bound
            .and_then(BoundReport::caveat)
            .map(|caveat| Warning::new("rough_surface", format!("{name}: {caveat}")));
        let unproven = of_certificate(uvs, &report.certificate, mirrored);
        let caveats = distorted.into_iter().chain(rough);
        let caveats = caveats.chain(mixed_winding(name, report));
        unproven.into_iter().chain(caveats)
    });
    limited(found)
}

/// Warns of charts whose faces the file winds in both directions.
fn mixed_winding(name: &str, report: &GroupReport) -> Option<Warning> {
    let mixed = report.measures.validity.winding_inconsistent_faces > 0;
    let edges = report
        .defects
        .as_ref()
        .filter(|defects| mixed && defects.inconsistent_edges > 0)?
        .inconsistent_edges;
    Some(Warning::new(
        "mixed_winding",
        format!(
            "{name}: faces are wound against their neighbors at {}; seen from their front, they show the texture mirrored",
            count(edges, "edge")
        ),
    ))
}

/// Returns warnings about everything that prevents the certification of UVs.
pub fn unproven(
    groups: &[GroupUvs],
    certificates: &[Certificate],
    mirrored: Mirrored,
) -> Vec<Warning> {
    let groups = groups.iter().zip(certificates);
    limited(groups.flat_map(|(uvs, certificate)| of_certificate(uvs, certificate, mirrored)))
}

/// Returns warnings about requested properties that a certificate does not prove.
fn of_certificate(uvs: &GroupUvs, certificate: &Certificate, mirrored: Mirrored) -> Vec<Warning> {
    let proven = Proven::of(std::iter::once(certificate));
    if proven.lacks(Overlap::Test, mirrored).is_empty() {
        return Vec::new();
    }
    let name = &uvs.label;
    let charts = chart_ids(&uvs.positions, &uvs.triangles, &uvs.uvs);
    let mut found = faces(name, certificate, &charts);
    found.extend(overlapping(name, certificate, &charts));
    found.extend(whole_charts(name, certificate, mirrored));
    found.extend(padding(name, certificate, &charts));
    found.extend(bits(name, certificate));
    found
}

/// Warns of flipped, degenerate and nonfinite faces.
fn faces(name: &str, certificate: &Certificate, charts: &[u32]) -> Vec<Warning> {
    let place = (certificate.offending_faces.first())
        .map(|&face| format!(", one of them triangle {face} in {}", chart(charts, face)))
        .unwrap_or_default();
    let counted = [
        (
            "flipped",
            certificate.flipped,
            "flipped (the map is not locally injective)",
        ),
        (
            "zero_area",
            certificate.degenerate,
            "degenerate (without area in UV)",
        ),
        (
            "not_finite",
            certificate.nonfinite_faces,
            "with UVs that are not finite",
        ),
    ];
    let warning = |(code, n, what): (&'static str, usize, &str)| {
        (n > 0).then(|| {
            Warning::new(
                code,
                format!("{name}: {} {what}{place}", count(n, "triangle")),
            )
        })
    };
    counted.into_iter().filter_map(warning).collect()
}

fn overlapping(name: &str, certificate: &Certificate, charts: &[u32]) -> Option<Warning> {
    let pairs = certificate.overlapping_pairs.unwrap_or(0);
    if certificate.overlap_truncated {
        let text = format!("{name}: too many candidates for overlaps to test them all");
        return Some(Warning::new("overlapping", text));
    }
    let place = (certificate.offending_pairs.first()).map(|&[a, b]| {
        let (in_a, in_b) = (chart(charts, a), chart(charts, b));
        if in_a == in_b {
            format!(", one of them triangles {a} and {b} in {in_a}")
        } else {
            format!(", one of them triangle {a} in {in_a} and triangle {b} in {in_b}")
        }
    });
    let place = place.unwrap_or_default();
    let what = "overlapping in UV (the map is not bijective)";
    let pairs = (pairs > 0).then(|| count(pairs as usize, "pair"))?;
    Some(Warning::new(
        "overlapping",
        format!("{name}: {pairs} of triangles {what}{place}"),
    ))
}

/// Warns of charts that are mirrored, nonorientable, not aligned or not on one page.
fn whole_charts(name: &str, certificate: &Certificate, mirrored: Mirrored) -> Vec<Warning> {
    let mut warnings = Vec::new();
    let mut add = |code, n: usize, what: &str| {
        if n > 0 {
            let text = format!("{name}: {} {what}", count(n, "chart"));
            warnings.push(Warning::new(code, text));
        }
    };
    let first = certificate.mirrored.first();
    let first = first.map_or(String::new(), |chart| {
        format!(", one of them chart {chart}")
    });
    let n_mirrored = match mirrored {
        Mirrored::Allowed => 0,
        Mirrored::InStacks => certificate.mirrored_charts - certificate.mirrored_in_stacks,
        Mirrored::Refused => certificate.mirrored_charts,
    };
    let what = format!("mirrored (seen from behind){first}");
    add("mirrored", n_mirrored, &what);
    add(
        "one_sided",
        certificate.nonorientable_charts,
        "not orientable (like a Möbius strip)",
    );
    add(
        "not_aligned",
        certificate.unaligned_charts.unwrap_or(0),
        "not aligned to texel borders",
    );
    if let Some(pages) = &certificate.pages {
        let asked = count(pages.asked as usize, "page");
        add(
            "outside_pages",
            pages.charts_across,
            &format!("not inside one of {asked}"),
        );
    }
    warnings
}

fn padding(name: &str, certificate: &Certificate, charts: &[u32]) -> Option<Warning> {
    let verdict = certificate
        .padding
        .as_ref()
        .filter(|verdict| !verdict.kept)?;
    let PaddingVerdict {
        asked_texels,
        resolution,
        pairs_too_close,
        ..
    } = verdict;
    let nearest = (verdict.reached_texels)
        .map(|reached| format!(", the nearest at {reached:.3}"))
        .unwrap_or_default();
    let place = (verdict.offending_faces.first())
        .map(|&[a, b]| {
            format!(
                ", one of them {} and {}",
                chart(charts, a),
                chart(charts, b)
            )
        })
        .unwrap_or_default();
    let pairs = count(*pairs_too_close, "pair");
    Some(Warning::new(
        "padding_missed",
        format!(
            "{name}: {pairs} of charts closer than the padding of {asked_texels} texels at {resolution}{nearest}{place}; use a larger \
             --resolution or a smaller --padding"
        ),
    ))
}

fn bits(name: &str, certificate: &Certificate) -> Option<Warning> {
    let verdict = certificate.bits.as_ref().filter(|verdict| !verdict.hold)?;
    let faces = count(verdict.faces_in_doubt, "triangle");
    let pairs = count(verdict.pairs_in_doubt as usize, "pair");
    let asked = verdict.asked;
    Some(Warning::new(
        "bits_missed",
        format!("{name}: rounded to {asked} bits, {faces} may flip and {pairs} of edges may touch"),
    ))
}

fn chart(charts: &[u32], face: u32) -> String {
    charts
        .get(face as usize)
        .map_or("a chart".to_owned(), |chart| format!("chart {chart}"))
}

fn count(n: usize, thing: &str) -> String {
    let plural = if n == 1 { "" } else { "s" };
    format!("{n} {thing}{plural}")
}

/// Keeps the first warnings of each code and counts the rest.
fn limited(found: impl Iterator<Item = Warning>) -> Vec<Warning> {
    let mut all: Vec<Warning> = found.collect();
    all.sort_by(|a, b| a.code.cmp(&b.code));
    let mut kept = Vec::new();
    for of_code in all.chunk_by(|a, b| a.code == b.code) {
        if of_code.len() <= MOST_OF_A_CODE {
            kept.extend_from_slice(of_code);
            continue;
        }
        let (shown, rest) = of_code.split_at(MOST_OF_A_CODE - 1);
        kept.extend_from_slice(shown);
        let text = format!(
            "{} more of these ({}); the report lists them all",
            rest.len(),
            rest[0].code
        );
        kept.push(Warning {
            code: rest[0].code.clone(),
            message: text,
        });
    }
    kept
}

// Facts about a judged atlas that only unwrapping knows.

/// Adds the facts that only unwrapping knows to each group.
pub fn add_history(
    groups: &mut [GroupReport],
    atlases: &[Unwrapped],
    uvs: &WrittenUvs,
    plan: &Plan,
    options: &Options,
) {
    let aspect = options.layout.resolution.aspect();
    let names: Vec<String> = groups.iter().map(|group| group.name.clone()).collect();
    for ((group, atlas), uvs) in groups.iter_mut().zip(atlases).zip(&uvs.groups) {
        group.defects = Some(atlas.defects);
        group.atlas = Some(AtlasReport {
            bound: (plan.reported_bound).map(|bound| {
                BoundReport::new(
                    &bound,
                    plan.most_charts,
                    &group.measures.distortion,
                    uvs,
                    aspect,
                )
            }),
            same_as: atlas.same_as.map(|group| names[group].clone()),
            ..AtlasReport::new(atlas)
        });
    }
}

/// Returns a warning if parts of one shape were to be stacked, and there are none.
pub fn nothing_stacked(groups: &[GroupReport], options: &Options) -> Option<Warning> {
    let by_shape = [Some(Stacking::Identical), Some(Stacking::Mirrored)];
    let is_asked = by_shape.contains(&options.layout.stack);
    let is_any = groups.iter().any(|group| group.stacks.is_some());
    (is_asked && !is_any).then(|| {
        let text = "nothing is stacked: no two parts have one shape and one material";
        Warning::new("nothing_stacked", text.to_owned())
    })
}

/// Rejects UVs with flips if none are allowed; `missing` describes them.
pub fn promise_kept(
    plan: &Plan,
    groups: &[GroupReport],
    missing: &[Warning],
) -> Result<(), PipelineError> {
    if !plan.is_promised || groups.iter().all(|group| group.certificate.is_valid()) {
        return Ok(());
    }
    let messages: Vec<&str> = missing.iter().map(|w| w.message.as_str()).collect();
    Err(PipelineError::NotValid(messages.join("; ")))
}
