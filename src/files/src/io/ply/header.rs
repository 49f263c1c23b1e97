//! PLY header: the elements that follow, their properties and their encoding.

use super::super::{ReadError, number, words};
use super::malformed;

#[derive(Clone, Copy, PartialEq)]
pub(super) enum Encoding {
    Text,
    LittleEndian,
    BigEndian,
}

#[derive(Clone, Copy)]
pub(super) enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

pub(super) enum Kind {
    Scalar(Scalar),
    List { count: Scalar, item: Scalar },
}

pub(super) struct Property {
    pub name: Vec<u8>,
    pub kind: Kind,
}

pub(super) struct Element {
    pub name: Vec<u8>,
    pub count: u64,
    pub properties: Vec<Property>,
}

pub(super) struct Header {
    pub encoding: Encoding,
    pub elements: Vec<Element>,
    /// First byte after the header.
    pub end: usize,
}

/// Reads the header.
pub(super) fn header(bytes: &[u8]) -> Result<Header, ReadError> {
    let mut elements: Vec<Element> = Vec::new();
    let mut encoding = None;
    let mut at = 0;
    loop {
        // Find the next line and its ending.
        let rest = &bytes[at..];
        let length = rest.iter().position(|&b| b == b'\n' || b == b'\r');
        let length = length.ok_or_else(|| malformed(at, "the header has no end"))?;
        let line = &rest[..length];
        let ending = if rest[length..].starts_with(b"\r\n") {
            2
        } else {
            1
        };
        // Interpret it.
        let mut line_words = words(line);
        match line_words.next().unwrap_or_default() {
            b"end_header" => {
                at += length + ending;
                break;
            }
            b"format" => {
                encoding = match line_words.next() {
                    Some(b"ascii") => Some(Encoding::Text),
                    Some(b"binary_little_endian") => Some(Encoding::LittleEndian),
                    Some(b"binary_big_endian") => Some(Encoding::BigEndian),
                    _ => return Err(malformed(at, "an unknown encoding")),
                }
            }
            b"element" => {
                let element = element(&mut line_words);
                elements.push(
                    element.ok_or_else(|| malformed(at, "an element needs a name and a count"))?,
                );
            }
            b"property" => {
                let property = property(&mut line_words)
                    .ok_or_else(|| malformed(at, "a property needs a type and a name"))?;
                let element = elements.last_mut();
                let element =
                    element.ok_or_else(|| malformed(at, "a property without an element"))?;
                element.properties.push(property);
            }
            _ => {}
        }
        at += length + ending;
    }
    let encoding = encoding.ok_or_else(|| malformed(at, "the header names no encoding"))?;
    Ok(Header {
        encoding,
        elements,
        end: at,
    })
}

fn element<'a>(words: &mut impl Iterator<Item = &'a [u8]>) -> Option<Element> {
    Some(Element {
        name: words.next()?.to_vec(),
        count: number(words.next()?)?,
        properties: Vec::new(),
    })
}

fn property<'a>(words: &mut impl Iterator<Item = &'a [u8]>) -> Option<Property> {
    let first = words.next()?;
    let kind = if first == b"list" {
        Kind::List {
            count: scalar(words.next()?)?,
            item: scalar(words.next()?)?,
        }
    } else {
        Kind::Scalar(scalar(first)?)
    };
    Some(Property {
        name: words.next()?.to_vec(),
        kind,
    })
}

fn scalar(name: &[u8]) -> Option<Scalar> {
    Some(match name {
        b"char" | b"int8" => Scalar::I8,
        b"uchar" | b"uint8" => Scalar::U8,
        b"short" | b"int16" => Scalar::I16,
        b"ushort" | b"uint16" => Scalar::U16,
        b"int" | b"int32" => Scalar::I32,
        b"uint" | b"uint32" => Scalar::U32,
        b"float" | b"float32" => Scalar::F32,
        b"double" | b"float64" => Scalar::F64,
        _ => return None,
    })
}
