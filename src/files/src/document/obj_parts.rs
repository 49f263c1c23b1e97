//! Data of polygons and vertices of an OBJ text besides their shape: objects, groups, materials, colors.
use super::Warning;
use super::colors::{Color, WHITE, from_srgb};
use crate::io::obj::{Statement, statements};
use std::collections::{BTreeSet, HashMap, HashSet};

/// Most meshes and primitives into which a file is divided: each is an object in JSON and a draw call.
const MOST_PARTS: usize = 8192;

/// Names and colors of an OBJ file.
#[derive(Debug, Default)]
pub(super) struct ObjParts {
    /// Names of objects, or of groups in a file without objects.
    pub objects: Vec<String>,
    /// Names of materials.
    pub materials: Vec<String>,
    /// For each polygon its object and its material.
    pub of_polygons: Vec<Part>,
    /// For each vertex its color, if any has one.
    pub colors: Option<Vec<Color>>,
    /// Number of groups that divide objects further.
    n_lost_groups: usize,
    /// Number of points, lines and curves.
    n_lost_elements: usize,
    /// Number of parts, if they are too many to be kept apart.
    n_joined_parts: usize,
}

/// An object and a material, each by its index.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) struct Part {
    pub object: Option<u32>,
    pub material: Option<u32>,
}

impl ObjParts {
    /// Reads the statements of a text.
    pub fn of(bytes: &[u8]) -> Self {
        let (mut objects, mut groups, mut materials) = (
            PartNames::default(),
            PartNames::default(),
            PartNames::default(),
        );
        let mut polygons = Vec::new();
        let mut colors = Vec::new();
        let (mut is_colored, mut n_lost_elements) = (false, 0);
        // Read names and colors in effect at each polygon and vertex.
        for statement in statements(bytes) {
            match statement.keyword {
                b"o" => objects.begin(&statement),
                b"g" => groups.begin(&statement),
                b"usemtl" => materials.begin(&statement),
                b"f" | b"fo" => {
                    polygons.push([objects.current, groups.current, materials.current]);
                }
                b"v" => {
                    let color = color(&statement);
                    is_colored |= color.is_some();
                    colors.push(color.unwrap_or(WHITE));
                }
                b"p" | b"l" | b"curv" | b"curv2" | b"surf" => n_lost_elements += 1,
                _ => {}
            }
        }
        // Objects divide the file into parts; without objects, groups do.
        let has_objects = !objects.all.is_empty();
        let part = |&[object, group, material]: &[Option<u32>; 3]| Part {
            object: if has_objects { object } else { group },
            material,
        };
        let n_lost_groups = if has_objects {
            lost_groups(&polygons)
        } else {
            0
        };
        let mut of_polygons: Vec<Part> = polygons.iter().map(part).collect();
        Self {
            n_joined_parts: join(&mut of_polygons),
            of_polygons,
            objects: if has_objects { objects } else { groups }.all,
            materials: materials.all,
            colors: is_colored.then_some(colors),
            n_lost_groups,
            n_lost_elements,
        }
    }

    /// Returns warnings about content that a glTF file cannot hold.
    pub fn warnings(&self) -> Vec<Warning> {
        let mut warnings = Vec::new();
        if self.n_joined_parts > 0 {
            let n = self.n_joined_parts;
            let message = format!(
                "the {n} parts of the file are joined: a glTF file gets at most {MOST_PARTS}"
            );
            warnings.push(Warning::new("parts_joined", message));
        }
        if self.n_lost_groups > 0 {
            let n = self.n_lost_groups;
            let message = format!("objects become meshes; the {n} groups in them are left out");
            warnings.push(Warning::new("groups_dropped", message));
        }
        if self.n_lost_elements > 0 {
            let n = self.n_lost_elements;
            let message = format!("points, lines and curves are left out: {n} statements");
            warnings.push(Warning::new("elements_dropped", message));
        }
        warnings
    }
}

/// Returns the names after a statement, joined by single blanks.
pub(super) fn name_of(statement: &Statement) -> String {
    let words: Vec<_> = statement
        .words
        .iter()
        .map(|word| String::from_utf8_lossy(word))
        .collect();
    words.join(" ")
}

/// Names in the order of their first use, and the current one.
#[derive(Default)]
struct PartNames {
    all: Vec<String>,
    numbers: HashMap<String, u32>,
    current: Option<u32>,
}

impl PartNames {
    fn begin(&mut self, statement: &Statement) {
        let name = name_of(statement);
        self.current = (!name.is_empty()).then(|| {
            *self.numbers.entry(name).or_insert_with_key(|name| {
                self.all.push(name.clone());
                self.all.len() as u32 - 1
            })
        });
    }
}

/// Drops objects, and then materials, if there are too many parts. Returns the number of parts in that case, else 0.
fn join(parts: &mut [Part]) -> usize {
    let n = |parts: &[Part]| parts.iter().collect::<HashSet<_>>().len();
    let n_parts = n(parts);
    if n_parts <= MOST_PARTS {
        return 0;
    }
    for part in &mut *parts {
        part.object = None;
    }
    if n(parts) > MOST_PARTS {
        parts.fill(Part::default());
    }
    n_parts
}

/// Counts the groups of objects that have more than one group.
fn lost_groups(polygons: &[[Option<u32>; 3]]) -> usize {
    let pairs: BTreeSet<_> = polygons.iter().map(|[o, g, _]| (*o, *g)).collect();
    let pairs: Vec<_> = pairs.into_iter().collect();
    let mixed = pairs.chunk_by(|a, b| a.0 == b.0).filter(|c| c.len() > 1);
    mixed.flatten().filter(|(_, group)| group.is_some()).count()
}

/// Parses the color of `v x y z r g b`.
fn color(statement: &Statement) -> Option<Color> {
    let [_, _, _, r, g, b] = statement.words[..] else {
        return None;
    };
    let number = |word: &[u8]| {
        let number: f64 = std::str::from_utf8(word).ok()?.parse().ok()?;
        number.is_finite().then_some(number)
    };
    Some(from_srgb([number(r)?, number(g)?, number(b)?, 1.0]))
}
