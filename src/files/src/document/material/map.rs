//! Maps of MTL: options and a file name.

use crate::document::uri::normalized;
use std::collections::{BTreeMap, BTreeSet};

/// A picture on a surface.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::document) struct TextureMap {
    /// Path of the file, as in the material file.
    pub path: String,
    /// Factors of u and v, v up.
    pub scale: [f64; 2],
    /// Offsets of u and v, added after scaling.
    pub offset: [f64; 2],
    /// `true` if the outermost texels continue beyond the border, `false` if the picture repeats.
    pub clamp: bool,
    /// Strength of a bump or normal map.
    pub strength: f64,
    /// Channel that provides a single number.
    pub channel: Option<char>,
    /// Options that no glTF texture can have.
    pub lost_options: Vec<String>,
}

impl TextureMap {
    /// Creates the map of a whole picture without options.
    pub fn of(path: impl Into<String>) -> Self {
        Self {
            path: path.into(),
            scale: [1.0; 2],
            offset: [0.0; 2],
            clamp: false,
            strength: 1.0,
            channel: None,
            lost_options: Vec::new(),
        }
    }

    /// Parses the words after the keyword. A file name extends to the end of the line, and may contain blanks; `None`
    /// if there is none.
    pub fn parse(mut rest: &str) -> Option<Self> {
        let mut map = Self::of("");
        while let (option, after) = next_word(rest)
            && option.starts_with('-')
            && !after.trim().is_empty()
        {
            rest = map.take_option(&option.to_ascii_lowercase(), after);
        }
        rest.trim().clone_into(&mut map.path);
        (!map.path.is_empty()).then_some(map)
    }

    /// Takes the arguments of an option and returns the rest.
    fn take_option<'a>(&mut self, option: &str, rest: &'a str) -> &'a str {
        match option {
            "-s" | "-o" | "-t" => {
                let (numbers, after) = numbers(rest, 3);
                let [u, v] = match option {
                    "-s" => self.scale,
                    _ => self.offset,
                };
                let pair = [
                    numbers.first().copied().unwrap_or(u),
                    numbers.get(1).copied().unwrap_or(v),
                ];
                match option {
                    "-s" => self.scale = pair,
                    "-o" => self.offset = pair,
                    _ if pair != [0.0; 2] => self.lost_options.push(option.to_owned()),
                    _ => {}
                }
                after
            }
            "-mm" => {
                let (numbers, after) = numbers(rest, 2);
                if !matches!(numbers[..], [] | [0.0] | [0.0, 1.0]) {
                    self.lost_options.push(option.to_owned());
                }
                after
            }
            "-bm" => {
                let (numbers, after) = numbers(rest, 1);
                self.strength = numbers.first().copied().unwrap_or(1.0);
                after
            }
            "-clamp" => {
                let (word, after) = next_word(rest);
                self.clamp = word.eq_ignore_ascii_case("on");
                after
            }
            "-imfchan" => {
                let (word, after) = next_word(rest);
                self.channel = word.chars().next().map(|c| c.to_ascii_lowercase());
                after
            }
            "-type" => {
                self.lost_options.push(option.to_owned());
                next_word(rest).1
            }
            // Filters and resolutions, one word each.
            _ => next_word(rest).1,
        }
    }

    /// Returns whether both show the same picture in the same place.
    pub fn shows_same(&self, other: &Self) -> bool {
        let place = |map: &Self| (map.scale, map.offset, map.clamp);
        self.path == other.path && place(self) == place(other)
    }
}

/// Returns the first word and the rest.
pub(super) fn next_word(text: &str) -> (&str, &str) {
    let text = text.trim_start();
    let end = text.find(char::is_whitespace).unwrap_or(text.len());
    text.split_at(end)
}

/// Returns up to `n` numbers, and the rest; the last word is never a number, as it is the file name.
fn numbers(mut rest: &str, n: usize) -> (Vec<f64>, &str) {
    let mut numbers = Vec::new();
    while numbers.len() < n
        && let (word, after) = next_word(rest)
        && let Ok(number) = word.parse::<f64>()
        && number.is_finite()
        && !after.trim().is_empty()
    {
        numbers.push(number);
        rest = after;
    }
    (numbers, rest)
}

// Pictures of material files, among the supplied files.

/// Files of an upload.
pub(in crate::document) struct UploadedPictures<'a> {
    resources: &'a BTreeMap<String, Vec<u8>>,
    /// Paths of pictures that were not supplied.
    pub missing: BTreeSet<String>,
}

impl<'a> UploadedPictures<'a> {
    /// Searches among the files of an upload.
    pub fn among(resources: &'a BTreeMap<String, Vec<u8>>) -> Self {
        Self {
            resources,
            missing: BTreeSet::new(),
        }
    }

    /// Returns name and content of a picture named by a material file in `folder`.
    pub fn find(&mut self, folder: &str, path: &str) -> Option<(&'a str, &'a [u8])> {
        let resources = self.resources;
        let found = Self::candidates(folder, path)
            .find_map(|name| resources.get_key_value(&name))
            .map(|(name, bytes)| (name.as_str(), bytes.as_slice()));
        if found.is_none() {
            let shown = path.chars().filter(|c| !c.is_control()).take(120);
            self.missing.insert(shown.collect());
        }
        found
    }

    /// Iterates over the possible meanings of a path: relative to the material file, to the main file, or, as absolute
    /// paths belong to another machine, a file of that name in the folder of one of them. None leaves the main file's
    /// folder.
    pub fn candidates(folder: &str, path: &str) -> impl Iterator<Item = String> {
        let name = path.rsplit(['/', '\\']).next().unwrap_or(path);
        let within =
            |path: &str| format!("{folder}{}{path}", if folder.is_empty() { "" } else { "/" });
        let paths = [within(path), path.to_owned(), within(name), name.to_owned()];
        let is_absolute = path.starts_with(['/', '\\']) || path.contains(':');
        let paths = paths.into_iter().skip(if is_absolute { 2 } else { 0 });
        paths.filter_map(|path| normalized(&path).filter(|path| !path.is_empty()))
    }
}
