//! How false colors stand for values, and what is said of them.

/// Whole numbers that a legend shows one by one span at most so much.
pub(crate) const MOST_STEPS: f32 = 12.0;

/// What a legend says.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Legend {
    /// Name of the channel or column.
    pub name: String,
    /// One line about it.
    pub doc: String,
    /// Unit of measure.
    pub unit: String,
    /// How colors stand for values.
    pub kind: Key,
}

/// How colors stand for values.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Key {
    /// [`crate::colors::ramp`] from the first number to the second.
    Ramp(f32, f32),
    /// [`crate::colors::diverging`] from minus this number to plus this number.
    Diverging(f32),
    /// [`crate::colors::of_direction`].
    Direction,
    /// Components as red, green and blue, each over its range: names, least and greatest.
    Box([&'static str; 3], [f32; 3], [f32; 3]),
    /// [`crate::colors::ramp`] over whole numbers, from the first to the second.
    Steps(i32, i32),
    /// [`crate::colors::of_id`]; so many ids.
    Ids(usize),
    /// [`crate::colors::of_role`].
    Roles,
}

impl Key {
    /// One key for two pictures: it spans what both span.
    pub fn with(self, other: Key) -> Key {
        let each = |a: [f32; 3], b: [f32; 3], pick: fn(f32, f32) -> f32| std::array::from_fn(|c| pick(a[c], b[c]));
        match (self, other) {
            (Key::Ramp(a, b), Key::Ramp(c, d)) => Key::Ramp(a.min(c), b.max(d)),
            (Key::Steps(a, b), Key::Steps(c, d)) => {
                let (low, high) = (a.min(c), b.max(d));
                if (high - low) as f32 > MOST_STEPS {
                    Key::Ramp(low as f32, high as f32)
                } else {
                    Key::Steps(low, high)
                }
            }
            // A few whole numbers beside many, or beside one alone.
            (Key::Steps(a, b), Key::Ramp(c, d)) | (Key::Ramp(c, d), Key::Steps(a, b)) => {
                Key::Ramp(c.min(a as f32), d.max(b as f32))
            }
            (Key::Box(names, a, b), Key::Box(_, c, d)) => Key::Box(names, each(a, c, f32::min), each(b, d, f32::max)),
            (Key::Ids(a), Key::Ids(b)) => Key::Ids(a.max(b)),
            (own, _) => own,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_key_spans_both_pictures() {
        assert_eq!(Key::Ramp(0.0, 2.0).with(Key::Ramp(1.0, 5.0)), Key::Ramp(0.0, 5.0));
        assert_eq!(Key::Steps(0, 3).with(Key::Steps(2, 6)), Key::Steps(0, 6));
        assert_eq!(Key::Steps(0, 3).with(Key::Steps(0, 40)), Key::Ramp(0.0, 40.0));
        assert_eq!(Key::Steps(0, 3).with(Key::Ramp(-1.0, 2.0)), Key::Ramp(-1.0, 3.0));
        let names = ["X", "Y", "Z"];
        let both = Key::Box(names, [0.0; 3], [1.0; 3]).with(Key::Box(names, [-1.0, 0.5, 0.0], [0.5, 3.0, 1.0]));
        assert_eq!(both, Key::Box(names, [-1.0, 0.0, 0.0], [1.0, 3.0, 1.0]));
    }
}
