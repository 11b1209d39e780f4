//! Lines that join a new room to what is there: each goes to a known place of a known file.

use super::named;
use anyhow::{Context, Result};

/// A file that must know of the room.
pub struct Joined {
    pub file: &'static str,
    /// What to write, and before what; the first place where that stands.
    lines: &'static [(&'static str, &'static str)],
}

/// All of them.
pub const JOINED: [Joined; 4] = [
    Joined {
        file: "Cargo.toml",
        lines: &[("foliar-__room__ = { path = \"crates/__room__\" }\n", "foliar-carrier = { path")],
    },
    Joined {
        file: "crates/programs/Cargo.toml",
        lines: &[
            ("foliar-__room__.workspace = true\n", "foliar-schema.workspace = true"),
            ("[[bin]]\nname = \"foliar-__room__\"\ndoc = false\n\n", "[[bin]]\nname = \"foliar-view\""),
        ],
    },
    Joined {
        file: "crates/programs/src/lib.rs",
        lines: &[("&foliar___room__::__Room__,\n    ", "// Bakers of libraries.")],
    },
    Joined {
        file: "crates/schema/src/rooms/mod.rs",
        lines: &[("mod __room__;\n", "mod structure;\n"), (" __room__", ";\n    library:")],
    },
];

impl Joined {
    /// The file's text with the room in it.
    pub fn with(&self, text: &str, name: &str) -> Result<String> {
        let mut text = text.to_owned();
        for (line, before) in self.lines {
            let at = text.find(before).with_context(|| {
                format!("{}: {before:?} is gone, before which the lines of a room go: say where in lines.rs", self.file)
            })?;
            text.insert_str(at, &named(line, name));
        }
        // A room that was named as one to come has come; no other of these files has such a list.
        Ok(text.replace(&format!("\"{name}\", "), "").replace(&format!(", \"{name}\"]"), "]"))
    }
}
