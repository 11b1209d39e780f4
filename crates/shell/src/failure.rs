//! Why a program ends without having done what was asked, and the exit status that says so.

use foliar_bake::BakeError;
use foliar_carrier::CarrierError;
use foliar_structure::StructureError;

/// Why a program ends; each kind has its exit status.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Failure {
    /// A check found something, or `--check` would change something: status 1.
    #[error("{0}")]
    Found(String),
    /// Flags, environment or configuration: status 2.
    #[error("{0}")]
    Usage(String),
    /// clap refused the command line, or prints help: its own text and status (2 or 0).
    #[error("{0}")]
    Clap(clap::Error),
    /// An asset, layer or map is unreadable, unsupported, or does not belong: status 3.
    #[error("{0}")]
    Input(String),
    /// An output cannot be written: status 4.
    #[error("{0}")]
    Output(String),
    /// Some or all of a batch failed: status 5.
    #[error("{failed} of {total} assets failed{rest}")]
    Batch {
        /// How many failed.
        failed: usize,
        /// How many were asked for.
        total: usize,
        /// What became of the others, in words; may be empty.
        rest: String,
    },
    /// A fault of foliar: status 70.
    #[error("{0}")]
    Fault(String),
}

impl Failure {
    /// The exit status (house rules, section 5).
    pub fn status(&self) -> u8 {
        match self {
            Failure::Found(_) => 1,
            Failure::Usage(_) => 2,
            Failure::Clap(error) => u8::try_from(error.exit_code()).unwrap_or(2),
            Failure::Input(_) => 3,
            Failure::Output(_) => 4,
            Failure::Batch { .. } => 5,
            Failure::Fault(_) => 70,
        }
    }

    /// A usage failure.
    pub fn usage(message: impl Into<String>) -> Self {
        Failure::Usage(message.into())
    }

    /// An output that cannot be written: its name, what the system said, what would be right.
    pub fn output(file: impl std::fmt::Display, reason: impl std::fmt::Display) -> Self {
        Failure::Output(format!("{file}: cannot be written: {reason}: name a file in a folder that you may write to"))
    }

    /// The same failure with the file that it is about in front, unless it says so already.
    pub fn in_file(self, file: &str) -> Self {
        let name = |text: String| if text.contains(file) { text } else { format!("{file}: {text}") };
        match self {
            Failure::Input(text) => Failure::Input(name(text)),
            Failure::Fault(text) => Failure::Fault(name(text)),
            other => other,
        }
    }
}

impl From<CarrierError> for Failure {
    fn from(error: CarrierError) -> Self {
        if error.is_output() { Failure::Output(error.to_string()) } else { Failure::Input(error.to_string()) }
    }
}

impl From<StructureError> for Failure {
    fn from(error: StructureError) -> Self {
        match error {
            StructureError::Pattern { .. } | StructureError::Parameter { .. } => Failure::Usage(error.to_string()),
            _ => Failure::Input(error.to_string()),
        }
    }
}

impl From<BakeError> for Failure {
    fn from(error: BakeError) -> Self {
        match error {
            BakeError::Range { .. } | BakeError::Parameter { .. } => Failure::Usage(error.to_string()),
            BakeError::Broken { .. } => Failure::Fault(error.to_string()),
            _ => Failure::Input(error.to_string()),
        }
    }
}

impl From<clap::Error> for Failure {
    fn from(error: clap::Error) -> Self {
        Failure::Clap(error)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_kind_has_the_status_of_the_house() {
        let batch = Failure::Batch { failed: 1, total: 2, rest: String::new() };
        let text = String::new;
        let kinds = [Failure::Found(text()), Failure::Usage(text()), Failure::Input(text()), Failure::Output(text())];
        assert_eq!(kinds.map(|k| k.status()), [1, 2, 3, 4]);
        assert_eq!((batch.status(), Failure::Fault(text()).status()), (5, 70));
    }

    #[test]
    fn a_file_is_named_once() {
        let named = Failure::Input("a.obj: empty".into()).in_file("a.obj").to_string();
        assert_eq!(named, "a.obj: empty");
        assert_eq!(Failure::Input("empty".into()).in_file("a.obj").to_string(), "a.obj: empty");
    }
}
