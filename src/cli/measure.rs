//! `unwrapd measure` and `unwrapd verify`: quality of existing UVs, and proofs about them.

use super::console::{self, CommandFailure, LineTarget, one_line, print_json, say, warn};
use super::files::{Mapped, read_upload};
use unwrapd_maps::certificate::Certificate;
use unwrapd_pipeline::{
    self as pipeline, GroupReport, MeasureOptions, VerifyOptions, stretch_percent, verify_document,
};

/// Measures the UVs of a file: distortion, seams, packing, overlaps.
#[derive(clap::Args)]
pub(super) struct Args {
    #[command(flatten)]
    mapped: Mapped,
    #[command(flatten)]
    options: MeasureOptions,
    /// Print the whole report as JSON
    #[arg(long)]
    json: bool,
}

/// Runs `measure`.
pub(super) fn run(args: &Args) -> Result<(), CommandFailure> {
    let upload = read_upload(&args.mapped.input)?;
    let report = pipeline::measure_document(&upload, &args.options)?;
    if args.json {
        print_json(&report)?;
    } else {
        print_table(&report.groups);
        warn(&report.warnings);
    }
    Ok(())
}

/// Formats the counts of faces and defects.
fn certificate_text(certificate: &Certificate) -> String {
    let overlap = certificate
        .overlapping_pairs
        .map_or(String::new(), |n| format!(", {n} overlapping pairs"));
    format!(
        "{} faces ({} exempt), {} flipped, {} degenerate{overlap}",
        certificate.faces, certificate.exempt_faces, certificate.flipped, certificate.degenerate
    )
}

// `unwrapd verify`: proofs about existing UVs.

/// The arguments of `verify`.
#[derive(clap::Args)]
pub(super) struct VerifyArgs {
    #[command(flatten)]
    mapped: Mapped,
    #[command(flatten)]
    options: VerifyOptions,
    /// Print the certificates as JSON
    #[arg(long)]
    json: bool,
    /// Print nothing; the exit status tells the result
    #[arg(short, long, conflicts_with = "json")]
    quiet: bool,
}

/// Runs `verify`; exits with 4 if a requested property does not hold.
pub(super) fn verify(args: &VerifyArgs) -> Result<(), CommandFailure> {
    if args.quiet {
        console::direct(LineTarget::None);
    }
    // Judge the file.
    let upload = read_upload(&args.mapped.input)?;
    let verified = verify_document(&upload, &args.options)?;
    // Print what was required, and the certificates.
    if args.json {
        print_json(&verified)?;
    } else {
        say(format_args!("judged: {}", verified.judged));
        if let Some(mark) = &verified.mark {
            let required = mark.terms.to_string();
            if !required.is_empty() {
                say(format_args!(
                    "required by the record in the file: {required}"
                ));
            }
            let made_for = mark.terms.group_by;
            if made_for != verified.judged.group_by && args.options.judged.group_by.is_none() {
                say(format_args!(
                    "the record says that the UVs were made with --group-by {made_for}"
                ));
            }
        }
        for group in &verified.groups {
            let text = certificate_text(&group.certificate);
            say(format_args!("{}: {text}", group.label));
            let islands = &group.certificate.islands;
            if !islands.faulty.is_empty() {
                say(format_args!("{}: islands: {islands}", group.label));
            }
        }
    }
    warn(&verified.warnings);
    // Fail if a requirement does not hold.
    if !verified.certified {
        let lacking = verified.lacking.join(", ");
        return Err(CommandFailure::uncertified(format!("not valid: {lacking}")));
    }
    if !args.json {
        say(format_args!("valid: {}", verified.proven));
    }
    Ok(())
}

// A table of atlases: at most ten lines and totals.

/// Maximum number of lines, without head and totals: the table fits on a screen together with the rest of the output.
const LINES: usize = 10;
/// Maximum length of a name in characters. Longer names make lines wrap on more terminals.
const NAME: usize = 28;

/// Prints the quality of atlases: uncertified ones first, then the largest. If there are more than ten, the last line
/// sums up the rest.
pub(super) fn print_table(groups: &[GroupReport]) {
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
        say(table_line(&name, width, &Sums::of(&[group])));
    }
    if !rest.is_empty() {
        let name = format!("{} others", rest.len());
        say(table_line(&name, width, &Sums::of(rest)));
    }
    if groups.len() > 1 {
        let name = format!("{} atlases", groups.len());
        say(table_line(&name, width, &Sums::of(&order)));
    }
    // Explain needles and scales, and list the pages.
    let needles = Sums::of(&order).needles;
    if needles > 0 {
        say(format_args!(
            "needles: {needles} triangles less high than 1/10,000 of their length; stretch leaves them out where they have less than \
             .1 % of the area"
        ));
    }
    // With several atlases, the report tells.
    if let [group] = groups
        && let Some(atlas) = group.atlas.as_ref().filter(|atlas| atlas.charts.len() > 1)
        && let Some(limit) = &atlas.limit
    {
        say(format_args!(
            "{}: chart {} is as long as the texture and sets the scale; no layout of these charts fills more than {:.1} %",
            group.label,
            limit.chart,
            100.0 * limit.utilization
        ));
    }
    for group in shown {
        if let Some(stacks) = group.stacks {
            let plural = if stacks.stacks == 1 { "" } else { "s" };
            say(format_args!(
                "{}: {} charts share the texels of {} stack{plural}, which gains {} texels",
                group.label, stacks.charts, stacks.stacks, stacks.texels_gained
            ));
        }
    }
    for group in shown.iter().filter(|group| group.measures.pages.len() > 1) {
        let mut pages = Vec::new();
        for page in &group.measures.pages {
            pages.push(format!("{} {:.1} % filled", page.udim, 100.0 * page.fill));
        }
        say(format_args!("{}: {}", group.label, pages.join(", ")));
    }
}

fn table_line(name: &str, width: usize, sums: &Sums) -> String {
    let overlapping = sums.overlapping.map_or("-".to_owned(), |n| n.to_string());
    format!(
        "{name:width$} {:>9} {:>7} {:>11} {:>8} {:>8} {:>15} {:>16} {:>8} {:>8} {overlapping:>11}",
        sums.faces,
        sums.charts,
        percent_text(sums.stretch.map(|stretch| 100.0 * (stretch - 1.0))),
        percent_text(sums.energy().map(stretch_percent)),
        percent_text(sums.filled.map(|share| 100.0 * share)),
        number_text(sums.density()),
        number_text(sums.seams()),
        sums.flipped,
        sums.degenerate,
    )
}

fn number_text(x: Option<f64>) -> String {
    x.map_or("-".into(), three_digits)
}

fn percent_text(x: Option<f64>) -> String {
    x.map_or("-".into(), |x| format!("{x:.1} %"))
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
            match certificate.stacks.as_deref() {
                // Stacked charts cover their texels once.
                Some([_, ..]) if m.pages.len() == 1 => fills.extend(m.packing.pack_unit),
                _ => fills.extend(m.pages.iter().map(|page| page.fill)),
            }
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
