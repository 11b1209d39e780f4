//! Values with their sources, merged: a later source is a stronger one. Every section is
//! deserialized once, and an error names the source of the value that it is about.

use super::Field;
use crate::Failure;
use serde::de::DeserializeOwned;
use serde_json::{Map, Value};
use std::collections::BTreeMap;
use std::fmt;
use std::path::PathBuf;

/// Where a value came from, weakest first.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Origin {
    /// What the scene implies, with the reason.
    Scene(String),
    /// A file, with the line.
    File(PathBuf, usize),
    /// The record of a layer in a master.
    Record(PathBuf),
    /// A variable of the environment.
    Environment(String),
    /// A flag, as it was typed.
    Flag(String),
}

impl Origin {
    /// The kind of source in one word.
    pub fn kind(&self) -> &'static str {
        match self {
            Origin::Scene(_) => "scene",
            Origin::File(..) => "file",
            Origin::Record(_) => "record",
            Origin::Environment(_) => "environment",
            Origin::Flag(_) => "flag",
        }
    }
}

impl fmt::Display for Origin {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Origin::Scene(because) => write!(f, "scene ({because})"),
            Origin::File(path, line) => write!(f, "{}:{line}", path.display()),
            Origin::Record(path) => write!(f, "record in {}", path.display()),
            Origin::Environment(name) => write!(f, "environment {name}"),
            Origin::Flag(flag) => write!(f, "flag {flag}"),
        }
    }
}

/// A value and where it came from.
#[derive(Clone, Debug, PartialEq)]
pub struct Given {
    /// The value; never null.
    pub value: Value,
    /// Its source.
    pub origin: Origin,
}

/// Everything that was given, by place with dots. What is not here has its default.
#[derive(Clone, Debug, Default)]
pub struct Settings {
    given: BTreeMap<String, Given>,
    /// Configuration files that were really read.
    pub files: Vec<PathBuf>,
}

impl Settings {
    /// Takes a value from a source that is stronger than all before it.
    pub fn set(&mut self, field: &Field, value: Value, origin: Origin) {
        if !value.is_null() {
            self.given.insert(field.dotted(), Given { value, origin });
        }
    }

    /// Takes everything of a stronger source.
    pub fn overlay(&mut self, stronger: Settings) {
        self.given.extend(stronger.given);
        self.files.extend(stronger.files);
    }

    /// Forgets a value that a stronger source rules out.
    pub fn remove(&mut self, dotted: &str) {
        self.given.remove(dotted);
    }

    /// What was given in this place.
    pub fn get(&self, dotted: &str) -> Option<&Given> {
        self.given.get(dotted)
    }

    /// Everything that was given whose place ends so, to be put otherwise.
    pub fn ending_mut<'a>(&'a mut self, ending: &'a str) -> impl Iterator<Item = (&'a str, &'a mut Given)> {
        let all = self.given.iter_mut().map(|(dotted, given)| (dotted.as_str(), given));
        all.filter(move |(dotted, _)| dotted.ends_with(ending))
    }

    /// The first that was given outside a section.
    pub fn outside(&self, section: &str) -> Option<&Given> {
        let inside = |dotted: &str| dotted.strip_prefix(section).is_some_and(|rest| rest.starts_with('.'));
        self.given.iter().find(|(dotted, _)| !inside(dotted)).map(|(_, given)| given)
    }

    /// Whether anything of a section was given.
    pub fn has_section(&self, section: &str) -> bool {
        self.section_values(section).next().is_some()
    }

    fn section_values<'a>(&'a self, section: &'a str) -> impl Iterator<Item = (&'a str, &'a Given)> {
        let inside = move |dotted: &'a str| dotted.strip_prefix(section)?.strip_prefix('.');
        self.given.iter().filter_map(move |(dotted, given)| Some((inside(dotted)?, given)))
    }

    /// What was given in a section, nested as the section is.
    pub fn given(&self, section: &str) -> Map<String, Value> {
        let mut object = Map::new();
        for (path, given) in self.section_values(section) {
            match path.split_once('.') {
                None => _ = object.insert(path.into(), given.value.clone()),
                Some((outer, inner)) => {
                    let slot = object.entry(outer).or_insert_with(|| Value::Object(Map::new()));
                    if let Some(nested) = slot.as_object_mut() {
                        nested.insert(inner.into(), given.value.clone());
                    }
                }
            }
        }
        object
    }

    /// A refusal that begins with the name of a parameter, behind the source of its value.
    pub fn refused(&self, error: impl std::fmt::Display) -> Failure {
        let text = error.to_string();
        let name = text.split(' ').next().unwrap_or_default();
        let source = self.get(name).map_or_else(String::new, |given| format!("{}: ", given.origin));
        Failure::usage(format!("{source}{text}"))
    }

    /// A section as its struct, defaults filled in.
    ///
    /// # Errors
    /// [`Failure::Usage`] with place and source of a value that the struct refuses.
    pub fn section<T: DeserializeOwned>(&self, section: &str) -> Result<T, Failure> {
        let value = Value::Object(self.given(section));
        serde_path_to_error::deserialize(value).map_err(|error| {
            let dotted = format!("{section}.{}", error.path());
            let source = self.get(&dotted).map_or_else(String::new, |given| format!("{}: ", given.origin));
            Failure::usage(format!("{source}{dotted}: {}", error.inner()))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::Fields;
    use foliar_schema::{Import, Scene, Up};

    fn set(settings: &mut Settings, name: &str, value: impl Into<Value>) {
        let fields = Fields::new(&[]).unwrap();
        settings.set(fields.find(name).unwrap(), value.into(), Origin::Flag("--test".into()));
    }

    #[test]
    fn defaults_agree_with_an_empty_section() {
        let none = Settings::default();
        assert_eq!(none.section::<Import>("import").unwrap(), Import::default());
        assert_eq!(none.section::<Scene>("scene").unwrap(), Scene::default());
    }

    #[test]
    fn the_stronger_source_wins_and_null_never_merges() {
        let mut settings = Settings::default();
        set(&mut settings, "import.up", "y");
        set(&mut settings, "import.up", "z");
        set(&mut settings, "import.up", Value::Null);
        assert_eq!(settings.section::<Import>("import").unwrap().up, Some(Up::Z));
    }

    #[test]
    fn nested_values_reach_their_place() {
        let mut settings = Settings::default();
        set(&mut settings, "scene.camera.nearest_m", 2.0);
        let scene: Scene = settings.section("scene").unwrap();
        assert!((scene.camera.nearest_m - 2.0).abs() < f64::EPSILON);
        assert_eq!(scene.camera.height_px, 1080);
    }

    #[test]
    fn what_the_struct_refuses_is_named_with_its_source() {
        let mut settings = Settings::default();
        set(&mut settings, "scene.camera.height_px", u64::MAX);
        let error = settings.section::<Scene>("scene").unwrap_err().to_string();
        assert!(error.starts_with("flag --test: scene.camera.height_px: "), "{error}");
    }
}
