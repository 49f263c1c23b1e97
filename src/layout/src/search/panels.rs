//! Panels: flat parts and walls that a person would keep straight.

use super::metric::Metric;
use super::pieces::Pieces;
use crate::charts::Observer;
use unwrapd_maps::mesh::CUT;

/// Times that the excess on a panel counts: bevels, fillets and round parts take the distortion instead. With 16, a study of
/// hard assets found panels as straight as in the layouts of their artists, with 4 less so.
pub const PANEL_FACTOR: f64 = 16.0;
/// Least area of a flat panel, as a share of the surface. This and the next two tell the panels of the shapes that the same study
/// looked at from the facets of elbows, tori and spheres.
const LEAST: f64 = 0.004;
/// Mean fold around a panel, in radians, that sets it apart from the facets of something round, which are alike and gently folded.
const SET_APART: f64 = 0.9;
/// Area of a flat panel over that of its neighbors that sets it apart as well.
const LARGER: f64 = 3.0;
/// Least area of a wall, as a share of the surface. Smaller ones, of holes and studs, take distortion: with a tenth of this, seams and
/// charts cost up to twice as much on 6 of 19 machine parts (`cargo bench -p unwrapd-layout --bench search`).
const LEAST_WALL: f64 = 0.05;
/// Largest sum of the angle defects inside a wall, in radians; its excess is then below 1e-6.
const STRAIGHT: f64 = 0.01;

/// A connected part of a surface; sums over its border are weighted by length.
#[derive(Clone, Copy, Default)]
struct SurfacePart {
    area: f64,
    /// Length of the border to other parts.
    border: f64,
    fold: f64,
    area_across: f64,
}

impl SurfacePart {
    /// Returns whether the folds to other parts are sharp on average, or there are none.
    fn is_set_apart(&self) -> bool {
        self.border <= 0.0 || self.fold > SET_APART * self.border
    }

    fn is_larger(&self) -> bool {
        self.area * self.border > LARGER * self.area_across
    }
}

impl Metric<'_> {
    /// Lets the excess on panels count [several times](PANEL_FACTOR); returns the share of the area that lies on panels.
    ///
    /// If the observer ends that early, some of the panels are not known.
    pub fn weigh_panels(&mut self, observer: &dyn Observer) -> f64 {
        let is_panel = panels(self, observer);
        let faces = self.weight.iter_mut().zip(&self.area).zip(is_panel);
        let mut share = 0.0;
        for ((weight, area), _) in faces.filter(|(_, is_panel)| *is_panel) {
            *weight *= PANEL_FACTOR;
            share += area;
        }
        share
    }
}

/// Returns for each face whether it lies on a panel.
///
/// A panel is a facet of some size that sharp folds or much smaller neighbors set apart, or a large wall, such as that of a tube: other
/// facets, gently folded, that are developable together, with sharp folds around.
fn panels(metric: &Metric, observer: &dyn Observer) -> Vec<bool> {
    let mut pieces = Pieces::of_facets(metric);
    let facet = pieces.labels();
    let facets = parts(metric, &facet);
    let is_flat =
        |part: &SurfacePart| part.area > LEAST && (part.is_set_apart() || part.is_larger());
    let mut is_panel: Vec<bool> = (facet.iter())
        .map(|&facet| is_flat(&facets[facet as usize]))
        .collect();
    let may_be_inside = |edge: u32| {
        let h = metric.halfedge[edge as usize];
        let mut sides = [h, metric.twin[h as usize]].into_iter();
        metric.fold[edge as usize] < SET_APART && sides.all(|h| !is_panel[h as usize / 3])
    };
    pieces.join(STRAIGHT, may_be_inside, observer);
    let wall = pieces.labels();
    let walls = parts(metric, &wall);
    for (is_panel, &wall) in is_panel.iter_mut().zip(&wall) {
        let wall = &walls[wall as usize];
        *is_panel |= wall.area > LEAST_WALL && wall.is_set_apart();
    }
    is_panel
}

/// Returns the parts into which labels divide the faces.
fn parts(metric: &Metric, label: &[u32]) -> Vec<SurfacePart> {
    let n = label.iter().max().map_or(0, |&last| last as usize + 1);
    let mut parts = vec![SurfacePart::default(); n];
    for (&label, &area) in label.iter().zip(&metric.area) {
        parts[label as usize].area += area;
    }
    for (edge, &h) in metric.halfedge.iter().enumerate() {
        let t = metric.twin[h as usize];
        if t == CUT {
            continue;
        }
        let [here, there] = [h, t].map(|h| label[h as usize / 3] as usize);
        if here != there {
            let length = metric.length[edge];
            for (a, b) in [(here, there), (there, here)] {
                parts[a].border += length;
                parts[a].fold += length * metric.fold[edge];
                parts[a].area_across += length * parts[b].area;
            }
        }
    }
    parts
}
