//! What an asset has to be for a run to succeed.

use std::str::FromStr;

use super::row::{Figures, Row, Status};

/// One condition. An asset without an output meets none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Gate {
    /// There is an output.
    Written,
    /// Everything requested is proven of it.
    Certified,
    /// It has so many charts at most.
    MaxCharts(u64),
    /// The mean symmetric Dirichlet energy of its worst atlas is so large at most.
    MaxDistortion(f64),
    /// The 99th percentile of the stretch of its worst atlas is so large at most.
    MaxStretch(f64),
    /// It took so many seconds at most.
    MaxSeconds(f64),
}

/// Conditions, all of which an asset has to meet; written `max_charts=12,certified`.
#[derive(Clone, Debug, PartialEq)]
pub struct Gates(Vec<Gate>);

/// Why conditions cannot be read. Each names the part that is wrong.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum GateError {
    /// There is no such condition.
    #[error("{0:?} is not a gate: expected {WORDS}")]
    Unknown(String),
    /// A number is missing or cannot be read.
    #[error("{part:?} needs {expected}")]
    Value {
        /// The part.
        part: String,
        /// What it needs.
        expected: &'static str,
    },
    /// A condition that has no number has one.
    #[error("{0:?} takes no value")]
    NoValue(String),
}

const WORDS: &str = "written, certified, max_charts=N, max_distortion=E, max_stretch=S or \
                     max_seconds=T";

impl Default for Gates {
    /// Certified, as with the exit status of `unwrap`.
    fn default() -> Self {
        Self(vec![Gate::Certified])
    }
}

impl Gates {
    /// Whether an asset meets all conditions.
    pub fn accept(&self, row: &Row) -> bool {
        match &row.status {
            Status::Written(figures) => self.0.iter().all(|gate| gate.accepts(row, figures)),
            Status::Failed { .. } | Status::Missing => false,
        }
    }
}

impl Gate {
    fn accepts(self, row: &Row, figures: &Figures) -> bool {
        let is_within = |figure: Option<f64>, most: f64| figure.is_none_or(|figure| figure <= most);
        match self {
            Self::Written => true,
            Self::Certified => figures.certified,
            Self::MaxCharts(most) => figures.charts <= most,
            Self::MaxDistortion(most) => is_within(figures.distortion, most),
            Self::MaxStretch(most) => is_within(figures.stretch, most),
            Self::MaxSeconds(most) => row.seconds <= most,
        }
    }
}

impl FromStr for Gates {
    type Err = GateError;

    fn from_str(text: &str) -> Result<Self, GateError> {
        let gates = text.split(',').map(|part| part.trim().parse());
        gates.collect::<Result<_, _>>().map(Self)
    }
}

impl FromStr for Gate {
    type Err = GateError;

    fn from_str(part: &str) -> Result<Self, GateError> {
        let (word, value) = match part.split_once('=') {
            Some((word, value)) => (word, Some(value)),
            None => (part, None),
        };
        let needs = |expected| GateError::Value {
            part: part.to_owned(),
            expected,
        };
        let number = || {
            let number = value.and_then(|value| value.parse::<f64>().ok());
            let number = number.filter(|number| (0.0..).contains(number));
            number.ok_or(needs("a number, 0 or more"))
        };
        let gate = match word {
            "written" => Self::Written,
            "certified" => Self::Certified,
            "max_charts" => {
                let count = value.and_then(|value| value.parse().ok());
                return Ok(Self::MaxCharts(count.ok_or(needs("a whole number"))?));
            }
            "max_distortion" => return number().map(Self::MaxDistortion),
            "max_stretch" => return number().map(Self::MaxStretch),
            "max_seconds" => return number().map(Self::MaxSeconds),
            _ => return Err(GateError::Unknown(part.to_owned())),
        };
        match value {
            None => Ok(gate),
            Some(_) => Err(GateError::NoValue(part.to_owned())),
        }
    }
}
