//! Merging of materials: the request, the plan and the record of the result.

use super::{Group, Primitive};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fmt;
use std::str::FromStr;

/// Materials to merge into one; written `all` or `NAME=MATERIAL,MATERIAL`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub enum MaterialMerge {
    /// All materials that no name claims.
    All,
    /// Some materials, each by its name or its index in the file.
    Named {
        /// Name of the material that replaces them.
        name: String,
        /// Names or indices of these materials.
        materials: Vec<String>,
    },
}

/// Word that requests all materials.
const ALL: &str = "all";

impl FromStr for MaterialMerge {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if text == ALL {
            return Ok(Self::All);
        }
        let wrong = || format!("{text:?} is neither `all` nor of the form NAME=MATERIAL,MATERIAL");
        let (name, materials) = text.split_once('=').ok_or_else(wrong)?;
        let materials: Vec<String> = materials.split(',').map(|m| m.trim().to_owned()).collect();
        let is_complete = !name.trim().is_empty() && materials.iter().all(|m| !m.is_empty());
        if !is_complete {
            return Err(wrong());
        }
        Ok(Self::Named {
            name: name.trim().to_owned(),
            materials,
        })
    }
}

impl TryFrom<String> for MaterialMerge {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        text.parse()
    }
}

impl From<MaterialMerge> for String {
    fn from(merge: MaterialMerge) -> Self {
        merge.to_string()
    }
}

impl fmt::Display for MaterialMerge {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::All => f.write_str(ALL),
            Self::Named { name, materials } => write!(f, "{name}={}", materials.join(",")),
        }
    }
}

/// Materials to merge, by their indices.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct MergePlan {
    /// Materials to make.
    pub merged: Vec<MergedMaterial>,
    /// Materials that were to be merged and cannot be.
    pub apart: Vec<ApartMaterial>,
}

/// A material that replaces several.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct MergedMaterial {
    /// Its name.
    pub name: String,
    /// Indices of the materials that it replaces, in increasing order.
    pub members: Vec<usize>,
}

/// A material that was to be merged with others and stays apart from them.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct ApartMaterial {
    /// Index of the material in the file that was read.
    pub material: usize,
    /// Its name, or `material` and its index.
    pub name: String,
    /// Why.
    pub reason: String,
}

impl MergePlan {
    /// Unites groups of one material each whose materials will be one.
    pub fn united(&self, groups: Vec<Group>, primitives: &[Primitive]) -> Vec<Group> {
        let of_material: BTreeMap<usize, usize> = (self.merged.iter().enumerate())
            .flat_map(|(number, merged)| merged.members.iter().map(move |&member| (member, number)))
            .collect();
        let mut places: BTreeMap<usize, usize> = BTreeMap::new();
        let mut united: Vec<Group> = Vec::new();
        for group in groups {
            let first = group.primitives.first();
            let material = first.and_then(|&index| primitives[index].material);
            let number = material.and_then(|material| of_material.get(&material).copied());
            let Some(number) = number else {
                united.push(group);
                continue;
            };
            if let Some(&place) = places.get(&number) {
                united[place].primitives.extend(group.primitives);
                united[place].primitives.sort_unstable();
            } else {
                places.insert(number, united.len());
                united.push(Group {
                    label: self.merged[number].name.clone(),
                    ..group
                });
            }
        }
        united
    }
}

// Record of the result.

/// Materials that were merged, those that stayed apart, and the draw calls saved.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct MergeNote {
    /// Materials that replace others.
    pub materials: Vec<MergedNote>,
    /// Materials that were to be merged and stayed apart, and why.
    pub apart: Vec<ApartMaterial>,
    /// Draw calls of the file that was read: primitives of all nodes with a mesh.
    pub draw_calls_before: usize,
    /// Draw calls of the written file.
    pub draw_calls_after: usize,
}

/// A material that replaces others.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct MergedNote {
    /// Index of the material in the written file.
    pub material: usize,
    /// Its name.
    pub name: String,
    /// Names of the materials that it replaces; `material` and the index for one without a name.
    pub replaces: Vec<String>,
}

/// A triangle primitive of the written file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct JoinedPrimitive {
    /// Index of its mesh in the file.
    pub mesh: usize,
    /// Index of the primitive in its mesh.
    pub primitive: usize,
    /// The document's primitives whose faces it has, one after the other.
    pub parts: Vec<JoinedPart>,
}

/// A primitive of the document as a part of a written one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct JoinedPart {
    /// Its index among the document's.
    pub primitive: usize,
    /// Number of its faces.
    pub n_faces: usize,
}
