//! Limits of a computation, which its options cannot exceed.

use serde::{Deserialize, Serialize};

/// Limits set by the operator, beside the options of the user. Absent limits do not apply.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(default)]
pub struct Limits {
    /// Maximum number of triangles or tetrahedra; larger documents are refused.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub triangles: Option<u64>,
    /// Maximum number of threads.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub threads: Option<usize>,
    /// Time limit in seconds. When it is reached, the current valid map becomes the result.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub seconds: Option<f64>,
}

// JSON with words for numbers that are not finite.

/// Parses JSON in which `NaN`, `Infinity` and `-Infinity` may stand for `null`.
pub fn from_json<T: serde::de::DeserializeOwned>(json: &[u8]) -> serde_json::Result<T> {
    match serde_json::from_slice(json) {
        Err(error) if error.is_syntax() => match without_words(json) {
            Some(json) => serde_json::from_slice(&json),
            None => Err(error),
        },
        result => result,
    }
}

/// Replaces these words by `null`; returns `None` for a text without such words.
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
