use super::Warning;
use crate::io::Fanned;

/// Returns a warning about polygons without an inside, if there are any; `place` names the unit of their places.
pub(super) fn warning(fanned: &Fanned, place: &str) -> Option<Warning> {
    let n = fanned.n_polygons;
    let mut places: Vec<String> = fanned.first.iter().map(usize::to_string).collect();
    if n > places.len() {
        places.push("…".to_owned());
    }
    let places = places.join(", ");
    let message = match n {
        0 => return None,
        1 => format!(
            "1 polygon crosses itself or has no area ({place} {places}). It became a triangle fan, which may \
             overlap. Repair it and unwrap again."
        ),
        _ => format!(
            "{n} polygons cross themselves or have no area ({place}s {places}). They became triangle fans, \
             which may overlap. Repair them and unwrap again."
        ),
    };
    Some(Warning::new("polygon_fanned", message))
}
