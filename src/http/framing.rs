//! Whether a received file is one that a kind of job works on at all: looked at before a job is accepted.
//!
//! This knows the outermost layer of each format and nothing of what is inside; a file that passes may still turn out
//! to be unusable, which then is the job's failure.

use std::fs::File;
use std::io::{BufReader, Read, Seek, SeekFrom};
use std::path::Path;

use serde::Deserialize;
use serde::de::IgnoredAny;

use super::problem::{Code, Problem};
use crate::jobs::{Failure, Kind};

/// How much of a text is searched for the words of its format.
const SEARCHED_BYTES: u64 = 1 << 20;

const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";

/// The formats that a kind of job reads, as file name extensions.
fn formats(kind: Kind) -> &'static [&'static str] {
    match kind {
        Kind::Unwrap | Kind::Measure | Kind::EditUv | Kind::TextureMap | Kind::Repack => {
            &["glb", "gltf", "obj", "off", "ply", "stl"]
        }
        Kind::Solve => &["json"],
        Kind::Deform => &[
            "glb", "gltf", "obj", "off", "ply", "stl", "msh", "mesh", "tet", "png", "svg",
        ],
        Kind::Warp => &["png", "jpg", "jpeg"],
    }
}

/// Whether a name ends like those of a kind's files.
pub(super) fn is_named(name: &str, kind: Kind) -> bool {
    let extension = name.rsplit_once('.').map(|(_, e)| e.to_ascii_lowercase());
    extension.is_some_and(|extension| formats(kind).contains(&extension.as_str()))
}

/// The file name extension of the format that the file is in, one of those that the kind reads.
pub(super) fn extension(path: &Path, kind: Kind) -> Result<&'static str, Problem> {
    let mut file = File::open(path)?;
    let size = file.metadata()?.len();
    let mut head = Vec::new();
    (&mut file).take(SEARCHED_BYTES).read_to_end(&mut head)?;
    let format = format(&head, size, kind).filter(|format| formats(kind).contains(format));
    match format {
        Some("glb") => glb(&mut file, size)?,
        Some("gltf") => {
            file.seek(SeekFrom::Start(if is_marked(&head) { 3 } else { 0 }))?;
            json(BufReader::new(file))?;
        }
        _ => {}
    }
    format.ok_or_else(|| {
        let detail = format!("{} reads {}", kind.word(), formats(kind).join(", "));
        Problem::new(Code::UnknownFormat, detail)
    })
}

/// The format by the first bytes of a file and its size.
fn format(head: &[u8], size: u64, kind: Kind) -> Option<&'static str> {
    let text = head[if is_marked(head) { 3 } else { 0 }..].trim_ascii_start();
    Some(if head.starts_with(b"glTF") {
        "glb"
    } else if head.starts_with(b"\x89PNG") {
        "png"
    } else if head.starts_with(b"\xff\xd8\xff") {
        "jpg"
    } else if text.starts_with(b"{") {
        if kind == Kind::Solve { "json" } else { "gltf" }
    } else if text.starts_with(b"<") && contains(text, b"<svg") {
        "svg"
    } else if text.starts_with(b"$MeshFormat") {
        "msh"
    } else if text.starts_with(b"MeshVersionFormatted") {
        "mesh"
    } else if text.starts_with(b"ply") {
        "ply"
    } else if is_off(text) {
        "off"
    } else if is_stl(head, size) {
        "stl"
    } else if is_tet(text) {
        "tet"
    } else if is_obj(text) {
        "obj"
    } else {
        return None;
    })
}

fn is_marked(head: &[u8]) -> bool {
    head.starts_with(BYTE_ORDER_MARK)
}

fn invalid(detail: impl Into<String>) -> Problem {
    Problem::new(Code::InvalidGltf, detail)
}

/// Header of twelve bytes, then a JSON chunk that lies within the file.
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

/// One JSON value. It is parsed without being kept; padding of any kind may follow.
fn json(reader: impl Read) -> Result<(), Problem> {
    IgnoredAny::deserialize(&mut serde_json::Deserializer::from_reader(reader))
        .map(|_| ())
        .map_err(|error| invalid(format!("the JSON is malformed: {error}")))
}

/// `OFF`, or with letters before it for what vertices have beside positions.
fn is_off(text: &[u8]) -> bool {
    let word = text
        .split(u8::is_ascii_whitespace)
        .next()
        .unwrap_or_default();
    word.ends_with(b"OFF") && word.len() <= 7 && word.iter().all(u8::is_ascii_alphanumeric)
}

/// Text with facets, or 84 bytes and 50 for each of the triangles that it announces.
fn is_stl(head: &[u8], size: u64) -> bool {
    if head.trim_ascii_start().starts_with(b"solid") && contains(head, b"facet") {
        return true;
    }
    head.get(80..84)
        .and_then(|count| count.try_into().ok())
        .is_some_and(|count| size == 84 + 50 * u64::from(u32::from_le_bytes(count)))
}

/// A first line of two numbers: how many vertices, how many tetrahedra.
fn is_tet(text: &[u8]) -> bool {
    let line = text.split(|byte| *byte == b'\n').next().unwrap_or_default();
    let words = line.split(u8::is_ascii_whitespace);
    let words: Vec<&[u8]> = words.filter(|word| !word.is_empty()).collect();
    words.len() == 2 && words.concat().iter().all(u8::is_ascii_digit)
}

/// Text with a line that is a vertex.
fn is_obj(text: &[u8]) -> bool {
    let is_vertex = |line: &[u8]| {
        let line = line.trim_ascii_start();
        line.starts_with(b"v ") || line.starts_with(b"v\t")
    };
    !text.contains(&0)
        && text
            .split(|byte| matches!(byte, b'\n' | b'\r'))
            .any(is_vertex)
}

fn contains(text: &[u8], word: &[u8]) -> bool {
    text.windows(word.len()).any(|window| window == word)
}
