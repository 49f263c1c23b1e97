//! How running jobs are told what clients want of them.

use tokio_util::sync::CancellationToken;

/// How a live job is told what clients want of it.
#[derive(Clone, Default)]
pub(super) struct Control {
    pub cancel: CancellationToken,
    pub finish: CancellationToken,
}
