//! One chunk of an OBJ, line by line: numbers, faces with the file's own indices, and the
//! statements between them. Chunks end at line ends, so they are scanned in parallel.

use super::number::{Cursor, LineError, integer};
use super::text::{excerpt, name, split_word, trim};
use std::borrow::Cow;

/// "No index" in a corner.
pub const NONE: u32 = u32::MAX;

/// One corner of a face: 0-based indices of the file's own `v`, `vt` and `vn` lines, [`NONE`] where
/// the corner has none.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Corner {
    /// Index of the position.
    pub v: u32,
    /// Index of the texture coordinate.
    pub vt: u32,
    /// Index of the normal.
    pub vn: u32,
}

/// What a line between faces says.
#[derive(Clone, Debug)]
pub(crate) enum Statement {
    /// `o NAME`
    Object(String),
    /// `g NAME`
    Group(String),
    /// `usemtl NAME`
    Material(String),
    /// `mtllib NAME`
    Library(String),
}

/// A statement and where it stands.
#[derive(Clone, Debug)]
pub(crate) struct Event {
    /// Number of faces of the chunk before it.
    pub face: u32,
    /// Line within the chunk, from 1.
    pub line: u32,
    /// What it says.
    pub statement: Statement,
}

/// Things that are counted, and said once in a finding.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Oddity {
    /// `l` and `p`.
    LinesAndPoints,
    /// `s`.
    Smoothing,
    /// Faces of one or two corners.
    ShortFace,
    /// Colors behind the coordinates of `v`.
    VertexColor,
    /// A fourth coordinate other than 1.
    Weight,
    /// A `vn` that is not finite.
    BadNormal,
    /// Curves, surfaces, and keywords that nobody knows.
    Unknown,
    /// Names that are no UTF-8.
    Latin1,
}

/// Number of kinds of [`Oddity`].
pub(crate) const ODDITIES: usize = Oddity::Latin1 as usize + 1;

/// How often, where first (line from 1), and the first one's text.
#[derive(Clone, Debug, Default)]
pub(crate) struct Tally {
    /// How often.
    pub count: u64,
    /// First line.
    pub line: u32,
    /// Keyword or name there.
    pub example: String,
}

/// A face: its corners end at `end` in the chunk's list; it stands in line `line` of the chunk.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Face {
    /// End of its corners.
    pub end: u32,
    /// Line within the chunk, from 1.
    pub line: u32,
}

/// What one chunk holds.
#[derive(Debug, Default)]
pub(crate) struct Chunk {
    /// `v`, as in the file.
    pub positions: Vec<[f64; 3]>,
    /// `vt`, as in the file.
    pub uvs: Vec<[f32; 2]>,
    /// `vn`, as in the file; zero where the file's is not finite.
    pub normals: Vec<[f32; 3]>,
    /// Corners of all faces. Where a bit of `relative` is set, an index counts from the chunk's
    /// first element (and wraps below zero into earlier chunks).
    pub corners: Vec<Corner>,
    /// Bits 1, 2, 4 for v, vt, vn; empty while no index was negative.
    pub relative: Vec<u8>,
    /// Faces in order.
    pub faces: Vec<Face>,
    /// Statements in order.
    pub events: Vec<Event>,
    /// What was counted.
    pub tallies: [Tally; ODDITIES],
    /// Number of lines.
    pub lines: u32,
}

/// Scans a chunk: `bytes` starts at the beginning of a line.
pub(crate) fn scan(bytes: &[u8]) -> Result<Chunk, LineError> {
    let mut chunk = Chunk::default();
    let mut at = 0;
    while at < bytes.len() {
        let end = memchr::memchr(b'\n', &bytes[at..]).map_or(bytes.len(), |n| at + n);
        chunk.lines += 1;
        let line = chunk.lines;
        let first = trim(&bytes[at..end]);
        at = end + 1;
        let text = if first.last() == Some(&b'\\') && first[0] != b'#' {
            Cow::Owned(chunk.continued(first, bytes, &mut at))
        } else {
            Cow::Borrowed(first)
        };
        chunk.statement(&text, line).map_err(|error| LineError { line, ..error })?;
    }
    Ok(chunk)
}

impl Chunk {
    /// Joins a line that ends in a backslash with those that it goes on in.
    fn continued(&mut self, first: &[u8], bytes: &[u8], at: &mut usize) -> Vec<u8> {
        let mut joined = first.to_vec();
        while joined.last() == Some(&b'\\') {
            joined.pop();
            joined.push(b' ');
            if *at >= bytes.len() {
                break;
            }
            let end = memchr::memchr(b'\n', &bytes[*at..]).map_or(bytes.len(), |n| *at + n);
            joined.extend_from_slice(trim(&bytes[*at..end]));
            *at = end + 1;
            self.lines += 1;
        }
        joined
    }

    fn statement(&mut self, text: &[u8], line: u32) -> Result<(), LineError> {
        let (keyword, rest) = split_word(text);
        match keyword {
            b"v" => self.position(rest, line)?,
            b"vt" => self.uv(rest)?,
            b"vn" => self.normal(rest, line)?,
            b"f" | b"fo" => self.face(rest, line)?,
            b"" => {}
            [b'#', ..] => {}
            b"o" => self.named(Statement::Object, rest, line),
            b"g" => self.named(Statement::Group, rest, line),
            b"usemtl" => self.named(Statement::Material, rest, line),
            b"mtllib" => self.named(Statement::Library, rest, line),
            b"s" => self.count(Oddity::Smoothing, line, keyword),
            b"l" | b"p" => self.count(Oddity::LinesAndPoints, line, keyword),
            _ => self.unknown(keyword, line)?,
        }
        Ok(())
    }

    fn position(&mut self, rest: &[u8], line: u32) -> Result<(), LineError> {
        let mut cursor = Cursor::new(rest);
        let position = [cursor.coordinate("x")?, cursor.coordinate("y")?, cursor.coordinate("z")?];
        self.positions.push(position);
        if cursor.has_more() { self.more_than_three(cursor, line) } else { Ok(()) }
    }

    /// A weight (one number) or a color (three, or four with alpha or after a weight).
    fn more_than_three(&mut self, mut cursor: Cursor, line: u32) -> Result<(), LineError> {
        let first = cursor.number("the number after z")?;
        if cursor.has_more() {
            self.count(Oddity::VertexColor, line, b"v");
            while cursor.has_more() {
                cursor.number("color")?;
            }
        } else if first.to_bits() != 1f64.to_bits() {
            self.count(Oddity::Weight, line, b"v");
        }
        Ok(())
    }

    fn uv(&mut self, rest: &[u8]) -> Result<(), LineError> {
        let mut cursor = Cursor::new(rest);
        let u = cursor.coordinate("u")?;
        let v = if cursor.has_more() { cursor.coordinate("v")? } else { 0.0 };
        self.uvs.push([u as f32, v as f32]);
        Ok(())
    }

    fn normal(&mut self, rest: &[u8], line: u32) -> Result<(), LineError> {
        let mut cursor = Cursor::new(rest);
        let normal = [cursor.number("nx")? as f32, cursor.number("ny")? as f32, cursor.number("nz")? as f32];
        let finite = normal.iter().all(|n| n.is_finite());
        if !finite {
            self.count(Oddity::BadNormal, line, b"vn");
        }
        self.normals.push(if finite { normal } else { [0.0; 3] });
        Ok(())
    }

    fn face(&mut self, rest: &[u8], line: u32) -> Result<(), LineError> {
        let start = self.corners.len();
        let mut cursor = Cursor::new(rest);
        while cursor.has_more() {
            self.corner(cursor.word())?;
        }
        if self.corners.len() - start < 3 {
            self.corners.truncate(start);
            self.relative.truncate(start);
            self.count(Oddity::ShortFace, line, b"f");
            return Ok(());
        }
        self.faces.push(Face { end: self.corners.len() as u32, line });
        Ok(())
    }

    /// `v`, `v/vt`, `v//vn` or `v/vt/vn`.
    fn corner(&mut self, word: &[u8]) -> Result<(), LineError> {
        let counts = [self.positions.len(), self.uvs.len(), self.normals.len()];
        let mut indices = [NONE; 3];
        let mut relative = 0u8;
        let mut at = 0;
        for (kind, &count) in counts.iter().enumerate() {
            match integer(&word[at..]) {
                Some((index, used)) => {
                    at += used;
                    relative |= u8::from(index < 0) << kind;
                    indices[kind] = stored(index, count).ok_or_else(|| bad_index(word, index))?;
                }
                // Only the texture coordinate may be left out between two strokes, or a trailing part.
                None if kind > 0 && (at == word.len() || word[at] == b'/') => {}
                None => return Err(bad_corner(word)),
            }
            match word.get(at) {
                None => break,
                Some(b'/') if kind < 2 => at += 1,
                Some(_) => return Err(bad_corner(word)),
            }
        }
        if relative != 0 || !self.relative.is_empty() {
            self.relative.resize(self.corners.len(), 0);
            self.relative.push(relative);
        }
        self.corners.push(Corner { v: indices[0], vt: indices[1], vn: indices[2] });
        Ok(())
    }

    fn named(&mut self, make: fn(String) -> Statement, rest: &[u8], line: u32) {
        let (text, latin1) = name(rest);
        if latin1 {
            self.count(Oddity::Latin1, line, rest);
        }
        self.events.push(Event { face: self.faces.len() as u32, line, statement: make(text) });
    }

    fn unknown(&mut self, keyword: &[u8], line: u32) -> Result<(), LineError> {
        if keyword.iter().all(|b| b.is_ascii_graphic()) {
            self.count(Oddity::Unknown, line, keyword);
            return Ok(());
        }
        let problem = format!("starts with {:?}, which is no OBJ statement", excerpt(keyword));
        Err(LineError::new(problem, "name a Wavefront OBJ text file"))
    }

    fn count(&mut self, oddity: Oddity, line: u32, example: &[u8]) {
        let tally = &mut self.tallies[oddity as usize];
        if tally.count == 0 {
            tally.line = line;
            tally.example = excerpt(example);
        }
        tally.count += 1;
    }
}

/// 0-based index of a 1-based one; a negative one counts back from the `count` elements so far, and
/// wraps where it reaches into an earlier chunk. `None` for 0 and what no file can hold.
fn stored(index: i64, count: usize) -> Option<u32> {
    const LARGEST: i64 = i32::MAX as i64;
    match index {
        1..=LARGEST => Some((index - 1) as u32),
        _ if (-LARGEST..0).contains(&index) => Some((count as i64 + index) as i32 as u32),
        _ => None,
    }
}

fn bad_index(word: &[u8], index: i64) -> LineError {
    let problem = format!("face corner {:?} has index {index}", excerpt(word));
    LineError::new(problem, "OBJ counts from 1, or from -1 backward")
}

fn bad_corner(word: &[u8]) -> LineError {
    let problem = format!("face corner {:?} is none of v, v/vt, v//vn, v/vt/vn", excerpt(word));
    LineError::new(problem, "write whole numbers between strokes")
}
