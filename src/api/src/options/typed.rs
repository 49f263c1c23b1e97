//! Options as they are typed on the command line.

use serde::Serialize;
use serde_json::Value;

use super::option_set::OptionSet;

/// Returns a value as it is typed: its JSON form without quotes.
pub fn typed<T: Serialize>(value: &T) -> String {
    match serde_json::to_value(value) {
        Ok(Value::String(word)) => word,
        Ok(Value::Number(number)) => number
            .as_f64()
            .map_or(number.to_string(), |number| number.to_string()),
        Ok(value) => value.to_string(),
        // Defaults are plain data, so serialization cannot fail.
        Err(_) => String::new(),
    }
}

/// Returns the help of an option for an argument that the command line declares itself. It is empty for an unknown
/// name, which a test detects.
pub fn help_of<O: OptionSet>(name: &str) -> String {
    let lines = O::about(name).unwrap_or_default().lines();
    let text = lines.map(str::trim).collect::<Vec<_>>().join(" ");
    text.trim_end_matches('.').to_owned()
}

/// Returns a text about options with their names as they are typed: names in backticks that satisfy `is_option`
/// become options such as `--seam-weight`.
pub fn as_typed(text: &str, is_option: impl Fn(&str) -> bool) -> String {
    let parts = text.split('`').enumerate();
    let typed = parts.map(|(i, part)| match i % 2 {
        0 => part.to_owned(),
        _ if is_option(part) => format!("--{}", part.replace('_', "-")),
        _ => format!("`{part}`"),
    });
    typed.collect()
}
