//! Sequential reading of values, from words of text or from bytes.

use super::faces::ReadError;

/// Encoding of numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum NumberEncoding {
    /// Words separated by blanks.
    Text,
    LittleEndian,
    BigEndian,
}

/// A position in a file of a given format.
pub(super) struct Cursor<'a> {
    bytes: &'a [u8],
    at: usize,
    format: &'static str,
    pub encoding: NumberEncoding,
}

impl<'a> Cursor<'a> {
    pub fn new(bytes: &'a [u8], format: &'static str) -> Self {
        Self {
            bytes,
            at: 0,
            format,
            encoding: NumberEncoding::Text,
        }
    }

    /// Creates an error at this position.
    pub fn malformed(&self, cause: &'static str) -> ReadError {
        ReadError::Malformed {
            format: self.format,
            place: "byte",
            at: self.at,
            cause,
        }
    }

    /// Takes the next word of text; `None` at the end.
    pub fn word(&mut self) -> Option<&'a [u8]> {
        let word = self.peek_word()?;
        self.at += word.len();
        Some(word)
    }

    /// Returns the next word without taking it; skips the blanks before it.
    pub fn peek_word(&mut self) -> Option<&'a [u8]> {
        let rest = &self.bytes[self.at..];
        let blanks = rest.iter().position(|b| !b.is_ascii_whitespace())?;
        self.at += blanks;
        let word = &rest[blanks..];
        let length = word.iter().position(u8::is_ascii_whitespace);
        Some(&word[..length.unwrap_or(word.len())])
    }

    /// Skips the rest of the line.
    pub fn end_line(&mut self) {
        let rest = &self.bytes[self.at..];
        let length = rest.iter().position(|&b| b == b'\n').map(|n| n + 1);
        self.at += length.unwrap_or(rest.len());
    }

    /// Skips everything up to and including `mark`; returns `false`, without moving, if it does not occur.
    pub fn skip_past(&mut self, mark: &[u8]) -> bool {
        let found = self.bytes[self.at..]
            .windows(mark.len())
            .position(|w| w == mark);
        self.at += found.map_or(0, |n| n + mark.len());
        found.is_some()
    }

    /// Reads a number written as text, whatever the encoding of the file.
    pub fn parse<T: std::str::FromStr>(&mut self, cause: &'static str) -> Result<T, ReadError> {
        let parsed = self.word().and_then(number);
        parsed.ok_or_else(|| self.malformed(cause))
    }

    /// Reads a 32-bit integer.
    pub fn int(&mut self) -> Result<i32, ReadError> {
        match self.encoding {
            NumberEncoding::Text => self.parse("expected an integer"),
            NumberEncoding::LittleEndian => self.array().map(i32::from_le_bytes),
            NumberEncoding::BigEndian => self.array().map(i32::from_be_bytes),
        }
    }

    /// Reads a 64-bit count or tag.
    pub fn size(&mut self) -> Result<u64, ReadError> {
        match self.encoding {
            NumberEncoding::Text => self.parse("expected a count or a tag"),
            NumberEncoding::LittleEndian => self.array().map(u64::from_le_bytes),
            NumberEncoding::BigEndian => self.array().map(u64::from_be_bytes),
        }
    }

    /// Reads a coordinate; NaN and infinity count as numbers here.
    pub fn float(&mut self) -> Result<f64, ReadError> {
        match self.encoding {
            NumberEncoding::Text => self.parse("expected a coordinate"),
            NumberEncoding::LittleEndian => self.array().map(f64::from_le_bytes),
            NumberEncoding::BigEndian => self.array().map(f64::from_be_bytes),
        }
    }

    /// Reads three coordinates.
    pub fn point(&mut self) -> Result<[f64; 3], ReadError> {
        Ok([self.float()?, self.float()?, self.float()?])
    }

    fn array<const N: usize>(&mut self) -> Result<[u8; N], ReadError> {
        let bytes = self.bytes[self.at..].first_chunk::<N>();
        let bytes = *bytes.ok_or_else(|| self.malformed("the file ends early"))?;
        self.at += N;
        Ok(bytes)
    }
}

/// Iterates over the lines of a text, numbered from 1; `\n`, `\r\n` and `\r` all end a line.
pub(super) fn lines(bytes: &[u8]) -> impl Iterator<Item = (usize, &[u8])> {
    let mut rest = bytes;
    let mut number = 0;
    std::iter::from_fn(move || {
        if rest.is_empty() {
            return None;
        }
        let end = rest.iter().position(|&b| b == b'\n' || b == b'\r');
        let line = &rest[..end.unwrap_or(rest.len())];
        let ending = match end {
            None => 0,
            Some(e) if rest[e..].starts_with(b"\r\n") => 2,
            Some(_) => 1,
        };
        rest = &rest[line.len() + ending..];
        number += 1;
        Some((number, line))
    })
}

/// Iterates over the words of a line, separated by blanks.
pub(super) fn words(line: &[u8]) -> impl Iterator<Item = &[u8]> {
    line.split(u8::is_ascii_whitespace)
        .filter(|word| !word.is_empty())
}

/// Parses a number in a text; `nan` and `inf` count as numbers here, [`position`](super::position) refuses them.
pub(super) fn number<T: std::str::FromStr>(word: &[u8]) -> Option<T> {
    std::str::from_utf8(word).ok()?.parse().ok()
}

/// Parses three numbers from the next three words.
pub(super) fn three_numbers<'a>(words: &mut impl Iterator<Item = &'a [u8]>) -> Option<[f64; 3]> {
    Some([
        number(words.next()?)?,
        number(words.next()?)?,
        number(words.next()?)?,
    ])
}
