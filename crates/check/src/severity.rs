//! How serious a code is in one project: entries `CODE=off|note|warning|error` of section `check`.

use crate::CheckError;
use foliar_schema::{CODES, Finding, Severity};
use std::collections::BTreeMap;

/// Codes whose severity was set; `None` turns one off.
pub(crate) struct Overrides(BTreeMap<&'static str, Option<Severity>>);

impl Overrides {
    /// Reads the entries; commas separate several in one.
    pub fn new(entries: &[String]) -> Result<Self, CheckError> {
        let entries = entries.iter().flat_map(|entry| entry.split(',')).map(str::trim).filter(|e| !e.is_empty());
        entries.map(one).collect::<Result<_, _>>().map(Overrides)
    }

    /// The findings as they count here.
    pub fn apply(&self, findings: Vec<Finding>) -> Vec<Finding> {
        let judged = |mut finding: Finding| match self.0.get(finding.code.as_str()) {
            Some(None) => None,
            Some(Some(severity)) => {
                finding.severity = *severity;
                Some(finding)
            }
            None => Some(finding),
        };
        findings.into_iter().filter_map(judged).collect()
    }
}

fn one(entry: &str) -> Result<(&'static str, Option<Severity>), CheckError> {
    let fail = |what: String| CheckError::Setting(format!("check.severity = {entry:?}: {what}"));
    let (name, word) = entry.split_once('=').ok_or_else(|| fail("must be CODE=off|note|warning|error".into()))?;
    let info = CODES.iter().find(|info| info.code.eq_ignore_ascii_case(name.trim()));
    let info = info.ok_or_else(|| fail(format!("{name}: no such code; `foliar explain` lists all")))?;
    let severity = match word.trim() {
        "off" => None,
        "note" => Some(Severity::Note),
        "warning" => Some(Severity::Warning),
        "error" => Some(Severity::Error),
        other => return Err(fail(format!("{other}: must be one of off, note, warning, error"))),
    };
    Ok((info.code, severity))
}

#[cfg(test)]
mod tests {
    use super::*;
    use foliar_schema::code;

    #[test]
    fn codes_are_turned_off_or_weighed_anew() {
        let entries = ["GEOMETRY-UNUSED=off, unit-suspect=error".to_string()];
        let found = [&code::GEOMETRY_UNUSED, &code::UNIT_SUSPECT, &code::STALE].map(|info| Finding::new(info, ""));
        let kept = Overrides::new(&entries).unwrap().apply(found.to_vec());
        let told: Vec<_> = kept.iter().map(|f| (f.code.as_str(), f.severity)).collect();
        assert_eq!(told, [("UNIT-SUSPECT", Severity::Error), ("STALE", Severity::Warning)]);
    }

    #[test]
    fn unknown_codes_and_words_are_refused_with_what_would_be_right() {
        let said = |entry: &str| Overrides::new(&[entry.to_string()]).err().unwrap().to_string();
        assert!(said("NONE=off").contains("no such code"));
        assert!(said("STALE=fatal").contains("must be one of off, note, warning, error"));
        assert!(said("STALE").contains("must be CODE="));
    }
}
