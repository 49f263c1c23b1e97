//! Materials with a higher or lower texel density.

use std::collections::BTreeMap;
use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

use crate::PipelineError;
use unwrapd_api::options::within;
use unwrapd_files::document::{Document, Group, Primitive};

/// Factor on the linear texel density of a material, relative to materials without a weight; written `MATERIAL=W`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct TexelWeight {
    /// Name of the material, or its index in the file.
    pub material: String,
    /// The factor.
    pub weight: f64,
}

impl TexelWeight {
    pub(crate) fn check(&self) -> Result<(), String> {
        within("texel_weight", self.weight, 1e-3, 1e3)
    }
}

impl FromStr for TexelWeight {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let wrong = || format!("{text:?} is not a material weight of the form MATERIAL=W");
        let (material, weight) = text.rsplit_once('=').ok_or_else(wrong)?;
        Ok(Self {
            material: material.to_owned(),
            weight: weight.parse().map_err(|_| wrong())?,
        })
    }
}

impl TryFrom<String> for TexelWeight {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        text.parse()
    }
}

impl From<TexelWeight> for String {
    fn from(weight: TexelWeight) -> Self {
        weight.to_string()
    }
}

impl fmt::Display for TexelWeight {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}={}", self.material, self.weight)
    }
}

/// Returns the weight of every face of a group. If a material is named twice, the last weight counts.
pub fn face_weights(
    document: &Document,
    primitives: &[Primitive],
    group: &Group,
    weights: &[TexelWeight],
) -> Result<Vec<f64>, PipelineError> {
    let mut of_material = BTreeMap::new();
    for TexelWeight { material, weight } in weights {
        let index = document
            .material(material)
            .ok_or_else(|| PipelineError::UnknownMaterial(material.clone()))?;
        of_material.insert(index, *weight);
    }
    let of_primitive = |primitive: &Primitive| {
        let weight = primitive.material.and_then(|m| of_material.get(&m));
        std::iter::repeat_n(weight.copied().unwrap_or(1.0), primitive.triangles.len())
    };
    let group = group.primitives.iter();
    Ok(group
        .flat_map(|&index| of_primitive(&primitives[index]))
        .collect())
}
