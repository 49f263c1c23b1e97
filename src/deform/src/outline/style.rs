//! Presentation attributes of SVG elements that affect the filled region.

use super::{OutlineError, transform};
use kurbo::Affine;
use roxmltree::Node;

/// Fill rule: the parts inside a shape that winds around them several times.
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

/// Properties that an element passes on to its children.
#[derive(Clone, Copy)]
pub(super) struct Style {
    pub map: Affine,
    pub is_filled: bool,
    pub rule: Rule,
}

impl Style {
    /// Properties of the root.
    pub const INITIAL: Self = Self {
        map: Affine::IDENTITY,
        is_filled: true,
        rule: Rule::NonZero,
    };

    /// Returns the style of an element; `None` if it is not shown.
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

/// Returns a presentation property, from the `style` attribute or an attribute of its own.
fn property<'a>(node: Node<'a, '_>, name: &str) -> Option<&'a str> {
    let declarations = node.attribute("style").unwrap_or_default().split(';');
    declarations
        .filter_map(|declaration| declaration.split_once(':'))
        .find(|(key, _)| key.trim() == name)
        .map(|(_, value)| value.trim())
        .or_else(|| node.attribute(name).map(str::trim))
}
