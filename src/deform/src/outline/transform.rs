//! SVG's `transform` attribute.

use kurbo::Affine;

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
