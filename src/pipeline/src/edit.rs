//! Editing of a document's UVs by anchors.

use crate::arrays::unwrap::in_pool;
use crate::deform::solution::{Completion, PullReport};
use crate::documents::corner_selection::CornerSelection;
use crate::judge::groups::WrittenUvs;
use crate::judge::proven::{Mirrored, Proven};
use crate::judge::shortfalls::unproven;
use crate::observer::Observer;
use crate::options::{CommandOptions, EditOptions, Editing, MeasureOptions};
use crate::start::start;
use crate::tracker::Tracker;
use crate::{PipelineError, limits};
use serde::Serialize;
use unwrapd_api::Stage;
use unwrapd_deform::Unreached;
use unwrapd_deform::uv::{Anchor, ChartFaces, EditedUvs, UvMesh, UvRest, UvSession, edit_uvs_from};
use unwrapd_files::document::{
    Corners, Document, DocumentError, GroupBy, Layout, Marked, NewUvs, OutputFormat, Sets, Terms,
    Upload, Warning, WriteOptions, Written,
};
use unwrapd_maps::certificate::{Overlap, PlanarCertificate, boundary_crossings, certify_planar};
use unwrapd_maps::mesh::CornerUvs;
use unwrapd_method::barrier::BarrierKind;

// Editing of a document's UVs by anchors, judged in the written bytes.

/// A document with edited UVs.
#[derive(Clone, Debug)]
pub struct EditedDocument {
    /// Written files by relative name, the main file first.
    pub files: Vec<(String, Vec<u8>)>,
    /// Report on the edit.
    pub report: EditReport,
}

/// Moves anchors of a document's UVs to their targets and judges the written bytes. UVs are those of the file, in
/// glTF with v down; vertices are counted through all triangle primitives in file order.
pub fn edit_document(
    upload: &Upload,
    editing: Editing,
    options: &EditOptions,
    observer: &dyn Observer,
) -> Result<EditedDocument, PipelineError> {
    options.check()?;
    let tracker = Tracker::new(observer, options.caller.budget(options.budget));
    in_pool(options.caller.workers(options.workers), || {
        // Read the UVs.
        tracker.stage(Stage::Read);
        let document = Document::read(upload)?;
        limits::check(&options.caller.limits, &document)?;
        let whole = Whole::gather(&document, options.texcoord)?;
        let mut anchors = options.anchors.clone();
        whole.fill(&document, &mut anchors)?;
        // Edit them.
        let how = options.of_map(editing);
        let start = start(upload, 6 * whole.triangles.len())?;
        let start = start
            .as_deref()
            .map(|start| start.as_chunks().0.as_chunks().0);
        let edited = edit_uvs_from(&whole.mesh(), start, &anchors, &how, &tracker)?;
        // Write the document.
        tracker.stage(Stage::Write);
        let stem = options.caller.stem(upload);
        let mut write_options = WriteOptions {
            format: options.format,
            stem,
            texcoord: Some(options.texcoord),
            overwrite: false,
            terms: Some(edited_terms(&document, options)?),
        };
        let uvs = new_uvs(&document, &whole, &edited);
        let mut written = document.write(&uvs, &write_options)?;
        // Judge the charts with anchors in the bytes written.
        tracker.stage(Stage::Judge);
        let again = written.read_again()?;
        let found = Whole::gather(&again, options.texcoord)?;
        let places = places(&written, edited.uvs.len());
        let charts = judge_charts(&edited, &document, &again, &found, &places)?;
        let is_kept = charts.iter().all(|chart| chart.map.certificate.is_valid());
        let overlaps = charts.iter().any(|chart| !chart.map.bijective);
        if !is_kept && options.model.barrier != BarrierKind::None {
            let what = "a triangle is flipped or without area";
            return Err(PipelineError::NotValid(what.to_owned()));
        }
        if options.model.bijective && overlaps {
            let what = "a chart overlaps itself";
            return Err(PipelineError::NotValid(what.to_owned()));
        }
        // Judge the whole set; a faulty one must not be recorded as free of overlaps.
        let judgment = WholeJudgment::new(&again, options.texcoord)?;
        if let Some(terms) = &mut write_options.terms
            && !judgment.is_certified()
        {
            terms.overlaps = true;
            written = document.write(&uvs, &write_options)?;
        }
        // Report.
        let mut warnings = [document.warnings(), &written.notes.warnings].concat();
        warnings.extend(tracker.warning());
        let (completion, unfinished) = completion(&edited);
        warnings.extend(unfinished);
        warnings.extend_from_slice(&judgment.warnings);
        if !judgment.is_certified() {
            warnings.extend(WholeJudgment::new(&document, options.texcoord)?.as_before());
        }
        let certified = judgment.is_certified();
        let report = EditReport {
            certified,
            bijective: judgment.proven.bijective,
            lacking: judgment.lacking,
            proven: judgment.proven,
            completion,
            warnings,
            rest: how.rest,
            charts,
        };
        Ok(EditedDocument {
            files: written.files,
            report,
        })
    })?
}

/// UVs under live editing, and the document by which anchors select parts of them.
pub struct SessionUvs {
    /// Session without anchors.
    pub session: UvSession,
    selection: CornerSelection,
}

impl SessionUvs {
    /// Fills in what the selector of an anchor names, if it has one.
    ///
    /// # Errors
    /// If the selector cannot be parsed, or names a material that does not exist.
    pub fn fill(&self, anchor: &mut Anchor) -> Result<(), PipelineError> {
        self.selection.fill(anchor.select_mut())
    }
}

/// Opens a session on the UVs that [`edit_document`] would edit. The caller adds the anchors.
pub fn open_uvs(
    upload: &Upload,
    editing: Editing,
    options: &EditOptions,
) -> Result<SessionUvs, PipelineError> {
    options.check()?;
    let document = Document::read(upload)?;
    limits::check(&options.caller.limits, &document)?;
    let whole = Whole::gather(&document, options.texcoord)?;
    Ok(SessionUvs {
        session: UvSession::new(&whole.mesh(), options.of_map(editing)),
        selection: whole.selection(&document),
    })
}

/// All primitives of a document as one mesh. Primitives without UVs contribute only vertices.
pub(super) struct Whole {
    positions: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
    uvs: Vec<CornerUvs>,
    /// Number of faces of each primitive; `None` if it has no UVs.
    n_faces: Vec<Option<usize>>,
}

impl Whole {
    pub fn gather(document: &Document, texcoord: u32) -> Result<Self, PipelineError> {
        let mut whole = Self {
            positions: Vec::new(),
            triangles: Vec::new(),
            uvs: Vec::new(),
            n_faces: Vec::new(),
        };
        for (index, primitive) in document.primitives().iter().enumerate() {
            let uvs = document.corner_uvs(index, texcoord)?;
            whole.n_faces.push(uvs.as_ref().map(Vec::len));
            let first = whole.positions.len() as u32;
            let positions = primitive.positions.iter().map(|p| p.map(f64::from));
            whole.positions.extend(positions);
            if let Some(uvs) = uvs {
                let triangles = primitive.triangles.iter().map(|t| t.map(|v| v + first));
                whole.triangles.extend(triangles);
                whole.uvs.extend(uvs);
            }
        }
        if whole.triangles.is_empty() {
            let group = "the file".to_owned();
            return Err(PipelineError::NoUvs { group, texcoord });
        }
        Ok(whole)
    }

    /// Fills in what the selectors of anchors name.
    fn fill(&self, document: &Document, anchors: &mut [Anchor]) -> Result<(), PipelineError> {
        let mut selects = anchors.iter_mut().filter_map(Anchor::select_mut).peekable();
        if selects.peek().is_none() {
            return Ok(());
        }
        self.selection(document).fill(selects)
    }

    /// Returns the selection of corners of its triangles.
    fn selection(&self, document: &Document) -> CornerSelection {
        let with_uvs = (0..).zip(&self.n_faces).filter(|(_, n)| n.is_some());
        let primitives = with_uvs.map(|(index, _)| index).collect();
        CornerSelection::new(document.clone(), primitives)
    }

    pub fn mesh(&self) -> UvMesh<'_> {
        UvMesh {
            positions: &self.positions,
            triangles: &self.triangles,
            uvs: &self.uvs,
        }
    }
}

fn new_uvs(document: &Document, whole: &Whole, edited: &EditedUvs) -> NewUvs {
    let mut rest = edited.uvs.as_slice();
    let mut next = |n: usize| -> Vec<Corners> {
        let (own, others) = rest.split_at(n);
        rest = others;
        own.iter()
            .map(|face| face.map(|uv| uv.map(|x| x as f32)))
            .collect()
    };
    NewUvs {
        layout: Layout::Edited,
        v_axis: document.v_axis(),
        corners: whole.n_faces.iter().map(|n| n.map(&mut next)).collect(),
    }
}

/// Returns the index of each face in the written file.
fn places(written: &Written, n_faces: usize) -> Vec<usize> {
    let Some(faces) = &written.notes.faces else {
        return (0..n_faces).collect();
    };
    let mut places = vec![0; n_faces];
    for (place, &face) in faces.iter().enumerate() {
        if let Some(slot) = places.get_mut(face as usize) {
            *slot = place;
        }
    }
    places
}

/// Judges each chart with anchors separately in the written bytes; `places` are the indices of its faces there.
fn judge_charts(
    edited: &EditedUvs,
    document: &Document,
    again: &Document,
    found: &Whole,
    places: &[usize],
) -> Result<Vec<ChartEditReport>, PipelineError> {
    if found.uvs.len() != edited.uvs.len() {
        return Err(DocumentError::InvalidUvs.into());
    }
    let found: Vec<CornerUvs> = places.iter().map(|&place| found.uvs[place]).collect();
    let flip_v = again.v_axis() != document.v_axis();
    let charts = edited.charts.iter().map(|chart| {
        let crossings = boundary_crossings(&chart.vertices, &chart.triangles);
        let certificate = certified(&chart.faces, &found, flip_v);
        ChartEditReport {
            chart: chart.chart,
            untangled: chart.untangled,
            map: PullReport::new(chart.summary.clone(), crossings, certificate),
        }
    });
    Ok(charts.collect())
}

/// Certifies a chart by the UVs of the file; `flip_v` states that the file's v axis was reversed.
fn certified(faces: &ChartFaces, uvs: &[CornerUvs], flip_v: bool) -> PlanarCertificate {
    let places: Vec<[f64; 2]> = faces
        .corners()
        .flatten()
        .map(|corner: u32| {
            let [u, v] = uvs[corner as usize / 3][corner as usize % 3];
            [u, if flip_v { -v } else { v }]
        })
        .collect();
    let triangles = (0..faces.len() as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]);
    certify_planar(&places, &triangles.collect::<Vec<_>>())
}

// Promises in the record of a document with edited UVs.

/// Returns the record of a document with edited UVs in which no two faces overlap. It promises nothing about
/// distances between charts, which the edit does not check.
pub fn edited_terms(document: &Document, options: &EditOptions) -> Result<Terms, PipelineError> {
    let present = match document.marked()? {
        Marked::Fits(mark) if mark.sets == Sets::One(options.texcoord) => Some(mark.terms),
        _ => None,
    };
    let present = present.as_ref();
    let resolution = present.map(|terms| terms.resolution);
    Ok(Terms {
        group_by: match options.format {
            OutputFormat::Obj => GroupBy::Scene,
            OutputFormat::Glb | OutputFormat::Gltf => {
                present.map_or(document.grouping(), |terms| terms.group_by)
            }
        },
        separate_nodes: present.is_some_and(|terms| terms.separate_nodes),
        padding: None,
        resolution: resolution.unwrap_or(MeasureOptions::default().resolution()),
        pages: None,
        mips: 0,
        aligned: false,
        bits: None,
        overlaps: false,
    })
}

/// Judgment of a whole UV set, including charts without anchors.
pub struct WholeJudgment {
    pub proven: Proven,
    /// Missing properties, in words.
    pub lacking: Vec<&'static str>,
    /// Warnings with place and extent of what is missing.
    pub warnings: Vec<Warning>,
}

impl WholeJudgment {
    /// Judges all primitives that have the set, as [`verify_document`](crate::verify_document) does with
    /// `bijective`. Mirrored charts are left to the author of the UVs.
    pub fn new(document: &Document, texcoord: u32) -> Result<Self, PipelineError> {
        let uvs = WrittenUvs::of_set(document, texcoord)?;
        let certificates = uvs.certify(&Overlap::Test.into());
        let proven = Proven::of(certificates.iter());
        Ok(Self {
            lacking: proven.lacks(Overlap::Test, Mirrored::Allowed),
            warnings: unproven(&uvs.groups, &certificates, Mirrored::Allowed),
            proven,
        })
    }

    pub fn is_certified(&self) -> bool {
        self.lacking.is_empty()
    }

    /// Returns a warning if the UVs were faulty before the edit.
    pub fn as_before(&self) -> Option<Warning> {
        let lacking = self.lacking.join(", ");
        (!self.is_certified()).then(|| {
            Warning::new(
                "uncertified_before",
                format!("before the edit, the UVs already had: {lacking}"),
            )
        })
    }
}

// Reports of edited UVs.

/// Report on the edited UVs of a document.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct EditReport {
    /// `true` if the whole UV set is proven in the bytes written: no face is flipped or degenerate, and no two faces
    /// that share a UV space overlap, whether their charts have anchors or not. Warnings name what is missing.
    pub certified: bool,
    /// `true` if the whole UV set is bijective in the bytes written.
    pub bijective: bool,
    /// Properties that are missing, in words.
    pub lacking: Vec<&'static str>,
    /// Proven properties of the whole UV set.
    pub proven: Proven,
    /// Degree to which the request was completed.
    pub completion: Completion,
    /// Warnings about the input file, the work and the written file.
    pub warnings: Vec<Warning>,
    /// The shapes that were kept.
    pub rest: UvRest,
    /// The charts with anchors.
    pub charts: Vec<ChartEditReport>,
}

/// Report on an edited chart.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct ChartEditReport {
    /// Its number among the charts of the document, in the order of their first faces.
    pub chart: u32,
    /// Number of its faces that were flipped or empty and had to be untangled first.
    pub untangled: usize,
    /// Quality of the map; the certificate is about the bytes written.
    #[serde(flatten)]
    pub map: PullReport,
}

/// Returns the worst completion of all charts, with its warning.
pub(super) fn completion(edited: &EditedUvs) -> (Completion, Option<Warning>) {
    let summaries = || edited.charts.iter().map(|chart| &chart.summary);
    let worst = summaries().max_by_key(|summary| Completion::of(summary.status));
    let Some(status) = worst.map(|summary| summary.status) else {
        return (Completion::Complete, None);
    };
    let completion = Completion::of(status);
    let of_worst = summaries().filter(|summary| Completion::of(summary.status) == completion);
    let mut unreached: Vec<Unreached> = of_worst.flat_map(|s| s.unreached.clone()).collect();
    unreached.sort_by_key(|anchor| anchor.handle);
    (completion, completion.warning(status, &unreached))
}
