//! A table of atlases: at most ten lines and totals.

use super::console::{one_line, say};
use unwrapd_maps::certificate::Certificate;
use unwrapd_maps::measure::Page;
use unwrapd_pipeline::{GroupReport, stretch_percent};

/// Maximum number of lines, without head and totals: the table fits on a screen together with the rest of the output.
const LINES: usize = 10;
/// Maximum length of a name in characters. Longer names make lines wrap on more terminals.
const NAME: usize = 28;

/// Prints the quality of atlases: uncertified ones first, then the largest. If there are more than ten, the last line
/// sums up the rest.
pub(super) fn print(groups: &[GroupReport]) {
    // Choose the atlases to show.
    let mut order: Vec<&GroupReport> = groups.iter().collect();
    order.sort_by_key(|group| (group.is_certified(), usize::MAX - group.measures.size.faces));
    let n_shown = if order.len() <= LINES {
        order.len()
    } else {
        LINES - 1
    };
    let (shown, rest) = order.split_at(n_shown);
    let width = shown
        .iter()
        .map(|group| one_line(&group.label).chars().count())
        .max()
        .unwrap_or(0);
    let width = width.clamp(10, NAME);
    // Print the table.
    say(format_args!(
        "{:width$} {:>9} {:>7} {:>11} {:>8} {:>8} {:>15} {:>16} {:>8} {:>8} {:>11}",
        "",
        "triangles",
        "charts",
        "stretch p99",
        "mean",
        "filled",
        "texels per unit",
        "seams per √area",
        "flipped",
        "no area",
        "overlapping"
    ));
    for group in shown {
        let name: String = one_line(&group.label).chars().take(NAME).collect();
        say(line(&name, width, &Sums::of(&[group])));
    }
    if !rest.is_empty() {
        let name = format!("{} others", rest.len());
        say(line(&name, width, &Sums::of(rest)));
    }
    if groups.len() > 1 {
        let name = format!("{} atlases", groups.len());
        say(line(&name, width, &Sums::of(&order)));
    }
    // Explain needles, and list the pages.
    let needles = Sums::of(&order).needles;
    if needles > 0 {
        say(format_args!(
            "needles: {needles} triangles less high than 1/10,000 of their length; stretch leaves them out where they have less than \
             .1 % of the area"
        ));
    }
    for group in shown.iter().filter(|group| group.measures.pages.len() > 1) {
        let page = |page: &Page| format!("{} {:.1} % filled", page.udim, 100.0 * page.fill);
        let pages: Vec<String> = group.measures.pages.iter().map(page).collect();
        say(format_args!("{}: {}", group.label, pages.join(", ")));
    }
}

fn line(name: &str, width: usize, sums: &Sums) -> String {
    let number = |x: Option<f64>| x.map_or("-".into(), three_digits);
    let percent = |x: Option<f64>| x.map_or("-".into(), |x| format!("{x:.1} %"));
    let overlapping = sums.overlapping.map_or("-".to_owned(), |n| n.to_string());
    format!(
        "{name:width$} {:>9} {:>7} {:>11} {:>8} {:>8} {:>15} {:>16} {:>8} {:>8} {overlapping:>11}",
        sums.faces,
        sums.charts,
        percent(sums.stretch.map(|stretch| 100.0 * (stretch - 1.0))),
        percent(sums.energy().map(stretch_percent)),
        percent(sums.filled.map(|share| 100.0 * share)),
        number(sums.density()),
        number(sums.seams()),
        sums.flipped,
        sums.degenerate,
    )
}

/// Formats a number with three significant digits: 340, 3.27, 0.0123, 1.2e9.
fn three_digits(x: f64) -> String {
    let rounded: f64 = format!("{x:.2e}").parse().unwrap_or(x);
    match rounded {
        0.0 => "0".into(),
        1e-4..1e7 => {
            let decimals = (2 - rounded.log10().floor() as i32).max(0) as usize;
            format!("{rounded:.decimals$}")
        }
        _ => format!("{rounded:e}"),
    }
}

/// Figures of several atlases: sums of counts, and means weighted by surface area.
#[derive(Default)]
struct Sums {
    faces: usize,
    charts: usize,
    area: f64,
    /// Sum of energy times area, over surfaces with an energy.
    energies: Option<f64>,
    /// Maximum 99th percentile of the stretch.
    stretch: Option<f64>,
    needles: usize,
    texels: Option<f64>,
    seam: f64,
    /// Mean over all pages.
    filled: Option<f64>,
    flipped: usize,
    degenerate: usize,
    overlapping: Option<u64>,
}

impl Sums {
    fn of(groups: &[&GroupReport]) -> Self {
        // Add up counts, and areas times means.
        let mut sums = Self::default();
        let mut fills = Vec::new();
        for group in groups {
            let m = &group.measures;
            let area = m.size.area_3d;
            let certificate: &Certificate = &group.certificate;
            sums.faces += m.size.faces;
            sums.charts += m.seams.charts;
            sums.area += area;
            if let Some(energy) = m.distortion.sym_dirichlet_mean {
                *sums.energies.get_or_insert(0.0) += energy * area;
            }
            let largest = [sums.stretch, m.distortion.stretch_p99]
                .into_iter()
                .flatten();
            sums.stretch = largest.reduce(f64::max);
            sums.needles += m.distortion.needles;
            if let Some(texels) = group.texels_per_unit {
                *sums.texels.get_or_insert(0.0) += texels * texels * area;
            }
            sums.seam += m.seams.seam_over_sqrt_area.unwrap_or(0.0) * area.sqrt();
            fills.extend(m.pages.iter().map(|page| page.fill));
            sums.flipped += certificate.flipped;
            sums.degenerate += certificate.degenerate;
            if let Some(pairs) = certificate.overlapping_pairs {
                *sums.overlapping.get_or_insert(0) += pairs;
            }
        }
        // Average over the pages.
        let n = fills.len();
        sums.filled = (n > 0).then(|| fills.iter().sum::<f64>() / n as f64);
        sums
    }

    fn mean(&self, of: Option<f64>) -> Option<f64> {
        of.filter(|_| self.area > 0.0).map(|sum| sum / self.area)
    }

    fn energy(&self) -> Option<f64> {
        self.mean(self.energies)
    }

    fn density(&self) -> Option<f64> {
        self.mean(self.texels).map(f64::sqrt)
    }

    fn seams(&self) -> Option<f64> {
        (self.area > 0.0).then(|| self.seam / self.area.sqrt())
    }
}
