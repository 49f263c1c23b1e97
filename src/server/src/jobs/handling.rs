//! Client settings of a job beside what it computes: gates, metadata and webhook.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};
use sha2::{Digest as _, Sha256};
use url::Url;

use unwrapd_api::{InputFile, Kind, Quality};

/// Handling of a job; jobs that compute the same may be handled differently.
#[derive(Clone, Debug, Default)]
pub struct Handling {
    /// Priority: of an owner's waiting jobs, those with a higher one start first.
    pub priority: i32,
    /// Notes of the client.
    pub metadata: Metadata,
    /// Gates that the result has to pass.
    pub accept: Option<Gates>,
    /// Webhook that is told of the end.
    pub webhook: Option<Webhook>,
}

impl Handling {
    /// Returns the digest of everything that a request with the same idempotency key must repeat. `digest` is that of
    /// its computation. The priority may differ.
    pub fn fingerprint(&self, digest: &str) -> String {
        let Self {
            metadata,
            accept,
            webhook,
            ..
        } = self;
        // Without settings the fingerprint is the digest alone, as in earlier versions, so that stored keys stay valid.
        if metadata.is_empty() && accept.is_none() && webhook.is_none() {
            return digest.to_owned();
        }
        let mut all = Digest::default();
        all.add(digest.as_bytes());
        for label in metadata.labels() {
            all.add(label.as_bytes());
        }
        let accept = accept.as_ref().map(ToString::to_string);
        let webhook = webhook.as_ref().map(ToString::to_string);
        for said in [accept, webhook] {
            all.add(said.unwrap_or_default().as_bytes());
        }
        all.finish()
    }
}

// Acceptance gates of results.

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
        (self.0.iter()).filter(move |gate| !gate.accepts(quality, seconds))
    }

    /// Checks that all gates can be judged for jobs of a kind.
    pub fn check(&self, kind: Kind) -> Result<(), GateError> {
        for gate in &self.0 {
            let (is_judged, lacks) = match gate {
                Gate::Written | Gate::MaxSeconds(_) => continue,
                Gate::Certified => (kind.proves(), "proves nothing"),
                _ => (kind.measures(), "measures no atlas"),
            };
            if !is_judged {
                return Err(GateError::Unjudged {
                    gate: gate.to_string(),
                    kind: kind.word(),
                    lacks,
                });
            }
        }
        Ok(())
    }
}

impl Gate {
    fn accepts(self, quality: &Quality, seconds: f64) -> bool {
        // A surface without area has no distortion, so it passes.
        match self {
            Self::Written => true,
            Self::Certified => quality.certified == Some(true),
            Self::MaxCharts(most) => quality.charts.is_none_or(|charts| charts <= most),
            Self::MaxDistortion(most) => quality.distortion.is_none_or(|it| it <= most),
            Self::MaxStretch(most) => quality.stretch.is_none_or(|it| it <= most),
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
        // Gates with a value return here; the others are checked for a stray value below.
        let gate = match word {
            "written" => Self::Written,
            "certified" => Self::Certified,
            "max_charts" => {
                let count = value.and_then(|value| value.parse().ok());
                let count = count.ok_or_else(|| lacks_value(part, "a whole number"))?;
                return Ok(Self::MaxCharts(count));
            }
            "max_distortion" | "max_symmetric_dirichlet" => {
                return number(part, value).map(Self::MaxDistortion);
            }
            "max_stretch" => return number(part, value).map(Self::MaxStretch),
            "max_seconds" => return number(part, value).map(Self::MaxSeconds),
            _ => return Err(GateError::Unknown(part.to_owned())),
        };
        match value {
            None => Ok(gate),
            Some(_) => Err(GateError::NoValue(part.to_owned())),
        }
    }
}

/// Parses the value of a gate whose limit is a number.
fn number(part: &str, value: Option<&str>) -> Result<f64, GateError> {
    let number = value.and_then(|value| value.parse::<f64>().ok());
    let number = number.filter(|number| (0.0..).contains(number));
    number.ok_or_else(|| lacks_value(part, "a number, 0 or more"))
}

fn lacks_value(part: &str, expected: &'static str) -> GateError {
    GateError::Value {
        part: part.to_owned(),
        expected,
    }
}

// Client metadata of jobs.

/// Limits of the JSON text in bytes, and of its members. The text is stored with the job and repeated in every view
/// of it; each member is a row in the table of labels.
const MOST_BYTES: usize = 4096;
const MOST_MEMBERS: usize = 64;

/// Client metadata: a JSON object that is repeated wherever the job is shown, and by whose members jobs can be found.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Metadata(Map<String, Value>);

/// Error for a text that is not metadata.
#[derive(Debug, thiserror::Error)]
pub enum MetadataError {
    /// It is not a JSON object.
    #[error("metadata is not a JSON object: {0}")]
    Malformed(#[from] serde_json::Error),
    /// It is too large.
    #[error("metadata can have at most {MOST_BYTES} bytes of JSON and {MOST_MEMBERS} members")]
    TooLarge,
}

impl Metadata {
    /// Returns whether there are no members.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Returns a digest of each member, name and value, for lookups.
    pub fn labels(&self) -> Vec<String> {
        let labels = self.0.iter().map(|(name, value)| {
            let mut label = Digest::default();
            label.add(name.as_bytes());
            label.add(value.to_string().as_bytes());
            label.finish()
        });
        labels.collect()
    }

    /// Returns the texts that a person knows a job by: the members `name` and `path`, and the names of members that are
    /// `true`, which are tags.
    pub fn texts(&self) -> impl Iterator<Item = &str> {
        self.0.iter().filter_map(|(name, value)| match value {
            Value::String(text) if name == "name" || name == "path" => Some(text.as_str()),
            Value::Bool(true) => Some(name.as_str()),
            _ => None,
        })
    }
}

impl FromStr for Metadata {
    type Err = MetadataError;

    fn from_str(text: &str) -> Result<Self, MetadataError> {
        if MOST_BYTES < text.len() {
            return Err(MetadataError::TooLarge);
        }
        let metadata: Self = serde_json::from_str(text)?;
        if MOST_MEMBERS < metadata.0.len() {
            return Err(MetadataError::TooLarge);
        }
        Ok(metadata)
    }
}

// Webhook addresses.

/// Maximum length of an address in bytes, by convention. The address is stored with the job and with its notice.
const MOST_WEBHOOK_BYTES: usize = 2048;

/// Address to which the end of a job is posted.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Webhook(Url);

/// Error for a text that is not a webhook address.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum WebhookError {
    /// It is not an HTTP address.
    #[error("it is not an address that begins with http:// or https://")]
    NoAddress,
    /// It is too long.
    #[error("it can have at most {MOST_WEBHOOK_BYTES} bytes")]
    TooLong,
    /// It has a user name or a password.
    #[error("it must not contain credentials: deliveries are signed")]
    Credentials,
}

impl Webhook {
    /// Returns the address.
    pub fn url(&self) -> &Url {
        &self.0
    }
}

impl fmt::Display for Webhook {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl FromStr for Webhook {
    type Err = WebhookError;

    fn from_str(text: &str) -> Result<Self, WebhookError> {
        if MOST_WEBHOOK_BYTES < text.len() {
            return Err(WebhookError::TooLong);
        }
        let url: Url = text.parse().map_err(|_| WebhookError::NoAddress)?;
        if !matches!(url.scheme(), "http" | "https") || url.host().is_none() {
            return Err(WebhookError::NoAddress);
        }
        if !url.username().is_empty() || url.password().is_some() {
            return Err(WebhookError::Credentials);
        }
        Ok(Self(url))
    }
}

// Digests of work requests.

/// SHA-256 of a sequence of texts. Lengths are hashed too, so different sequences never hash the same bytes.
#[derive(Clone, Debug, Default)]
pub struct Digest(Sha256);

impl Digest {
    /// Adds a text with its length.
    pub fn add(&mut self, text: &[u8]) {
        self.0.update((text.len() as u64).to_le_bytes());
        self.0.update(text);
    }

    /// Returns the digest of a job of this kind with these options and input files.
    pub fn of_job<'a>(
        kind: Kind,
        options: &Value,
        files: impl Iterator<Item = &'a InputFile>,
    ) -> String {
        let mut digest = Self::default();
        digest.add(kind.word().as_bytes());
        digest.add(options.to_string().as_bytes());
        for file in files {
            digest.add(file.name.as_bytes());
            digest.add(file.sha256.as_deref().unwrap_or_default().as_bytes());
        }
        digest.finish()
    }

    /// Returns the digest in hexadecimal digits.
    pub fn finish(self) -> String {
        format!("{:x}", self.0.finalize())
    }
}
