//! What became of an asset: one line of the summary.

use serde::{Deserialize, Serialize};

use super::asset::Asset;
use unwrapd_api::{Failure, Worth};
use unwrapd_server::jobs::Gates;

/// What became of an asset.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Name of the input.
    pub input: String,
    /// Path of the output within the output folder.
    pub output: String,
    /// Seconds from reading the input to having the output in place.
    pub seconds: f64,
    /// How it ended.
    #[serde(flatten)]
    pub status: Status,
}

/// How an asset ended.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "status", rename_all = "snake_case")]
pub enum Status {
    /// There is an output.
    Written(Figures),
    /// There is none, for a reason.
    Failed {
        /// Stable snake_case word.
        code: String,
        /// One line.
        detail: String,
    },
    /// No run has recorded anything of it.
    Missing,
}

/// What an output is worth.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Figures {
    /// Whether everything requested is proven.
    pub certified: bool,
    /// Triangles.
    pub faces: u64,
    /// Charts of all atlases.
    pub charts: u64,
    /// Mean symmetric Dirichlet energy of the worst atlas; an isometry has 4.
    pub distortion: Option<f64>,
    /// 99th percentile of the stretch of the worst atlas; an isometry has 1.
    pub stretch: Option<f64>,
    /// Warnings in the report.
    pub warnings: u64,
    /// Whether a limit ended it before it was done.
    #[serde(default)]
    pub ended_early: bool,
    /// True if textures or colors were not resampled as requested. `unwrap` ends with 7 then.
    #[serde(default)]
    pub partly_done: bool,
}

impl Row {
    /// The row of an asset.
    pub(super) fn new(asset: &Asset, seconds: f64, status: Status) -> Self {
        Self {
            input: asset.name.clone(),
            output: asset.output.to_string_lossy().into_owned(),
            seconds,
            status,
        }
    }
}

impl Row {
    /// Whether the asset meets all gates. One without an output meets none.
    pub fn is_accepted(&self, gates: &Gates) -> bool {
        match &self.status {
            Status::Written(figures) => gates.accept(&figures.worth(), self.seconds),
            Status::Failed { .. } | Status::Missing => false,
        }
    }
}

impl From<Failure> for Status {
    fn from(Failure { code, detail }: Failure) -> Self {
        Self::Failed { code, detail }
    }
}

/// What is read of a report.
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
    /// What gates judge of them.
    fn worth(&self) -> Worth {
        Worth {
            certified: Some(self.certified),
            charts: Some(self.charts),
            distortion: self.distortion,
            stretch: self.stretch,
        }
    }

    /// What a report says.
    pub(super) fn of_report(report: &[u8]) -> serde_json::Result<Self> {
        let ReportRead {
            certified,
            partly_done,
            warnings,
            groups,
        } = serde_json::from_slice(report)?;
        let measures = || groups.iter().map(|group| &group.measures);
        Ok(Self {
            certified,
            faces: measures().map(|m| m.faces).sum(),
            charts: measures().map(|m| m.charts).sum(),
            distortion: measures()
                .filter_map(|m| m.sym_dirichlet_mean)
                .reduce(f64::max),
            stretch: measures().filter_map(|m| m.stretch_p99).reduce(f64::max),
            warnings: warnings.len() as u64,
            partly_done,
            ended_early: warnings.iter().any(|it| it.code == "ended_early"),
        })
    }
}
