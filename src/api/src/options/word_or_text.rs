//! Command line options whose value is a word or another text.

use std::ffi::OsStr;
use std::fmt::Display;
use std::marker::PhantomData;
use std::str::FromStr;

use clap::builder::{PossibleValue, TypedValueParser};
use clap::error::ErrorKind;
use clap::{Arg, Command, Error, ValueEnum};

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
