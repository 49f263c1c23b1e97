//! Why a formula is not an energy.

/// Why a formula is not an energy. Columns count characters, from 1.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FormulaError {
    /// The text is too long.
    #[error("the formula is longer than {longest} bytes")]
    TooLong {
        /// How long it may be.
        longest: usize,
    },
    /// Brackets, signs and powers are nested too deep.
    #[error("the formula is nested more than {deepest} deep at column {column}")]
    TooDeep {
        /// Where.
        column: usize,
        /// How deep it may be.
        deepest: usize,
    },
    /// Something else stands where the grammar wants one of these.
    #[error("the formula needs {expected} at column {column}")]
    Unexpected {
        /// Where.
        column: usize,
        /// What could stand there.
        expected: &'static str,
    },
    /// A name that is neither a singular value nor a function.
    #[error(
        "the formula does not know `{name}` at column {column}; it knows s1 to s{last}, sqrt, exp, \
         log and cosh"
    )]
    UnknownName {
        /// Where.
        column: usize,
        /// The name.
        name: String,
        /// How many singular values there are.
        last: usize,
    },
    /// ψ is not finite at the identity.
    #[error("the formula is not finite at the identity: it is {value}")]
    NotFinite {
        /// What it is.
        value: f64,
    },
    /// ψ has no first or second derivatives at the identity.
    #[error("the formula is not smooth at the identity: it has no second derivatives there")]
    NotSmooth,
    /// ψ changes when singular values are exchanged.
    #[error("the formula is not symmetric: it changes when singular values are exchanged")]
    NotSymmetric,
    /// ψ is less near the identity than there.
    #[error("the formula is not minimal at the identity: it is less at singular values {at:?}")]
    NotMinimal {
        /// Where it is less.
        at: Vec<f64>,
    },
    /// There is a closure for the other dimension only.
    #[error("there is no formula of {dim} singular values")]
    OtherDimension {
        /// How many singular values there are.
        dim: usize,
    },
}

impl FormulaError {
    /// The column that it names, if it names one.
    pub fn column(&self) -> Option<usize> {
        match self {
            Self::TooDeep { column, .. }
            | Self::Unexpected { column, .. }
            | Self::UnknownName { column, .. } => Some(*column),
            _ => None,
        }
    }
}
