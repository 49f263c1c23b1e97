//! Reasons why a formula is not an energy.

/// Reason why a formula is not an energy. Columns count characters, from 1.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FormulaError {
    /// The text is too long.
    #[error("the formula is longer than {longest} bytes")]
    TooLong {
        /// Largest length, in bytes.
        longest: usize,
    },
    /// Brackets, signs and powers are nested too deep.
    #[error("the formula is nested more than {deepest} deep at column {column}")]
    TooDeep {
        /// Column of the excess.
        column: usize,
        /// Deepest nesting allowed.
        deepest: usize,
    },
    /// The formula contains something else where the grammar requires one of these.
    #[error("the formula needs {expected} at column {column}")]
    Unexpected {
        /// Column of the unexpected text.
        column: usize,
        /// Tokens that are allowed there.
        expected: &'static str,
    },
    /// A name that is neither a singular value nor a function.
    #[error(
        "the formula does not know `{name}` at column {column}; it knows s1 to s{last}, sqrt, exp, \
         log and cosh"
    )]
    UnknownName {
        /// Column of the name.
        column: usize,
        /// The unknown name.
        name: String,
        /// Number of singular values.
        last: usize,
    },
    /// ψ is not finite at the identity.
    #[error("the formula is not finite at the identity: it is {value}")]
    NotFinite {
        /// Value at the identity.
        value: f64,
    },
    /// ψ has no first or second derivatives at the identity.
    #[error("the formula is not smooth at the identity: it has no second derivatives there")]
    NotSmooth,
    /// ψ changes when singular values are exchanged.
    #[error("the formula is not symmetric: it changes when singular values are exchanged")]
    NotSymmetric,
    /// ψ is smaller at some singular values near the identity than at the identity.
    #[error("the formula is not minimal at the identity: it is less at singular values {at:?}")]
    NotMinimal {
        /// Singular values at which ψ is smaller.
        at: Vec<f64>,
    },
    /// A closure was given for the other dimension only.
    #[error("there is no formula of {dim} singular values")]
    OtherDimension {
        /// Number of singular values.
        dim: usize,
    },
}

impl FormulaError {
    /// Returns the column of the error, if it has one.
    pub fn column(&self) -> Option<usize> {
        match self {
            Self::TooDeep { column, .. }
            | Self::Unexpected { column, .. }
            | Self::UnknownName { column, .. } => Some(*column),
            _ => None,
        }
    }
}
