//! Named arrays of a layer.

/// Numbers in rows of `width`.
#[derive(Clone, Debug, PartialEq)]
pub enum Array {
    /// 32-bit floats.
    F32 {
        /// Numbers per row.
        width: usize,
        /// Row after row.
        data: Vec<f32>,
    },
    /// 32-bit integers.
    I32 {
        /// Numbers per row.
        width: usize,
        /// Row after row.
        data: Vec<i32>,
    },
}

impl Array {
    /// One float per row.
    pub fn scalars(data: Vec<f32>) -> Self {
        Array::F32 { width: 1, data }
    }

    /// Three floats per row.
    pub fn vectors(data: &[glam::Vec3]) -> Self {
        Array::F32 { width: 3, data: bytemuck::cast_slice(data).to_vec() }
    }

    /// One integer per row.
    pub fn integers(data: Vec<i32>) -> Self {
        Array::I32 { width: 1, data }
    }

    /// Numbers per row.
    pub fn width(&self) -> usize {
        match self {
            Array::F32 { width, .. } | Array::I32 { width, .. } => *width,
        }
    }

    /// Numbers in all rows.
    pub fn numbers(&self) -> usize {
        match self {
            Array::F32 { data, .. } => data.len(),
            Array::I32 { data, .. } => data.len(),
        }
    }

    /// One of them, row after row; whole ones beyond 2^24 rounded.
    ///
    /// # Panics
    /// Where there is none.
    pub fn number(&self, at: usize) -> f32 {
        match self {
            Array::F32 { data, .. } => data[at],
            Array::I32 { data, .. } => data[at] as f32,
        }
    }

    /// Rows.
    pub fn rows(&self) -> usize {
        match self {
            Array::F32 { width, data } => data.len() / width,
            Array::I32 { width, data } => data.len() / width,
        }
    }

    /// The floats, where it holds floats.
    pub fn as_f32(&self) -> Option<&[f32]> {
        match self {
            Array::F32 { data, .. } => Some(data),
            Array::I32 { .. } => None,
        }
    }

    /// The integers, where it holds integers.
    pub fn as_i32(&self) -> Option<&[i32]> {
        match self {
            Array::I32 { data, .. } => Some(data),
            Array::F32 { .. } => None,
        }
    }

    /// Little-endian bytes.
    pub fn bytes(&self) -> &[u8] {
        match self {
            Array::F32 { data, .. } => bytemuck::cast_slice(data),
            Array::I32 { data, .. } => bytemuck::cast_slice(data),
        }
    }
}
