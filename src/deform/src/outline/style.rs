//! What an SVG element's attributes say of how its shape fills the plane.

use super::{OutlineError, transform};
use kurbo::Affine;
use roxmltree::Node;

/// Which parts of a shape that winds around them several times are inside.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Rule {
    NonZero,
    EvenOdd,
}

impl Rule {
    pub fn is_inside(self, winding: i32) -> bool {
        match self {
            Self::NonZero => winding != 0,
            Self::EvenOdd => winding % 2 != 0,
        }
    }
}

/// What an element hands down to those within it.
#[derive(Clone, Copy)]
pub(super) struct Style {
    pub map: Affine,
    pub is_filled: bool,
    pub rule: Rule,
}

impl Style {
    /// What a document begins with.
    pub const INITIAL: Self = Self {
        map: Affine::IDENTITY,
        is_filled: true,
        rule: Rule::NonZero,
    };

    /// The style of an element; `None` where it is not shown.
    pub fn of(node: Node, outer: Self) -> Result<Option<Self>, OutlineError> {
        if property(node, "display") == Some("none")
            || property(node, "visibility") == Some("hidden")
        {
            return Ok(None);
        }
        let mut style = outer;
        if let Some(text) = node.attribute("transform") {
            let map = transform::parse(text)
                .ok_or_else(|| OutlineError::InvalidSvg(format!("transform: {text}")))?;
            style.map *= map;
        }
        if let Some(fill) = property(node, "fill") {
            style.is_filled = fill != "none";
        }
        if let Some(rule) = property(node, "fill-rule") {
            style.rule = if rule == "evenodd" {
                Rule::EvenOdd
            } else {
                Rule::NonZero
            };
        }
        Ok(Some(style))
    }
}

/// A presentation property, from the `style` attribute or one of its own.
fn property<'a>(node: Node<'a, '_>, name: &str) -> Option<&'a str> {
    let declarations = node.attribute("style").unwrap_or_default().split(';');
    declarations
        .filter_map(|declaration| declaration.split_once(':'))
        .find(|(key, _)| key.trim() == name)
        .map(|(_, value)| value.trim())
        .or_else(|| node.attribute(name).map(str::trim))
}
