//! All sources in their order: project file, asset file, record, environment, flags.

use crate::commands::Call;
use crate::config::{Fields, Settings, asset_file, from_file, project_file};
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
