//! Findings that a project knows already, in a file: only what is new counts.

use foliar_schema::Finding;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::{Component, Path, PathBuf};

/// One known finding. Its words are left out: numbers in them change with every export.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Known {
    /// The file from the folder of the baseline on, with `/` between folders, so that a checkout elsewhere matches.
    file: String,
    code: String,
    #[serde(default, skip_serializing_if = "String::is_empty")]
    place: String,
}

impl Known {
    fn of(finding: &Finding, home: &Path) -> Self {
        Known {
            file: relative(finding.file.as_deref().unwrap_or_default(), home),
            code: finding.code.clone(),
            place: finding.place.clone().unwrap_or_default(),
        }
    }
}

/// A path from a folder on; as it stands where nothing leads there, as from one drive to another.
fn relative(file: &str, home: &Path) -> String {
    let file = file.replace('\\', "/");
    let (to, from) = (plain(Path::new(&file)), plain(home));
    let shared = to.components().zip(from.components()).take_while(|(a, b)| a == b).count();
    if shared == 0 {
        return file;
    }
    let up = from.components().skip(shared).map(|_| "..".to_owned());
    let down = to.components().skip(shared).map(|part| part.as_os_str().to_string_lossy().into_owned());
    up.chain(down).collect::<Vec<_>>().join("/")
}

/// An absolute path without `.` and `..`.
fn plain(path: &Path) -> PathBuf {
    let whole = std::path::absolute(path).unwrap_or_else(|_| path.to_path_buf());
    whole.components().fold(PathBuf::new(), |mut plain, part| {
        match part {
            Component::ParentDir => _ = plain.pop(),
            Component::CurDir => {}
            part => plain.push(part),
        }
        plain
    })
}

/// Known findings, each as often as it is known.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Baseline(BTreeMap<Known, usize>);

impl Baseline {
    /// A baseline of all these findings, to be kept in the folder `home`.
    pub fn of<'a>(findings: impl IntoIterator<Item = &'a Finding>, home: &Path) -> Self {
        let mut known = BTreeMap::new();
        findings.into_iter().for_each(|finding| *known.entry(Known::of(finding, home)).or_default() += 1);
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

    /// The findings that are new, and how many are known; the baseline lies in the folder `home`.
    pub fn filter(&self, findings: Vec<Finding>, home: &Path) -> (Vec<Finding>, usize) {
        let mut left = self.0.clone();
        let total = findings.len();
        let is_new = |finding: &Finding| match left.get_mut(&Known::of(finding, home)) {
            Some(times) if *times > 0 => {
                *times -= 1;
                false
            }
            _ => true,
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
        let baseline = Baseline::of(&[finding("/a", "/a/repo/x/tree.glb")], Path::new("/a/repo/ci"));
        let again = Baseline::parse(&baseline.to_text()).unwrap();
        assert_eq!(again, baseline);
        assert!(baseline.to_text().contains("\"../x/tree.glb\""), "{}", baseline.to_text());
        // Another checkout, whichever way the file is named there.
        let home = Path::new("/build/repo/ci");
        let [whole, turning] = ["/build/repo/x/tree.glb", "/build/repo/ci/../y/../x/./tree.glb"];
        for file in [whole, turning] {
            let (new, known) = again.filter(vec![finding("/a", file), finding("/a", file), finding("/b", file)], home);
            assert_eq!((new.len(), known), (2, 1), "{new:?}");
        }
        // Another folder is another tree, and so is a longer name.
        let others = ["/build/repo/y/tree.glb", "/build/repo/x/old-tree.glb", "/build/tree.glb"];
        let (new, known) = again.filter(others.map(|file| finding("/a", file)).into(), home);
        assert_eq!((new.len(), known), (3, 0), "{new:?}");
        assert!(Baseline::parse("{}").unwrap_err().contains("--write-baseline"));
        assert_eq!(Baseline::parse(&Baseline::default().to_text()), Ok(Baseline::default()));
    }
}
