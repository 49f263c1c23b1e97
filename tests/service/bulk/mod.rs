//! Many files in one run: `unwrapd batch`.

mod failures;
mod gates;
mod interrupted;
mod lists;
mod resumed;
mod schedulers;
mod shards;
mod special;
mod unwilling;

use std::collections::BTreeMap;
use std::fs;
use std::os::unix::fs::MetadataExt;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use tempfile::TempDir;

/// A folder with an input folder `in`, and `out`, which does not exist yet.
pub struct Folders {
    root: TempDir,
}

impl Folders {
    /// With inputs of these names.
    pub fn with(names: &[&str]) -> Self {
        let root = tempfile::tempdir().expect("a folder");
        let folders = Self { root };
        fs::create_dir_all(folders.path("in")).expect("a folder");
        for (number, name) in names.iter().enumerate() {
            folders.write(&format!("in/{name}"), &mesh(number));
        }
        folders
    }

    /// With so many inputs.
    pub fn of(count: usize) -> Self {
        let names: Vec<String> = (0..count).map(|i| format!("{i:03}.obj")).collect();
        Self::with(&names.iter().map(String::as_str).collect::<Vec<_>>())
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.root.path().join(name)
    }

    pub fn text(&self, name: &str) -> String {
        self.path(name).to_string_lossy().into_owned()
    }

    pub fn write(&self, name: &str, text: &str) {
        let path = self.path(name);
        fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        fs::write(path, text).expect("a file");
    }

    /// `unwrapd batch in -o out` with more arguments, not yet started.
    pub fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_unwrapd"));
        command.args(["batch", &self.text("in"), "-o", &self.text("out")]);
        command.args(arguments);
        let says_how = |argument: &&str| ["--cut", "--max-charts"].contains(argument);
        if !arguments.iter().any(says_how) {
            command.args(QUICK);
        }
        // What is in the making is the test's own.
        fs::create_dir_all(self.path("tmp")).expect("a folder");
        command.env("TMPDIR", self.path("tmp"));
        command
    }

    /// `unwrapd submit in -o out --server …` with more arguments, not yet started.
    pub fn submission(&self, server: &str, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_unwrapd"));
        command.args(["submit", &self.text("in"), "-o", &self.text("out")]);
        command
            .args(["--server", server])
            .args(QUICK)
            .args(arguments);
        fs::create_dir_all(self.path("tmp")).expect("a folder");
        command.env("TMPDIR", self.path("tmp"));
        command
    }

    pub fn submit(&self, server: &str, arguments: &[&str]) -> Output {
        let output = self.submission(server, arguments).output();
        output.expect("the binary runs")
    }

    pub fn batch(&self, arguments: &[&str]) -> Output {
        let output = self.command(arguments).output();
        output.expect("the binary runs")
    }

    /// The rows of a summary, by input.
    pub fn summary(&self, name: &str) -> BTreeMap<String, Row> {
        let text = fs::read_to_string(self.path("out").join(name)).expect("a summary");
        let mut lines = text.lines().map(|line| line.split(',').collect::<Vec<_>>());
        let names = lines.next().expect("a header");
        let rows = lines.map(|cells| {
            let cells = names.iter().zip(cells);
            let row: Row = cells
                .map(|(name, cell)| (name.to_string(), cell.to_owned()))
                .collect();
            (row["input"].clone(), row)
        });
        rows.collect()
    }

    /// The files below `out`, apart from summaries, as names and what tells two writings apart.
    pub fn written(&self) -> BTreeMap<String, Writing> {
        let mut found = BTreeMap::new();
        let root = self.path("out");
        collect(&root, &root, &mut found);
        found.retain(|name, _| !name.starts_with("summary"));
        found
    }

    /// The outputs alone.
    pub fn outputs(&self) -> Vec<String> {
        let names = self.written().into_keys();
        names.filter(|name| !name.starts_with('.')).collect()
    }
}

/// The quickest way to unwrap.
pub const QUICK: [&str; 2] = ["--cut", "fast"];

/// Cells of a row by column.
pub type Row = BTreeMap<String, String>;

/// A mesh that no other number has.
pub fn mesh(number: usize) -> String {
    let x = number + 1;
    format!("v {x} 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\n")
}

/// What tells two writings of a file apart: its inode and its time. The inode alone does not,
/// since that of a file that was removed is given to another; the time alone is that of a tick.
pub type Writing = (u64, i64, i64);

fn collect(root: &Path, folder: &Path, found: &mut BTreeMap<String, Writing>) {
    for entry in fs::read_dir(folder).into_iter().flatten() {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            collect(root, &path, found);
        } else {
            // What a run at work has moved away is not there.
            let Ok(of) = fs::metadata(&path) else {
                continue;
            };
            let name = path.strip_prefix(root).expect("inside");
            let writing = (of.ino(), of.mtime(), of.mtime_nsec());
            found.insert(name.to_string_lossy().into_owned(), writing);
        }
    }
}
