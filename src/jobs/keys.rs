//! The names under which blobs of a job are stored.

use super::job::JobId;

pub(super) fn input_key(id: JobId, index: usize) -> String {
    format!("{id}/input/{index}")
}

pub(super) fn output_key(id: JobId, index: usize) -> String {
    format!("{id}/output/{index}")
}
