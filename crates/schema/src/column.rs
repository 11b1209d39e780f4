//! Columns (values per leaf or branch), with units, ranges and the step that an eye can just see.

use crate::{COLUMNS, Element, names};

/// One value per row of a property table.
#[derive(Clone, Copy, Debug)]
pub struct Column {
    /// Class of the table.
    pub class: &'static str,
    /// Property of the class.
    pub name: &'static str,
    /// Who writes it.
    pub room: &'static str,
    /// Number type.
    pub element: Element,
    /// Numbers per row: 1 SCALAR, 2 to 4 VECn (or an array where `array`).
    pub width: usize,
    /// A fixed-length array rather than a vector.
    pub array: bool,
    /// Unit of measure.
    pub unit: &'static str,
    /// Least and greatest value of a number.
    pub range: [f32; 2],
    /// Smallest difference that can be seen; 0 where a difference is no matter of seeing.
    pub visible_step: f64,
    /// As of [`crate::Channel`].
    pub optical_depth: bool,
    /// One line for docs.
    pub doc: &'static str,
}

/// Any number.
pub(crate) const ANY: [f32; 2] = [f32::MIN, f32::MAX];

/// Any number that is not below 0.
pub(crate) const NOT_NEGATIVE: [f32; 2] = [0.0, f32::MAX];

/// Rows of a table, and -1 for none.
pub(crate) const ROWS: [f32; 2] = [-1.0, f32::MAX];

/// Columns whose numbers are rows of the table of a class; -1 is none.
pub const REFERENCES: [(&str, &str, &str); 4] = [
    (names::CLASS_LEAF, "branch", names::CLASS_BRANCH),
    (names::CLASS_BRANCH, "parent", names::CLASS_BRANCH),
    (names::CLASS_BRANCH, "chain", names::CLASS_BRANCH),
    (names::CLASS_AXIS, "branch", names::CLASS_BRANCH),
];

/// The column of this class and name.
pub fn column(class: &str, name: &str) -> Option<&'static Column> {
    COLUMNS.iter().find(|c| c.class == class && c.name == name)
}
