//! Formulas as expression trees.

use super::Jet;

/// A formula, or a part of one. The parser bounds the depth of trees, so recursion cannot exhaust the stack.
#[derive(Clone, Debug)]
pub(super) enum Expression {
    Number(f64),
    /// A singular value, by its index from 0.
    Sigma(usize),
    Sum(Box<[Self; 2]>),
    Difference(Box<[Self; 2]>),
    Product(Box<[Self; 2]>),
    Quotient(Box<[Self; 2]>),
    /// An expression raised to a constant power.
    Power(Box<Self>, f64),
    /// The first expression raised to the power of the second.
    Exponential(Box<[Self; 2]>),
    Negative(Box<Self>),
    Call(Function, Box<Self>),
}

/// A function of one argument.
#[derive(Clone, Copy, Debug)]
pub(super) enum Function {
    Sqrt,
    Exp,
    Log,
    Cosh,
}

impl Function {
    pub(super) fn named(name: &str) -> Option<Self> {
        Some(match name {
            "sqrt" => Self::Sqrt,
            "exp" => Self::Exp,
            "log" => Self::Log,
            "cosh" => Self::Cosh,
            _ => return None,
        })
    }

    fn of<const D: usize>(self, x: Jet<D>) -> Jet<D> {
        match self {
            Self::Sqrt => x.sqrt(),
            Self::Exp => x.exp(),
            Self::Log => x.ln(),
            Self::Cosh => x.cosh(),
        }
    }
}

impl Expression {
    /// Returns the value and its derivatives, given those of the singular values.
    pub(super) fn at<const D: usize>(&self, sigma: &[Jet<D>; D]) -> Jet<D> {
        match self {
            Self::Number(number) => Jet::constant(*number),
            Self::Sigma(i) => sigma[*i],
            Self::Sum(parts) => parts[0].at(sigma) + parts[1].at(sigma),
            Self::Difference(parts) => parts[0].at(sigma) - parts[1].at(sigma),
            Self::Product(parts) => match &**parts {
                [Self::Number(number), x] | [x, Self::Number(number)] => x.at(sigma) * *number,
                [x, y] => x.at(sigma) * y.at(sigma),
            },
            Self::Quotient(parts) => match &**parts {
                [Self::Number(number), x] => x.at(sigma).powf(-1.0) * *number,
                [x, y] => x.at(sigma) / y.at(sigma),
            },
            Self::Power(x, p) => x.at(sigma).powf(*p),
            Self::Exponential(parts) => parts[0].at(sigma).pow(parts[1].at(sigma)),
            Self::Negative(x) => -x.at(sigma),
            Self::Call(function, x) => function.of(x.at(sigma)),
        }
    }

    /// Returns the number that the expression equals; `None` if a singular value occurs in it.
    pub(super) fn constant(&self) -> Option<f64> {
        let is_constant = match self {
            Self::Number(_) => true,
            Self::Sigma(_) => false,
            Self::Sum(parts)
            | Self::Difference(parts)
            | Self::Product(parts)
            | Self::Quotient(parts)
            | Self::Exponential(parts) => parts.iter().all(|part| part.constant().is_some()),
            Self::Power(x, _) | Self::Negative(x) | Self::Call(_, x) => x.constant().is_some(),
        };
        is_constant.then(|| self.at::<0>(&[]).value)
    }
}
