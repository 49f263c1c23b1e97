//! UVs of a document edited by anchors, and judged in the bytes that are written.

use serde::Serialize;

use super::PipelineError;
use super::arrays::in_pool;
use super::documents::stem;
use super::edit_options::{EditOptions, Editing};
use super::observer::{Observer, Stage, Tracker};
use crate::barrier::BarrierKind;
use crate::certificate::CornerUvs;
use crate::deform::PullReport;
use crate::deform::uv::{EditedUvs, UvMesh, UvRest, edit_uvs};
use crate::document::{
    Corners, Document, DocumentError, Layout, NewUvs, Upload, Warning, WriteOptions, Written,
};

/// A document with edited UVs.
#[derive(Clone, Debug)]
pub struct EditedDocument {
    /// The written files by relative name, the main file first.
    pub files: Vec<(String, Vec<u8>)>,
    /// What was done.
    pub report: EditReport,
}

/// What was done to the UVs of a document.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema))]
pub struct EditReport {
    /// Whether every chart with an anchor is proven to be without flips in the bytes written.
    pub certified: bool,
    /// Whether, beyond that, none of them overlaps itself.
    pub bijective: bool,
    /// What users should know of the file that was read, of the work and of the file that was written.
    pub warnings: Vec<Warning>,
    /// The shapes that were kept.
    pub rest: UvRest,
    /// The charts with anchors.
    pub charts: Vec<ChartEditReport>,
    /// What users should know of the files.
    pub warnings: Vec<Warning>,
}

/// What was done to a chart.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema))]
pub struct ChartEditReport {
    /// Its number among the charts of the document, in the order of their first faces.
    pub chart: u32,
    /// How many of its faces were flipped or empty and had to be untangled first.
    pub untangled: usize,
    /// What the map is worth; the certificate is about the bytes written.
    #[serde(flatten)]
    pub map: PullReport,
}

/// Pulls anchors of a document's UVs to their targets and judges the bytes it writes. UVs are in the numbers of the file, in
/// glTF with v down; vertices count through all triangle primitives in file order.
pub fn edit_document(
    upload: &Upload,
    editing: Editing,
    options: &EditOptions,
    observer: &dyn Observer,
) -> Result<EditedDocument, PipelineError> {
    options.check()?;
    let tracker = Tracker::new(observer, options.limits.time_budget(options.time_budget));
    in_pool(options.limits.threads, || {
        tracker.stage(Stage::Read);
        let document = Document::read(upload)?;
        options.limits.check(&document)?;
        let whole = Whole::gather(&document, options.texcoord)?;
        let how = options.of_map(editing);
        let edited = edit_uvs(&whole.mesh(), &options.anchors, &how, &tracker)?;
        tracker.stage(Stage::Write);
        let written = write(&document, &whole, &edited, upload, options)?;
        tracker.stage(Stage::Judge);
        let report = judge(&document, &edited, &written, (options.texcoord, how.rest))?;
        let is_kept = report.certified || options.model.barrier == BarrierKind::None;
        if !is_kept || options.model.bijective && !report.bijective {
            let what = if report.certified {
                "a chart overlaps itself"
            } else {
                "a triangle is flipped or without area"
            };
            return Err(PipelineError::NotValid(what.to_owned()));
        }
        Ok(EditedDocument {
            files: written.files,
            report,
        })
    })?
}

/// All primitives of a document as one mesh; those without UVs have vertices only.
struct Whole {
    positions: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
    uvs: Vec<CornerUvs>,
    /// The number of faces of each primitive that has UVs.
    n_faces: Vec<Option<usize>>,
}

impl Whole {
    fn gather(document: &Document, texcoord: u32) -> Result<Self, PipelineError> {
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

    fn mesh(&self) -> UvMesh<'_> {
        UvMesh {
            positions: &self.positions,
            triangles: &self.triangles,
            uvs: &self.uvs,
        }
    }
}

fn write(
    document: &Document,
    whole: &Whole,
    edited: &EditedUvs,
    upload: &Upload,
    options: &EditOptions,
) -> Result<Written, PipelineError> {
    let mut rest = edited.uvs.as_slice();
    let mut next = |n: usize| -> Vec<Corners> {
        let (own, others) = rest.split_at(n);
        rest = others;
        own.iter()
            .map(|face| face.map(|uv| uv.map(|x| x as f32)))
            .collect()
    };
    let uvs = NewUvs {
        layout: Layout::Edited,
        pages: 1,
        v_axis: document.v_axis(),
        corners: whole.n_faces.iter().map(|n| n.map(&mut next)).collect(),
    };
    let options = WriteOptions {
        format: options.format,
        stem: options.stem.clone().unwrap_or_else(|| stem(&upload.name)),
        texcoord: Some(options.texcoord),
        overwrite: false,
    };
    Ok(document.write(&uvs, &options)?)
}

/// Reads the written bytes again and judges the charts in them.
fn judge(
    document: &Document,
    edited: &EditedUvs,
    written: &Written,
    (texcoord, rest): (u32, UvRest),
) -> Result<EditReport, PipelineError> {
    let mut files = written.files.iter().cloned();
    let (name, bytes) = files.next().unwrap_or_default();
    let resources = files.collect();
    let again = Document::read(&Upload {
        name,
        bytes,
        resources,
    })?;
    let mut found = Whole::gather(&again, texcoord)?.uvs;
    if found.len() != edited.uvs.len() {
        return Err(DocumentError::InvalidUvs.into());
    }
    if let Some(faces) = &written.notes.faces {
        let mut placed: Vec<_> = faces.iter().zip(&found).collect();
        placed.sort_unstable_by_key(|(face, _)| **face);
        found = placed.into_iter().map(|(_, uvs)| *uvs).collect();
    }
    let flip_v = again.v_axis() != document.v_axis();
    let charts = edited.charts.iter().map(|chart| {
        let certificate = chart.faces.certify(&found, flip_v);
        let map = PullReport {
            bijective: certificate.is_bijective(),
            certificate,
            ..chart.report.clone()
        };
        ChartEditReport {
            chart: chart.chart,
            untangled: chart.untangled,
            map,
        }
    });
    let charts: Vec<ChartEditReport> = charts.collect();
    Ok(EditReport {
        certified: charts.iter().all(|c| c.map.certificate.is_valid()),
        bijective: charts.iter().all(|c| c.map.bijective),
        warnings: [document.warnings(), &written.notes.warnings].concat(),
        rest,
        charts,
        warnings: [document.warnings(), &written.notes.warnings].concat(),
    })
}
