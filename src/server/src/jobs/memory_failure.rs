//! Failures of computations that run out of memory.
use unwrapd_api::Failure;

/// Returns the failure of a job that exceeds its memory limit of `limit` bytes.
pub(super) fn out_of_memory(limit: u64) -> Failure {
    let detail = format!(
        "needs more than {} MiB, the memory limit of a job",
        limit >> 20
    );
    Failure::new("out_of_memory", detail)
}

/// Returns the failure of a job that the system killed because the container or machine ran out of memory.
pub(super) fn killed_for_memory() -> Failure {
    let detail = "the system ended it because the memory of the container or machine was used up";
    Failure::new("out_of_memory", detail)
}
