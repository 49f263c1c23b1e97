//! The grammar of formulas.
//!
//! ```text
//! sum     = product { ("+" | "-") product }
//! product = signed { ("*" | "/") signed }
//! signed  = "-" signed | power
//! power   = atom [ ("^" | "**") signed ]
//! atom    = number | "s1" | … | "(" sum ")" | ("sqrt" | "exp" | "log" | "cosh") "(" sum ")"
//! ```
//! So −s1^2 is −(s1²), and powers of powers associate to the right, as in Python.

use super::Jet;

/// Longest text, in bytes; the energies of the literature have about 100.
pub(super) const LONGEST: usize = 1000;

/// Deepest nesting of brackets, signs and powers.
const DEEPEST: usize = 50;

/// Parses `text` as an expression of `D` singular values.
pub(super) fn parsed<const D: usize>(text: &str) -> Result<Expression, FormulaError> {
    if text.len() > LONGEST {
        return Err(FormulaError::TooLong { longest: LONGEST });
    }
    let mut parser = Parser {
        text,
        at: 0,
        depth: 0,
        n_sigma: D,
    };
    let expression = parser.sum()?;
    match parser.peek() {
        None => Ok(expression),
        Some(_) => Err(parser.expected("an operator")),
    }
}

struct Parser<'a> {
    text: &'a str,
    /// Position of the next character, in bytes.
    at: usize,
    depth: usize,
    n_sigma: usize,
}

type Parsed = Result<Expression, FormulaError>;

impl<'a> Parser<'a> {
    fn sum(&mut self) -> Parsed {
        let mut sum = self.product()?;
        loop {
            sum = if self.takes("+") {
                Expression::Sum(Box::new([sum, self.product()?]))
            } else if self.takes("-") {
                Expression::Difference(Box::new([sum, self.product()?]))
            } else {
                return Ok(sum);
            };
        }
    }

    fn product(&mut self) -> Parsed {
        let mut product = self.signed()?;
        loop {
            product = if self.takes("*") {
                Expression::Product(Box::new([product, self.signed()?]))
            } else if self.takes("/") {
                Expression::Quotient(Box::new([product, self.signed()?]))
            } else {
                return Ok(product);
            };
        }
    }

    /// Parses a signed expression. Every nested level passes through here, so this function counts the depth.
    fn signed(&mut self) -> Parsed {
        if self.depth == DEEPEST {
            return Err(FormulaError::TooDeep {
                column: self.column(),
                deepest: DEEPEST,
            });
        }
        self.depth += 1;
        let signed = if self.takes("-") {
            Expression::Negative(Box::new(self.signed()?))
        } else {
            self.power()?
        };
        self.depth -= 1;
        Ok(signed)
    }

    fn power(&mut self) -> Parsed {
        let base = self.atom()?;
        if !(self.takes("**") || self.takes("^")) {
            return Ok(base);
        }
        let exponent = self.signed()?;
        Ok(match exponent.constant() {
            Some(number) => Expression::Power(Box::new(base), number),
            None => Expression::Exponential(Box::new([base, exponent])),
        })
    }

    fn atom(&mut self) -> Parsed {
        if self.takes("(") {
            return self.closed();
        }
        match self.peek() {
            Some(c) if c.is_ascii_digit() || c == '.' => self.number(),
            Some(c) if c.is_alphabetic() => self.named(),
            _ => Err(self.expected("a number, a singular value, a function or `(`")),
        }
    }

    /// Parses the contents of brackets after the opening one, up to the closing one.
    fn closed(&mut self) -> Parsed {
        let inside = self.sum()?;
        if self.takes(")") {
            Ok(inside)
        } else {
            Err(self.expected("an operator or `)`"))
        }
    }

    fn number(&mut self) -> Parsed {
        let rest = &self.text[self.at..];
        let digits = |from: usize| {
            let is_digit = |c: char| c.is_ascii_digit() || c == '.';
            from + rest[from..]
                .find(|c| !is_digit(c))
                .unwrap_or(rest.len() - from)
        };
        let mut end = digits(0);
        if let Some(exponent) = rest[end..].strip_prefix(['e', 'E']) {
            let sign = usize::from(exponent.starts_with(['+', '-']));
            end = digits(end + 1 + sign);
        }
        let Ok(number) = rest[..end].parse() else {
            return Err(self.expected("a number"));
        };
        self.at += end;
        Ok(Expression::Number(number))
    }

    fn named(&mut self) -> Parsed {
        let (start, name) = (self.column(), self.name());
        let names = ["s1", "s2", "s3"];
        if let Some(i) = names[..self.n_sigma].iter().position(|&s| s == name) {
            return Ok(Expression::Sigma(i));
        }
        let Some(function) = FunctionName::named(name) else {
            return Err(FormulaError::UnknownName {
                column: start,
                name: name.to_owned(),
                last: self.n_sigma,
            });
        };
        if !self.takes("(") {
            return Err(self.expected("`(`"));
        }
        Ok(Expression::Call(function, Box::new(self.closed()?)))
    }

    fn name(&mut self) -> &'a str {
        let rest = &self.text[self.at..];
        let end = rest
            .find(|c: char| !c.is_alphanumeric())
            .unwrap_or(rest.len());
        self.at += end;
        &rest[..end]
    }

    fn peek(&mut self) -> Option<char> {
        let rest = self.text[self.at..].trim_start();
        self.at = self.text.len() - rest.len();
        rest.chars().next()
    }

    /// Skips the sign and returns `true` if it comes next.
    fn takes(&mut self, sign: &str) -> bool {
        self.peek();
        let rest = &self.text[self.at..];
        // `**` is one sign.
        let comes = rest.starts_with(sign) && !(sign == "*" && rest.starts_with("**"));
        self.at += if comes { sign.len() } else { 0 };
        comes
    }

    fn column(&mut self) -> usize {
        self.peek();
        self.text[..self.at].chars().count() + 1
    }

    fn expected(&mut self, expected: &'static str) -> FormulaError {
        FormulaError::Unexpected {
            column: self.column(),
            expected,
        }
    }
}

// Formulas as expression trees.

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
    Call(FunctionName, Box<Self>),
}

/// A function of one argument.
#[derive(Clone, Copy, Debug)]
pub(super) enum FunctionName {
    Sqrt,
    Exp,
    Log,
    Cosh,
}

impl FunctionName {
    fn named(name: &str) -> Option<Self> {
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
    fn constant(&self) -> Option<f64> {
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

// Reasons why a formula is not an energy.

/// Reason why a formula is not an energy. Columns count characters, from 1.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
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
    #[error("the energy is not finite at the identity: it is {value}")]
    NotFinite {
        /// Value at the identity.
        value: f64,
    },
    /// ψ has no first or second derivatives at the identity.
    #[error("the energy is not smooth at the identity: it has no second derivatives there")]
    NotSmooth,
    /// ψ changes when singular values are exchanged.
    #[error("the energy is not symmetric: it changes when singular values are exchanged")]
    NotSymmetric,
    /// ψ is smaller at some singular values near the identity than at the identity.
    #[error("the energy is not minimal at the identity: it is less at singular values {at:?}")]
    NotMinimal {
        /// Singular values at which ψ is smaller.
        at: Vec<f64>,
    },
    /// A density was given for the other dimension only.
    #[error("there is no energy of {dim} singular values")]
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
