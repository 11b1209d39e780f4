//! A whole OBJ: chunks scanned in parallel and joined, polygons cut into triangles, runs of one
//! object and material. The result is the same for any thread count, because chunks are cut by size.

use super::number::LineError;
use super::polygon::Cutter;
use super::runs::{self, Run};
use super::scan::{Chunk, Corner, NONE, ODDITIES, Oddity, Tally, scan};
use super::text::{prepare, trim};
use crate::CarrierError;
use glam::DVec3;
use rayon::prelude::*;

/// Bytes per chunk, before it is moved to the next line end.
const CHUNK_BYTES: usize = 1 << 20;

/// A `mtllib` line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Library {
    /// What it names.
    pub name: String,
    /// Where it stands, from 1.
    pub line: u64,
}

/// An OBJ as it stands in the file: nothing is scaled, turned, welded or renumbered.
#[derive(Clone, Debug, Default)]
pub struct ObjFile {
    /// `v` lines.
    pub positions: Vec<[f64; 3]>,
    /// `vt` lines, v up.
    pub uvs: Vec<[f32; 2]>,
    /// `vn` lines; zero where the file's is not finite.
    pub normals: Vec<[f32; 3]>,
    /// Triangles, n - 2 per polygon of n corners, in the order of the faces.
    pub triangles: Vec<[Corner; 3]>,
    /// Runs in the order of the file; empty ones are left out.
    pub runs: Vec<Run>,
    /// Names of objects (or groups, where a file has no objects), in the order of their first line.
    pub objects: Vec<String>,
    /// Names of materials, in the order of their first line.
    pub materials: Vec<String>,
    /// Libraries in the order of their lines.
    pub libraries: Vec<Library>,
    /// Number of groups that were not told apart.
    pub merged_groups: usize,
    /// Whether the file began with a byte order mark.
    pub had_bom: bool,
    pub(crate) tallies: Vec<Tally>,
}

impl ObjFile {
    /// How often something odd stood in the file, and where first.
    pub(crate) fn tally(&self, oddity: Oddity) -> &Tally {
        &self.tallies[oddity as usize]
    }
}

/// Reads OBJ bytes; `file` stands in messages.
///
/// # Errors
/// [`CarrierError::Input`] with the line: numbers that are none, indices out of range, files without
/// faces, UTF-16, binary data.
pub fn parse(bytes: &[u8], file: &str) -> Result<ObjFile, CarrierError> {
    let text = prepare(bytes, file, "OBJ")?;
    let scanned: Vec<_> = split(&text.bytes).into_par_iter().map(scan).collect();
    let chunks = first_error(scanned, file)?;
    let origins = origins(&chunks, file)?;
    let totals = origins[chunks.len()];
    let resolved: Vec<_> = chunks
        .into_par_iter()
        .zip(&origins)
        .map(|(mut chunk, origin)| resolve(&mut chunk, origin, &totals).map(|()| chunk))
        .collect();
    // Errors of this step carry the line of the whole file already.
    let mut chunks = in_order(resolved, |error| line_error(file, u64::from(error.line), &error))?;
    let mut joined = join(&mut chunks, &origins);
    joined.had_bom = text.had_bom;
    let cut: Vec<_> = chunks.par_iter().map(|chunk| triangles(chunk, &joined.positions)).collect();
    let lines: Vec<u64> = origins.iter().map(|o| o.line).collect();
    runs::find(&chunks, &cut, &lines, &mut joined);
    joined.triangles.reserve_exact(cut.iter().map(|c| c.triangles.len()).sum());
    cut.into_iter().for_each(|mut c| joined.triangles.append(&mut c.triangles));
    if joined.triangles.is_empty() {
        let problem = format!("holds no faces ({} vertices)", joined.positions.len());
        return Err(CarrierError::input(file, "", problem, "export the tree with its faces ('f' lines)"));
    }
    Ok(joined)
}

/// Line-aligned pieces; none begins inside a continued line.
fn split(bytes: &[u8]) -> Vec<&[u8]> {
    let mut pieces = Vec::new();
    let mut rest = bytes;
    while !rest.is_empty() {
        let (piece, after) = rest.split_at(boundary(rest));
        pieces.push(piece);
        rest = after;
    }
    pieces
}

/// End of the first line at or after [`CHUNK_BYTES`] that does not go on in the next.
fn boundary(bytes: &[u8]) -> usize {
    let mut end = CHUNK_BYTES.min(bytes.len());
    while let Some(found) = memchr::memchr(b'\n', &bytes[end..]) {
        let line_start = memchr::memrchr(b'\n', &bytes[..end + found]).map_or(0, |n| n + 1);
        end += found + 1;
        if !trim(&bytes[line_start..end]).ends_with(b"\\") {
            return end;
        }
    }
    bytes.len()
}

/// Where a chunk's elements start in the whole file.
#[derive(Clone, Copy, Default)]
struct Origin {
    counts: [usize; 3],
    line: u64,
}

fn origins(chunks: &[Chunk], file: &str) -> Result<Vec<Origin>, CarrierError> {
    let mut origin = Origin::default();
    let mut all = vec![origin];
    for chunk in chunks {
        let counts = [chunk.positions.len(), chunk.uvs.len(), chunk.normals.len()];
        origin.counts = std::array::from_fn(|k| origin.counts[k] + counts[k]);
        origin.line += u64::from(chunk.lines);
        all.push(origin);
    }
    if origin.counts.iter().any(|&count| count > i32::MAX as usize) {
        let problem = format!("holds {:?} v, vt and vn lines", origin.counts);
        return Err(CarrierError::input(file, "", problem, format!("at most {} of each", i32::MAX)));
    }
    Ok(all)
}

/// Makes every index 0-based and absolute, and refuses those that are out of range.
fn resolve(chunk: &mut Chunk, origin: &Origin, totals: &Origin) -> Result<(), LineError> {
    for (at, &mask) in chunk.relative.iter().enumerate() {
        let corner = &mut chunk.corners[at];
        for (kind, index) in [&mut corner.v, &mut corner.vt, &mut corner.vn].into_iter().enumerate() {
            if mask & (1 << kind) != 0 {
                *index = (*index as i32 as i64 + origin.counts[kind] as i64).try_into().unwrap_or(NONE - 1);
            }
        }
    }
    let inside = |index: u32, kind: usize| index == NONE || (index as usize) < totals.counts[kind];
    let fits = |c: &Corner| inside(c.v, 0) && inside(c.vt, 1) && inside(c.vn, 2);
    let Some(bad) = chunk.corners.iter().position(|c| !fits(c)) else { return Ok(()) };
    let face = chunk.faces.partition_point(|f| f.end as usize <= bad);
    Err(out_of_range(&chunk.corners[bad], totals, origin.line + u64::from(chunk.faces[face].line)))
}

fn out_of_range(corner: &Corner, totals: &Origin, line: u64) -> LineError {
    let list = [("v", corner.v), ("vt", corner.vt), ("vn", corner.vn)];
    let bad = list.iter().zip(totals.counts).find(|((_, i), count)| *i != NONE && *i as usize >= *count);
    let problem = bad.map_or(String::new(), |((kind, index), count)| {
        if *index == NONE - 1 {
            format!("a negative {kind} index points before the first of {count} {kind} lines")
        } else {
            format!("{kind} index {} is out of range: the file has {count} {kind} lines", *index as u64 + 1)
        }
    });
    let remedy = "the file is damaged or cut short; export it again";
    LineError { line: line.try_into().unwrap_or(u32::MAX), problem, remedy: remedy.into() }
}

fn first_error(scanned: Vec<Result<Chunk, LineError>>, file: &str) -> Result<Vec<Chunk>, CarrierError> {
    let mut lines = 0;
    let mut chunks = Vec::with_capacity(scanned.len());
    for result in scanned {
        let chunk = result.map_err(|error| line_error(file, lines + u64::from(error.line), &error))?;
        lines += u64::from(chunk.lines);
        chunks.push(chunk);
    }
    Ok(chunks)
}

/// All values, or the first error in the order of the list (rayon's own would be any of them).
fn in_order<T, E>(results: Vec<Result<T, E>>, make: impl Fn(E) -> CarrierError) -> Result<Vec<T>, CarrierError> {
    results.into_iter().map(|r| r.map_err(&make)).collect()
}

fn line_error(file: &str, line: u64, error: &LineError) -> CarrierError {
    CarrierError::input(file, format!("line {line}"), error.problem.as_str(), error.remedy.as_str())
}

fn join(chunks: &mut [Chunk], origins: &[Origin]) -> ObjFile {
    let mut joined = ObjFile { tallies: vec![Tally::default(); ODDITIES], ..ObjFile::default() };
    let totals = origins[chunks.len()].counts;
    joined.positions.reserve_exact(totals[0]);
    joined.uvs.reserve_exact(totals[1]);
    joined.normals.reserve_exact(totals[2]);
    for (chunk, origin) in chunks.iter_mut().zip(origins) {
        joined.positions.append(&mut chunk.positions);
        joined.uvs.append(&mut chunk.uvs);
        joined.normals.append(&mut chunk.normals);
        for (all, tally) in joined.tallies.iter_mut().zip(&chunk.tallies) {
            if all.count == 0 && tally.count > 0 {
                all.line = origin.line as u32 + tally.line;
                all.example.clone_from(&tally.example);
            }
            all.count += tally.count;
        }
    }
    joined
}

/// Triangles of a chunk.
pub(crate) struct Cut {
    /// Triangles of all its faces in order.
    pub triangles: Vec<[Corner; 3]>,
    /// Where each face's begin, and the end.
    pub starts: Vec<usize>,
}

fn triangles(chunk: &Chunk, positions: &[[f64; 3]]) -> Cut {
    let mut cutter = Cutter::new();
    let mut points = Vec::new();
    let mut places = Vec::new();
    let mut cut = Cut {
        triangles: Vec::with_capacity(chunk.corners.len().saturating_sub(2 * chunk.faces.len())),
        starts: Vec::with_capacity(chunk.faces.len() + 1),
    };
    let mut start = 0;
    for face in &chunk.faces {
        let corners = &chunk.corners[start..face.end as usize];
        start = face.end as usize;
        cut.starts.push(cut.triangles.len());
        if let [a, b, c] = corners {
            cut.triangles.push([*a, *b, *c]);
            continue;
        }
        points.clear();
        places.clear();
        points.extend(corners.iter().map(|c| DVec3::from(positions[c.v as usize])));
        cutter.cut(&points, &mut places);
        cut.triangles.extend(places.iter().map(|t| t.map(|i| corners[i as usize])));
    }
    cut.starts.push(cut.triangles.len());
    cut
}
