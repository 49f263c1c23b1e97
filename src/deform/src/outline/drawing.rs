//! The outline of a drawing's filled shapes.

use super::{MOST_LOOPS, MOST_VERTICES, Outline, OutlineError, OutlineFrame, Windings};
use kurbo::{Affine, BezPath, Circle, Ellipse, PathEl, Point, Rect, RoundedRect, Shape};
use roxmltree::{Document, Node, ParsingOptions};
use unwrapd_maps::plane::{doubled_polygon_area, meeting_point};

/// Most elements of a document.
const MOST_NODES: u32 = 1_000_000;
/// Deepest nesting of groups: bounds the recursion.
const DEEPEST: usize = 64;

/// Settings for outlining a drawing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SvgSettings {
    /// Largest distance of the polygons from the curves, in user units.
    pub tolerance: f64,
}

impl Default for SvgSettings {
    fn default() -> Self {
        Self { tolerance: 0.25 }
    }
}

/// Computes the outline of everything that is filled: paths, polygons, rectangles, circles and ellipses, with the
/// transforms of their groups, in user units of the document's root (its `viewBox` is not applied).
///
/// Shapes within each other count as their union; within one shape its `fill-rule` applies. Shapes that cross are
/// refused: unite them in the drawing first. Not drawn are shapes with `fill="none"`, hidden ones, those in
/// definitions, text, and references (`use`). Documents with entity declarations are refused.
pub fn of_svg(text: &str, settings: &SvgSettings) -> Result<Outline, OutlineError> {
    if !(settings.tolerance > 0.0 && settings.tolerance.is_finite()) {
        return Err(OutlineError::InvalidSetting("tolerance"));
    }
    if text.contains("<!ENTITY") {
        return Err(OutlineError::InvalidSvg("it declares entities".into()));
    }
    let options = ParsingOptions {
        allow_dtd: true, // many programs write a document type
        nodes_limit: MOST_NODES,
        ..ParsingOptions::default()
    };
    let document = Document::parse_with_options(text, options)
        .map_err(|error: roxmltree::Error| OutlineError::InvalidSvg(error.to_string()))?;
    let root = document.root_element();
    if root.tag_name().name() != "svg" {
        return Err(OutlineError::InvalidSvg("the root is not `svg`".into()));
    }
    let mut drawing = SvgDrawing {
        tolerance: settings.tolerance,
        n_paths: 0,
        n_vertices: 0,
        loops: Vec::new(),
    };
    drawing.visit(root, SvgStyle::INITIAL, 0)?;
    Outline::new(drawing.boundary()?)
}

/// A closed polygon of one shape.
struct Loop {
    vertices: Vec<[f64; 2]>,
    shape: usize,
    rule: Rule,
}

struct SvgDrawing {
    tolerance: f64,
    n_paths: usize,
    n_vertices: usize,
    loops: Vec<Loop>,
}

impl SvgDrawing {
    fn visit(&mut self, node: Node, outer: SvgStyle, depth: usize) -> Result<(), OutlineError> {
        if depth > DEEPEST {
            return Err(OutlineError::InvalidSvg(
                "groups are nested too deep".into(),
            ));
        }
        let Some(style) = SvgStyle::of(node, outer)? else {
            return Ok(());
        };
        if matches!(node.tag_name().name(), "svg" | "g" | "a" | "switch") {
            for child in node.children().filter(Node::is_element) {
                self.visit(child, style, depth + 1)?;
            }
        } else if let Some(path) = path(node).map_err(OutlineError::InvalidSvg)?
            && style.is_filled
        {
            self.n_paths += 1;
            self.push_path(style.map * path, style.rule)?;
        }
        Ok(())
    }

    /// Adds the closed polygons of a path.
    fn push_path(&mut self, path: BezPath, rule: Rule) -> Result<(), OutlineError> {
        let polygons = match polygons(path, self.tolerance, MOST_VERTICES - self.n_vertices) {
            Ok(polygons) => polygons,
            Err(PathError::OutOfRange) => {
                let reason = "a coordinate is out of range";
                return Err(OutlineError::InvalidSvg(reason.into()));
            }
            Err(PathError::TooDetailed) => return Err(OutlineError::TooDetailed),
            Err(PathError::Open) => return Err(OutlineError::OpenPath { path: self.n_paths }),
        };
        self.n_vertices += polygons.iter().map(Vec::len).sum::<usize>();
        let shape = self.n_paths;
        self.loops.extend(polygons.into_iter().map(|vertices| Loop {
            vertices,
            shape,
            rule,
        }));
        if self.loops.len() > MOST_LOOPS {
            return Err(OutlineError::TooDetailed);
        }
        Ok(())
    }

    /// Returns the polygons that bound the union of all shapes: those with no shape on one side.
    fn boundary(self) -> Result<Vec<Vec<[f64; 2]>>, OutlineError> {
        // Put all loops on one grid and refuse those that cross or touch.
        let vertices: Vec<_> = self.loops.iter().map(|l| l.vertices.clone()).collect();
        let frame = OutlineFrame::of(&vertices)?;
        let (loops, owners): (Vec<_>, Vec<_>) = self
            .loops
            .into_iter()
            .map(|l| (frame.polygon(l.vertices), (l.shape, l.rule)))
            .filter(|(vertices, _)| vertices.len() >= 3)
            .unzip();
        if let Some(at) = meeting_point(&loops) {
            return Err(OutlineError::SelfIntersecting { at });
        }
        // A loop is a boundary if no other shape covers it and its own shape is on one side only.
        let windings = Windings::new(&loops);
        let is_boundary = |k: usize| {
            let (shape, rule) = owners[k];
            let mut outside = 0;
            let mut covering: Vec<(usize, Rule, i32)> = Vec::new();
            for (other, &(of, of_rule)) in owners.iter().enumerate().filter(|&(o, _)| o != k) {
                let winding = windings.around(loops[k][0], other);
                if of == shape {
                    outside += winding;
                } else {
                    match covering.last_mut() {
                        Some(last) if last.0 == of => last.2 += winding,
                        _ => covering.push((of, of_rule, winding)),
                    }
                }
            }
            let turn = if doubled_polygon_area(&loops[k]) > 0.0 {
                1
            } else {
                -1
            };
            let is_covered = covering
                .iter()
                .any(|&(_, rule, winding)| rule.is_inside(winding));
            !is_covered && rule.is_inside(outside) != rule.is_inside(outside + turn)
        };
        let kept: Vec<bool> = (0..loops.len()).map(is_boundary).collect();
        Ok(loops
            .into_iter()
            .zip(kept)
            .filter_map(|(vertices, kept)| kept.then_some(vertices))
            .collect())
    }
}

// Paths of curves as closed polygons.

/// Largest coordinate of a path.
const GREATEST: f64 = 1e9;

/// Reason why a path has no polygons.
enum PathError {
    /// A coordinate is not finite or beyond [`GREATEST`].
    OutOfRange,
    /// The path has more vertices than allowed.
    TooDetailed,
    /// A part of the path does not end where it began.
    Open,
}

/// Returns the closed polygons of a path, nowhere farther than `tolerance` from its curves, with at most
/// `most_vertices` in total.
///
/// A polygon may repeat its first vertex at its end. Parts of a single point are left out.
fn polygons(
    path: BezPath,
    tolerance: f64,
    most_vertices: usize,
) -> Result<Vec<Vec<[f64; 2]>>, PathError> {
    if !path.elements().iter().all(|e: &PathEl| {
        e.is_finite()
            && e.end_point()
                .is_none_or(|p: Point| p.x.abs() < GREATEST && p.y.abs() < GREATEST)
    }) {
        return Err(PathError::OutOfRange);
    }
    let mut parts = PathParts::default();
    let mut n_vertices = 0;
    kurbo::flatten(path, tolerance, |element| {
        n_vertices += 1;
        if n_vertices <= most_vertices {
            parts.push(element);
        }
    });
    parts.begin(None);
    if n_vertices > most_vertices {
        Err(PathError::TooDetailed)
    } else if parts.is_any_open {
        Err(PathError::Open)
    } else {
        Ok(parts.closed)
    }
}

/// The finished parts of a path, and the one in progress.
#[derive(Default)]
struct PathParts {
    closed: Vec<Vec<[f64; 2]>>,
    is_any_open: bool,
    current: Vec<[f64; 2]>,
}

impl PathParts {
    fn push(&mut self, element: PathEl) {
        match element {
            PathEl::MoveTo(p) => self.begin(Some([p.x, p.y])),
            PathEl::LineTo(p) => self.current.push([p.x, p.y]),
            // Flattened paths have no other elements than the end of a part. What follows begins where this part did,
            // if it has no beginning of its own.
            _ => {
                let first = self.current.first().copied();
                self.current.extend(first);
                self.begin(first);
            }
        }
    }

    /// Ends the current part and begins another one at a point.
    fn begin(&mut self, first: Option<[f64; 2]>) {
        let part = std::mem::replace(&mut self.current, first.into_iter().collect());
        if part.len() > 1 {
            self.is_any_open |= part.first() != part.last();
            self.closed.push(part);
        }
    }
}

// SVG's basic shapes as paths.

/// Largest error of the curves of circles and ellipses, in user units, before any flattening.
const ARC_TOLERANCE: f64 = 1e-4;

/// Returns the path of a shape element; `Ok(None)` for other elements and for shapes without extent.
fn path(node: Node) -> Result<Option<BezPath>, String> {
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

// Presentation attributes of SVG elements that affect the filled region.

/// Fill rule: the parts inside a shape that winds around them several times.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Rule {
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
struct SvgStyle {
    pub map: Affine,
    pub is_filled: bool,
    pub rule: Rule,
}

impl SvgStyle {
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
            let map = parse(text)
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

// SVG's `transform` attribute.

/// Parses a list of transforms; returns `None` if it is malformed.
pub(super) fn parse(text: &str) -> Option<Affine> {
    let mut map = Affine::IDENTITY;
    let mut rest = text.trim();
    while !rest.is_empty() {
        let (name, after) = rest.split_once('(')?;
        let (arguments, after) = after.split_once(')')?;
        map *= transform(name.trim(), &numbers(arguments)?)?;
        rest = after.trim_start_matches(|c: char| c.is_whitespace() || c == ',');
    }
    map.as_coeffs().iter().all(|x| x.is_finite()).then_some(map)
}

/// Parses numbers separated by blanks or commas.
pub(super) fn numbers(text: &str) -> Option<Vec<f64>> {
    text.split(|c: char| c.is_whitespace() || c == ',')
        .filter(|word| !word.is_empty())
        .map(|word| word.parse().ok())
        .collect()
}

fn transform(name: &str, arguments: &[f64]) -> Option<Affine> {
    Some(match (name, arguments) {
        ("matrix", &[a, b, c, d, e, f]) => Affine::new([a, b, c, d, e, f]),
        ("translate", &[x]) => Affine::translate((x, 0.0)),
        ("translate", &[x, y]) => Affine::translate((x, y)),
        ("scale", &[s]) => Affine::scale(s),
        ("scale", &[x, y]) => Affine::scale_non_uniform(x, y),
        ("rotate", &[degrees]) => Affine::rotate(degrees.to_radians()),
        ("rotate", &[degrees, x, y]) => Affine::rotate_about(degrees.to_radians(), (x, y)),
        ("skewX", &[degrees]) => Affine::skew(degrees.to_radians().tan(), 0.0),
        ("skewY", &[degrees]) => Affine::skew(0.0, degrees.to_radians().tan()),
        _ => return None,
    })
}
