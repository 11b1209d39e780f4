//! Findings that a project knows already, in a file: only what is new counts.

use foliar_schema::Finding;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// One known finding. Its words are left out: numbers in them change with every export.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Known {
    /// The file as it was named, with `/` between folders.
    file: String,
    code: String,
    #[serde(default, skip_serializing_if = "String::is_empty")]
    place: String,
}

impl Known {
    fn of(finding: &Finding) -> Self {
        let file = finding.file.as_deref().unwrap_or_default();
        Known {
            file: file.replace('\\', "/").trim_start_matches("./").to_owned(),
            code: finding.code.clone(),
            place: finding.place.clone().unwrap_or_default(),
        }
    }
}

impl Known {
    /// Whether it is the same finding, of a checkout that may lie elsewhere: one path must be the end of the other.
    fn is(&self, other: &Known) -> bool {
        let ends =
            |long: &str, end: &str| long.strip_suffix(end).is_some_and(|rest| rest.is_empty() || rest.ends_with('/'));
        let same = ends(&self.file, &other.file) || ends(&other.file, &self.file);
        same && self.code == other.code && self.place == other.place
    }
}

/// Known findings, each as often as it is known.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Baseline(BTreeMap<Known, usize>);

impl Baseline {
    /// A baseline of all these findings.
    pub fn of<'a>(findings: impl IntoIterator<Item = &'a Finding>) -> Self {
        let mut known = BTreeMap::new();
        findings.into_iter().for_each(|finding| *known.entry(Known::of(finding)).or_default() += 1);
        Baseline(known)
    }

    /// Reads a baseline file.
    ///
    /// # Errors
    /// A sentence with the place.
    pub fn parse(text: &str) -> Result<Self, String> {
        let list: Vec<Known> = serde_json::from_str(text)
            .map_err(|e| format!("no baseline ({e}): write one with foliar-check --write-baseline"))?;
        let mut known = BTreeMap::new();
        list.into_iter().for_each(|one| *known.entry(one).or_default() += 1);
        Ok(Baseline(known))
    }

    /// The file: sorted, so that it can be kept under version control.
    pub fn to_text(&self) -> String {
        let list: Vec<&Known> = self.0.iter().flat_map(|(known, times)| std::iter::repeat_n(known, *times)).collect();
        let lines: Vec<String> = list.iter().filter_map(|known| serde_json::to_string(known).ok()).collect();
        if lines.is_empty() { "[]\n".into() } else { format!("[\n  {}\n]\n", lines.join(",\n  ")) }
    }

    /// The findings that are new, and how many are known.
    pub fn filter(&self, findings: Vec<Finding>) -> (Vec<Finding>, usize) {
        let mut left = self.0.clone();
        let total = findings.len();
        let is_new = |finding: &Finding| {
            let own = Known::of(finding);
            let times = left.iter_mut().find(|(known, times)| **times > 0 && known.is(&own)).map(|(_, times)| times);
            times.map(|times| *times -= 1).is_none()
        };
        let new: Vec<Finding> = findings.into_iter().filter(is_new).collect();
        let known = total - new.len();
        (new, known)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use foliar_schema::code;

    fn finding(place: &str, file: &str) -> Finding {
        Finding::new(&code::GEOMETRY_UNUSED, format!("7 at {place}")).at(place).in_file(file)
    }

    #[test]
    fn what_is_known_is_left_out_as_often_as_it_is_known() {
        let baseline = Baseline::of(&[finding("/a", "x/tree.glb")]);
        let again = Baseline::parse(&baseline.to_text()).unwrap();
        assert_eq!(again, baseline);
        let (new, known) =
            again.filter(vec![finding("/a", "/c/x/tree.glb"), finding("/a", "tree.glb"), finding("/b", "x/tree.glb")]);
        assert_eq!((new.len(), known), (2, 1), "{new:?}");
        // Another folder is another tree, and so is a longer name.
        let (new, known) = again.filter(vec![finding("/a", "y/tree.glb"), finding("/a", "x/old-tree.glb")]);
        assert_eq!((new.len(), known), (2, 0), "{new:?}");
        assert_eq!(again.filter(vec![finding("/a", ".\\x\\tree.glb")]).1, 1);
        assert!(Baseline::parse("{}").unwrap_err().contains("--write-baseline"));
        assert_eq!(Baseline::parse(&Baseline::default().to_text()), Ok(Baseline::default()));
    }
}
