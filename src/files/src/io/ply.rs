//! PLY, text and binary of both byte orders.
//!
//! A header declares elements and their properties, the data follow in that order. The reader uses `x y z` of `vertex`
//! and the list `vertex_indices` (or `vertex_index`) of `face`; everything else is skipped by its declared size
//! ([`extras`](fn@extras) has the colors). Read without a library: the maintained one refuses `nan` anywhere in a text
//! file, numbers such as `1.` and comments that are not UTF-8, and loops forever on an element that has a count but no
//! properties.

use super::{Faces, IndexedTriangles, ReadError, any_position, number, words};

fn malformed(at: usize, cause: &'static str) -> ReadError {
    ReadError::Malformed {
        format: "PLY",
        place: "byte",
        at,
        cause,
    }
}

/// Returns whether the file begins with the format's first line.
pub(super) fn has_header(head: &[u8]) -> bool {
    head.starts_with(b"ply") && matches!(head.get(3), Some(b'\n' | b'\r' | b' '))
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
    let mut faces = Faces::default();
    for element in &header.elements {
        match element.name.as_slice() {
            b"vertex" => read_vertices(element, &mut data, &mut mesh)?,
            b"face" => read_faces(element, &mut data, &mut faces)?,
            _ => read_records(element, &mut data, None, |_| Ok(()))?,
        }
    }
    let n_vertices = mesh.positions.len();
    match faces.last_corner() {
        Some(index) if index as usize >= n_vertices => Err(ReadError::IndexOutOfRange {
            index: i64::from(index),
            n_vertices,
        }),
        _ => {
            (mesh.triangles, mesh.fanned) = faces.filled(|v| (v, mesh.positions[v as usize]))?;
            Ok(mesh)
        }
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
        mesh.positions.push(any_position(coordinates));
        Ok(())
    })
}

/// Reads faces. They may come before the vertices: their indices are compared with the vertices at the end of the file.
fn read_faces(element: &Element, data: &mut Data, faces: &mut Faces) -> Result<(), ReadError> {
    let list = element.properties.iter().position(|p| {
        matches!(p.kind, PropertyKind::List { .. })
            && matches!(p.name.as_slice(), b"vertex_indices" | b"vertex_index")
    });
    let mut face = 0;
    read_records(element, data, list, |record| {
        faces.push_checked(&record.list, u32::MAX as usize, face)?;
        face += 1;
        Ok(())
    })
}

/// One record: the scalars by property (a list counts as 0), and the requested list.
struct Record {
    scalars: Vec<f64>,
    list: Vec<i64>,
}

/// Reads all records of an element. Each takes at least one byte, so a false count ends with the file.
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
        // Keep the scalars and the wanted list, and skip other lists.
        for (k, property) in element.properties.iter().enumerate() {
            match property.kind {
                PropertyKind::Scalar(scalar) => record.scalars[k] = data.next(scalar)?,
                PropertyKind::List { count, item } => {
                    let n_items = data.next(count)?;
                    if n_items < 0.0 || n_items.fract() != 0.0 {
                        return Err(malformed(data.at, "a list has an impossible length"));
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

// PLY header: the elements that follow, their properties and their encoding.

#[derive(Clone, Copy, PartialEq)]
pub(super) enum PlyEncoding {
    Text,
    LittleEndian,
    BigEndian,
}

#[derive(Clone, Copy)]
pub(super) enum PlyScalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

enum PropertyKind {
    Scalar(PlyScalar),
    List { count: PlyScalar, item: PlyScalar },
}

struct Property {
    pub name: Vec<u8>,
    pub kind: PropertyKind,
}

struct Element {
    pub name: Vec<u8>,
    pub count: u64,
    pub properties: Vec<Property>,
}

struct PlyHeader {
    pub encoding: PlyEncoding,
    pub elements: Vec<Element>,
    /// First byte after the header.
    pub end: usize,
}

/// Reads the header.
fn header(bytes: &[u8]) -> Result<PlyHeader, ReadError> {
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
                    Some(b"ascii") => Some(PlyEncoding::Text),
                    Some(b"binary_little_endian") => Some(PlyEncoding::LittleEndian),
                    Some(b"binary_big_endian") => Some(PlyEncoding::BigEndian),
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
    Ok(PlyHeader {
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
        PropertyKind::List {
            count: scalar(words.next()?)?,
            item: scalar(words.next()?)?,
        }
    } else {
        PropertyKind::Scalar(scalar(first)?)
    };
    Some(Property {
        name: words.next()?.to_vec(),
        kind,
    })
}

fn scalar(name: &[u8]) -> Option<PlyScalar> {
    Some(match name {
        b"char" | b"int8" => PlyScalar::I8,
        b"uchar" | b"uint8" => PlyScalar::U8,
        b"short" | b"int16" => PlyScalar::I16,
        b"ushort" | b"uint16" => PlyScalar::U16,
        b"int" | b"int32" => PlyScalar::I32,
        b"uint" | b"uint32" => PlyScalar::U32,
        b"float" | b"float32" => PlyScalar::F32,
        b"double" | b"float64" => PlyScalar::F64,
        _ => return None,
    })
}

// PLY data: numbers as text or bytes of either order, one after the other.

/// The data after the header.
pub(super) struct Data<'a> {
    pub bytes: &'a [u8],
    pub at: usize,
    pub encoding: PlyEncoding,
}

impl Data<'_> {
    /// Reads the next number.
    pub fn next(&mut self, scalar: PlyScalar) -> Result<f64, ReadError> {
        let big = self.encoding == PlyEncoding::BigEndian;
        if self.encoding == PlyEncoding::Text {
            return self.next_word();
        }
        Ok(match scalar {
            PlyScalar::I8 => f64::from(i8::from_le_bytes(self.take(false)?)),
            PlyScalar::U8 => f64::from(u8::from_le_bytes(self.take(false)?)),
            PlyScalar::I16 => f64::from(i16::from_le_bytes(self.take(big)?)),
            PlyScalar::U16 => f64::from(u16::from_le_bytes(self.take(big)?)),
            PlyScalar::I32 => f64::from(i32::from_le_bytes(self.take(big)?)),
            PlyScalar::U32 => f64::from(u32::from_le_bytes(self.take(big)?)),
            PlyScalar::F32 => f64::from(f32::from_le_bytes(self.take(big)?)),
            PlyScalar::F64 => f64::from_le_bytes(self.take(big)?),
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
        item: PlyScalar,
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

// Additional data of a PLY file: colors of vertices, and names of properties that are not read.

/// Names of the properties that are colors; alpha may be missing.
const COLORS: [[&[u8]; 4]; 3] = [
    [b"red", b"green", b"blue", b"alpha"],
    [
        b"diffuse_red",
        b"diffuse_green",
        b"diffuse_blue",
        b"diffuse_alpha",
    ],
    [b"r", b"g", b"b", b"a"],
];

/// Data besides the shape.
#[derive(Debug, Default, Clone, PartialEq)]
pub struct Extras {
    /// Red, green, blue and alpha of each vertex, at most 1, in the encoding of the file.
    pub colors: Option<Vec<[f64; 4]>>,
    /// Names of properties and elements that are not read, such as `vertex nx`.
    pub left_out: Vec<String>,
}

/// Reads the data that [`read`] skips.
pub fn extras(bytes: &[u8]) -> Result<Extras, ReadError> {
    let header = header(bytes)?;
    let channels = header
        .elements
        .iter()
        .find(|element: &&Element| element.name == b"vertex")
        .and_then(channels);
    Ok(Extras {
        left_out: left_out(&header, channels.as_deref().unwrap_or_default()),
        colors: match channels {
            Some(channels) => Some(colors(bytes, &header, &channels)?),
            None => None,
        },
    })
}

/// Returns the places of the color channels among the properties, three or four of them.
fn channels(element: &Element) -> Option<Vec<usize>> {
    let place = |name: &[u8]| element.properties.iter().position(|p| p.name == name);
    COLORS.iter().find_map(|[r, g, b, a]| {
        let color = [place(r)?, place(g)?, place(b)?];
        Some(color.into_iter().chain(place(a)).collect())
    })
}

fn colors(
    bytes: &[u8],
    header: &PlyHeader,
    channels: &[usize],
) -> Result<Vec<[f64; 4]>, ReadError> {
    let mut data = Data {
        bytes,
        at: header.end,
        encoding: header.encoding,
    };
    let mut colors = Vec::new();
    for element in &header.elements {
        let is_vertex = element.name == b"vertex";
        let largest: Vec<f64> = channels.iter().map(|&k| largest(element, k)).collect();
        read_records(element, &mut data, None, |record| {
            if is_vertex {
                let mut color = [1.0; 4];
                for ((x, &k), largest) in color.iter_mut().zip(channels).zip(&largest) {
                    *x = record.scalars[k] / largest;
                }
                let is_finite = color.iter().all(|x| x.is_finite());
                colors.push(if is_finite { color } else { [1.0; 4] });
            }
            Ok(())
        })?;
        if is_vertex {
            break;
        }
    }
    Ok(colors)
}

/// Returns the number that stands for full intensity.
fn largest(element: &Element, property: usize) -> f64 {
    match element.properties.get(property).map(|p| &p.kind) {
        Some(PropertyKind::Scalar(PlyScalar::U8)) => 255.0,
        Some(PropertyKind::Scalar(PlyScalar::I8)) => 127.0,
        Some(PropertyKind::Scalar(PlyScalar::U16)) => 65_535.0,
        Some(PropertyKind::Scalar(PlyScalar::I16)) => 32_767.0,
        Some(PropertyKind::Scalar(PlyScalar::U32)) => f64::from(u32::MAX),
        Some(PropertyKind::Scalar(PlyScalar::I32)) => f64::from(i32::MAX),
        _ => 1.0,
    }
}

fn left_out(header: &PlyHeader, channels: &[usize]) -> Vec<String> {
    let text = |name: &[u8]| String::from_utf8_lossy(name).into_owned();
    let mut names = Vec::new();
    for element in &header.elements {
        let known: &[&[u8]] = match element.name.as_slice() {
            b"vertex" => &[b"x", b"y", b"z"],
            b"face" => &[b"vertex_indices", b"vertex_index"],
            _ => {
                names.push(text(&element.name));
                continue;
            }
        };
        for (k, property) in element.properties.iter().enumerate() {
            let is_color = element.name == b"vertex" && channels.contains(&k);
            if !is_color && !known.contains(&property.name.as_slice()) {
                names.push(format!("{} {}", text(&element.name), text(&property.name)));
            }
        }
    }
    names
}
