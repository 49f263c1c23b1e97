//! Energies by name or formula.

use std::str::FromStr;

use serde::de::IntoDeserializer;
use serde::de::value::Error;
use serde::{Deserialize, Serialize};

use unwrapd_method::energy::{FormulaError, OwnEnergy};

/// Deformation energy to minimize.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(clap::ValueEnum))]
#[serde(
    rename_all = "kebab-case",
    expecting = "expected the name of an energy or a formula"
)]
pub enum DeformationEnergy {
    /// As rigid as possible.
    #[default]
    Arap,
    /// Squared norm of Green's strain, not weighted by size.
    Green,
    /// Dirichlet energy of the displacement.
    Dirichlet,
    /// Biharmonic energy of the displacement, cotangent weights.
    Laplacian,
    /// Biharmonic energy of the displacement, uniform weights.
    #[serde(alias = "uniform_laplacian")]
    UniformLaplacian,
    /// Least-squares conformal; in the plane only.
    Lscm,
    /// Symmetric Dirichlet.
    #[serde(alias = "symmetric_dirichlet")]
    SymmetricDirichlet,
    /// Most isometric parameterizations (MIPS): conformal distortion.
    Mips,
    /// Advanced MIPS with exponent factor 1.
    Amips,
    /// St. Venant–Kirchhoff with Lamé parameters λ = 1, μ = ½.
    StVenantKirchhoff,
    /// Neo-Hookean with Lamé parameters λ = 1, μ = ½.
    NeoHookean,
    /// One's own: a formula of the singular values.
    #[cfg_attr(feature = "schema", value(skip))]
    #[serde(untagged)]
    Formula(OwnEnergy),
}

/// Parses a name or a formula.
impl FromStr for DeformationEnergy {
    type Err = FormulaError;

    fn from_str(text: &str) -> Result<Self, FormulaError> {
        let named: Result<Self, Error> = Self::deserialize(text.into_deserializer());
        let energy = named.unwrap_or_else(|_| Self::Formula(OwnEnergy::from(text)));
        energy.check()?;
        Ok(energy)
    }
}

impl DeformationEnergy {
    /// Checks that it is an energy; only a formula can fail.
    pub fn check(&self) -> Result<(), FormulaError> {
        match self {
            Self::Formula(own) => own.check(),
            _ => Ok(()),
        }
    }
}

/// Lists the names as an enum, and allows any text that is short enough for a formula.
#[cfg(feature = "schema")]
impl utoipa::PartialSchema for DeformationEnergy {
    fn schema() -> utoipa::openapi::RefOr<utoipa::openapi::Schema> {
        use clap::ValueEnum;
        use utoipa::openapi::schema::{AnyOfBuilder, ObjectBuilder, Type};
        let words = Self::value_variants()
            .iter()
            .filter_map(ValueEnum::to_possible_value);
        let names = words.map(|word| word.get_name().to_owned());
        let name = ObjectBuilder::new()
            .schema_type(Type::String)
            .enum_values(Some(names));
        let formula = ObjectBuilder::new()
            .schema_type(Type::String)
            .max_length(Some(OwnEnergy::LONGEST))
            .description(Some(
                "A formula of the signed singular values s1 and s2, in space s3",
            ))
            .examples(["log(s1)^2 + log(s2)^2"]);
        (AnyOfBuilder::new().item(name).item(formula))
            .description(Some("Which deformation energy is minimized."))
            .into()
    }
}

#[cfg(feature = "schema")]
impl utoipa::ToSchema for DeformationEnergy {}
