//! The component types of accessors.

/// Type of one component of an accessor element.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Component {
    I8,
    U8,
    I16,
    U16,
    U32,
    F32,
}

impl Component {
    /// Returns the type for a `componentType`.
    pub fn from_code(code: usize) -> Option<Self> {
        Some(match code {
            5120 => Self::I8,
            5121 => Self::U8,
            5122 => Self::I16,
            5123 => Self::U16,
            5125 => Self::U32,
            5126 => Self::F32,
            _ => return None,
        })
    }

    /// Returns the `componentType`.
    pub fn code(self) -> usize {
        match self {
            Self::I8 => 5120,
            Self::U8 => 5121,
            Self::I16 => 5122,
            Self::U16 => 5123,
            Self::U32 => 5125,
            Self::F32 => 5126,
        }
    }

    /// Returns the size in bytes.
    pub fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::U32 | Self::F32 => 4,
        }
    }

    /// Returns the smallest unsigned type whose restart value is not a vertex index.
    pub fn for_indices(n_vertices: usize) -> Self {
        match n_vertices {
            ..=255 => Self::U8,
            256..=65_535 => Self::U16,
            _ => Self::U32,
        }
    }

    /// Returns the number in the first bytes of `bytes`; 0 if they are too few.
    pub fn read(self, bytes: &[u8]) -> f64 {
        match (self, bytes) {
            (Self::I8, &[a, ..]) => f64::from(a.cast_signed()),
            (Self::U8, &[a, ..]) => f64::from(a),
            (Self::I16, &[a, b, ..]) => f64::from(i16::from_le_bytes([a, b])),
            (Self::U16, &[a, b, ..]) => f64::from(u16::from_le_bytes([a, b])),
            (Self::U32, &[a, b, c, d, ..]) => f64::from(u32::from_le_bytes([a, b, c, d])),
            (Self::F32, &[a, b, c, d, ..]) => f64::from(f32::from_le_bytes([a, b, c, d])),
            _ => 0.0,
        }
    }

    /// Appends `value`, saturated if the type is narrower.
    pub fn push(self, value: f64, bytes: &mut Vec<u8>) {
        match self {
            Self::I8 => bytes.extend_from_slice(&(value as i8).to_le_bytes()),
            Self::U8 => bytes.push(value as u8),
            Self::I16 => bytes.extend_from_slice(&(value as i16).to_le_bytes()),
            Self::U16 => bytes.extend_from_slice(&(value as u16).to_le_bytes()),
            Self::U32 => bytes.extend_from_slice(&(value as u32).to_le_bytes()),
            Self::F32 => bytes.extend_from_slice(&(value as f32).to_le_bytes()),
        }
    }

    /// Returns the number that stands for 1 in a normalized accessor.
    pub fn one(self) -> f64 {
        match self {
            Self::I8 => f64::from(i8::MAX),
            Self::U8 => f64::from(u8::MAX),
            Self::I16 => f64::from(i16::MAX),
            Self::U16 => f64::from(u16::MAX),
            Self::U32 => f64::from(u32::MAX),
            Self::F32 => 1.0,
        }
    }
}
