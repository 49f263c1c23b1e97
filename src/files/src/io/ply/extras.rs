//! Additional data of a PLY file: colors of vertices, and names of properties that are not read.

use super::data::Data;
use super::header::{Element, Header, Kind, Scalar, header};
use super::read_records;
use crate::io::ReadError;

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

/// Reads the data that [`read`](super::read) skips.
pub fn extras(bytes: &[u8]) -> Result<Extras, ReadError> {
    let header = header(bytes)?;
    let is_vertex = |element: &&Element| element.name == b"vertex";
    let channels = header.elements.iter().find(is_vertex).and_then(channels);
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

fn colors(bytes: &[u8], header: &Header, channels: &[usize]) -> Result<Vec<[f64; 4]>, ReadError> {
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
        Some(Kind::Scalar(Scalar::U8)) => 255.0,
        Some(Kind::Scalar(Scalar::I8)) => 127.0,
        Some(Kind::Scalar(Scalar::U16)) => 65_535.0,
        Some(Kind::Scalar(Scalar::I16)) => 32_767.0,
        Some(Kind::Scalar(Scalar::U32)) => f64::from(u32::MAX),
        Some(Kind::Scalar(Scalar::I32)) => f64::from(i32::MAX),
        _ => 1.0,
    }
}

fn left_out(header: &Header, channels: &[usize]) -> Vec<String> {
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
