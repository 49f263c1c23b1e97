//! The summary of a run: a table of rows, and totals.

use serde::Serialize;

use super::row::{Row, Status};
use unwrapd_server::jobs::Gates;

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
    pub fn of(rows: &[Row], gates: &Gates) -> Self {
        let count = |is: fn(&Status) -> bool| rows.iter().filter(|row| is(&row.status)).count();
        Self {
            assets: rows.len(),
            written: count(|status| matches!(status, Status::Written(_))),
            failed: count(|status| matches!(status, Status::Failed { .. })),
            missing: count(|status| matches!(status, Status::Missing)),
            accepted: rows.iter().filter(|row| row.is_accepted(gates)).count(),
            partly_done: count(|status| matches!(status, Status::Written(it) if it.partly_done)),
        }
    }
}

/// Formats rows as CSV (RFC 4180) with a header.
///
/// # Errors
/// Does not fail in practice, because it writes to memory.
pub fn csv(rows: &[Row], gates: &Gates) -> std::io::Result<Vec<u8>> {
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

fn cells(row: &Row, gates: &Gates) -> [String; 14] {
    let number = |number: Option<f64>| number.map_or(String::new(), |x| format!("{x:.4}"));
    let common = |status: &str, code: &str, figures: [String; 7], detail: &str| {
        let [
            certified,
            faces,
            charts,
            distortion,
            stretch,
            warnings,
            partly_done,
        ] = figures;
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
    };
    match &row.status {
        Status::Written(it) => {
            let figures = [
                it.certified.to_string(),
                it.faces.to_string(),
                it.charts.to_string(),
                number(it.distortion),
                number(it.stretch),
                it.warnings.to_string(),
                it.partly_done.to_string(),
            ];
            common("written", "", figures, "")
        }
        Status::Failed { code, detail } => common("failed", code, Default::default(), detail),
        Status::Missing => common("missing", "", Default::default(), ""),
    }
}
