//! Options from JSON objects.

use serde::de::{DeserializeOwned, Error};
use serde::{Deserialize, Deserializer};
use serde_json::{Map, Value};

/// Deserializes the options of an object that has no other members.
pub fn deserialized<'de, O, D>(deserializer: D) -> Result<O, D::Error>
where
    O: OptionSet,
    D: Deserializer<'de>,
{
    let mut given = Object::deserialize(deserializer)?;
    let options = O::taken_from(&mut given).map_err(D::Error::custom)?;
    match given.keys().next() {
        None => Ok(options),
        Some(name) => {
            let known: Vec<String> = O::names().iter().map(|name| format!("`{name}`")).collect();
            let text = format!(
                "unknown option `{name}`, expected one of {}",
                known.join(", ")
            );
            Err(D::Error::custom(text))
        }
    }
}

/// Removes an option from an object by one of its names and returns its value, or the default if it is absent. A word
/// may have underscores in the place of its hyphens.
pub fn taken<T: DeserializeOwned>(
    given: &mut Object,
    names: &[&str],
    default: T,
) -> Result<T, String> {
    let Some((name, value)) = names.iter().find_map(|name| given.remove_entry(*name)) else {
        return Ok(default);
    };
    let hyphenated = value.as_str().map(|word| word.replace('_', "-"));
    serde_json::from_value(value)
        .or_else(|error| {
            let word = hyphenated.map(Value::String);
            word.and_then(|word| serde_json::from_value(word).ok())
                .ok_or(error)
        })
        .map_err(|error| format!("`{name}`: {error}"))
}

// The trait of all sets of options.

/// A JSON object of options.
pub type Object = Map<String, Value>;

/// A set of options, with the groups that it consists of.
pub trait OptionSet: Sized {
    /// Checks every number against its range. The error names the option.
    fn check_ranges(&self) -> Result<(), String>;

    /// Returns the names of all options, including those of groups.
    fn names() -> Vec<&'static str>;

    /// Returns the text of an option of this set, not of its groups.
    fn about(name: &str) -> Option<&'static str>;

    /// Removes the options from a JSON object; absent options have their defaults.
    fn taken_from(given: &mut Object) -> Result<Self, String>;
}

// Numbers and their ranges.

/// A value that can be checked against a range.
pub trait Ranged {
    /// Checks the value against a range. The error names the option.
    fn check(&self, name: &str, low: f64, high: f64) -> Result<(), String>;
}

impl Ranged for f64 {
    fn check(&self, name: &str, low: f64, high: f64) -> Result<(), String> {
        within(name, *self, low, high)
    }
}

impl Ranged for u32 {
    fn check(&self, name: &str, low: f64, high: f64) -> Result<(), String> {
        within(name, f64::from(*self), low, high)
    }
}

impl Ranged for usize {
    fn check(&self, name: &str, low: f64, high: f64) -> Result<(), String> {
        within(name, *self as f64, low, high)
    }
}

/// An absent value is in every range.
impl<T: Ranged> Ranged for Option<T> {
    fn check(&self, name: &str, low: f64, high: f64) -> Result<(), String> {
        self.as_ref()
            .map_or(Ok(()), |value| value.check(name, low, high))
    }
}

/// Checks a number against its range. The error names the option in backticks, like all texts about options.
pub fn within(name: &str, value: f64, low: f64, high: f64) -> Result<(), String> {
    if (low..=high).contains(&value) {
        Ok(())
    } else {
        Err(format!(
            "`{name}` must lie between {low} and {high}, not {value}"
        ))
    }
}
