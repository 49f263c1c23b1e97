//! No two files of a crate need each other. The files that only gather a folder, `mod.rs`, are left out: a folder is one with its parts.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use crate::places;

type ModulePath = Vec<String>;

/// The files by the module that each is.
struct Sources {
    texts: BTreeMap<ModulePath, String>,
    gathering: BTreeSet<ModulePath>,
}

impl Sources {
    fn read(folder: &Path) -> Self {
        let mut sources = Self {
            texts: BTreeMap::new(),
            gathering: BTreeSet::new(),
        };
        sources.add(folder, &[]);
        sources
    }

    fn add(&mut self, folder: &Path, at: &[String]) {
        for entry in fs::read_dir(folder).expect("a folder").flatten() {
            let path = entry.path();
            let name = path
                .file_stem()
                .expect("a name")
                .to_string_lossy()
                .into_owned();
            let module = [at, std::slice::from_ref(&name)].concat();
            if path.join("Cargo.toml").is_file() {
                // A crate of its own.
            } else if path.is_dir() {
                self.add(&path, &module);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                let text = code(&fs::read_to_string(&path).expect("text"));
                match name.as_str() {
                    "mod" => {
                        self.gathering.insert(at.to_vec());
                        self.texts.insert(at.to_vec(), text);
                    }
                    "lib" => drop(self.texts.insert(Vec::new(), text)),
                    _ => drop(self.texts.insert(module, text)),
                }
            }
        }
    }

    /// The modules whose items a module names.
    fn uses(&self, module: &ModulePath) -> BTreeSet<ModulePath> {
        (paths(&self.texts[module]).into_iter())
            .filter_map(|path| self.absolute(module, &path))
            .map(|path| self.home(&path))
            .filter(|home| home != module && !self.gathering.contains(home) && !home.is_empty())
            .collect()
    }

    /// A path from the crate's root; `None` where it does not lead there.
    fn absolute(&self, module: &ModulePath, path: &[String]) -> Option<ModulePath> {
        let n_up = path.iter().take_while(|name| *name == "super").count();
        let (base, rest) = match path[0].as_str() {
            "crate" => (Vec::new(), &path[1..]),
            "self" => (module.clone(), &path[1..]),
            "super" => (
                module[..module.len().checked_sub(n_up)?].to_vec(),
                &path[n_up..],
            ),
            first => {
                let child = [&module[..], &[first.to_owned()]].concat();
                (self.texts.contains_key(&child)).then(|| (module.clone(), path))?
            }
        };
        Some([&base, rest].concat())
    }

    /// The module in which the item at a path stands, re-exports followed.
    fn home(&self, path: &[String]) -> ModulePath {
        let depth = (0..=path.len())
            .rev()
            .find(|&n| self.texts.contains_key(&path[..n]));
        let module = path[..depth.unwrap_or(0)].to_vec();
        let Some(name) = path.get(module.len()) else {
            return module;
        };
        let exports = paths(&self.texts[&module]).into_iter();
        let exported = exports
            .filter(|export| export.last() == Some(name) && export.len() > 1)
            .find_map(|export| self.absolute(&module, &export))
            .filter(|export| export != path);
        match exported {
            Some(export) if self.gathering.contains(&module) => self.home(&export),
            _ => module,
        }
    }
}

/// A source without comments and texts.
fn code(text: &str) -> String {
    let lines = text
        .lines()
        .map(|line| line.split("//").next().unwrap_or_default());
    let mut code = String::new();
    for (n, part) in lines.collect::<Vec<_>>().join("\n").split('"').enumerate() {
        code.push_str(if n % 2 == 0 { part } else { "_" });
    }
    code
}

/// All paths of more than one name, trees of `use` taken apart.
fn paths(code: &str) -> Vec<Vec<String>> {
    let is_name = |c: char| c.is_alphanumeric() || c == '_';
    let mut found = Vec::new();
    let mut trees: Vec<Vec<String>> = Vec::new();
    let mut path: Vec<String> = Vec::new();
    let mut rest = code;
    while let Some(first) = rest.chars().next() {
        if is_name(first) {
            let end = rest.find(|c| !is_name(c)).unwrap_or(rest.len());
            path.push(rest[..end].to_owned());
            rest = &rest[end..];
        }
        if let Some(inner) = rest.strip_prefix("::") {
            rest = inner;
            if let Some(inside) = inner.strip_prefix('{') {
                trees.push(std::mem::take(&mut path));
                rest = inside;
            }
            continue;
        }
        if !path.is_empty() {
            let mut whole = trees.concat();
            whole.append(&mut path);
            if whole.len() > 1 && whole.last().is_some_and(|name| name == "self") {
                whole.pop();
            }
            if whole.len() > 1 {
                found.push(whole);
            }
        }
        if let Some(next) = rest.chars().next() {
            if next == '}' {
                trees.pop();
            }
            rest = &rest[next.len_utf8()..];
        }
    }
    found
}

#[test]
fn no_files_need_each_other() {
    let mut crates = vec![places::repository("src")];
    let members = fs::read_dir(places::repository("src")).expect("a folder");
    crates.extend(
        (members.flatten())
            .map(|member| member.path())
            .filter(|path| path.join("Cargo.toml").is_file())
            .map(|path| path.join("src")),
    );
    assert!(crates.len() > 5, "{crates:?}");
    for folder in crates {
        let circles = circles(&Sources::read(&folder));
        assert!(circles.is_empty(), "{}: {circles:#?}", folder.display());
    }
}

/// The files that need each other, as sets.
fn circles(sources: &Sources) -> BTreeSet<Vec<String>> {
    let modules = sources
        .texts
        .keys()
        .filter(|module| !sources.gathering.contains(*module));
    let graph: BTreeMap<_, _> = modules
        .map(|module| (module, sources.uses(module)))
        .collect();
    let reachable: BTreeMap<&ModulePath, BTreeSet<&ModulePath>> = (graph.keys())
        .map(|&module| {
            let mut reached = BTreeSet::new();
            let mut open: Vec<&ModulePath> = graph[module].iter().collect();
            while let Some(next) = open.pop() {
                if reached.insert(next) {
                    open.extend(&graph[next]);
                }
            }
            (module, reached)
        })
        .collect();
    (reachable.iter())
        .map(|(&module, reached)| {
            let back = reached
                .iter()
                .filter(|other| reachable[**other].contains(module));
            back.map(|other| other.join("/")).collect()
        })
        .filter(|circle: &Vec<String>| !circle.is_empty())
        .collect()
}
