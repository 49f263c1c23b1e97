//! Coordinates as JSON has them.
//!
//! JSON has no word for a number that is not finite. JavaScript writes `null` in its place, Python the bare words `NaN` and
//! `Infinity`. Both are read as NaN here: a target that is no place is then named as such instead of as a fault of the syntax.

use serde::{Deserialize, Deserializer};

/// A position of as many coordinates as there are.
pub(super) fn position<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<f64>, D::Error> {
    let numbers = Vec::<Option<f64>>::deserialize(from)?;
    Ok(numbers.into_iter().map(or_nan).collect())
}

/// A position in the plane.
pub(super) fn planar<'de, D: Deserializer<'de>>(from: D) -> Result<[f64; 2], D::Error> {
    <[Option<f64>; 2]>::deserialize(from).map(|numbers| numbers.map(or_nan))
}

/// A list of positions.
pub(super) fn positions<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<Vec<f64>>, D::Error> {
    let positions = Vec::<Vec<Option<f64>>>::deserialize(from)?;
    let finite = |numbers: Vec<Option<f64>>| numbers.into_iter().map(or_nan).collect();
    Ok(positions.into_iter().map(finite).collect())
}

fn or_nan(number: Option<f64>) -> f64 {
    number.unwrap_or(f64::NAN)
}

/// Parses JSON, in which `NaN`, `Infinity` and `-Infinity` may stand for `null`.
pub fn from_json<T: serde::de::DeserializeOwned>(json: &[u8]) -> serde_json::Result<T> {
    match serde_json::from_slice(json) {
        Err(error) if error.is_syntax() => match without_words(json) {
            Some(json) => serde_json::from_slice(&json),
            None => Err(error),
        },
        result => result,
    }
}

/// The text with `null` in place of the words, none where it has no such word.
fn without_words(json: &[u8]) -> Option<Vec<u8>> {
    const WORDS: [&[u8]; 3] = [b"NaN", b"Infinity", b"-Infinity"];
    let mut text = Vec::with_capacity(json.len());
    let (mut in_string, mut is_escaped, mut has_word) = (false, false, false);
    let mut rest = json;
    while let Some((&byte, after)) = rest.split_first() {
        let word = WORDS.iter().find(|word| rest.starts_with(word));
        if let Some(word) = word.filter(|_| !in_string) {
            text.extend(b"null");
            has_word = true;
            rest = &rest[word.len()..];
            continue;
        }
        in_string ^= byte == b'"' && !is_escaped;
        is_escaped = in_string && byte == b'\\' && !is_escaped;
        text.push(byte);
        rest = after;
    }
    has_word.then_some(text)
}
