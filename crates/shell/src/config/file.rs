//! Configuration files: `foliar.toml` of the project, `tree.foliar.toml` of an asset. Each value
//! keeps its line; paths in a file start from the file's folder.

use super::{Field, Fields, Origin, Settings, from_json};
use crate::{Failure, neighbors};
use serde_json::Value;
use std::io::ErrorKind;
use std::ops::Range;
use std::path::{Path, PathBuf};
use toml::de::{DeArray, DeTable, DeValue};

/// Fields that hold paths, and what stands before (`=`) or after (`@`) the path in each entry.
const PATHS: [(&str, Option<char>); 3] =
    [("import.search", None), ("import.texture", Some('=')), (neighbors::ENDING, Some('@'))];

/// The project's file: `foliar.toml` in the input's folder or the nearest above it.
pub fn project_file(folder: &Path) -> Option<PathBuf> {
    let folder = std::path::absolute(if folder.as_os_str().is_empty() { Path::new(".") } else { folder }).ok()?;
    folder.ancestors().map(|above| above.join("foliar.toml")).find(|file| file.is_file())
}

/// The asset's own file, where there is one: `birch.foliar.toml` beside `birch.obj`.
pub fn asset_file(input: &Path) -> Option<PathBuf> {
    let stem = input.file_stem()?.to_str()?;
    let file = input.with_file_name(format!("{stem}.foliar.toml"));
    file.is_file().then_some(file)
}

/// What a file gives.
///
/// # Errors
/// [`Failure::Usage`] with file and line: no TOML, an unknown key, a bad value.
pub fn from_file(fields: &Fields, path: &Path) -> Result<Settings, Failure> {
    let unreadable = |e: std::io::Error| {
        let remedy = if e.kind() == ErrorKind::InvalidData { "save it as UTF-8" } else { "name a TOML file" };
        Failure::usage(format!("{}: cannot be read: {e}: {remedy}", path.display()))
    };
    let text = std::fs::read_to_string(path).map_err(unreadable)?;
    let mut settings = from_toml(fields, path, &text)?;
    settings.files.push(path.to_path_buf());
    Ok(settings)
}

/// What the text of a file gives; `path` stands in messages, and its paths start from there.
///
/// # Errors
/// As [`from_file`].
pub fn from_toml(fields: &Fields, path: &Path, text: &str) -> Result<Settings, Failure> {
    let reader = Reader { fields, path, text };
    let table = DeTable::parse(text).map_err(|error| {
        let place = error.span().unwrap_or_default();
        reader.failure(&place, format!("no TOML: {}", error.message()))
    })?;
    let mut settings = Settings::default();
    reader.table(table.get_ref(), "", &mut settings)?;
    Ok(settings)
}

struct Reader<'a> {
    fields: &'a Fields,
    path: &'a Path,
    text: &'a str,
}

impl Reader<'_> {
    fn table(&self, table: &DeTable, prefix: &str, settings: &mut Settings) -> Result<(), Failure> {
        for (key, value) in table {
            let dotted =
                if prefix.is_empty() { key.get_ref().to_string() } else { format!("{prefix}.{}", key.get_ref()) };
            let is_group = self.fields.all().iter().any(|field| field.dotted().starts_with(&format!("{dotted}.")));
            match value.get_ref() {
                DeValue::Table(inner) if is_group => self.table(inner, &dotted, settings)?,
                other => self.value(other, &value.span(), &key.span(), &dotted, settings)?,
            }
        }
        Ok(())
    }

    fn value(
        &self,
        value: &DeValue,
        place: &Range<usize>,
        key: &Range<usize>,
        dotted: &str,
        settings: &mut Settings,
    ) -> Result<(), Failure> {
        let field = self.fields.find(dotted).map_err(|e| self.failure(key, e))?;
        let value = json(value).map_err(|e| self.failure(place, format!("{dotted} = {e}")))?;
        let value = from_json(field, &value).map_err(|e| self.failure(place, e))?;
        let origin = Origin::File(self.path.to_path_buf(), self.line(key));
        settings.set(field, self.rebase(field, dotted, value), origin);
        Ok(())
    }

    /// Paths in a file start from the file's folder.
    fn rebase(&self, field: &Field, dotted: &str, value: Value) -> Value {
        let known = PATHS.iter().find(|(name, _)| dotted.ends_with(name)).map(|(_, separator)| *separator);
        let Some(separator) = known.or_else(|| field.map.as_ref().map(|_| Some('='))) else { return value };
        let folder = self.path.parent().unwrap_or(Path::new(""));
        let joined = |path: &str| folder.join(path).display().to_string();
        let entry = |text: &str| match separator {
            Some('@') => text.rsplit_once('@').map(|(file, place)| format!("{}@{place}", joined(file))),
            Some(c) => text.split_once(c).map(|(part, file)| format!("{part}={}", joined(file))),
            None => None,
        };
        let entry = |text: &str| entry(text).unwrap_or_else(|| joined(text));
        value.as_array().into_iter().flatten().filter_map(Value::as_str).map(entry).collect()
    }

    fn line(&self, place: &Range<usize>) -> usize {
        1 + self.text.get(..place.start).unwrap_or(self.text).matches('\n').count()
    }

    fn failure(&self, place: &Range<usize>, reason: String) -> Failure {
        Failure::usage(format!("{}:{}: {reason}", self.path.display(), self.line(place)))
    }
}

/// A TOML value as JSON; numbers that JSON has not are refused.
fn json(value: &DeValue) -> Result<Value, String> {
    match value {
        DeValue::String(text) => Ok(text.as_ref().into()),
        DeValue::Boolean(yes) => Ok((*yes).into()),
        DeValue::Integer(number) => i64::from_str_radix(number.as_str(), number.radix())
            .map(Value::from)
            .map_err(|_| format!("{number}: must be a whole number of at most 64 bits")),
        DeValue::Float(number) => number
            .as_str()
            .parse()
            .ok()
            .and_then(serde_json::Number::from_f64)
            .map(Value::Number)
            .ok_or_else(|| format!("{number}: must be a finite number")),
        DeValue::Array(items) => array(items),
        DeValue::Datetime(date) => Err(format!("{date}: no parameter is a date")),
        DeValue::Table(_) => Err("{ ... }: must be a single value, not a table".into()),
    }
}

fn array(items: &DeArray) -> Result<Value, String> {
    items.iter().map(|item| json(item.get_ref())).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Settings, Failure> {
        from_toml(&Fields::new(&[]).unwrap(), Path::new("assets/foliar.toml"), text)
    }

    fn error(text: &str) -> String {
        read(text).unwrap_err().to_string()
    }

    #[test]
    fn values_keep_their_lines() {
        let settings = read("[import]\nup = 'z'\n\n[scene.camera]\n# near\nnearest_m = 2\n").unwrap();
        let given = settings.get("scene.camera.nearest_m").unwrap();
        assert_eq!(given.value, 2.0);
        assert_eq!(given.origin.to_string(), "assets/foliar.toml:6");
    }

    #[test]
    fn errors_name_file_line_and_remedy() {
        assert_eq!(
            error("[import]\nupp = 'z'"),
            "assets/foliar.toml:2: import.upp: no such parameter; did you mean import.up?"
        );
        assert!(
            error("[import]\nup = 'x'").starts_with("assets/foliar.toml:2: import.up = \"x\": must be one of y, z")
        );
        assert!(
            error("[import]\nheight_m = nan")
                .starts_with("assets/foliar.toml:2: import.height_m = nan: must be a finite")
        );
        assert!(
            error("[import]\n\nheight_m = -1")
                .starts_with("assets/foliar.toml:3: import.height_m = -1: must be above 0")
        );
        assert!(error("[import\n").starts_with("assets/foliar.toml:1: no TOML: "));
        assert!(error("[fall]\nlevels = 2").contains("fall: not in this version"));
        assert!(error("up = 'z'").starts_with("assets/foliar.toml:1: up: no such parameter"));
        assert!(error("import = 3").starts_with("assets/foliar.toml:1: import: no such parameter"));
        assert!(error("[import]\nup = { a = 1 }").contains("must be a single value"));
    }

    #[test]
    fn paths_start_from_the_folder_of_the_file() {
        let settings = read("[import]\nsearch = ['maps']\ntexture = ['leaf=maps/a.png']").unwrap();
        assert_eq!(settings.get("import.search").unwrap().value, serde_json::json!(["assets/maps"]));
        assert_eq!(settings.get("import.texture").unwrap().value, serde_json::json!(["leaf=assets/maps/a.png"]));
    }
}
