//! SVG's basic shapes as paths.

use super::transform::numbers;
use kurbo::{BezPath, Circle, Ellipse, Rect, RoundedRect, Shape};
use roxmltree::Node;

/// Largest error of the curves of circles and ellipses, in user units, before any flattening.
const ARC_TOLERANCE: f64 = 1e-4;

/// Returns the path of a shape element; `Ok(None)` for other elements and for shapes without extent.
pub(super) fn path(node: Node) -> Result<Option<BezPath>, String> {
    // A missing attribute is zero.
    let length = |name: &str| match node.attribute(name) {
        None => Ok(0.0),
        Some(text) => parse_length(text).ok_or_else(|| format!("`{name}` is not a number: {text}")),
    };
    Ok(Some(match node.tag_name().name() {
        "path" => {
            let data = node.attribute("d").unwrap_or_default();
            BezPath::from_svg(data).map_err(|error| format!("path data: {error}"))?
        }
        "polygon" => polygon(node.attribute("points").unwrap_or_default(), true)?,
        "polyline" => polygon(node.attribute("points").unwrap_or_default(), false)?,
        "rect" => {
            let (x, y, w, h) = (
                length("x")?,
                length("y")?,
                length("width")?,
                length("height")?,
            );
            if w <= 0.0 || h <= 0.0 {
                return Ok(None);
            }
            let rect = Rect::new(x, y, x + w, y + h);
            let radius = length("rx")?.max(length("ry")?).min(0.5 * w.min(h));
            RoundedRect::from_rect(rect, radius).to_path(ARC_TOLERANCE)
        }
        "circle" => {
            let radius = length("r")?;
            if radius <= 0.0 {
                return Ok(None);
            }
            Circle::new((length("cx")?, length("cy")?), radius).to_path(ARC_TOLERANCE)
        }
        "ellipse" => {
            let radii = (length("rx")?, length("ry")?);
            if radii.0 <= 0.0 || radii.1 <= 0.0 {
                return Ok(None);
            }
            let ellipse = Ellipse::new((length("cx")?, length("cy")?), radii, 0.0);
            let mut path = ellipse.to_path(ARC_TOLERANCE);
            path.close_path(); // it ends next to its beginning
            path
        }
        _ => return Ok(None),
    }))
}

fn polygon(points: &str, is_closed: bool) -> Result<BezPath, String> {
    let numbers = numbers(points).ok_or_else(|| format!("points: {points}"))?;
    let mut path = BezPath::new();
    for (k, point) in numbers.chunks_exact(2).enumerate() {
        let point = (point[0], point[1]);
        if k == 0 {
            path.move_to(point);
        } else {
            path.line_to(point);
        }
    }
    if is_closed && !path.is_empty() {
        path.close_path();
    }
    Ok(path)
}

/// Parses a number in user units; `px` is one, other units depend on the screen and are not read.
fn parse_length(text: &str) -> Option<f64> {
    let text = text.trim();
    text.strip_suffix("px").unwrap_or(text).parse().ok()
}
