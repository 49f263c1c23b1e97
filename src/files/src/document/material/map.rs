//! Maps of MTL: options and a file name.

/// A picture on a surface.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::document) struct Map {
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

impl Map {
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
