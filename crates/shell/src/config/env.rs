//! The environment as a source: `FOLIAR_DENSITY_RADIUS_M`.

use super::{Fields, Origin, Settings, from_text};
use crate::Failure;
use crate::config::fields::nearest;

/// Variables that start with `FOLIAR_` and are no parameters: where tests find and leave their files.
const OTHERS: [&str; 2] = ["FOLIAR_SHARED", "FOLIAR_TEST_OUTPUTS"];

/// What the environment gives.
///
/// # Errors
/// [`Failure::Usage`] for an unknown `FOLIAR_` name or a bad value.
pub fn from_environment(
    fields: &Fields,
    variables: impl Iterator<Item = (String, String)>,
) -> Result<Settings, Failure> {
    let mut settings = Settings::default();
    for (name, text) in variables.filter(|(name, _)| name.starts_with("FOLIAR_") && !OTHERS.contains(&name.as_str())) {
        let field = fields.all().iter().find(|field| field.env_name() == name);
        let field = field.ok_or_else(|| Failure::usage(unknown(fields, &name)))?;
        let value = from_text(field, &text).map_err(|e| Failure::usage(format!("environment {name}: {e}")))?;
        settings.set(field, value, Origin::Environment(name));
    }
    Ok(settings)
}

fn unknown(fields: &Fields, name: &str) -> String {
    let names: Vec<String> = fields.all().iter().map(super::Field::env_name).collect();
    format!("environment {name}: no such parameter{}", nearest(name, names.iter().map(String::as_str)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(name: &str, text: &str) -> Result<Settings, Failure> {
        from_environment(&Fields::new(&[]).unwrap(), [(name.to_owned(), text.to_owned())].into_iter())
    }

    #[test]
    fn a_parameter_is_taken_and_a_stranger_left_alone() {
        let settings = read("FOLIAR_IMPORT_UP", "z").unwrap();
        assert_eq!(settings.get("import.up").unwrap().origin, Origin::Environment("FOLIAR_IMPORT_UP".into()));
        assert!(!read("PATH", "z").unwrap().has_section("import"));
        assert!(read("FOLIAR_SHARED", "/tmp").is_ok());
    }

    #[test]
    fn an_unknown_name_and_a_bad_value_are_refused() {
        let error = read("FOLIAR_IMPORT_UPP", "z").unwrap_err().to_string();
        assert!(error.contains("did you mean FOLIAR_IMPORT_UP?"), "{error}");
        let error = read("FOLIAR_IMPORT_HEIGHT_M", "NaN").unwrap_err().to_string();
        assert!(error.starts_with("environment FOLIAR_IMPORT_HEIGHT_M: import.height_m = NaN"), "{error}");
    }
}
