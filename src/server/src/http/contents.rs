//! Contents of uploads: the formats of files, the files that an input references, and archives.
//!
//! A check looks only at the outermost layer of each format. A file that passes may still turn out to be unusable,
//! which then fails the job.

use std::collections::BTreeSet;
use std::fs::File;
use std::io::{self, BufReader, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use serde::Deserialize;
use serde::de::IgnoredAny;
use serde_json::Value;
use sha2::{Digest as _, Sha256};
use zip::ZipArchive;
use zip::read::ZipFile;

use super::problem::{Code, Problem};
use unwrapd_api::{
    Catalog, Content, Failure, Format, InputFile, Kind, SEARCHED_BYTES, START, Upload, without_mark,
};

/// Returns whether a name has an extension of the formats that the kind reads.
pub(super) fn is_named(name: &str, kind: Kind) -> bool {
    Format::of_name(name).is_some_and(|format| format.holds(kind.reads()))
}

/// Detects the format of a file, among those that the kind reads.
pub(super) fn detect_format(
    catalog: &dyn Catalog,
    path: &Path,
    kind: Kind,
) -> Result<Format, Problem> {
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
        Some(Format::Glb) => check_glb(&mut file, size)?,
        Some(Format::Gltf) => {
            let mark = head.len() - without_mark(&head).len();
            file.seek(SeekFrom::Start(mark as u64))?;
            check_json(BufReader::new(file))?;
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

fn invalid_gltf(detail: impl Into<String>) -> Problem {
    Problem::new(Code::InvalidGltf, detail)
}

/// Checks a GLB: a header of twelve bytes, then a JSON chunk that lies within the file.
fn check_glb(file: &mut File, size: u64) -> Result<(), Problem> {
    let mut header = [[0; 4]; 5];
    file.seek(SeekFrom::Start(0))?;
    file.read_exact(header.as_flattened_mut())
        .map_err(|_| invalid_gltf("the GLB header is cut off"))?;
    let [_, version, _, length, chunk] = header;
    let version = u32::from_le_bytes(version);
    if version != 2 {
        let detail = format!("GLB version {version} is not 2");
        let failure = Failure::new("unsupported_version", detail);
        return Err(Problem::of_failure(&failure));
    }
    let length = u64::from(u32::from_le_bytes(length));
    if &chunk != b"JSON" || size < 20 + length {
        return Err(invalid_gltf("the GLB has no complete JSON chunk"));
    }
    check_json(BufReader::new(file.take(length)))
}

/// Checks that there is one JSON value, without keeping it. Any padding may follow.
fn check_json(reader: impl Read) -> Result<(), Problem> {
    IgnoredAny::deserialize(&mut serde_json::Deserializer::from_reader(reader))
        .map(|_| ())
        .map_err(|error| invalid_gltf(format!("the JSON is malformed: {error}")))
}

// Selection of the files that an input references. A job keeps its files for weeks, and unused ones would waste
// space.

/// Lock that lets only one input at a time be in memory to find its references: it may be as large as an upload.
static ONE_INPUT: Mutex<()> = Mutex::new(());

/// Returns the names among `known` that an input of a kind references. `input` reads the input, and `material` a
/// material file by name. An input without other files is not read.
pub(super) fn referenced(
    catalog: &dyn Catalog,
    kind: Kind,
    name: &str,
    known: &BTreeSet<String>,
    input: impl FnOnce() -> Result<Vec<u8>, Problem>,
    material: impl FnMut(&str) -> Result<Vec<u8>, Problem>,
) -> Result<BTreeSet<String>, Problem> {
    // The rest shapes of an untangled mesh are named by an option.
    if known.is_empty() || kind == Kind::Untangle {
        return Ok(known.clone());
    }
    let _one_input = ONE_INPUT.lock().unwrap_or_else(PoisonError::into_inner);
    let bytes = input()?;
    let mut names = match kind.reads() {
        Content::Problem => of_problem(&bytes, known),
        _ => of_surface(catalog, Upload::single(name, bytes), known, material)?,
    };
    names.insert(START.to_owned());
    Ok(names.intersection(known).cloned().collect())
}

/// Returns the references of a mesh and of its material files. Only OBJ has material files.
fn of_surface(
    catalog: &dyn Catalog,
    mut upload: Upload,
    known: &BTreeSet<String>,
    mut material: impl FnMut(&str) -> Result<Vec<u8>, Problem>,
) -> Result<BTreeSet<String>, Problem> {
    let names = catalog.references(&upload);
    if catalog.format_of(&upload) != Some(Format::Obj) {
        return Ok(names);
    }
    for name in names.intersection(known) {
        let content = material(name)?;
        upload.resources.insert(name.clone(), content);
    }
    Ok(catalog.references(&upload))
}

/// Returns the files named by the strings of a problem file, by path or by name alone. If it is not JSON, returns all
/// files; it is rejected later.
fn of_problem(bytes: &[u8], known: &BTreeSet<String>) -> BTreeSet<String> {
    let Ok(problem) = serde_json::from_slice::<Value>(bytes) else {
        return known.clone();
    };
    let mut words = BTreeSet::new();
    gather_words(&problem, &mut words);
    let names = words
        .iter()
        .flat_map(|word| [Some(*word), word.rsplit('/').next()]);
    let names: BTreeSet<&str> = names.flatten().collect();
    let named = known.iter().filter(|name| names.contains(name.as_str()));
    named.cloned().collect()
}

fn gather_words<'a>(value: &'a Value, words: &mut BTreeSet<&'a str>) {
    match value {
        Value::String(word) => drop(words.insert(word)),
        Value::Array(values) => values.iter().for_each(|value| gather_words(value, words)),
        Value::Object(members) => members
            .values()
            .for_each(|value| gather_words(value, words)),
        _ => {}
    }
}

// Uploads as one ZIP: an input with the files that it references. Other files stay packed.
//
// The declared sizes of an archive are checked first, and the unpacked bytes are counted. Files on disk get names
// chosen by this program; the names in the archive are only the paths that the input uses.

/// First bytes of archives, with and without files.
const SIGNATURES: [&[u8]; 2] = [b"PK\x03\x04", b"PK\x05\x06"];
/// Bytes per read. Larger blocks take more memory, smaller ones more system calls.
const BLOCK: usize = 64 << 10;

/// Maximum number of files of an upload. Each is a file on disk and an entry of the record.
pub(super) const MAX_FILES: usize = 4096;
/// Maximum length of a resource path in bytes. With `MAX_FILES`, it bounds the names in a record to 4 MiB.
const MAX_NAME: usize = 1024;

/// Files with their current paths, the input first.
pub(super) type Files = Vec<(InputFile, PathBuf)>;

/// Rejects file paths that are too long.
pub(super) fn at_most_name(name: &str) -> Result<(), Problem> {
    at_most(name, MAX_NAME)
}

/// Rejects file names of more than `bytes` bytes.
pub(super) fn at_most(name: &str, bytes: usize) -> Result<(), Problem> {
    if name.len() <= bytes {
        return Ok(());
    }
    let detail = format!("a file name can have at most {bytes} bytes");
    Err(Problem::new(Code::InvalidRequest, detail))
}

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
    let mut archive = ZipArchive::new(File::open(path)?).map_err(|e| invalid_archive(&e))?;
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
        let entry = archive.by_index(index).map_err(|e| invalid_archive(&e))?;
        let name = entry_name(&entry)?;
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
    let input = entries
        .next()
        .ok_or_else(|| invalid_archive(&"it is empty"))?;
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
            let entry = entry.ok_or_else(|| invalid_archive(&"an entry is gone"))?;
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
        let entry = self
            .archive
            .by_index(*index)
            .map_err(|e| invalid_archive(&e))?;
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
            Err(error) => return Err(invalid_archive(&error)),
        };
        bytes += count as u64;
        hash.update(&block[..count]);
        file.write_all(&block[..count])?;
    }
}

/// Returns the path of an entry within the archive.
fn entry_name<R: Read>(entry: &ZipFile<'_, R>) -> Result<String, Problem> {
    let inside = entry.enclosed_name();
    let inside = inside.as_deref().and_then(Path::to_str);
    let name = inside.ok_or_else(|| invalid_archive(&"the path of a file leads out of it"))?;
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
    let inputs: Vec<&str> = names.filter(|name| is_named(name, kind)).collect();
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

fn invalid_archive(error: &dyn std::fmt::Display) -> Problem {
    Problem::new(Code::InvalidArchive, error.to_string())
}
