//! The parts of a job's JSON that are read.

use serde::Deserialize;
use unwrapd_api::Failure;

/// A job as the service describes it.
#[derive(Deserialize)]
pub(super) struct Job {
    pub id: String,
    pub state: State,
    error: Option<Problem>,
    links: RemoteLinks,
}

/// State of a job.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum State {
    Succeeded,
    Failed,
    Cancelled,
    /// Queued, running, or any other state that is not final.
    #[serde(other)]
    Live,
}

/// Error description (RFC 9457).
#[derive(Deserialize)]
pub(super) struct Problem {
    pub code: String,
    pub detail: String,
}

#[derive(Deserialize)]
struct RemoteLinks {
    #[serde(rename = "self")]
    itself: String,
    files: Vec<RemoteFile>,
}

#[derive(Deserialize)]
struct RemoteFile {
    href: String,
}

impl State {
    pub fn is_final(self) -> bool {
        self != Self::Live
    }
}

impl Job {
    /// Returns the roles of its files, which are the ends of their paths.
    pub fn roles(&self) -> impl Iterator<Item = &str> {
        let own = format!("{}/", self.links.itself);
        let files = self.links.files.iter();
        files.filter_map(move |file| file.href.strip_prefix(&own))
    }

    /// Returns the cause of its failure.
    pub fn failure(self) -> Failure {
        let unknown = || Failure::new("internal_error", "the service gives no reason");
        self.error
            .map_or_else(unknown, |error| Failure::new(&error.code, error.detail))
    }
}
