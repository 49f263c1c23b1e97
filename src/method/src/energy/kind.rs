//! Energies by name or formula.
//!
//! This is the one list of energies: commands, HTTP, Python and Node take theirs from it. To add a density, add a
//! variant to [`DensityKind`], and a line to [`DensityKind::planar`] and to [`DensityKind::spatial`].

use std::str::FromStr;
use std::sync::Arc;
#[cfg(feature = "schema")]
use std::sync::LazyLock;

use serde::de::IntoDeserializer;
use serde::de::value::Error;
use serde::{Deserialize, Serialize};

use super::{
    Amips, Arap, Density, FormulaError, FrozenArap, Green, Lscm, Mips, NeoHookean, OwnEnergy,
    Quadratic, RestShape, StVenantKirchhoff, SymmetricDirichlet, biharmonic, dirichlet,
    uniform_biharmonic,
};

/// Lamé parameters λ and μ of an ordinary solid with Poisson's ratio ⅓, in its own unit.
const LAME: [f64; 2] = [1.0, 0.5];

/// Energy that is a function of an element's singular values, for maps of surfaces and for deformations.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(clap::ValueEnum))]
#[serde(
    rename_all = "kebab-case",
    expecting = "expected the name of an energy or a formula"
)]
#[non_exhaustive]
pub enum DensityKind {
    /// As rigid as possible (ARAP).
    #[default]
    Arap,
    /// ARAP with the rotations frozen in each step, as the paper solves it: the same minima, more steps.
    #[serde(alias = "frozen_arap")]
    FrozenArap,
    /// Squared norm of Green's strain. A deformation does not weight it by size.
    Green,
    /// Least-squares conformal (LSCM); in the plane only.
    Lscm,
    /// Symmetric Dirichlet: penalizes stretching and shrinking alike.
    #[serde(alias = "symmetric_dirichlet")]
    SymmetricDirichlet,
    /// Most isometric parameterizations (MIPS): conformal distortion.
    Mips,
    /// Advanced MIPS with exponent factor 1.
    Amips,
    /// St. Venant–Kirchhoff with Lamé parameters λ = 1, μ = ½.
    #[serde(alias = "st_venant_kirchhoff")]
    StVenantKirchhoff,
    /// Neo-Hookean with Lamé parameters λ = 1, μ = ½.
    #[serde(alias = "neo_hookean")]
    NeoHookean,
    /// One's own: a formula of the singular values.
    #[cfg_attr(feature = "schema", value(skip))]
    #[serde(untagged)]
    Formula(OwnEnergy),
}

/// Quadratic form of the displacement from the rest positions, for deformations: a map of a surface has none.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(clap::ValueEnum))]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum DisplacementKind {
    /// Dirichlet energy of the displacement.
    Dirichlet,
    /// Biharmonic energy of the displacement, cotangent weights.
    Laplacian,
    /// Biharmonic energy of the displacement, uniform weights.
    #[serde(alias = "uniform_laplacian")]
    UniformLaplacian,
}

/// Energy of a deformation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged, expecting = "expected the name of an energy or a formula")]
pub enum EnergyKind {
    /// A quadratic form of the displacement.
    Displacement(DisplacementKind),
    /// A function of singular values.
    Density(DensityKind),
}

/// The energy is not defined for elements of this dimension.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum DimensionError {
    /// It is an energy of triangles.
    #[error("this energy exists only in the plane")]
    PlanarOnly,
    /// The formula does not define an energy of this dimension.
    #[error(transparent)]
    Formula(#[from] FormulaError),
}

impl DensityKind {
    /// Returns ψ for triangles.
    ///
    /// # Errors
    /// If it is a formula that is not an energy of triangles.
    pub fn planar(&self) -> Result<Arc<dyn Density<2>>, FormulaError> {
        let [lambda, mu] = LAME;
        Ok(match self {
            Self::Arap => Arc::new(Arap),
            Self::FrozenArap => Arc::new(FrozenArap),
            Self::Green => Arc::new(Green),
            Self::Lscm => Arc::new(Lscm),
            Self::SymmetricDirichlet => Arc::new(SymmetricDirichlet),
            Self::Mips => Arc::new(Mips),
            Self::Amips => Arc::new(Amips { s: 1.0 }),
            Self::StVenantKirchhoff => Arc::new(StVenantKirchhoff { lambda, mu }),
            Self::NeoHookean => Arc::new(NeoHookean { lambda, mu }),
            Self::Formula(own) => own.planar()?,
        })
    }

    /// Returns ψ for tetrahedra.
    ///
    /// # Errors
    /// If it is an energy of triangles only.
    pub fn spatial(&self) -> Result<Arc<dyn Density<3>>, DimensionError> {
        let [lambda, mu] = LAME;
        Ok(match self {
            Self::Arap => Arc::new(Arap),
            Self::FrozenArap => Arc::new(FrozenArap),
            Self::Green => Arc::new(Green),
            Self::Lscm => return Err(DimensionError::PlanarOnly),
            Self::SymmetricDirichlet => Arc::new(SymmetricDirichlet),
            Self::Mips => Arc::new(Mips),
            Self::Amips => Arc::new(Amips { s: 1.0 }),
            Self::StVenantKirchhoff => Arc::new(StVenantKirchhoff { lambda, mu }),
            Self::NeoHookean => Arc::new(NeoHookean { lambda, mu }),
            Self::Formula(own) => own.spatial()?,
        })
    }
}

impl DisplacementKind {
    /// Creates the quadratic form around the rest positions `rest`, D coordinates per vertex, given rest shape of each
    /// element and the mass of each vertex.
    pub fn quadratic<const D: usize>(
        self,
        elements: &[&[u32]],
        shapes: &[RestShape<D>],
        masses: &[f64],
        rest: Vec<f64>,
    ) -> Quadratic {
        let sizes: Vec<f64> = shapes.iter().map(|shape| shape.size).collect();
        match self {
            Self::Dirichlet => dirichlet(elements, shapes, &sizes, rest),
            Self::Laplacian => biharmonic(elements, shapes, &sizes, masses, rest),
            Self::UniformLaplacian => uniform_biharmonic(D, elements, rest),
        }
    }
}

impl EnergyKind {
    /// Checks that it is an energy; only a formula can fail.
    pub fn check(&self) -> Result<(), FormulaError> {
        match self {
            Self::Density(DensityKind::Formula(own)) => own.check(),
            _ => Ok(()),
        }
    }

    /// Returns the paper's β for this energy.
    pub fn default_beta(&self) -> f64 {
        if self.is_weighted() { 0.01 } else { 100.0 }
    }

    /// Returns whether elements are weighted by their size in a deformation; the paper does not weight Green's strain.
    pub fn is_weighted(&self) -> bool {
        *self != Self::Density(DensityKind::Green)
    }
}

impl Default for EnergyKind {
    fn default() -> Self {
        Self::Density(DensityKind::default())
    }
}

impl From<DensityKind> for EnergyKind {
    fn from(density: DensityKind) -> Self {
        Self::Density(density)
    }
}

impl From<DisplacementKind> for EnergyKind {
    fn from(displacement: DisplacementKind) -> Self {
        Self::Displacement(displacement)
    }
}

/// Parses a name or a formula.
impl FromStr for DensityKind {
    type Err = FormulaError;

    fn from_str(text: &str) -> Result<Self, FormulaError> {
        let named: Result<Self, Error> = Self::deserialize(text.into_deserializer());
        let density = named.unwrap_or_else(|_| Self::Formula(OwnEnergy::from(text)));
        EnergyKind::Density(density.clone()).check()?;
        Ok(density)
    }
}

/// Parses a name or a formula.
impl FromStr for EnergyKind {
    type Err = FormulaError;

    fn from_str(text: &str) -> Result<Self, FormulaError> {
        let named: Result<DisplacementKind, Error> =
            DisplacementKind::deserialize(text.into_deserializer());
        match named {
            Ok(displacement) => Ok(displacement.into()),
            Err(_) => text.parse().map(Self::Density),
        }
    }
}

// Names for command lines and OpenAPI documents.

#[cfg(feature = "schema")]
impl clap::ValueEnum for EnergyKind {
    fn value_variants<'a>() -> &'a [Self] {
        static ALL: LazyLock<Vec<EnergyKind>> = LazyLock::new(|| {
            let densities = DensityKind::value_variants().iter().cloned();
            let displacements = DisplacementKind::value_variants().iter().copied();
            (densities.map(EnergyKind::from))
                .chain(displacements.map(EnergyKind::from))
                .collect()
        });
        &ALL
    }

    fn to_possible_value(&self) -> Option<clap::builder::PossibleValue> {
        match self {
            Self::Displacement(displacement) => displacement.to_possible_value(),
            Self::Density(density) => density.to_possible_value(),
        }
    }
}

/// Lists the names as an enum, and allows any text that is short enough for a formula of the variables that `variables`
/// names.
#[cfg(feature = "schema")]
fn name_or_formula<T: clap::ValueEnum>(
    variables: &str,
) -> utoipa::openapi::RefOr<utoipa::openapi::Schema> {
    use utoipa::openapi::schema::{AnyOfBuilder, ObjectBuilder, Type};
    let values = (T::value_variants().iter()).filter_map(T::to_possible_value);
    let names = values.map(|value| value.get_name().to_owned());
    let name = ObjectBuilder::new()
        .schema_type(Type::String)
        .enum_values(Some(names));
    let formula = ObjectBuilder::new()
        .schema_type(Type::String)
        .max_length(Some(OwnEnergy::LONGEST))
        .description(Some(format!(
            "A formula of the signed singular values {variables}"
        )))
        .examples(["log(s1)^2 + log(s2)^2"]);
    (AnyOfBuilder::new().item(name).item(formula)).into()
}

#[cfg(feature = "schema")]
impl utoipa::PartialSchema for DensityKind {
    fn schema() -> utoipa::openapi::RefOr<utoipa::openapi::Schema> {
        name_or_formula::<Self>("s1 and s2")
    }
}

#[cfg(feature = "schema")]
impl utoipa::PartialSchema for EnergyKind {
    fn schema() -> utoipa::openapi::RefOr<utoipa::openapi::Schema> {
        name_or_formula::<Self>("s1 and s2, in space s3")
    }
}

#[cfg(feature = "schema")]
impl utoipa::ToSchema for DensityKind {}

#[cfg(feature = "schema")]
impl utoipa::ToSchema for EnergyKind {}
