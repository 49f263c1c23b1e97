//! What is said of a computation that had too little memory.
use unwrapd_api::Failure;

/// What a job is told that needs more than its share.
pub(super) fn out_of_memory(limit: u64) -> Failure {
    let detail = format!(
        "needs more than {} MiB, the memory limit of a job",
        limit >> 20
    );
    Failure::new("out_of_memory", detail)
}

/// What a job is told that the system ended for the memory of all.
pub(super) fn killed_for_memory() -> Failure {
    let detail = "the system ended it because the memory of the container or machine was used up";
    Failure::new("out_of_memory", detail)
}
