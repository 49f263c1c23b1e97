//! Reader of material files.

use super::map::next_word;
use super::{Material, TextureMap};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

/// Materials of several files by name; the first wins.
#[derive(Debug, Default)]
pub(in crate::document) struct MaterialFiles {
    statements: BTreeMap<String, Statements>,
}

/// Folder of the material's file, and its statements by keyword in lower case.
#[derive(Debug, Default)]
struct Statements {
    folder: String,
    words: BTreeMap<String, String>,
}

/// Keywords that cannot be transferred, with the number of affected materials.
pub(in crate::document) type Dropped = BTreeMap<String, usize>;

/// Keywords about rendering rather than the surface, or that all files have: dropping them needs no warning.
const IDLE: &[&str] = &["ka", "illum", "sharpness", "tr", "d", "ni", "km", "map_aat"];

impl MaterialFiles {
    /// Adds the materials of the file at `path`, relative to the main file.
    pub fn add(&mut self, path: &str, bytes: &[u8]) {
        let folder = path.rsplit_once('/').map_or("", |(folder, _)| folder);
        let text = String::from_utf8_lossy(bytes);
        let mut name: Option<String> = None;
        for line in text.split(['\n', '\r']) {
            let (keyword, rest) = next_word(line);
            if keyword.is_empty() || keyword.starts_with('#') {
                continue;
            }
            let keyword = keyword.to_ascii_lowercase();
            if keyword == "newmtl" {
                let new = rest.trim().to_owned();
                name = (!self.statements.contains_key(&new)).then_some(new);
                if let Some(name) = &name {
                    let folder = folder.to_owned();
                    let words = BTreeMap::new();
                    self.statements
                        .insert(name.clone(), Statements { folder, words });
                }
            } else if let Some(name) = &name
                && let Some(statements) = self.statements.get_mut(name)
            {
                statements.words.insert(keyword, rest.trim().to_owned());
            }
        }
    }

    /// Returns whether there are no materials.
    pub fn is_empty(&self) -> bool {
        self.statements.is_empty()
    }

    /// Iterates over the files of maps, each with the folder of its material file.
    pub fn pictures(&self) -> impl Iterator<Item = (&str, String)> {
        self.statements.values().flat_map(|statements| {
            let maps = statements
                .words
                .iter()
                .filter(|(keyword, _)| is_map(keyword));
            maps.filter_map(|(_, rest)| {
                Some((statements.folder.as_str(), TextureMap::parse(rest)?.path))
            })
        })
    }

    /// Iterates over the keywords of maps that a material has.
    pub fn maps_of(&self, name: &str) -> impl Iterator<Item = &str> {
        let words = self.statements.get(name).into_iter();
        let keywords = words.flat_map(|statements| statements.words.keys());
        keywords.map(String::as_str).filter(|k| is_map(k))
    }

    /// Returns a material, and the folder to which its maps are relative; adds keywords that are left out to `dropped`.
    pub fn material(&self, name: &str, dropped: &mut Dropped) -> Option<(Material, &str)> {
        let statements = self.statements.get(name)?;
        let mut reader = MtlReader {
            words: &statements.words,
            used: BTreeSet::new(),
            lost: BTreeSet::new(),
        };
        let material = reader.material(name);
        for keyword in reader.left() {
            *dropped.entry(keyword).or_default() += 1;
        }
        Some((material, &statements.folder))
    }
}

/// Returns whether a keyword refers to a picture.
fn is_map(keyword: &str) -> bool {
    keyword.starts_with("map_") && keyword != "map_aat"
        || matches!(
            keyword,
            "bump" | "norm" | "disp" | "decal" | "refl" | "map_refl"
        )
}

/// Reads the statements of a material and records those it has used.
struct MtlReader<'a> {
    words: &'a BTreeMap<String, String>,
    used: BTreeSet<&'static str>,
    lost: BTreeSet<String>,
}

impl MtlReader<'_> {
    fn material(&mut self, name: &str) -> Material {
        let new = Material::named(name);
        let color_map = self.map("map_kd");
        let mut color = self.color("kd").unwrap_or(new.color);
        if color == [0.0; 3] && color_map.is_some() {
            // Tools that take the color from the map alone write black.
            color = [1.0; 3];
        }
        // `Tr` is the opposite of `d`.
        let opacity = self.number("d").or(self.number("tr").map(|tr| 1.0 - tr));
        // Take the roughness, or else convert the shininess as Blender does.
        let shine = self.number("ns");
        let from_shine = shine.map(|ns| 1.0 - (ns.clamp(0.0, 1000.0) / 1000.0).sqrt());
        let roughness = self.number("pr").or(from_shine).unwrap_or(new.roughness);
        let (normal_map, is_bump) = self.normal_map();
        let emission_map = self.map("map_ke");
        let emission = self.color("ke").unwrap_or(new.emission);
        let glows = emission != [0.0; 3] || emission_map.is_none();
        Material {
            color,
            alpha: opacity.map_or(1.0, unit),
            is_cut_out: self.is_cut_out(color_map.as_ref()),
            color_map,
            metallic: self.number("pm").map_or(0.0, unit),
            roughness: unit(roughness),
            metallic_roughness_map: self.metallic_roughness_map(),
            specular: self.color("ks").unwrap_or(new.specular),
            // Exporters that have no shininess write 1 or less.
            ior: self.number("ni").filter(|n| *n > 1.0).unwrap_or(new.ior),
            emission: if glows { emission } else { [1.0; 3] },
            emission_map,
            normal_map,
            is_bump,
            coat: [self.number("pc"), self.number("pcr")].map(|x| x.map_or(0.0, unit)),
            is_unlit: self.number("illum") == Some(0.0),
            ..new
        }
    }

    fn number(&mut self, keyword: &'static str) -> Option<f64> {
        let word = next_word(self.words.get(keyword)?).0;
        let number = word.parse().ok().filter(|x: &f64| x.is_finite())?;
        self.used.insert(keyword);
        Some(number)
    }

    /// Returns three numbers, or one for all three, clamped to be nonnegative.
    fn color(&mut self, keyword: &'static str) -> Option<[f64; 3]> {
        let words = self.words.get(keyword)?.split_whitespace();
        let numbers: Result<Vec<f64>, _> = words.take(3).map(str::parse).collect();
        let color = match numbers.ok()?[..] {
            [r, g, b] => [r, g, b],
            [r] => [r; 3],
            _ => return None,
        };
        if !color.iter().all(|x| x.is_finite()) {
            return None;
        }
        self.used.insert(keyword);
        Some(color.map(|x| x.max(0.0)))
    }

    fn map(&mut self, keyword: &'static str) -> Option<TextureMap> {
        let map = TextureMap::parse(self.words.get(keyword)?)?;
        self.used.insert(keyword);
        let options = map.lost_options.iter();
        self.lost
            .extend(options.map(|option| format!("{keyword} {option}")));
        Some(map)
    }

    /// Returns whether `map_d` is the alpha of `map_Kd`; another picture cannot be combined with it.
    fn is_cut_out(&mut self, color_map: Option<&TextureMap>) -> bool {
        let alpha = self
            .words
            .get("map_d")
            .and_then(|rest| TextureMap::parse(rest));
        let is_same =
            matches!((color_map, &alpha), (Some(color), Some(alpha)) if color.shows_same(alpha));
        if is_same {
            self.used.insert("map_d");
        }
        is_same
    }

    /// Returns the map of roughness and metalness if both are channels of one picture.
    fn metallic_roughness_map(&mut self) -> Option<TextureMap> {
        let parse = |keyword| {
            self.words
                .get(keyword)
                .and_then(|rest| TextureMap::parse(rest))
        };
        let (roughness, metallic) = (parse("map_pr")?, parse("map_pm")?);
        let channels = [roughness.channel, metallic.channel];
        if !roughness.shows_same(&metallic) || channels != [Some('g'), Some('b')] {
            return None;
        }
        self.used.extend(["map_pr", "map_pm"]);
        Some(roughness)
    }

    /// Returns a normal map, and whether it is only called a bump map, as in many tools.
    fn normal_map(&mut self) -> (Option<TextureMap>, bool) {
        let normal = self.map("norm");
        let bump = self.map("map_bump").or_else(|| self.map("bump"));
        match (normal, bump) {
            // The strength of a normal map is in a bump map of the same picture.
            (Some(normal), Some(bump)) if bump.shows_same(&normal) => (Some(bump), false),
            (Some(normal), Some(_)) => {
                self.lost.insert("map_bump".to_owned());
                (Some(normal), false)
            }
            (Some(normal), None) => (Some(normal), false),
            (None, bump) => {
                let is_bump = bump.is_some();
                (bump, is_bump)
            }
        }
    }

    /// Returns the keywords that were not used although they have an effect.
    fn left(&self) -> Vec<String> {
        let left = self
            .words
            .iter()
            .filter(|(keyword, rest): &(&String, &String)| {
                let is_idle = IDLE.contains(&keyword.as_str());
                let is_used = self.used.contains(keyword.as_str());
                !is_idle && !is_used && !self.is_neutral(keyword, rest)
            });
        let keywords = left.map(|(keyword, _)| keyword.clone());
        keywords.chain(self.lost.iter().cloned()).collect()
    }

    fn is_neutral(&self, keyword: &str, rest: &str) -> bool {
        let all = |value: f64| {
            let words = rest.split_whitespace();
            words.into_iter().all(|word| word.parse() == Ok(value))
        };
        match keyword {
            "tf" => all(1.0),
            // An ambient map equal to the color map changes nothing.
            "map_ka" => self.words.get("map_kd").is_some_and(|map| map == rest),
            "ns" | "ps" | "aniso" | "anisor" => all(0.0) || keyword == "ns",
            _ => false,
        }
    }
}

fn unit(x: f64) -> f64 {
    x.clamp(0.0, 1.0)
}

// Writer of material files.

/// Returns the text of a material file.
pub(in crate::document) fn mtl_text(materials: &[Material]) -> Vec<u8> {
    let mut text = String::new();
    for (k, material) in materials.iter().enumerate() {
        if k > 0 {
            text.push('\n');
        }
        // Writing to memory does not fail.
        let _ = push_material(&mut text, material);
    }
    text.into_bytes()
}

fn push_material(text: &mut String, material: &Material) -> std::fmt::Result {
    writeln!(text, "newmtl {}", material.name)?;
    push_color(text, "Kd", material.color)?;
    push_color(text, "Ke", material.emission)?;
    // A matte surface has no highlight, not one that is everywhere.
    let is_matte = material.roughness == 1.0 && material.specular == [0.5; 3];
    if !is_matte {
        push_color(text, "Ks", material.specular)?;
        let shine = 1000.0 * (1.0 - material.roughness).powi(2);
        writeln!(text, "Ns {}", short(shine))?;
    }
    let numbers = [
        ("Ni", material.ior),
        ("d", material.alpha),
        ("Pr", material.roughness),
        ("Pm", material.metallic),
    ];
    for (keyword, number) in numbers {
        writeln!(text, "{keyword} {}", short(number))?;
    }
    if material.coat[0] > 0.0 {
        let [coat, roughness] = material.coat.map(short);
        writeln!(text, "Pc {coat}\nPcr {roughness}")?;
    }
    // Illumination models: constant color, diffuse, diffuse with highlights.
    let model = match (material.is_unlit, is_matte) {
        (true, _) => 0,
        (false, true) => 1,
        (false, false) => 2,
    };
    writeln!(text, "illum {model}")?;
    // Write the maps.
    if let Some(map) = &material.color_map {
        push_map(text, "map_Kd", "", map)?;
        if material.is_cut_out {
            push_map(text, "map_d", "", map)?;
        }
    }
    if let Some(map) = &material.metallic_roughness_map {
        push_map(text, "map_Pr", " -imfchan g", map)?;
        push_map(text, "map_Pm", " -imfchan b", map)?;
    }
    if let Some(map) = &material.emission_map {
        push_map(text, "map_Ke", "", map)?;
    }
    if let Some(map) = &material.normal_map {
        push_map(text, "norm", "", map)?;
        // Blender looks here for the map and its strength.
        push_map(
            text,
            "map_Bump",
            &format!(" -bm {}", short(map.strength)),
            map,
        )?;
    }
    Ok(())
}

fn push_color(text: &mut String, keyword: &str, color: [f64; 3]) -> std::fmt::Result {
    let [r, g, b] = color.map(short);
    writeln!(text, "{keyword} {r} {g} {b}")
}

fn push_map(text: &mut String, keyword: &str, options: &str, map: &TextureMap) -> std::fmt::Result {
    write!(text, "{keyword}{options}")?;
    for (option, [u, v], neutral) in [("-s", map.scale, 1.0), ("-o", map.offset, 0.0)] {
        if [u, v] != [neutral; 2] {
            write!(text, " {option} {} {} {neutral}", short(u), short(v))?;
        }
    }
    writeln!(text, " {}", map.path)
}

/// Removes rounding noise from a number.
fn short(x: f64) -> f64 {
    (x * 1e9).round() / 1e9 + 0.0
}
