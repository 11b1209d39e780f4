//! What speaks for a part's role, and how it is told.

use foliar_plant::Place;
use foliar_schema::Role;
use std::fmt::Write;

/// Where evidence comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// A pattern of `[roles]`.
    Pattern,
    /// A word in a name.
    Name,
    /// Alpha or color of the material.
    Look,
    /// Shape of the pieces.
    Shape,
    /// Vertices shared with another part, or the place beside other parts.
    Neighbor,
}

/// One reason to believe in a role.
#[derive(Clone, Debug, PartialEq)]
pub struct Evidence {
    /// Where it comes from.
    pub source: Source,
    /// The role that it speaks for.
    pub role: Role,
    /// How much it says: natural logarithm of the odds.
    pub weight: f64,
    /// What was seen, in words and numbers.
    pub reason: String,
}

/// What is known of one part.
#[derive(Clone, Debug, PartialEq)]
pub struct PartEvidence {
    /// Where the part stands in the glTF.
    pub place: Place,
    /// Its name: material, else node, else mesh.
    pub name: String,
    /// What it was taken for.
    pub role: Role,
    /// How sure that is, 0 to 1.
    pub confidence: f64,
    /// Closed blobs that stand for foliage.
    pub crown_volume: bool,
    /// Trunk and crown in one part: the role is no answer, whatever it says.
    pub mixed: bool,
    /// Triangles, those without area included.
    pub triangles: usize,
    /// Pieces connected over position ids; over equal positions where it is soup.
    pub pieces: usize,
    /// Triangle soup: hardly any triangles share vertices.
    pub soup: bool,
    /// Every reason, in the order in which it was looked for.
    pub evidence: Vec<Evidence>,
}

/// A table of parts, roles and reasons for people to read (`--explain-roles`).
pub fn explain(parts: &[PartEvidence]) -> String {
    let mut text = String::new();
    for part in parts {
        let kind = match (part.mixed, part.crown_volume) {
            (true, _) => " (mixed: trunk and crown in one part)",
            (_, true) => " (crown volume)",
            _ => "",
        };
        let soup = if part.soup { ", soup welded at equal positions" } else { "" };
        // Writing to a String cannot fail.
        let _ = writeln!(
            text,
            "{:?} (mesh {}, primitive {}; {} triangles in {} pieces{soup}): {}{kind}, confidence {:.2}",
            part.name, part.place.mesh, part.place.primitive, part.triangles, part.pieces, part.role, part.confidence
        );
        for evidence in &part.evidence {
            let _ = writeln!(text, "    {:5} {:+.1}  {}", evidence.role, evidence.weight, evidence.reason);
        }
    }
    text
}
