//! What a result is written as: by the extension of OUT, or by `--format` where that has none.

use std::path::Path;

use super::failure::Failure;
use super::output::is_stream;
use super::words::{BODY_FORMATS, FORMATS};
use crate::document::OutputFormat;
use crate::pipeline::BodyFormat;

/// The format of a document to write.
pub(super) fn output_format(
    path: &Path,
    given: Option<OutputFormat>,
) -> Result<OutputFormat, Failure> {
    let format = agreed(path, given, FORMATS, |extension| match extension {
        "glb" => Some(OutputFormat::Glb),
        "gltf" => Some(OutputFormat::Gltf),
        "obj" => Some(OutputFormat::Obj),
        _ => None,
    })?;
    if format == OutputFormat::Gltf && is_stream(path) {
        return Err(several_files(path));
    }
    Ok(format)
}

/// The format of a body to write.
pub(super) fn body_format(path: &Path, given: Option<BodyFormat>) -> Result<BodyFormat, Failure> {
    let format = agreed(path, given, BODY_FORMATS, BodyFormat::of_extension)?;
    if format == BodyFormat::Gltf && is_stream(path) {
        return Err(several_files(path));
    }
    Ok(format)
}

/// Pictures are PNG.
pub(super) fn check_png(path: &Path) -> Result<(), Failure> {
    let extension = path.extension().unwrap_or_default();
    if extension.eq_ignore_ascii_case("png") || is_stream(path) {
        return Ok(());
    }
    let name = path.display();
    Err(Failure::usage(format!("{name}: OUT must end in .png")))
}

fn agreed<T: PartialEq>(
    path: &Path,
    given: Option<T>,
    words: &[&str],
    of_extension: impl Fn(&str) -> Option<T>,
) -> Result<T, Failure> {
    let extension = path.extension().unwrap_or_default().to_ascii_lowercase();
    let (name, words) = (path.display(), words.join(", "));
    match (of_extension(&extension.to_string_lossy()), given) {
        (Some(named), Some(given)) if named != given => Err(Failure::usage(format!(
            "{name}: --format and the extension are at odds"
        ))),
        (_, Some(format)) | (Some(format), None) => Ok(format),
        (None, None) => Err(Failure::usage(format!(
            "{name}: the format is not known: OUT ends in one of .{}, or --format is one of {words}",
            words.replace(", ", ", .")
        ))),
    }
}

fn several_files(path: &Path) -> Failure {
    let name = path.display();
    Failure::usage(format!(
        "{name}: gltf is several files, which do not go into a stream: glb does"
    ))
}
