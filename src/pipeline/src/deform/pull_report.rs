//! Reports of maps deformed by handles.

use serde::Serialize;

use unwrapd_deform::PullSummary;
use unwrapd_maps::certificate::PlanarCertificate;

/// Report on a map that handles pulled.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct PullReport {
    /// Outcome and cost of pulling it.
    #[serde(flatten)]
    pub summary: PullSummary,
    /// Pairs of boundary edges that cross or touch, exactly, before the map is rounded for a file.
    pub crossings: u64,
    /// `true` if every triangle is positive and no two overlap: the certificate's conclusion.
    pub bijective: bool,
    /// Facts about the result, proven by exact predicates.
    #[serde(flatten)]
    pub certificate: PlanarCertificate,
}

impl PullReport {
    pub(crate) fn new(
        summary: PullSummary,
        crossings: u64,
        certificate: PlanarCertificate,
    ) -> Self {
        Self {
            summary,
            crossings,
            bijective: certificate.is_bijective(),
            certificate,
        }
    }
}
