//! Acceptance gates of results.

use std::fmt;
use std::str::FromStr;
use unwrapd_api::{Kind, Quality};

/// One gate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Gate {
    /// There is a result.
    Written,
    /// Every requested property is proven.
    Certified,
    /// It has at most this many charts.
    MaxCharts(u64),
    /// The mean symmetric Dirichlet energy of its worst atlas is at most this. The name is that of the option with
    /// the same bound; `max_symmetric_dirichlet` is accepted, too.
    MaxDistortion(f64),
    /// The 99th percentile of the stretch of its worst atlas is at most this.
    MaxStretch(f64),
    /// It took at most this many seconds.
    MaxSeconds(f64),
}

/// Gates that a result has to pass, all of them; written `max_charts=12,certified`.
#[derive(Clone, Debug, PartialEq)]
pub struct Gates(Vec<Gate>);

/// Reason why gates cannot be parsed or judged. Each names the offending part.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum GateError {
    /// There is no such gate.
    #[error("{0:?} is not a gate: expected {WORDS}")]
    Unknown(String),
    /// A number is missing or cannot be parsed.
    #[error("{part:?} needs {expected}")]
    Value {
        /// Offending part.
        part: String,
        /// Value that it needs.
        expected: &'static str,
    },
    /// A gate that takes no value has one.
    #[error("{0:?} takes no value")]
    NoValue(String),
    /// Jobs of this kind do not determine the quantity.
    #[error("{gate:?} cannot be judged: a {kind} job {lacks}")]
    Unjudged {
        /// The gate.
        gate: String,
        /// Kind of the job.
        kind: &'static str,
        /// Reason, in words such as "proves nothing".
        lacks: &'static str,
    },
}

const WORDS: &str = "written, certified, max_charts=N, max_distortion=E, max_stretch=S or \
                     max_seconds=T";

impl Default for Gates {
    /// Returns the `certified` gate, like the exit status of `unwrap`.
    fn default() -> Self {
        Self(vec![Gate::Certified])
    }
}

impl Gates {
    /// Returns whether a result that took this many seconds passes all gates.
    pub fn accept(&self, quality: &Quality, seconds: f64) -> bool {
        self.missed(quality, seconds).next().is_none()
    }

    /// Returns the gates that the result misses.
    pub fn missed(&self, quality: &Quality, seconds: f64) -> impl Iterator<Item = &Gate> {
        let is_missed = move |gate: &&Gate| !gate.accepts(quality, seconds);
        self.0.iter().filter(is_missed)
    }

    /// Checks that all gates can be judged for jobs of a kind.
    pub fn check(&self, kind: Kind) -> Result<(), GateError> {
        let unjudged = |(gate, lacks): (&Gate, &'static str)| GateError::Unjudged {
            gate: gate.to_string(),
            kind: kind.word(),
            lacks,
        };
        let mut lacking = self.0.iter().filter_map(|gate| match gate {
            Gate::Written | Gate::MaxSeconds(_) => None,
            Gate::Certified => (!kind.proves()).then_some((gate, "proves nothing")),
            _ => (!kind.measures()).then_some((gate, "measures no atlas")),
        });
        lacking.next().map_or(Ok(()), |found| Err(unjudged(found)))
    }
}

impl Gate {
    fn accepts(self, quality: &Quality, seconds: f64) -> bool {
        // A surface without area has no distortion, so it passes.
        let is_within = |figure: Option<f64>, most: f64| figure.is_none_or(|figure| figure <= most);
        match self {
            Self::Written => true,
            Self::Certified => quality.certified == Some(true),
            Self::MaxCharts(most) => quality.charts.is_none_or(|charts| charts <= most),
            Self::MaxDistortion(most) => is_within(quality.distortion, most),
            Self::MaxStretch(most) => is_within(quality.stretch, most),
            Self::MaxSeconds(most) => seconds <= most,
        }
    }
}

/// Writes the gate as it is parsed.
impl fmt::Display for Gate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Written => f.write_str("written"),
            Self::Certified => f.write_str("certified"),
            Self::MaxCharts(most) => write!(f, "max_charts={most}"),
            Self::MaxDistortion(most) => write!(f, "max_distortion={most}"),
            Self::MaxStretch(most) => write!(f, "max_stretch={most}"),
            Self::MaxSeconds(most) => write!(f, "max_seconds={most}"),
        }
    }
}

/// Writes the gates as they are parsed.
impl fmt::Display for Gates {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let gates: Vec<String> = self.0.iter().map(ToString::to_string).collect();
        f.write_str(&gates.join(","))
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
        // Split the name from its value.
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
        // Gates with a value return here; the others are checked for a stray value below.
        let gate = match word {
            "written" => Self::Written,
            "certified" => Self::Certified,
            "max_charts" => {
                let count = value.and_then(|value| value.parse().ok());
                return Ok(Self::MaxCharts(count.ok_or(needs("a whole number"))?));
            }
            "max_distortion" | "max_symmetric_dirichlet" => {
                return number().map(Self::MaxDistortion);
            }
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
