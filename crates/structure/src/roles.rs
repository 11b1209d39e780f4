//! Roles of parts: evidence added up. Weights are natural logarithms of odds, so the confidence in a
//! role is exp(its sum) over the sum of exp over the three roles.

use crate::evidence::{Evidence, PartEvidence, Source};
use crate::forms::{Forms, shape_evidence};
use crate::geometry::Geometry;
use crate::look::look_evidence;
use crate::patterns::{Patterns, names};
use crate::shape::PieceShape;
use crate::sharing::larger_partner;
use crate::words::read_name;
use foliar_plant::Part;
use foliar_schema::Role;

/// A pattern that a person gave outweighs all that can be seen.
const PATTERN: f64 = 20.0;
/// Confidence where patterns of several roles match, at most.
const CONTRADICTED: f64 = 0.5;
/// All names but the first count this much: a material says more than the object that it is on.
const LATER_NAME: f64 = 0.5;
/// A part that lies on another by its vertices is what the other is.
const SHARED: f64 = 4.0;
/// A blob above wood is a crown.
const ABOVE_WOOD: f64 = 1.0;
/// Names with at least this weight settle that a part is not mixed.
const NAME_SETTLES: f64 = 3.0;

/// Decides all roles.
pub(crate) fn decide(geometry: &Geometry, shapes: &[Vec<PieceShape>], patterns: &Patterns) -> Vec<PartEvidence> {
    let forms: Vec<Forms> = shapes.iter().map(|s| Forms::of(s, geometry.diagonal)).collect();
    let partners = larger_partner(geometry);
    let mut parts: Vec<PartEvidence> = (0..forms.len())
        .map(|index| {
            let part = &geometry.parts[index];
            let mut evidence = pattern_evidence(part.part, patterns);
            evidence.extend(name_evidence(part.part));
            evidence.extend(look_evidence(part.part, geometry.base));
            if partners[index].is_none() {
                evidence.extend(shape_evidence(&forms[index]));
            }
            decided(PartEvidence {
                place: part.part.place,
                name: part.part.name().into(),
                role: Role::Other,
                confidence: 0.0,
                crown_volume: forms[index].mostly_blobs(),
                mixed: false,
                triangles: part.part.triangles.len(),
                pieces: part.pieces.count(),
                soup: part.pieces.soup,
                evidence,
            })
        })
        .collect();
    add_shared(&mut parts, &partners);
    add_above_wood(&mut parts, &forms);
    mark_mixed(&mut parts, &forms);
    for part in &mut parts {
        part.crown_volume &= part.role == Role::Leaf;
    }
    parts
}

/// The same part with role and confidence as its evidence has them; where nothing speaks at all it is
/// `other`, at one in three.
fn decided(mut part: PartEvidence) -> PartEvidence {
    let sum = |role| part.evidence.iter().filter(|e| e.role == role).map(|e| e.weight).sum::<f64>();
    let sums = [Role::Other, Role::Leaf, Role::Wood].map(|role| (role, sum(role)));
    let best = sums.iter().fold(sums[0], |best, &s| if s.1 > best.1 { s } else { best });
    part.role = best.0;
    part.confidence = 1.0 / sums.iter().map(|s| libm::exp(s.1 - best.1)).sum::<f64>();
    if part.evidence.iter().filter(|e| e.source == Source::Pattern).count() > 1 {
        part.confidence = part.confidence.min(CONTRADICTED);
    }
    part
}

fn pattern_evidence(part: &Part, patterns: &Patterns) -> Vec<Evidence> {
    let evidence = |(role, pattern, name): (Role, &str, &str)| Evidence {
        source: Source::Pattern,
        role,
        weight: PATTERN,
        reason: format!("pattern {pattern:?} of [roles] matches the name {name:?}"),
    };
    // One match per role is enough.
    let mut found: Vec<Evidence> = Vec::new();
    for matched in patterns.matches(part) {
        if !found.iter().any(|e| e.role == matched.0) {
            found.push(evidence(matched));
        }
    }
    found
}

/// At most one piece of evidence per role: the strongest of all names, earlier names first.
fn name_evidence(part: &Part) -> Vec<Evidence> {
    let mut found: Vec<Evidence> = Vec::new();
    for (rank, name) in names(part).into_iter().enumerate() {
        for (role, weight, word) in read_name(name) {
            let weight = if rank == 0 { weight } else { weight * LATER_NAME };
            let reason = format!("the name {name:?} says {word:?}");
            match found.iter_mut().find(|e| e.role == role) {
                Some(earlier) if earlier.weight >= weight => {}
                Some(earlier) => *earlier = Evidence { source: Source::Name, role, weight, reason },
                None => found.push(Evidence { source: Source::Name, role, weight, reason }),
            }
        }
    }
    found
}

fn add_shared(parts: &mut [PartEvidence], partners: &[Option<usize>]) {
    for index in 0..parts.len() {
        if let Some(partner) = partners[index] {
            let (role, name) = (parts[partner].role, parts[partner].name.clone());
            let reason =
                format!("shares nearly all its vertices with {name:?}, which is {role}; its own shape is not counted");
            parts[index].evidence.push(Evidence { source: Source::Neighbor, role, weight: SHARED, reason });
            parts[index] = decided(parts[index].clone());
        }
    }
}

fn add_above_wood(parts: &mut [PartEvidence], forms: &[Forms]) {
    let wood = (0..parts.len()).filter(|&i| parts[i].role == Role::Wood);
    let (area, moment) = wood.fold((0.0, 0.0), |(a, m), i| (a + forms[i].area, m + forms[i].area * forms[i].height));
    if area <= 0.0 {
        return;
    }
    for (part, form) in parts.iter_mut().zip(forms) {
        if part.crown_volume && form.height > moment / area {
            let reason = "stands higher than the middle of the wood".into();
            part.evidence.push(Evidence { source: Source::Neighbor, role: Role::Leaf, weight: ABOVE_WOOD, reason });
            *part = decided(part.clone());
        }
    }
}

/// A part is mixed where shape shows wood and foliage, or silhouettes of whole plants, and no name,
/// pattern or partner says what it is.
fn mark_mixed(parts: &mut [PartEvidence], forms: &[Forms]) {
    let wood_elsewhere: Vec<bool> =
        (0..parts.len()).map(|i| (0..parts.len()).any(|k| k != i && parts[k].role == Role::Wood)).collect();
    for ((part, form), wood_elsewhere) in parts.iter_mut().zip(forms).zip(wood_elsewhere) {
        let settled = part.evidence.iter().any(|e| e.weight >= NAME_SETTLES && e.source != Source::Shape);
        part.mixed = !settled && (form.wood_and_foliage() || (form.mostly_silhouettes() && !wood_elsewhere));
    }
}
