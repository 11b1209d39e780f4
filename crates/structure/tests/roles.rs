//! Roles from names, patterns, shape and neighbors; findings; what is refused.
#![expect(clippy::unwrap_used, reason = "a test that fails here says where")]

use foliar_plant::sample::{Recipe, odd_plants};
use foliar_plant::{Base, Part, Place};
use foliar_schema::{Role, Roles};
use foliar_structure::{Analysis, StructureError, StructureParams, analyze, explain};
use glam::Vec3;

fn find_with(base: &Base, roles: &Roles) -> Analysis {
    analyze(base, roles, &StructureParams::default()).unwrap()
}

fn find(base: &Base) -> Analysis {
    find_with(base, &Roles::default())
}

fn codes(analysis: &Analysis) -> Vec<&str> {
    analysis.findings.iter().map(|f| f.code.as_str()).collect()
}

/// A small tree whose names and materials say nothing.
fn nameless() -> Base {
    let mut base = Recipe::small().grow().base().clone();
    for part in &mut base.parts {
        (part.material_name, part.object_name, part.node_name, part.material) = (None, None, None, None);
    }
    base
}

/// All parts of a base as one.
fn joined(base: &Base) -> Base {
    let mut all = base.parts[0].clone();
    (all.uvs, all.normals) = (Vec::new(), Vec::new());
    for part in &base.parts[1..] {
        let first = all.positions.len() as u32;
        all.positions.extend(&part.positions);
        all.position_ids.extend(&part.position_ids);
        all.triangles.extend(part.triangles.iter().map(|t| t.map(|v| v + first)));
    }
    Base { parts: vec![all], ..base.clone() }
}

#[test]
fn shape_alone_tells_leaves_from_wood() {
    let analysis = find(&nameless());
    assert_eq!(analysis.structure.roles, [Role::Wood, Role::Leaf], "{}", explain(&analysis.parts));
    assert!(codes(&analysis).is_empty(), "{:?}", analysis.findings);
}

#[test]
fn trunk_and_crown_in_one_part_are_not_guessed_in_silence() {
    let base = joined(&nameless());
    assert!(codes(&find(&base)).contains(&"ROLE-MIXED"));
    let roles = Roles { leaf: vec!["*".into()], ..Roles::default() };
    let told = find_with(&base, &roles);
    assert_eq!((told.structure.roles[0], codes(&told).len()), (Role::Leaf, 0), "{:?}", told.findings);
}

#[test]
fn patterns_win_over_everything_and_ignore_case() {
    let base = Recipe::small().grow().base().clone();
    let roles = Roles { wood: vec!["LEA*".into()], other: vec!["?ark".into()], ..Roles::default() };
    let analysis = find_with(&base, &roles);
    assert_eq!(analysis.structure.roles, [Role::Other, Role::Wood]);
    assert!(codes(&analysis).contains(&"LEAF-NONE"));
}

#[test]
fn contradicting_patterns_are_unsure() {
    let base = Recipe::small().grow().base().clone();
    let roles = Roles { wood: vec!["leaf".into()], leaf: vec!["bark".into()], ..Roles::default() };
    let both = Roles { wood: vec!["*".into()], leaf: vec!["*".into()], ..Roles::default() };
    assert!(!codes(&find_with(&base, &roles)).contains(&"ROLE-UNSURE"));
    let names = Base { parts: nameless().parts, ..base.clone() };
    assert!(codes(&find_with(&names, &both)).contains(&"ROLE-UNSURE"));
    let two = Roles { wood: vec!["le*".into()], leaf: vec!["*af".into()], ..Roles::default() };
    let analysis = find_with(&base, &two);
    let finding = analysis.findings.iter().find(|f| f.code == "ROLE-UNSURE").unwrap();
    assert!(finding.message.contains("\"le*\"") && finding.message.contains("\"*af\""), "{}", finding.message);
    assert!(!finding.message.contains("[roles]\n"), "no lines to paste: {}", finding.message);
}

#[test]
fn a_pattern_that_matches_no_part_is_a_finding_with_the_names_that_there_are() {
    let base = Recipe::small().grow().base().clone();
    let roles = Roles { leaf: vec!["leaf".into(), "leafs".into()], ..Roles::default() };
    let analysis = find_with(&base, &roles);
    let found: Vec<&str> = analysis.findings.iter().map(|f| f.message.as_str()).collect();
    assert_eq!(codes(&analysis), ["ROLE-UNMATCHED"], "{found:?}");
    assert!(found[0].contains("roles.leaf = \"leafs\"") && found[0].contains("\"bark\""), "{found:?}");
}

#[test]
fn an_unsure_role_prints_the_lines_to_paste() {
    let triangle = Part {
        material_name: Some("Thing [1]".into()),
        positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y],
        triangles: vec![[0, 1, 2]],
        position_ids: vec![0, 1, 2],
        ..Part::default()
    };
    let base = Base { parts: vec![triangle], position_count: 3, ..Base::default() };
    let params = StructureParams { min_confidence: 1.0, ..StructureParams::default() };
    let analysis = analyze(&base, &Roles::default(), &params).unwrap();
    let finding = analysis.findings.iter().find(|f| f.code.starts_with("ROLE")).unwrap();
    let role = analysis.structure.roles[0];
    assert!(finding.message.contains("Thing ?1?"), "{}", finding.message);
    let pasted = Roles { leaf: vec!["Thing ?1?".into()], ..Roles::default() };
    assert_eq!(find_with(&base, &pasted).structure.roles, [Role::Leaf], "was {role}");
    assert!(explain(&analysis.parts).contains("\"Thing [1]\" (mesh 0, primitive 0; 1 triangles in 1 pieces)"));
}

#[test]
fn marks_on_a_trunk_are_wood() {
    let mut base = nameless();
    let trunk = base.parts[0].clone();
    // Every thirtieth triangle again, by vertices of its own over the trunk's positions.
    let vertices: Vec<u32> = trunk.triangles.iter().step_by(30).flatten().copied().collect();
    base.parts.push(Part {
        place: Place { mesh: 9, primitive: 0 },
        positions: vertices.iter().map(|&v| trunk.positions[v as usize]).collect(),
        position_ids: vertices.iter().map(|&v| trunk.position_ids[v as usize]).collect(),
        triangles: (0..vertices.len() as u32 / 3).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect(),
        ..Part::default()
    });
    let analysis = find(&base);
    assert_eq!(analysis.structure.roles[2], Role::Wood, "{}", explain(&analysis.parts));
}

#[test]
fn a_trunk_exported_as_triangle_soup_is_wood_all_the_same() {
    let mut base = nameless();
    for part in &mut base.parts {
        let corners: Vec<u32> = part.triangles.iter().flatten().copied().collect();
        part.positions = corners.iter().map(|&v| part.positions[v as usize]).collect();
        (part.uvs, part.normals) = (Vec::new(), Vec::new());
        part.triangles = (0..corners.len() as u32 / 3).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
    }
    let mut next = 0;
    for part in &mut base.parts {
        part.position_ids = (next..next + part.positions.len() as u32).collect();
        next += part.positions.len() as u32;
    }
    base.position_count = next;
    let analysis = find(&base);
    assert_eq!(analysis.structure.roles, [Role::Wood, Role::Leaf], "{}", explain(&analysis.parts));
    assert_eq!(analysis.structure.leaves.len(), find(&nameless()).structure.leaves.len());
}

#[test]
fn nothing_and_no_leaves_are_findings_not_errors() {
    for name in ["nothing", "wood-only"] {
        let sample = odd_plants().into_iter().find(|s| s.name == name).unwrap();
        let analysis = find(sample.plant.base());
        assert_eq!(codes(&analysis), ["LEAF-NONE"], "{name}");
        assert!(analysis.structure.leaves.is_empty() && analysis.layer.columns.is_empty());
    }
}

#[test]
fn pieces_without_area_are_counted() {
    let sample = odd_plants().into_iter().find(|s| s.name == "zero-area-piece").unwrap();
    let analysis = find(sample.plant.base());
    assert_eq!(codes(&analysis), ["IMPORT-DEGENERATE", "LEAF-ZERO-AREA"]);
    assert!(analysis.findings[1].message.starts_with("1 pieces"), "{:?}", analysis.findings);
}

#[test]
fn bad_input_is_refused_with_its_place() {
    let crown = odd_plants().into_iter().find(|s| s.name == "crown-volume").unwrap();
    let refuse = |base: &Base, roles: &Roles, params: &StructureParams| analyze(base, roles, params).unwrap_err();
    let base = crown.plant.base();
    let params = |crown_spacing_m| StructureParams { crown_spacing_m, ..StructureParams::default() };
    let none = Roles::default();
    for spacing in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = refuse(base, &none, &params(Some(spacing)));
        assert!(matches!(error, StructureError::Parameter { name: "crown_spacing_m", .. }), "{error}");
    }
    assert!(matches!(refuse(base, &none, &params(Some(1e-9))), StructureError::TooMany { .. }));
    let pattern = Roles { leaf: vec!["[".into()], ..Roles::default() };
    assert!(matches!(refuse(base, &pattern, &params(None)), StructureError::Pattern { role: "leaf", .. }));
    let mut broken = base.clone();
    broken.parts[0].triangles[0][1] = 1_000_000;
    assert!(matches!(refuse(&broken, &none, &params(None)), StructureError::Base(_)));
}

#[test]
fn a_given_spacing_decides_how_many_virtual_leaves_there_are() {
    let crown = odd_plants().into_iter().find(|s| s.name == "crown-volume").unwrap();
    let params = StructureParams { crown_spacing_m: Some(0.5), ..StructureParams::default() };
    let leaves = analyze(crown.plant.base(), &Roles::default(), &params).unwrap().structure.leaves;
    let area: f64 = leaves.iter().map(|l| f64::from(l.area)).sum();
    assert_eq!(leaves.len(), (area / 0.25).round() as usize);
}
