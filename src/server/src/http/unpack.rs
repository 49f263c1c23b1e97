//! Uploads as one ZIP: an input with the files that it references. Other files stay packed.
//!
//! The declared sizes of an archive are checked first, and the unpacked bytes are counted. Files on disk get names
//! chosen by this program; the names in the archive are only the paths that the input uses.

use std::fs::File;
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

use sha2::{Digest as _, Sha256};
use zip::ZipArchive;
use zip::read::ZipFile;

use super::framing;
use super::parts::{MAX_FILES, at_most_name};
use super::problem::{Code, Problem};
use super::references::referenced;
use unwrapd_api::{Catalog, InputFile, Kind};

/// First bytes of archives, with and without files.
const SIGNATURES: [&[u8]; 2] = [b"PK\x03\x04", b"PK\x05\x06"];
/// Bytes per read. Larger blocks take more memory, smaller ones more system calls.
const BLOCK: usize = 64 << 10;

/// Files with their current paths, the input first.
pub(super) type Files = Vec<(InputFile, PathBuf)>;

/// Returns whether a file is an archive.
pub(super) fn is_archive(path: &Path) -> io::Result<bool> {
    let mut head = Vec::new();
    File::open(path)?.take(4).read_to_end(&mut head)?;
    Ok(SIGNATURES
        .iter()
        .any(|signature| head.starts_with(signature)))
}

/// An entry of an archive: its index and its name for the input.
type ArchiveEntry = (usize, String);

/// Unpacks an archive of at most `limit` bytes into its folder: first the input of a kind, then the files that it
/// references, named by the paths that it uses. Nothing else is unpacked.
pub(super) fn unpacked(
    catalog: &dyn Catalog,
    path: &Path,
    kind: Kind,
    limit: u64,
) -> Result<Files, Problem> {
    // Check the number and the declared size of the entries.
    let mut archive = ZipArchive::new(File::open(path)?).map_err(|e| invalid(&e))?;
    if MAX_FILES < archive.len() {
        let detail = format!("an upload can have at most {MAX_FILES} files");
        return Err(Problem::new(Code::UploadTooLarge, detail).with_limit(MAX_FILES as u64));
    }
    if (archive.decompressed_size()).is_some_and(|declared| u128::from(limit) < declared) {
        return Err(too_large(limit));
    }
    // Find the input, and name the other entries from its folder.
    let mut entries = Vec::new();
    for index in 0..archive.len() {
        let entry = archive.by_index(index).map_err(|e| invalid(&e))?;
        let name = name(&entry)?;
        if !entry.is_dir() && !is_of_a_system(&name) {
            entries.push((index, name));
        }
    }
    let mut entries = with_input_first(entries, kind)?.into_iter();
    let mut unpacker = Unpacker {
        archive,
        folder: path.parent().unwrap_or(Path::new(".")).to_owned(),
        left: limit,
        limit,
    };
    let input = entries.next().ok_or_else(|| invalid(&"it is empty"))?;
    let mut files = vec![unpacker.unpack(&input)?];

    // Unpack what the input references. Material files are unpacked early to read their own references.
    let others: Vec<ArchiveEntry> = entries.collect();
    let known = others.iter().map(|(_, name)| name.clone()).collect();
    let mut materials = Vec::new();
    let kept = referenced(
        catalog,
        kind,
        &input.1,
        &known,
        || Ok(std::fs::read(&files[0].1)?),
        |name| {
            let entry = others.iter().find(|(_, known)| known == name);
            let entry = entry.ok_or_else(|| invalid(&"an entry is gone"))?;
            let file = unpacker.unpack(entry)?;
            let content = std::fs::read(&file.1)?;
            materials.push(file);
            Ok(content)
        },
    )?;
    for entry in others.iter().filter(|(_, name)| kept.contains(name)) {
        match materials.iter().position(|(file, _)| file.name == entry.1) {
            Some(index) => files.push(materials.swap_remove(index)),
            None => files.push(unpacker.unpack(entry)?),
        }
    }
    Ok(files)
}

/// Unpacks entries of an archive until the limit is reached.
struct Unpacker {
    archive: ZipArchive<File>,
    folder: PathBuf,
    left: u64,
    limit: u64,
}

impl Unpacker {
    fn unpack(&mut self, (index, name): &ArchiveEntry) -> Result<(InputFile, PathBuf), Problem> {
        let entry = self.archive.by_index(*index).map_err(|e| invalid(&e))?;
        let place = self.folder.join(format!("unpacked-{index}"));
        let unpacked = unpack(entry, &place, self.left)?;
        let (bytes, sha256) = unpacked.ok_or_else(|| too_large(self.limit))?;
        self.left -= bytes;
        let file = InputFile {
            name: name.clone(),
            bytes,
            sha256: Some(sha256),
        };
        Ok((file, place))
    }
}

fn too_large(limit: u64) -> Problem {
    let detail = format!("an upload can have at most {limit} bytes, unpacked");
    Problem::new(Code::UploadTooLarge, detail).with_limit(limit)
}

/// Copies an entry and returns its size and its SHA-256; `None` if it has more than `left` bytes.
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

/// Returns the path of an entry within the archive.
fn name<R: Read>(entry: &ZipFile<'_, R>) -> Result<String, Problem> {
    let inside = entry.enclosed_name();
    let inside = inside.as_deref().and_then(Path::to_str);
    let name = inside.ok_or_else(|| invalid(&"the path of a file leads out of it"))?;
    at_most_name(name)?;
    Ok(name.replace('\\', "/"))
}

/// Returns whether an entry was added by an operating system.
fn is_of_a_system(name: &str) -> bool {
    let last = name.rsplit('/').next().unwrap_or(name);
    name.starts_with("__MACOSX/") || last == ".DS_Store" || last == "Thumbs.db"
}

/// Moves the only file of a format that the kind reads to the front, and renames the others in its folder relative to
/// it.
fn with_input_first(
    mut entries: Vec<ArchiveEntry>,
    kind: Kind,
) -> Result<Vec<ArchiveEntry>, Problem> {
    // Find the only input.
    let names = entries.iter().map(|(_, name)| name.as_str());
    let inputs: Vec<&str> = names.filter(|name| framing::is_named(name, kind)).collect();
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
    // Put it first, and name the others as it references them.
    let folder = Path::new(input)
        .parent()
        .unwrap_or(Path::new(""))
        .to_owned();
    let input = input.to_owned();
    entries.sort_by_key(|(_, name)| *name != input);
    for (_, name) in entries.iter_mut().skip(1) {
        if let Ok(inside) = Path::new(name).strip_prefix(&folder) {
            *name = inside.to_string_lossy().into_owned();
        }
    }
    Ok(entries)
}

fn invalid(error: &dyn std::fmt::Display) -> Problem {
    Problem::new(Code::InvalidArchive, error.to_string())
}
