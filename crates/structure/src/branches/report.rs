//! What a person should know of branches: every one with its numbers for machines, the doubtful ones by name.

use super::{BranchReport, Found, RootKind};
use foliar_bake::BranchFacts;
use foliar_plant::{Base, LEVELS, NO_BRANCH, Plant};
use foliar_schema::{CodeInfo, Finding, code};
use serde_json::{Value, json};

/// Costs that differ by less say nothing: the step itself moves a branch to its grandparent for so much.
const LOW_MARGIN: f64 = 0.06;
/// From this share of split rings on a piece is told to be fused; tubes that bend sharply stay below.
pub(super) const FUSED: f64 = 0.1;
/// Branches that a finding names; the report holds all.
const NAMED: usize = 5;

/// What is doubtful.
pub fn findings(found: &Found, base: &Base) -> Vec<Finding> {
    let parts = parts(found, base);
    let ids = |holds: &dyn Fn(usize, &BranchReport) -> bool| -> Vec<usize> {
        (0..found.reports.len()).filter(|&id| holds(id, &found.reports[id])).collect()
    };
    let mut unsure = ids(&|id, report| is_unsure(found, id, report));
    unsure.sort_by(|&a, &b| found.reports[a].margin.total_cmp(&found.reports[b].margin).then(a.cmp(&b)));
    let islands = ids(&|_, report| report.kind == RootKind::Island);
    let fused = ids(&|_, report| report.split >= FUSED);
    let deep = ids(&|id, _| found.branches.rows[id].level as usize >= LEVELS);
    [
        (&code::BRANCH_FUSED, fused, "fork in one piece"),
        (&code::BRANCH_ISLAND, islands, "hang on nothing and stand on no ground"),
        (&code::BRANCH_LEVELS, deep, "lie beyond the fourth level"),
        (&code::BRANCH_UNSURE, unsure, "might as well hang elsewhere"),
    ]
    .into_iter()
    .filter(|(_, ids, _)| !ids.is_empty())
    .map(|(info, ids, what)| finding(info, &ids, what, found, &parts))
    .collect()
}

/// Whether the second-best parent is as good. A root has no parent to doubt.
fn is_unsure(found: &Found, id: usize, report: &BranchReport) -> bool {
    report.margin < LOW_MARGIN && found.branches.rows[id].parent != NO_BRANCH
}

fn finding(info: &CodeInfo, ids: &[usize], what: &str, found: &Found, parts: &[Option<&str>]) -> Finding {
    let one = |&id: &usize| {
        let (row, report) = (&found.branches.rows[id], &found.reports[id]);
        let [x, y, z] = row.pivot.to_array();
        let part = parts[id].map_or(String::new(), |part| format!(" of {part:?}"));
        let sure = if is_unsure(found, id, report) { format!(", margin {:.3}", report.margin) } else { String::new() };
        format!("branch {id}{part} at ({x:.3}, {y:.3}, {z:.3}) m{sure}")
    };
    let named: Vec<String> = ids.iter().take(NAMED).map(one).collect();
    let rest = ids.len().saturating_sub(NAMED);
    let rest = if rest > 0 { format!("; and {rest} more, see --report") } else { String::new() };
    let text = format!("{} of {} branches {what}: {}{rest}", ids.len(), found.reports.len(), named.join("; "));
    Finding::new(info, text)
}

/// Name of the part that each branch's first vertex belongs to.
fn parts<'a>(found: &Found, base: &'a Base) -> Vec<Option<&'a str>> {
    let mut names = vec![None; found.reports.len()];
    for (part, list) in base.parts.iter().zip(&found.branches.vertices) {
        for place in list.iter().filter(|place| place.branch != NO_BRANCH) {
            names[place.branch as usize].get_or_insert(part.name());
        }
    }
    names
}

/// Every branch, and what can be said of all without knowing the truth.
pub fn report(found: &Found, plant: &Plant) -> Value {
    let parts = parts(found, plant.base());
    let facts = BranchFacts::of(&found.branches);
    let rows = &found.branches.rows;
    let mut levels = vec![0usize; facts.levels];
    rows.iter().for_each(|row| levels[row.level as usize] += 1);
    let one = |(id, report): (usize, &BranchReport)| {
        let row = &rows[id];
        json!({
            "branch": id,
            "part": parts[id],
            "parent": if row.parent == NO_BRANCH { Value::Null } else { row.parent.into() },
            "level": row.level,
            "kind": report.kind.name(),
            "pivot_m": row.pivot.to_array(),
            "length_m": row.length,
            "radius_m": row.radius,
            "cost": report.cost,
            "margin": row.margin,
            "gap": report.gap,
            "roughness": report.roughness,
            "split": report.split,
            "tubes": report.tubes,
        })
    };
    let of_kind = |kind| (0..rows.len()).filter(|&id| found.reports[id].kind == kind).collect::<Vec<_>>();
    json!({
        "count": rows.len(),
        "levels": levels,
        "beyondFourLevels": levels.iter().skip(LEVELS).sum::<usize>(),
        "longest_m": facts.longest_m,
        "stems": of_kind(RootKind::Stem),
        "islands": of_kind(RootKind::Island),
        "metrics": metrics(found, plant),
        "branches": found.reports.iter().enumerate().map(one).collect::<Vec<_>>(),
    })
}

/// Figures that need no truth, each as median, 99th percentile and greatest.
fn metrics(found: &Found, plant: &Plant) -> Value {
    let of = |get: &dyn Fn(&BranchReport) -> f64| quantiles(found.reports.iter().map(get).collect());
    let rows = &found.branches.rows;
    let unsure = (0..rows.len()).filter(|&id| is_unsure(found, id, &found.reports[id])).count();
    let hidden = |id: usize| {
        let length = found.branches.axes[id].length();
        if length > 0.0 { found.branches.attachments[id].bark_arc / length } else { 0.0 }
    };
    json!({
        "gapInRadii": of(&|r| r.gap),
        "roughness": of(&|r| r.roughness),
        "split": of(&|r| r.split),
        "hiddenInParent": quantiles((0..rows.len()).filter(|&id| rows[id].parent != NO_BRANCH).map(hidden).collect()),
        "unsure": unsure,
        "unhungLeaves": found.branches.leaves.iter().filter(|place| place.branch == NO_BRANCH).count(),
        "leafReachInLeafSizes": quantiles(leaf_reaches(found, plant)),
    })
}

/// From each leaf's petiole to the bark of its branch, in sizes of the leaf (the root of its area).
fn leaf_reaches(found: &Found, plant: &Plant) -> Vec<f64> {
    let leaves = plant.leaves().iter().zip(&found.branches.leaves);
    let reach = |(leaf, place): (&foliar_plant::Leaf, &foliar_plant::OnBranch)| {
        let axis = found.branches.axes.get(place.branch as usize)?;
        let spot = axis.at(place.arc.into());
        let size = f64::from(leaf.area).sqrt();
        (size > 0.0).then(|| (spot.point.distance(leaf.petiole.as_dvec3()) - spot.radius).max(0.0) / size)
    };
    leaves.filter_map(reach).collect()
}

fn quantiles(mut values: Vec<f64>) -> Value {
    values.sort_by(f64::total_cmp);
    let at = |share: f64| values.get(((values.len().max(1) - 1) as f64 * share).round() as usize);
    json!({ "p50": at(0.5), "p99": at(0.99), "max": values.last() })
}

#[cfg(test)]
mod tests {
    use super::*;
    use foliar_plant::{Axis, Branches, Leaf, OnBranch, Part, Stalk, Structure};
    use foliar_schema::Role;
    use glam::{DVec3, Vec3};

    /// Six branches in a row, one vertex each, and a leaf of a hundredth of a square meter half a meter off the last.
    fn row() -> (Found, Plant) {
        let axis = |b: f64| Axis::new(vec![DVec3::new(b, 1.0, 0.0), DVec3::new(b + 1.0, 1.0, 0.0)], vec![0.1, 0.1]);
        let stalk =
            |b: u32| Stalk { parent: b.checked_sub(1), axis: axis(f64::from(b)), margin: 1.0, first_vertex: b.into() };
        let (mut branches, _) = Branches::grow((0..6).map(stalk).collect());
        branches.vertices = vec![(0..6).map(|branch| OnBranch { branch, arc: 0.0 }).collect()];
        branches.leaves = vec![OnBranch { branch: 5, arc: 0.5 }];
        let part = Part {
            object_name: Some("bark".into()),
            positions: (0..6).map(|b| Vec3::new(b as f32, 1.0, 0.0)).collect(),
            position_ids: (0..6).collect(),
            ..Part::default()
        };
        let leaf = Leaf { petiole: Vec3::new(5.5, 1.6, 0.0), area: 0.01, ..Leaf::default() };
        let structure = Structure { roles: vec![Role::Wood], leaves: vec![leaf], leaf_ids: vec![Vec::new()] };
        let base = Base { parts: vec![part], position_count: 6, ..Base::default() };
        let reports = vec![BranchReport { margin: 1.0, ..BranchReport::default() }; 6];
        (Found { branches, reports }, Plant::new(base, structure).unwrap())
    }

    #[test]
    fn doubtful_branches_are_named_with_place_and_part() {
        let (mut found, plant) = row();
        assert_eq!(
            findings(&found, plant.base()).iter().map(|f| f.code.as_str()).collect::<Vec<_>>(),
            ["BRANCH-LEVELS"]
        );
        found.reports[0] = BranchReport { kind: RootKind::Island, margin: 0.0, split: 0.5, ..found.reports[0] };
        found.reports[2].margin = 0.03;
        found.reports[3].margin = 0.01;
        let all = findings(&found, plant.base());
        let said: Vec<(&str, &str)> = all.iter().map(|f| (f.code.as_str(), f.message.as_str())).collect();
        assert_eq!(
            said[0],
            ("BRANCH-FUSED", "1 of 6 branches fork in one piece: branch 0 of \"bark\" at (0.000, 1.000, 0.000) m")
        );
        assert_eq!(said[1].0, "BRANCH-ISLAND");
        assert!(
            said[2].0 == "BRANCH-LEVELS"
                && said[2].1.starts_with("2 of 6 branches lie beyond the fourth level: branch 4")
        );
        // The least sure first; a root has no parent to doubt.
        assert!(
            said[3].1.starts_with("2 of 6 branches might as well hang elsewhere: branch 3 of \"bark\" at ("),
            "{said:?}"
        );
        assert!(said[3].1.contains("margin 0.010; branch 2"), "{said:?}");
    }

    #[test]
    fn the_report_holds_every_branch_and_figures_of_all() {
        let (mut found, plant) = row();
        found.reports[5].gap = 2.0;
        let told = report(&found, &plant);
        assert_eq!((&told["levels"], &told["beyondFourLevels"]), (&json!([1, 1, 1, 1, 1, 1]), &json!(2)));
        assert_eq!(told["branches"][5]["parent"], 4);
        assert_eq!((&told["branches"][0]["parent"], &told["branches"][0]["part"]), (&Value::Null, &json!("bark")));
        assert_eq!(
            (&told["metrics"]["gapInRadii"]["p50"], &told["metrics"]["gapInRadii"]["max"]),
            (&json!(0.0), &json!(2.0))
        );
        // Half a meter of air, a tenth of a meter of leaf.
        let reach = told["metrics"]["leafReachInLeafSizes"]["max"].as_f64().unwrap();
        assert!((reach - 5.0).abs() < 1e-5, "{reach}");
    }
}
