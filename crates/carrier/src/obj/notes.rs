//! Findings about what an OBJ held and the conversion left out or made up.

use super::file::ObjFile;
use super::mesh::Noticed;
use super::scan::Oddity;
use foliar_schema::{CodeInfo, Finding, code};

/// Findings about lines that were counted while scanning, and about what building meshes noticed.
pub(crate) fn findings(file: &ObjFile, noticed: &Noticed, name: &str) -> Vec<Finding> {
    let mut all: Vec<Finding> = Vec::new();
    if file.had_bom {
        let message = "the file began with a byte order mark, which was left out";
        all.push(Finding::new(&code::IMPORT_ENCODING, message));
    }
    let mut count = |oddity, what: &str| all.extend(counted(file, oddity, what));
    count(Oddity::LinesAndPoints, "lines and points ('l', 'p') are no surface");
    count(Oddity::ShortFace, "faces of fewer than three corners were left out");
    count(Oddity::VertexColor, "vertices with a color: the colors were left out");
    count(Oddity::Weight, "vertices with a fourth number other than 1, which only curves use");
    count(Oddity::BadNormal, "normals that are not finite were computed anew");
    count(Oddity::Unknown, "statements without a meaning here, such as");
    if noticed.computed_normals > 0 {
        count(Oddity::Smoothing, "smoothing groups ('s') were left out: computed normals are smooth");
    }
    let mut say = |info: &CodeInfo, number: usize, what: &str| {
        if number > 0 {
            all.push(Finding::new(info, format!("{number} {what}")));
        }
    };
    say(&code::IMPORT_IGNORED, file.merged_groups, "groups ('g') were not told apart: parts are materials");
    say(
        &code::IMPORT_IGNORED,
        noticed.missing_uvs,
        "vertices without a texture coordinate among such with one got 0 0",
    );
    say(&code::IMPORT_DEGENERATE, noticed.unused_positions, "vertices ('v') that no face uses were left out");
    all.into_iter().map(|finding| finding.in_file(name)).collect()
}

fn counted(file: &ObjFile, oddity: Oddity, what: &str) -> Option<Finding> {
    let tally = file.tally(oddity);
    let example = if oddity == Oddity::Unknown { format!(" {:?}", tally.example) } else { String::new() };
    let message = format!("{} {what}{example}", tally.count);
    (tally.count > 0).then(|| Finding::new(&code::IMPORT_IGNORED, message).at(format!("line {}", tally.line)))
}
