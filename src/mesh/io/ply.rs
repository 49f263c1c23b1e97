//! PLY, text and binary of both byte orders.
//!
//! A header declares elements and their properties, the data follow in that order. Used are `x y z` of `vertex`
//! and the list `vertex_indices` (or `vertex_index`) of `face`; everything else is passed over by its declared
//! size. Read without a library: the kept one at hand refuses `nan` anywhere in a text file, numbers such as `1.`
//! and comments that are not UTF-8, and runs for ever on an element that has a count but no properties.
use super::{IndexedTriangles, ReadError, number, position, push_fan, words};

fn malformed(at: usize, cause: &'static str) -> ReadError {
    ReadError::Malformed {
        format: "PLY",
        place: "byte",
        at,
        cause,
    }
}

#[derive(Clone, Copy, PartialEq)]
enum Encoding {
    Text,
    LittleEndian,
    BigEndian,
}

#[derive(Clone, Copy)]
enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

enum Kind {
    Scalar(Scalar),
    List { count: Scalar, item: Scalar },
}

struct Property {
    name: Vec<u8>,
    kind: Kind,
}

struct Element {
    name: Vec<u8>,
    count: u64,
    properties: Vec<Property>,
}

struct Header {
    encoding: Encoding,
    elements: Vec<Element>,
    /// First byte after the header.
    end: usize,
}

/// Reads a PLY file.
pub fn read(bytes: &[u8]) -> Result<IndexedTriangles, ReadError> {
    let header = header(bytes)?;
    let mut data = Data {
        bytes,
        at: header.end,
        encoding: header.encoding,
    };
    let mut mesh = IndexedTriangles::default();
    for element in &header.elements {
        match element.name.as_slice() {
            b"vertex" => read_vertices(element, &mut data, &mut mesh)?,
            b"face" => read_faces(element, &mut data, &mut mesh)?,
            _ => read_records(element, &mut data, None, |_| Ok(()))?,
        }
    }
    let n_vertices = mesh.positions.len();
    match mesh.triangles.iter().flatten().max() {
        Some(&index) if index as usize >= n_vertices => Err(ReadError::IndexOutOfRange {
            index: i64::from(index),
            n_vertices,
        }),
        _ => Ok(mesh),
    }
}

fn read_vertices(
    element: &Element,
    data: &mut Data,
    mesh: &mut IndexedTriangles,
) -> Result<(), ReadError> {
    let at = data.at;
    let axis = |name: &[u8]| {
        let found = element.properties.iter().position(|p| p.name == name);
        found.ok_or_else(|| malformed(at, "a vertex needs the properties x, y and z"))
    };
    let axes = [axis(b"x")?, axis(b"y")?, axis(b"z")?];
    read_records(element, data, None, |record| {
        let coordinates = axes.map(|property| record.scalars[property]);
        let vertex = mesh.positions.len();
        mesh.positions.push(position(coordinates, vertex)?);
        Ok(())
    })
}

/// Faces may come before the vertices: their indices are compared with the vertices at the end of the file.
fn read_faces(
    element: &Element,
    data: &mut Data,
    mesh: &mut IndexedTriangles,
) -> Result<(), ReadError> {
    let list = element.properties.iter().position(|p| {
        matches!(p.kind, Kind::List { .. })
            && matches!(p.name.as_slice(), b"vertex_indices" | b"vertex_index")
    });
    read_records(element, data, list, |record| {
        push_fan(&mut mesh.triangles, &record.list, u32::MAX as usize)
    })
}

/// One element: the scalars by property (a list counts as 0), and the list that was asked for.
struct Record {
    scalars: Vec<f64>,
    list: Vec<i64>,
}

/// Reads all records of an element. Each takes at least a byte, so a false count ends with the file.
fn read_records(
    element: &Element,
    data: &mut Data,
    wanted: Option<usize>,
    mut visit: impl FnMut(&Record) -> Result<(), ReadError>,
) -> Result<(), ReadError> {
    if element.properties.is_empty() {
        return Ok(());
    }
    let mut record = Record {
        scalars: vec![0.0; element.properties.len()],
        list: Vec::new(),
    };
    for _ in 0..element.count {
        for (k, property) in element.properties.iter().enumerate() {
            match property.kind {
                Kind::Scalar(scalar) => record.scalars[k] = data.next(scalar)?,
                Kind::List { count, item } => {
                    let n_items = data.next(count)?;
                    if n_items < 0.0 || n_items.fract() != 0.0 {
                        return Err(malformed(data.at, "a list of so many items is impossible"));
                    }
                    data.list(
                        n_items as u64,
                        item,
                        (wanted == Some(k)).then_some(&mut record.list),
                    )?;
                }
            }
        }
        visit(&record)?;
    }
    Ok(())
}

/// What follows the header.
struct Data<'a> {
    bytes: &'a [u8],
    at: usize,
    encoding: Encoding,
}

impl Data<'_> {
    /// The next number.
    fn next(&mut self, scalar: Scalar) -> Result<f64, ReadError> {
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

    /// The next `N` bytes, least significant first.
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
        let value =
            number(word).ok_or_else(|| malformed(self.at + start, "a number is expected"))?;
        self.at += start + word.len();
        Ok(value)
    }

    /// The items of a list, kept as indices where `kept` is given.
    fn list(
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

fn header(bytes: &[u8]) -> Result<Header, ReadError> {
    let mut elements: Vec<Element> = Vec::new();
    let mut encoding = None;
    let mut at = 0;
    loop {
        let rest = &bytes[at..];
        let length = rest.iter().position(|&b| b == b'\n' || b == b'\r');
        let length = length.ok_or_else(|| malformed(at, "the header does not end"))?;
        let line = &rest[..length];
        let ending = if rest[length..].starts_with(b"\r\n") {
            2
        } else {
            1
        };
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
                elements
                    .push(element.ok_or_else(|| malformed(at, "an element needs name and count"))?);
            }
            b"property" => {
                let property = property(&mut line_words)
                    .ok_or_else(|| malformed(at, "a property needs type and name"))?;
                let element = elements.last_mut();
                let element = element.ok_or_else(|| malformed(at, "a property of no element"))?;
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
