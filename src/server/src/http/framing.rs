//! Check of received files before a job is accepted.
//!
//! It looks only at the outermost layer of each format. A file that passes may still turn out to be unusable, which
//! then fails the job.

use std::fs::File;
use std::io::{BufReader, Read, Seek, SeekFrom};
use std::path::Path;

use serde::Deserialize;
use serde::de::IgnoredAny;

use super::problem::{Code, Problem};
use unwrapd_api::{Catalog, Failure, Format, Kind, SEARCHED_BYTES, without_mark};

/// Returns whether a name has an extension of the formats that the kind reads.
pub(super) fn is_named(name: &str, kind: Kind) -> bool {
    Format::of_name(name).is_some_and(|format| format.holds(kind.reads()))
}

/// Detects the format of a file, among those that the kind reads.
pub(super) fn format(catalog: &dyn Catalog, path: &Path, kind: Kind) -> Result<Format, Problem> {
    // Detect the format from the first bytes.
    let mut file = File::open(path)?;
    let size = file.metadata()?.len();
    let mut head = Vec::new();
    (&mut file)
        .take(SEARCHED_BYTES as u64)
        .read_to_end(&mut head)?;
    let format = catalog.format(&head, size, kind.reads());
    // Check the framing of glTF: its JSON must be complete and well-formed.
    match format {
        Some(Format::Glb) => glb(&mut file, size)?,
        Some(Format::Gltf) => {
            let mark = head.len() - without_mark(&head).len();
            file.seek(SeekFrom::Start(mark as u64))?;
            json(BufReader::new(file))?;
        }
        _ => {}
    }
    format.ok_or_else(|| {
        let formats = Format::that_hold(kind.reads());
        let words: Vec<&str> = formats.flat_map(Format::extensions).copied().collect();
        let detail = format!("{} reads {}", kind.word(), words.join(", "));
        Problem::new(Code::UnknownFormat, detail)
    })
}

fn invalid(detail: impl Into<String>) -> Problem {
    Problem::new(Code::InvalidGltf, detail)
}

/// Checks a GLB: a header of twelve bytes, then a JSON chunk that lies within the file.
fn glb(file: &mut File, size: u64) -> Result<(), Problem> {
    let mut header = [0; 20];
    file.seek(SeekFrom::Start(0))?;
    file.read_exact(&mut header)
        .map_err(|_| invalid("the GLB header is cut off"))?;
    let number = |at: usize| {
        u32::from_le_bytes([header[at], header[at + 1], header[at + 2], header[at + 3]])
    };
    if number(4) != 2 {
        let detail = format!("GLB version {} is not 2", number(4));
        let failure = Failure::new("unsupported_version", detail);
        return Err(Problem::of_failure(&failure));
    }
    let length = u64::from(number(12));
    if &header[16..20] != b"JSON" || size < 20 + length {
        return Err(invalid("the GLB has no complete JSON chunk"));
    }
    json(BufReader::new(file.take(length)))
}

/// Checks that there is one JSON value, without keeping it. Any padding may follow.
fn json(reader: impl Read) -> Result<(), Problem> {
    IgnoredAny::deserialize(&mut serde_json::Deserializer::from_reader(reader))
        .map(|_| ())
        .map_err(|error| invalid(format!("the JSON is malformed: {error}")))
}
