//! Triangles of a primitive: lists, strips and fans, indexed or not (glTF 2.0 section 3.7.2.1).

use crate::CarrierError;
use crate::accessor::Source;
use crate::document::index_of;
use serde_json::Value;

/// How vertices make triangles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Mode {
    List,
    Strip,
    Fan,
}

impl Mode {
    /// The mode of a primitive; `None` for points and lines.
    pub fn of(primitive: &Value) -> Option<Self> {
        match primitive.get("mode").map_or(Some(4), Value::as_u64) {
            Some(4) => Some(Mode::List),
            Some(5) => Some(Mode::Strip),
            Some(6) => Some(Mode::Fan),
            _ => None,
        }
    }
}

/// All triangles, counter-clockwise in the rest frame: `mirrored` turns them.
pub(crate) fn read(
    source: Source,
    primitive: &Value,
    mode: Mode,
    vertices: usize,
    mirrored: bool,
    pointer: &str,
) -> Result<Vec<[u32; 3]>, CarrierError> {
    let indices = match index_of(primitive, "indices") {
        Some(accessor) => source.indices(accessor)?,
        None => (0..vertices as u32).collect(),
    };
    if let Some(at) = indices.iter().position(|i| *i as usize >= vertices) {
        let problem = format!("index {} at {at} is not below {vertices}, the number of vertices", indices[at]);
        return Err(source.fail(format!("{pointer}/indices"), problem));
    }
    if mode == Mode::List && indices.len() % 3 != 0 {
        return Err(source.fail(format!("{pointer}/indices"), format!("{} indices are no triangles", indices.len())));
    }
    let mut triangles = make(mode, &indices);
    if mirrored {
        triangles.iter_mut().for_each(|t| t.swap(1, 2));
    }
    Ok(triangles)
}

fn make(mode: Mode, indices: &[u32]) -> Vec<[u32; 3]> {
    match mode {
        Mode::List => indices.chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect(),
        // Every second triangle of a strip is written the other way round.
        Mode::Strip => {
            let turned = |(i, t): (usize, &[u32])| if i % 2 == 0 { [t[0], t[1], t[2]] } else { [t[1], t[0], t[2]] };
            indices.windows(3).enumerate().map(turned).collect()
        }
        Mode::Fan => indices.windows(2).skip(1).map(|t| [indices[0], t[0], t[1]]).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strips_alternate_and_fans_keep_their_hub() {
        assert_eq!(make(Mode::Strip, &[0, 1, 2, 3]), [[0, 1, 2], [2, 1, 3]]);
        assert_eq!(make(Mode::Fan, &[7, 1, 2, 3]), [[7, 1, 2], [7, 2, 3]]);
        assert_eq!(make(Mode::Fan, &[7]), [[0u32; 3]; 0]);
    }
}
