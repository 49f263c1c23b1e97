//! The outline of a drawing's filled shapes.

use super::flatten::{PathError, polygons};
use super::nesting::Windings;
use super::style::{Rule, Style};
use super::{Frame, MOST_LOOPS, MOST_VERTICES, Outline, OutlineError, shape};
use kurbo::BezPath;
use roxmltree::{Document, Node, ParsingOptions};
use unwrapd_maps::plane::{doubled_polygon_area, meeting_point};

/// Most elements of a document.
const MOST_NODES: u32 = 1_000_000;
/// Deepest nesting of groups.
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
    let invalid = |error: roxmltree::Error| OutlineError::InvalidSvg(error.to_string());
    let document = Document::parse_with_options(text, options).map_err(invalid)?;
    let root = document.root_element();
    if root.tag_name().name() != "svg" {
        return Err(OutlineError::InvalidSvg("the root is not `svg`".into()));
    }
    let mut drawing = Drawing {
        tolerance: settings.tolerance,
        n_paths: 0,
        n_vertices: 0,
        loops: Vec::new(),
    };
    drawing.visit(root, Style::INITIAL, 0)?;
    Outline::new(drawing.boundary()?)
}

/// A closed polygon of one shape.
struct Loop {
    vertices: Vec<[f64; 2]>,
    shape: usize,
    rule: Rule,
}

struct Drawing {
    tolerance: f64,
    n_paths: usize,
    n_vertices: usize,
    loops: Vec<Loop>,
}

impl Drawing {
    fn visit(&mut self, node: Node, outer: Style, depth: usize) -> Result<(), OutlineError> {
        if depth > DEEPEST {
            return Err(OutlineError::InvalidSvg(
                "groups are nested too deep".into(),
            ));
        }
        let Some(style) = Style::of(node, outer)? else {
            return Ok(());
        };
        if matches!(node.tag_name().name(), "svg" | "g" | "a" | "switch") {
            for child in node.children().filter(Node::is_element) {
                self.visit(child, style, depth + 1)?;
            }
        } else if let Some(path) = shape::path(node).map_err(OutlineError::InvalidSvg)?
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
        let frame = Frame::of(&vertices)?;
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
