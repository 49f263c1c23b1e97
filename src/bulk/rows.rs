//! Rows of the summary, one per asset, and the summary: a table of rows, and totals.

use serde::{Deserialize, Serialize};

use super::assets::Asset;
use unwrapd_api::{Failure, Quality};
use unwrapd_server::jobs::Gates;

/// Outcome for an asset.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SummaryRow {
    /// Name of the input.
    pub input: String,
    /// Path of the output within the output folder.
    pub output: String,
    /// Seconds from reading the input to having the output in place.
    pub seconds: f64,
    /// Outcome.
    #[serde(flatten)]
    pub status: AssetStatus,
}

/// Status of a processed asset.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "status", rename_all = "snake_case")]
pub enum AssetStatus {
    /// It has an output.
    Written(Figures),
    /// It has no output, for this reason.
    Failed {
        /// Stable code in snake_case.
        code: String,
        /// Description in one line.
        detail: String,
    },
    /// No run has recorded it.
    Missing,
}

/// Quality figures of an output.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Figures {
    /// Set if everything requested is proven.
    pub certified: bool,
    /// Number of triangles.
    pub faces: u64,
    /// Number of charts of all atlases.
    pub charts: u64,
    /// Mean symmetric Dirichlet energy of the worst atlas; an isometry has 4.
    pub distortion: Option<f64>,
    /// 99th percentile of the stretch of the worst atlas; an isometry has 1.
    pub stretch: Option<f64>,
    /// Number of warnings in the report.
    pub warnings: u64,
    /// Set if a limit ended the work early.
    #[serde(default)]
    pub ended_early: bool,
    /// Set if textures or colors were not resampled as requested, in which case `unwrap` exits with 7.
    #[serde(default)]
    pub partly_done: bool,
}

impl SummaryRow {
    /// Creates the row of an asset.
    pub(super) fn new(asset: &Asset, seconds: f64, status: AssetStatus) -> Self {
        Self {
            input: asset.name.clone(),
            output: asset.output.to_string_lossy().into_owned(),
            seconds,
            status,
        }
    }

    /// Returns whether the asset passes all gates. One without an output passes none.
    pub fn is_accepted(&self, gates: &Gates) -> bool {
        match &self.status {
            AssetStatus::Written(figures) => gates.accept(&figures.quality(), self.seconds),
            AssetStatus::Failed { .. } | AssetStatus::Missing => false,
        }
    }
}

impl From<Failure> for AssetStatus {
    fn from(Failure { code, detail }: Failure) -> Self {
        Self::Failed { code, detail }
    }
}

/// Part of a report that is read.
#[derive(Deserialize)]
struct ReportRead {
    certified: bool,
    #[serde(default)]
    partly_done: bool,
    warnings: Vec<WarningRead>,
    groups: Vec<GroupRead>,
}

#[derive(Deserialize)]
struct WarningRead {
    code: String,
}

#[derive(Deserialize)]
struct GroupRead {
    measures: MeasuresRead,
}

#[derive(Deserialize)]
struct MeasuresRead {
    faces: u64,
    charts: u64,
    sym_dirichlet_mean: Option<f64>,
    stretch_p99: Option<f64>,
}

impl Figures {
    /// Returns the figures that gates judge.
    fn quality(&self) -> Quality {
        Quality {
            certified: Some(self.certified),
            charts: Some(self.charts),
            distortion: self.distortion,
            stretch: self.stretch,
        }
    }

    /// Reads the figures from a report.
    pub(super) fn of_report(report: &[u8]) -> serde_json::Result<Self> {
        let ReportRead {
            certified,
            partly_done,
            warnings,
            groups,
        } = serde_json::from_slice(report)?;
        let measures = groups.iter().map(|group| &group.measures);
        Ok(Self {
            certified,
            faces: measures.clone().map(|m| m.faces).sum(),
            charts: measures.clone().map(|m| m.charts).sum(),
            distortion: (measures.clone())
                .filter_map(|m| m.sym_dirichlet_mean)
                .reduce(f64::max),
            stretch: measures.filter_map(|m| m.stretch_p99).reduce(f64::max),
            warnings: warnings.len() as u64,
            partly_done,
            ended_early: warnings.iter().any(|it| it.code == "ended_early"),
        })
    }
}

// The summary of a run: a table of rows, and totals.

/// Names of the columns.
const HEADER: [&str; 14] = [
    "input",
    "output",
    "status",
    "code",
    "accepted",
    "certified",
    "faces",
    "charts",
    "distortion",
    "stretch",
    "warnings",
    "seconds",
    "detail",
    "partly_done",
];

/// Numbers of assets by outcome.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Totals {
    /// All assets.
    pub assets: usize,
    /// Assets with an output.
    pub written: usize,
    /// Failed assets.
    pub failed: usize,
    /// Assets without a record.
    pub missing: usize,
    /// Assets that pass the gates.
    pub accepted: usize,
    /// Written assets whose textures or colors were not resampled as requested.
    pub partly_done: usize,
}

impl Totals {
    /// Counts rows.
    pub fn of(rows: &[SummaryRow], gates: &Gates) -> Self {
        let mut totals = Self {
            assets: rows.len(),
            ..Self::default()
        };
        for row in rows {
            match &row.status {
                AssetStatus::Written(figures) => {
                    totals.written += 1;
                    totals.partly_done += usize::from(figures.partly_done);
                }
                AssetStatus::Failed { .. } => totals.failed += 1,
                AssetStatus::Missing => totals.missing += 1,
            }
            totals.accepted += usize::from(row.is_accepted(gates));
        }
        totals
    }
}

/// Formats rows as CSV (RFC 4180) with a header.
///
/// # Errors
/// Does not fail in practice, because it writes to memory.
pub fn csv(rows: &[SummaryRow], gates: &Gates) -> std::io::Result<Vec<u8>> {
    let mut table = csv::Writer::from_writer(Vec::new());
    table.write_record(HEADER)?;
    for row in rows {
        table.write_record(cells(row, gates))?;
    }
    table.into_inner().map_err(csv::IntoInnerError::into_error)
}

/// Escapes control characters in a text, because tables are also read in terminals and spreadsheets.
fn shown(text: &str) -> String {
    let mut shown = String::with_capacity(text.len());
    for c in text.chars() {
        if c.is_control() {
            shown.extend(c.escape_default());
        } else {
            shown.push(c);
        }
    }
    shown
}

/// Formats the cells of a row, in the order of the columns.
fn cells(row: &SummaryRow, gates: &Gates) -> [String; 14] {
    let (status, code, detail) = match &row.status {
        AssetStatus::Written(_) => ("written", "", ""),
        AssetStatus::Failed { code, detail } => ("failed", &**code, &**detail),
        AssetStatus::Missing => ("missing", "", ""),
    };
    let [
        certified,
        faces,
        charts,
        distortion,
        stretch,
        warnings,
        partly_done,
    ] = match &row.status {
        AssetStatus::Written(it) => [
            it.certified.to_string(),
            it.faces.to_string(),
            it.charts.to_string(),
            decimal(it.distortion),
            decimal(it.stretch),
            it.warnings.to_string(),
            it.partly_done.to_string(),
        ],
        AssetStatus::Failed { .. } | AssetStatus::Missing => Default::default(),
    };
    [
        shown(&row.input),
        shown(&row.output),
        status.to_owned(),
        code.to_owned(),
        row.is_accepted(gates).to_string(),
        certified,
        faces,
        charts,
        distortion,
        stretch,
        warnings,
        format!("{:.3}", row.seconds),
        shown(detail),
        partly_done,
    ]
}

fn decimal(number: Option<f64>) -> String {
    number.map_or(String::new(), |x| format!("{x:.4}"))
}
