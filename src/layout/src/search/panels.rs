//! Panels: flat parts that a person would keep straight.

use super::metric::Metric;
use super::pieces::facets;
use unwrapd_maps::mesh::CUT;

/// Times that the excess on a panel counts: bevels, fillets and round parts take the distortion instead. With 16, a study of
/// hard assets found panels as straight as in the layouts of their artists, with 4 less so.
pub const PANEL_FACTOR: f64 = 16.0;
/// Least area of a panel, as a share of the surface. This and the next two tell the panels of the shapes that the same study
/// looked at from the facets of elbows, tori and spheres.
const LEAST: f64 = 0.004;
/// Mean fold around a panel, in radians, that sets it apart from the facets of something round, which are alike and gently folded.
const SET_APART: f64 = 0.9;
/// Area of a panel over that of its neighbors that sets it apart as well.
const LARGER: f64 = 3.0;

/// Sums over the border of a facet, weighted by length.
#[derive(Clone, Copy, Default)]
struct Border {
    length: f64,
    fold: f64,
    area_across: f64,
}

/// Returns for each face whether it lies on a panel: a facet of some size that sharp folds or much smaller neighbors set apart.
pub fn panels(metric: &Metric) -> Vec<bool> {
    let (label, n) = facets(metric);
    let mut area = vec![0.0; n];
    for (&label, &of_face) in label.iter().zip(&metric.area) {
        area[label as usize] += of_face;
    }
    let mut borders = vec![Border::default(); n];
    for (edge, &h) in metric.halfedge.iter().enumerate() {
        let t = metric.twin[h as usize];
        if t == CUT {
            continue;
        }
        let [here, there] = [h, t].map(|h| label[h as usize / 3] as usize);
        if here != there {
            let length = metric.length[edge];
            for (a, b) in [(here, there), (there, here)] {
                borders[a].length += length;
                borders[a].fold += length * metric.fold[edge];
                borders[a].area_across += length * area[b];
            }
        }
    }
    let is_panel = |facet: usize| {
        let Border {
            length,
            fold,
            area_across,
        } = borders[facet];
        // A facet without neighbors is set apart, too.
        area[facet] > LEAST
            && (length <= 0.0
                || fold > SET_APART * length
                || area[facet] * length > LARGER * area_across)
    };
    label
        .iter()
        .map(|&facet| is_panel(facet as usize))
        .collect()
}
