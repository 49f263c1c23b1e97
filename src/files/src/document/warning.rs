use unwrapd_api::Warning;

/// Returns a warning about vertices that no face uses with coordinates that are not finite, if there are any.
pub(super) fn unused_not_finite(n_vertices: usize) -> Option<Warning> {
    (n_vertices > 0).then(|| {
        Warning::new(
            "unused_not_finite",
            format!("{n_vertices} vertices that no face uses have coordinates that are not finite"),
        )
    })
}

/// Lists the first of many names, each shortened, for a message.
pub(super) fn listed<'a>(names: impl Iterator<Item = &'a str>) -> String {
    const SHOWN: usize = 6;
    let mut names = names.map(shortened);
    let shown: Vec<String> = names.by_ref().take(SHOWN).collect();
    let shown = shown.join(", ");
    match names.count() {
        0 => shown,
        more => format!("{shown} and {more} more"),
    }
}

/// Returns the beginning of a name from a file.
fn shortened(name: &str) -> String {
    name.chars().filter(|c| !c.is_control()).take(80).collect()
}
