//! Findings: what a step noticed about an asset that a person may want to know.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How serious a finding is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Severity {
    /// Good to know.
    Note,
    /// Probably not what was meant.
    Warning,
    /// Wrong.
    Error,
}

/// One finding.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub struct Finding {
    /// Stable code, one of [`crate::CODES`].
    pub code: String,
    /// How serious it is.
    pub severity: Severity,
    /// What was found, with names and numbers, and what to do about it.
    pub message: String,
    /// Where: a JSON pointer into a glTF, or `line N` of a text file.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub place: Option<String>,
    /// The file concerned, as the user named it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
}

impl Finding {
    /// A finding of a listed code, with the code's own severity.
    pub fn new(info: &crate::CodeInfo, message: impl Into<String>) -> Self {
        Finding { code: info.code.into(), severity: info.severity, message: message.into(), place: None, file: None }
    }

    /// The same finding with a place: a JSON pointer or `line N`.
    pub fn at(mut self, place: impl Into<String>) -> Self {
        self.place = Some(place.into());
        self
    }

    /// The same finding with the file concerned.
    pub fn in_file(mut self, file: impl Into<String>) -> Self {
        self.file = Some(file.into());
        self
    }
}
