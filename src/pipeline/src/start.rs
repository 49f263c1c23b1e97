//! Maps at which work starts, as files beside its input.

use crate::PipelineError;
use unwrapd_api::START;
use unwrapd_deform::ProblemError;
use unwrapd_files::document::Upload;

/// The `expected` coordinates of the start, if there is one beside the input.
pub(super) fn start(upload: &Upload, expected: usize) -> Result<Option<Vec<f64>>, PipelineError> {
    let Some(bytes) = upload.resources.get(START) else {
        return Ok(None);
    };
    let (numbers, rest) = bytes.as_chunks::<8>();
    let start: Vec<f64> = numbers.iter().map(|&x| f64::from_le_bytes(x)).collect();
    if start.len() != expected || !rest.is_empty() {
        let found = start.len();
        return Err(ProblemError::WrongStart { found, expected }.into());
    }
    if !start.iter().all(|x| x.is_finite()) {
        let text = "a coordinate of the start is not a finite number".to_owned();
        return Err(PipelineError::InvalidOptions(text));
    }
    Ok(Some(start))
}

/// The file of a start.
pub fn start_file(coordinates: &[f64]) -> Vec<u8> {
    coordinates.iter().flat_map(|x| x.to_le_bytes()).collect()
}
