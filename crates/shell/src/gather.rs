//! All sources in their order: project file, asset file, record, environment, flags.

use crate::commands::Call;
use crate::config::{Fields, Given, Settings, asset_file, from_file, project_file};
use crate::options::{Options, is_dash};
use crate::{Failure, flags::Direct};
use std::path::Path;

/// Parameters of which the stronger source rules the other out.
const RIVALS: [(&str, &str); 1] = [("import.unit", "import.height_m")];

/// Where values may come from, beside files.
pub struct Sources<'a> {
    /// All parameters.
    pub fields: &'a Fields,
    /// What the environment gives.
    pub environment: Settings,
    /// What the flags give.
    pub flags: Settings,
}

impl<'a> Sources<'a> {
    /// The environment of this process, and the flags.
    ///
    /// # Errors
    /// [`Failure::Usage`] from the flags.
    pub fn new(call: &Call<'a>, direct: Direct) -> Result<Sources<'a>, Failure> {
        let flags = crate::flags::given(call.fields, direct, call.matches)?;
        Ok(Sources { fields: call.fields, environment: call.environment.clone(), flags })
    }

    /// Everything given for one input, stronger over weaker. `record` is what a master says was given
    /// when it was baked: weaker than environment and flags, stronger than files.
    ///
    /// # Errors
    /// [`Failure::Usage`] with source and line.
    pub fn gather(&self, options: &Options, input: &Path, record: Settings) -> Result<Settings, Failure> {
        let mut all = Settings::default();
        for file in files(options, input) {
            overlay(&mut all, from_file(self.fields, &file)?)?;
        }
        overlay(&mut all, record)?;
        overlay(&mut all, self.environment.clone())?;
        overlay(&mut all, self.flags.clone())?;
        one_role_each(&all)?;
        Ok(all)
    }
}

fn files(options: &Options, input: &Path) -> Vec<std::path::PathBuf> {
    if options.no_config {
        return Vec::new();
    }
    let folder = if is_dash(input) { Path::new("") } else { input.parent().unwrap_or(Path::new("")) };
    let project = options.config.clone().or_else(|| project_file(folder));
    project.into_iter().chain(asset_file(input)).collect()
}

fn overlay(all: &mut Settings, stronger: Settings) -> Result<(), Failure> {
    for (one, other) in RIVALS {
        match (stronger.get(one), stronger.get(other)) {
            (Some(a), Some(b)) => {
                let text =
                    format!("{one} ({}) and {other} ({}) contradict each other: give one of them", a.origin, b.origin);
                return Err(Failure::usage(text));
            }
            (Some(_), None) => all.remove(other),
            (None, Some(_)) => all.remove(one),
            (None, None) => {}
        }
    }
    all.overlay(stronger);
    Ok(())
}

/// Refuses a pattern that stands in the lists of two roles.
fn one_role_each(all: &Settings) -> Result<(), Failure> {
    let mut seen: Vec<(String, &str, &Given)> = Vec::new();
    for name in ["roles.leaf", "roles.wood", "roles.other"] {
        let Some(given) = all.get(name) else { continue };
        for pattern in given.value.as_array().into_iter().flatten().filter_map(|entry| entry.as_str()) {
            // Patterns ignore case.
            let folded = pattern.to_lowercase();
            if let Some((_, other, by)) = seen.iter().find(|(text, other, _)| *text == folded && *other != name) {
                return Err(Failure::usage(format!(
                    "{pattern:?} stands in {other} ({}) and in {name} ({}): a part has one role: take it out of one of them",
                    by.origin, given.origin
                )));
            }
            seen.push((folded, name, given));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::{Origin, from_environment};
    use serde_json::Value;

    fn source(fields: &Fields, name: &str, value: &str) -> Settings {
        from_environment(fields, [(name.to_owned(), value.to_owned())].into_iter()).unwrap()
    }

    fn flags(fields: &Fields, name: &str, value: impl Into<Value>) -> Settings {
        let mut flags = Settings::default();
        flags.set(fields.find(name).unwrap(), value.into(), Origin::Flag("--test".into()));
        flags
    }

    #[test]
    fn a_flag_beats_the_environment_and_a_record() {
        let fields = Fields::new(&[]).unwrap();
        let options = Options { no_config: true, ..Options::default() };
        let environment = source(&fields, "FOLIAR_IMPORT_NODE", "environment");
        let gather = |environment: Settings, flags: Settings| {
            let sources = Sources { fields: &fields, environment, flags };
            let record = source(&fields, "FOLIAR_IMPORT_NODE", "record");
            let all = sources.gather(&options, Path::new("tree.obj"), record).unwrap();
            all.get("import.node").unwrap().value.clone()
        };
        assert_eq!(gather(Settings::default(), Settings::default()), "record");
        assert_eq!(gather(environment.clone(), Settings::default()), "environment");
        assert_eq!(gather(environment, flags(&fields, "import.node", "flag")), "flag");
    }

    #[test]
    fn the_stronger_of_two_rivals_stays_and_equals_are_refused() {
        let fields = Fields::new(&[]).unwrap();
        let mut all = source(&fields, "FOLIAR_IMPORT_UNIT", "cm");
        overlay(&mut all, flags(&fields, "import.height_m", 3.0)).unwrap();
        assert!(all.get("import.unit").is_none() && all.get("import.height_m").is_some());
        overlay(&mut all, source(&fields, "FOLIAR_IMPORT_UNIT", "cm")).unwrap();
        assert!(all.get("import.unit").is_some() && all.get("import.height_m").is_none());
        let mut both = source(&fields, "FOLIAR_IMPORT_UNIT", "cm");
        both.overlay(source(&fields, "FOLIAR_IMPORT_HEIGHT_M", "3"));
        let error = overlay(&mut Settings::default(), both).unwrap_err().to_string();
        assert!(error.contains("import.unit") && error.contains("import.height_m"), "{error}");
    }
}
