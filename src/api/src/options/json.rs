//! Options from JSON objects.

use serde::de::{DeserializeOwned, Error};
use serde::{Deserialize, Deserializer};

use super::option_set::{Object, OptionSet};

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

/// Removes an option from an object by one of its names and returns its value, or the default if it is absent.
pub fn taken<T: DeserializeOwned>(
    given: &mut Object,
    names: &[&str],
    default: T,
) -> Result<T, String> {
    let Some((name, value)) = names.iter().find_map(|name| given.remove_entry(*name)) else {
        return Ok(default);
    };
    serde_json::from_value(value).map_err(|error| format!("`{name}`: {error}"))
}
