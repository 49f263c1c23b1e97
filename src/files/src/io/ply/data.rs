//! PLY data: numbers as text or bytes of either order, one after the other.

use super::super::{ReadError, number};
use super::header::{Encoding, Scalar};
use super::malformed;

/// The data after the header.
pub(super) struct Data<'a> {
    pub bytes: &'a [u8],
    pub at: usize,
    pub encoding: Encoding,
}

impl Data<'_> {
    /// Reads the next number.
    pub fn next(&mut self, scalar: Scalar) -> Result<f64, ReadError> {
        let big = self.encoding == Encoding::BigEndian;
        if self.encoding == Encoding::Text {
            return self.next_word();
        }
        Ok(match scalar {
            Scalar::I8 => f64::from(i8::from_le_bytes(self.take(false)?)),
            Scalar::U8 => f64::from(u8::from_le_bytes(self.take(false)?)),
            Scalar::I16 => f64::from(i16::from_le_bytes(self.take(big)?)),
            Scalar::U16 => f64::from(u16::from_le_bytes(self.take(big)?)),
            Scalar::I32 => f64::from(i32::from_le_bytes(self.take(big)?)),
            Scalar::U32 => f64::from(u32::from_le_bytes(self.take(big)?)),
            Scalar::F32 => f64::from(f32::from_le_bytes(self.take(big)?)),
            Scalar::F64 => f64::from_le_bytes(self.take(big)?),
        })
    }

    /// Takes the next `N` bytes, least significant first.
    fn take<const N: usize>(&mut self, big: bool) -> Result<[u8; N], ReadError> {
        let taken = self.bytes[self.at..].first_chunk::<N>();
        let mut taken = *taken.ok_or_else(|| malformed(self.at, "the file ends early"))?;
        self.at += N;
        if big {
            taken.reverse();
        }
        Ok(taken)
    }

    fn next_word(&mut self) -> Result<f64, ReadError> {
        let rest = &self.bytes[self.at..];
        let start = rest.iter().position(|b| !b.is_ascii_whitespace());
        let start = start.ok_or_else(|| malformed(self.at, "the file ends early"))?;
        let word = &rest[start..];
        let length = word.iter().position(u8::is_ascii_whitespace);
        let word = &word[..length.unwrap_or(word.len())];
        let value = number(word).ok_or_else(|| malformed(self.at + start, "expected a number"))?;
        self.at += start + word.len();
        Ok(value)
    }

    /// Reads the items of a list, kept as indices if `kept` is given.
    pub fn list(
        &mut self,
        n_items: u64,
        item: Scalar,
        mut kept: Option<&mut Vec<i64>>,
    ) -> Result<(), ReadError> {
        if let Some(kept) = &mut kept {
            kept.clear();
        }
        for _ in 0..n_items {
            let value = self.next(item)?;
            if let Some(kept) = &mut kept {
                kept.push(value as i64);
            }
        }
        Ok(())
    }
}
