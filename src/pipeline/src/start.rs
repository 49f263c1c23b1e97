//! Start files: initial maps beside an input.

use crate::PipelineError;
use unwrapd_api::START;
use unwrapd_deform::ProblemError;
use unwrapd_files::document::Upload;

/// Reads the start file beside the input, if there is one. It must have `expected` coordinates.
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

/// Parses numbers separated by blanks.
pub(super) fn numbers(bytes: &[u8]) -> Option<Vec<f64>> {
    let text = std::str::from_utf8(bytes).ok()?;
    text.split_ascii_whitespace()
        .map(|word| word.parse().ok())
        .collect()
}

/// Returns the content of a start file for positions as text.
///
/// # Errors
/// If a word is not a number.
pub fn start_file_of_text(text: &[u8]) -> Result<Vec<u8>, PipelineError> {
    let malformed = || PipelineError::InvalidOptions("the start is not a list of numbers".into());
    Ok(start_file(&numbers(text).ok_or_else(malformed)?))
}

/// Returns the content of a start file.
pub fn start_file(coordinates: &[f64]) -> Vec<u8> {
    coordinates.iter().flat_map(|x| x.to_le_bytes()).collect()
}
