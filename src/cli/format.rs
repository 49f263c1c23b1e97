//! Format of a result: given by the extension of OUT, or by `--format` if it has none.

use std::path::Path;

use clap::ValueEnum;

use super::failure::Failure;
use super::output::is_stream;
use unwrapd_files::document::OutputFormat;
use unwrapd_files::io::Format;
use unwrapd_pipeline::BodyFormat;

/// Returns the format of a document to write.
pub(super) fn output_format(
    path: &Path,
    given: Option<OutputFormat>,
) -> Result<OutputFormat, Failure> {
    let format = agreed(path, given)?;
    if format == OutputFormat::Gltf && is_stream(path) {
        return Err(several_files(path));
    }
    Ok(format)
}

/// Returns the format of a body to write.
pub(super) fn body_format(path: &Path, given: Option<BodyFormat>) -> Result<BodyFormat, Failure> {
    let format = agreed(path, given)?;
    if format == BodyFormat::Gltf && is_stream(path) {
        return Err(several_files(path));
    }
    Ok(format)
}

/// Checks that a picture is written as PNG.
pub(super) fn check_png(path: &Path) -> Result<(), Failure> {
    let format = Format::of_name(&path.to_string_lossy());
    if format == Some(Format::Png) || is_stream(path) {
        return Ok(());
    }
    let name = path.display();
    Err(Failure::usage(format!(
        "{name}: the name of OUT must end in .png"
    )))
}

fn agreed<F: ValueEnum + PartialEq>(path: &Path, given: Option<F>) -> Result<F, Failure> {
    let extension = path.extension().unwrap_or_default().to_ascii_lowercase();
    let name = path.display();
    match (F::from_str(&extension.to_string_lossy(), false).ok(), given) {
        (Some(named), Some(given)) if named != given => Err(Failure::usage(format!(
            "{name}: --format contradicts the extension"
        ))),
        (_, Some(format)) | (Some(format), None) => Ok(format),
        (None, None) => {
            let values = F::value_variants().iter();
            let values = values.filter_map(ValueEnum::to_possible_value);
            let words: Vec<String> = values.map(|value| value.get_name().to_owned()).collect();
            Err(Failure::usage(format!(
                "{name}: unknown format: use one of the extensions .{}, or --format with one of {}",
                words.join(", ."),
                words.join(", ")
            )))
        }
    }
}

fn several_files(path: &Path) -> Failure {
    let name = path.display();
    Failure::usage(format!(
        "{name}: gltf consists of several files, which a stream cannot carry: use glb"
    ))
}
