//! Finding and reading the material libraries of an OBJ.

use super::file::{Library, ObjFile};
use super::mtl::{Contents, Material, parse_mtl};
use super::scan::Oddity;
use crate::{CarrierError, paths};
use foliar_schema::{Finding, Import, code};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// What helps where a file beside the asset is missing.
pub(crate) const BESIDE: &str = "put it beside the asset, or name its folder with --search";

/// The asset that is being read: what messages call it, and where its files lie.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Source<'a> {
    /// Name in messages.
    pub name: &'a str,
    /// Folder of the OBJ.
    pub folder: &'a Path,
    /// Options of the import.
    pub import: &'a Import,
}

/// A material and the library that it stands in.
#[derive(Clone, Debug, Default)]
pub(crate) struct Defined {
    /// What the library says.
    pub material: Material,
    /// Path of the library.
    pub library: PathBuf,
}

/// All materials of all libraries.
#[derive(Debug, Default)]
pub(crate) struct Libraries {
    /// By name; the first definition counts, as libraries are searched in their order.
    pub materials: BTreeMap<String, Defined>,
    /// Libraries that were read.
    pub files: Vec<PathBuf>,
    /// What was noticed.
    pub findings: Vec<Finding>,
}

/// Reads every library that the OBJ names, each file once.
pub(crate) fn read(file: &ObjFile, source: &Source) -> Result<Libraries, CarrierError> {
    let mut all = Libraries::default();
    for library in &file.libraries {
        for path in candidates(library, source)? {
            all.add(&path, library, source)?;
        }
    }
    all.report_missing(file, source);
    Ok(all)
}

/// The files that a `mtllib` line names: the whole rest of the line where such a file exists (names
/// have blanks), else each name that ends in .mtl, else each word.
fn candidates(library: &Library, source: &Source) -> Result<Vec<PathBuf>, CarrierError> {
    let place = format!("line {}", library.line);
    let find = |name: &str| paths::resolve_at(name, source.folder, &source.import.search, source.name, &place);
    let whole = find(&library.name)?;
    let names = split_names(&library.name);
    if whole.is_file() || names.len() < 2 {
        return Ok(vec![whole]);
    }
    names.iter().map(|name| find(name)).collect()
}

/// Splits behind every `.mtl` that a blank follows; without any, at blanks.
fn split_names(line: &str) -> Vec<String> {
    let mut names = Vec::new();
    let mut open: Vec<&str> = Vec::new();
    for word in line.split_whitespace() {
        open.push(word);
        if word.to_ascii_lowercase().ends_with(".mtl") {
            names.push(open.join(" "));
            open.clear();
        }
    }
    names.extend(open.into_iter().map(str::to_string));
    names
}

impl Libraries {
    fn add(&mut self, path: &Path, library: &Library, source: &Source) -> Result<(), CarrierError> {
        if self.files.iter().any(|known| known == path) {
            return Ok(());
        }
        let missing = |why: String| {
            let message = format!("material library {:?} {why}; plain materials stand in", path.display());
            Finding::new(&code::IMPORT_MTL, message).at(format!("line {}", library.line)).in_file(source.name)
        };
        if !path.is_file() {
            self.findings.push(missing(format!("is missing: {BESIDE}")));
            return Ok(());
        }
        let bytes = match std::fs::read(path) {
            Ok(bytes) => bytes,
            Err(error) => {
                self.findings.push(missing(format!("cannot be read ({error}): make it readable")));
                return Ok(());
            }
        };
        self.files.push(path.to_path_buf());
        let Contents { materials, nested } = parse_mtl(&bytes, &path.display().to_string())?;
        if materials.is_empty() {
            self.findings.push(missing("defines no material: export it again".into()));
        }
        for (name, line) in nested {
            let message = format!("a library cannot name another: {name:?} is not read from here; name it in the OBJ");
            let file = path.display().to_string();
            self.findings.push(Finding::new(&code::IMPORT_MTL, message).at(format!("line {line}")).in_file(file));
        }
        for material in materials {
            self.report_unknown(&material, path);
            let name = material.name.clone();
            self.materials.entry(name).or_insert(Defined { material, library: path.to_path_buf() });
        }
        Ok(())
    }

    fn report_unknown(&mut self, material: &Material, path: &Path) {
        if !material.unknown.is_empty() {
            let keys: Vec<_> = material.unknown.iter().map(|(key, value)| format!("{key} {value}")).collect();
            let message = format!("material {:?} has keys without a meaning here: {}", material.name, keys.join(", "));
            let place = format!("line {}", material.line);
            let file = path.display().to_string();
            self.findings.push(Finding::new(&code::IMPORT_IGNORED, message).at(place).in_file(file));
        }
    }

    fn report_missing(&mut self, file: &ObjFile, source: &Source) {
        let missing: Vec<&str> =
            file.materials.iter().filter(|m| !self.materials.contains_key(*m)).map(String::as_str).collect();
        if !missing.is_empty() {
            let why =
                if file.libraries.is_empty() { "the file names no material library" } else { "no library has them" };
            let message = format!("materials {missing:?} are not defined: {why}; plain materials stand in");
            self.findings.push(Finding::new(&code::IMPORT_MTL, message).in_file(source.name));
        }
        let latin1 = file.tally(Oddity::Latin1);
        if latin1.count > 0 {
            let message = format!("names such as {:?} are no UTF-8 and were read as Latin-1", latin1.example);
            let place = format!("line {}", latin1.line);
            self.findings.push(Finding::new(&code::IMPORT_ENCODING, message).at(place).in_file(source.name));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn several_libraries_and_names_with_blanks_are_told_apart() {
        assert_eq!(split_names("a.mtl b.mtl"), ["a.mtl", "b.mtl"]);
        assert_eq!(split_names("my tree.mtl other.MTL"), ["my tree.mtl", "other.MTL"]);
        assert_eq!(split_names("a b"), ["a", "b"]);
    }
}
