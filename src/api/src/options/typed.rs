//! Options as they are typed on the command line.

use super::json::OptionSet;
use clap::builder::{PossibleValue, TypedValueParser};
use clap::error::ErrorKind;
use clap::{Arg, Command, Error, ValueEnum};
use serde::Serialize;
use serde_json::Value;
use std::ffi::OsStr;
use std::fmt::Display;
use std::marker::PhantomData;
use std::str::FromStr;

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

// Command line options whose value is a word or another text.

/// Parser of options whose words are the variants of an enum, but which also accept other texts: help and completions
/// list the words, and its `FromStr` accepts both.
pub struct WordOrText<T>(PhantomData<fn() -> T>);

impl<T> WordOrText<T> {
    /// Creates the parser of options of type `T`.
    pub fn new() -> Self {
        Self(PhantomData)
    }
}

impl<T> Default for WordOrText<T> {
    fn default() -> Self {
        Self::new()
    }
}

impl<T> Clone for WordOrText<T> {
    fn clone(&self) -> Self {
        Self::new()
    }
}

impl<T> TypedValueParser for WordOrText<T>
where
    T: ValueEnum + FromStr<Err: Display> + Send + Sync + 'static,
{
    type Value = T;

    fn parse_ref(&self, command: &Command, _: Option<&Arg>, text: &OsStr) -> Result<T, Error> {
        let refused = |kind, why: &dyn Display| Error::raw(kind, why).with_cmd(command);
        let text = text
            .to_str()
            .ok_or_else(|| refused(ErrorKind::InvalidUtf8, &"an option is not UTF-8"))?;
        text.parse()
            .map_err(|why| refused(ErrorKind::ValueValidation, &why))
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        let words = T::value_variants().iter();
        Some(Box::new(words.filter_map(ValueEnum::to_possible_value)))
    }
}
