//! Uploads as one ZIP: an input with the files that it references.
//!
//! What an archive says of the sizes of its files is checked first, and what comes out of it is
//! counted. Files get names of this program's own; those of the archive are only what the input
//! calls them.

use std::fs::File;
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

use sha2::{Digest as _, Sha256};
use zip::ZipArchive;
use zip::read::ZipFile;

use super::framing;
use super::parts::{MAX_FILES, at_most_name};
use super::problem::{Code, Problem};
use crate::jobs::{InputFile, Kind};

/// What archives begin with, also those without files.
const SIGNATURES: [&[u8]; 2] = [b"PK\x03\x04", b"PK\x05\x06"];
/// Bytes that are read at once.
const BLOCK: usize = 64 << 10;

/// Files with the places where they lie, the input first.
pub(super) type Files = Vec<(InputFile, PathBuf)>;

/// Whether a file is an archive.
pub(super) fn is_archive(path: &Path) -> io::Result<bool> {
    let mut head = Vec::new();
    File::open(path)?.take(4).read_to_end(&mut head)?;
    Ok(SIGNATURES
        .iter()
        .any(|signature| head.starts_with(signature)))
}

/// Unpacks an archive of at most so many bytes into its folder: the input of a kind first, then all
/// others under the paths by which it references them.
pub(super) fn unpacked(path: &Path, kind: Kind, limit: u64) -> Result<Files, Problem> {
    let mut archive = ZipArchive::new(File::open(path)?).map_err(|e| invalid(&e))?;
    if MAX_FILES < archive.len() {
        let detail = format!("an upload can have at most {MAX_FILES} files");
        return Err(Problem::new(Code::UploadTooLarge, detail).with_limit(MAX_FILES as u64));
    }
    let too_large = || {
        let detail = format!("an upload can have at most {limit} bytes, unpacked");
        Problem::new(Code::UploadTooLarge, detail).with_limit(limit)
    };
    if (archive.decompressed_size()).is_some_and(|declared| u128::from(limit) < declared) {
        return Err(too_large());
    }
    let folder = path.parent().unwrap_or(Path::new("."));
    let (mut files, mut left) = (Vec::new(), limit);
    for index in 0..archive.len() {
        let entry = archive.by_index(index).map_err(|e| invalid(&e))?;
        let name = name(&entry)?;
        if entry.is_dir() || is_of_a_system(&name) {
            continue;
        }
        let place = folder.join(format!("unpacked-{index}"));
        let (bytes, sha256) = unpack(entry, &place, left)?.ok_or_else(too_large)?;
        left -= bytes;
        let file = InputFile {
            name,
            bytes,
            sha256: Some(sha256),
        };
        files.push((file, place));
    }
    with_input_first(files, kind)
}

/// Copies an entry and returns its size and its digest; none if it has more bytes than are left.
fn unpack(entry: impl Read, place: &Path, left: u64) -> Result<Option<(u64, String)>, Problem> {
    let mut file = File::create(place)?;
    let mut entry = entry.take(left.saturating_add(1));
    let (mut hash, mut bytes, mut block) = (Sha256::new(), 0, vec![0; BLOCK]);
    loop {
        let count = match entry.read(&mut block) {
            Ok(0) => return Ok((bytes <= left).then(|| (bytes, format!("{:x}", hash.finalize())))),
            Ok(count) => count,
            Err(error) if error.kind() == io::ErrorKind::Interrupted => continue,
            Err(error) => return Err(invalid(&error)),
        };
        bytes += count as u64;
        hash.update(&block[..count]);
        file.write_all(&block[..count])?;
    }
}

/// The path of an entry within the archive.
fn name<R: Read>(entry: &ZipFile<'_, R>) -> Result<String, Problem> {
    let inside = entry.enclosed_name();
    let inside = inside.as_deref().and_then(Path::to_str);
    let name = inside.ok_or_else(|| invalid(&"the path of a file leads out of it"))?;
    at_most_name(name)?;
    Ok(name.replace('\\', "/"))
}

/// What operating systems put into archives beside what was meant.
fn is_of_a_system(name: &str) -> bool {
    let last = name.rsplit('/').next().unwrap_or(name);
    name.starts_with("__MACOSX/") || last == ".DS_Store" || last == "Thumbs.db"
}

/// The only file that the kind reads first; the others below its folder are named from there.
fn with_input_first(mut files: Files, kind: Kind) -> Result<Files, Problem> {
    let is_input = |(file, _): &&(InputFile, PathBuf)| framing::is_named(&file.name, kind);
    let inputs: Vec<&str> = (files.iter().filter(is_input))
        .map(|(file, _)| file.name.as_str())
        .collect();
    let [input] = *inputs else {
        let found: Vec<&str> = inputs.iter().take(5).copied().collect();
        let (kind, count, found) = (kind.word(), inputs.len(), found.join(", "));
        let detail = format!("the archive has {count} inputs of {kind}, not one: {found}");
        let code = if count == 0 {
            Code::MissingMesh
        } else {
            Code::InvalidArchive
        };
        return Err(Problem::new(
            code,
            detail.trim_end_matches([':', ' ']).to_owned(),
        ));
    };
    let folder = Path::new(input)
        .parent()
        .unwrap_or(Path::new(""))
        .to_owned();
    let input = input.to_owned();
    files.sort_by_key(|(file, _)| file.name != input);
    for (file, _) in files.iter_mut().skip(1) {
        if let Ok(name) = Path::new(&file.name).strip_prefix(&folder) {
            file.name = name.to_string_lossy().into_owned();
        }
    }
    Ok(files)
}

fn invalid(error: &dyn std::fmt::Display) -> Problem {
    Problem::new(Code::InvalidArchive, error.to_string())
}
