//! Rules of leaf materials: holes that are drawn, backs that are seen.

use crate::faces::{Facts, is_open};
use crate::{Report, Subject};
use foliar_carrier::survey::Found;
use foliar_plant::AlphaMode;
use foliar_schema::{Role, code};
use std::collections::BTreeSet;

/// A part whose triangles mostly have backs of their own needs no doubleSided: this share of them, or more.
const BACKED: f64 = 0.5;

pub(crate) fn check(subject: &Subject, facts: &[Facts], report: &mut Report) {
    let mut judged = BTreeSet::new();
    for ((part, role), facts) in subject.parts().zip(facts) {
        let Some(index) = part.material.map(|m| m as usize).filter(|_| role == Role::Leaf) else { continue };
        let Some(material) = subject.seen.base.materials.get(index) else { continue };
        let backed = facts.coincident as f64 * 2.0 >= BACKED * facts.solid as f64;
        let is_culled = !material.double_sided && !backed && facts.solid > 0 && is_open(part);
        if is_culled && judged.insert((index, true)) {
            let message = format!(
                "leaf material {:?} is single-sided, and part {:?} has no backs",
                name(&material.name),
                part.name()
            );
            report.say(&code::MATERIAL_CULLED, format!("/materials/{index}"), message);
        }
        if judged.insert((index, false)) {
            alpha(subject, index, report);
        }
    }
}

fn name(name: &Option<String>) -> &str {
    name.as_deref().unwrap_or_default()
}

/// Alpha of a leaf material beside what its picture can hold.
fn alpha(subject: &Subject, index: usize, report: &mut Report) {
    let material = &subject.seen.base.materials[index];
    let picture = subject.seen.base_pictures.get(index).copied().flatten().map(|p| &subject.seen.pictures[p]);
    let found = picture.map(|picture| &picture.found);
    let Some(Found::Picture { has_alpha, .. }) = found else { return };
    let has_alpha = &(*has_alpha || subject.seen.own_masks.contains(&index));
    let called = format!("leaf material {:?}", name(&material.name));
    let place = format!("/materials/{index}");
    match material.alpha_mode {
        AlphaMode::Opaque if *has_alpha => {
            report.say(&code::ALPHA_IGNORED, place, format!("{called} is OPAQUE, and its texture has alpha"));
        }
        AlphaMode::Blend if *has_alpha => {
            report.say(&code::ALPHA_BLENDED, place, format!("{called} is blended: MASK needs no order of drawing"));
        }
        AlphaMode::Mask(_) | AlphaMode::Blend if !*has_alpha && material.base_color[3] >= 1.0 => {
            report.say(&code::ALPHA_MISSING, place, format!("{called} asks for alpha, and its texture has none"));
        }
        _ => {}
    }
}
