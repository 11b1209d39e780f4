//! What the tests share: running a program, small trees, places for outputs, a look into a GLB.

use serde_json::Value;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

/// The programs under test.
pub const FOLIAR: &str = env!("CARGO_BIN_EXE_foliar");
pub const IMPORT: &str = env!("CARGO_BIN_EXE_foliar-import");
pub const DENSITY: &str = env!("CARGO_BIN_EXE_foliar-density");
pub const WIND: &str = env!("CARGO_BIN_EXE_foliar-wind");
pub const LIGHT: &str = env!("CARGO_BIN_EXE_foliar-light");
pub const TRANSLUCENCY: &str = env!("CARGO_BIN_EXE_foliar-translucency");
pub const NOISE: &str = env!("CARGO_BIN_EXE_foliar-noise");
pub const LEAFSCAN: &str = env!("CARGO_BIN_EXE_foliar-leafscan");
pub const VIEW: &str = env!("CARGO_BIN_EXE_foliar-view");
pub const PACK: &str = env!("CARGO_BIN_EXE_foliar-pack");
pub const CHECK: &str = env!("CARGO_BIN_EXE_foliar-check");

/// What a run left behind.
#[derive(Debug)]
pub struct Run {
    pub status: i32,
    pub stdout: String,
    pub stderr: String,
}

impl Run {
    /// Fails unless it ended with this status and said all of this on standard error.
    #[track_caller]
    pub fn expect(self, status: i32, said: &[&str]) -> Run {
        assert_eq!(self.status, status, "{self:#?}");
        for fragment in said {
            assert!(self.stderr.contains(fragment), "no {fragment:?} in {}", self.stderr);
        }
        self
    }

    /// The JSON lines of standard output.
    #[track_caller]
    pub fn json_lines(&self) -> Vec<Value> {
        self.stdout.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
    }
}

/// A program that hears nothing of the environment's own parameters.
pub fn command(program: &str) -> Command {
    let mut command = Command::new(program);
    for (name, _) in std::env::vars_os().filter(|(name, _)| name.to_string_lossy().starts_with("FOLIAR_")) {
        command.env_remove(name);
    }
    command
}

/// Runs a program in a folder.
pub fn run_in(folder: &Path, program: &str, arguments: &[&str]) -> Run {
    finish(command(program).current_dir(folder).args(arguments).stdin(Stdio::null()).output().unwrap())
}

/// Runs a program.
pub fn run(program: &str, arguments: &[&str]) -> Run {
    run_in(Path::new("."), program, arguments)
}

/// What a finished process left behind; -1 where a signal ended it.
pub fn finish(output: Output) -> Run {
    Run {
        status: output.status.code().unwrap_or(-1),
        stdout: String::from_utf8_lossy(&output.stdout).into_owned(),
        stderr: String::from_utf8_lossy(&output.stderr).into_owned(),
    }
}

/// A fresh folder for inputs; it goes away when dropped.
pub fn folder() -> tempfile::TempDir {
    tempfile::tempdir().unwrap()
}

/// The folder of all outputs.
fn outputs() -> PathBuf {
    let target = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../target/foliar-test-outputs");
    let folder = std::env::var_os("FOLIAR_TEST_OUTPUTS").map_or(target, PathBuf::from);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

/// Says why a test was skipped; `cargo xtask test` repeats it in its last lines.
pub fn skip(why: &str) {
    eprintln!("skipped: {why}");
}

/// Where a test leaves a glTF, so that `cargo xtask test` can validate it. Names are used once.
pub fn output(name: &str) -> PathBuf {
    let path = outputs().canonicalize().unwrap().join(name);
    // What an earlier run left would answer "unchanged".
    _ = std::fs::remove_file(&path);
    path
}

/// Leaves the foreign GLB that an output was made from beside it: the validator may then complain of the
/// output as often as of its input, and no more.
pub fn made_from(output: &Path, input: &Path) {
    let copy = format!("{}.base", output.display());
    std::fs::copy(input, &copy).unwrap();
    std::fs::write(format!("{}.input", output.display()), copy).unwrap();
}

/// A path as an argument.
pub fn text(path: &Path) -> &str {
    path.to_str().unwrap()
}

/// A file of the shared data, or nothing, said in so many words.
pub fn shared(name: &str) -> Option<PathBuf> {
    let beside = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared");
    let path = std::env::var_os("FOLIAR_SHARED").map_or(beside, PathBuf::from).join(name);
    if path.exists() {
        return Some(path);
    }
    skip(&format!("{} is not there: no shared data", path.display()));
    None
}

/// Writes `tree.obj` and `tree.mtl`: a tapering trunk of four sides and so many leaves (one quad each)
/// on a golden spiral around its upper half, Y up, meters.
pub fn tree(folder: &Path, leaves: usize) -> PathBuf {
    let path = folder.join("tree.obj");
    std::fs::write(&path, tree_text(leaves)).unwrap();
    let materials = "newmtl bark\nKd 0.4 0.3 0.2\nnewmtl leaves\nKd 0.2 0.5 0.2\n";
    std::fs::write(folder.join("tree.mtl"), materials).unwrap();
    path
}

/// The text of [`tree`].
pub fn tree_text(leaves: usize) -> String {
    let mut obj = String::from("mtllib tree.mtl\no trunk\nusemtl bark\n");
    for ring in 0..4 {
        let radius = 0.1 - 0.025 * f64::from(ring);
        for (x, z) in [(1.0, 1.0), (1.0, -1.0), (-1.0, -1.0), (-1.0, 1.0)] {
            writeln!(obj, "v {} {} {}", radius * x, ring, radius * z).unwrap();
        }
    }
    for ring in 0..3 {
        for side in 0..4 {
            let (a, b) = (4 * ring + side + 1, 4 * ring + (side + 1) % 4 + 1);
            writeln!(obj, "f {a} {b} {} {}", b + 4, a + 4).unwrap();
        }
    }
    obj.push_str("o crown\nusemtl leaves\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n");
    for leaf in 0..leaves {
        let share = (leaf as f64 + 0.5) / leaves as f64;
        #[expect(clippy::disallowed_methods, reason = "a test's input, compared with nothing stored")]
        let (sin, cos) = (2.399_963 * leaf as f64).sin_cos();
        let (x, y, z) = (share.sqrt() * cos, 1.5 + 1.5 * share, share.sqrt() * sin);
        for (u, v) in [(0.0, 0.0), (0.1, 0.0), (0.1, 0.08), (0.0, 0.08)] {
            writeln!(obj, "v {} {} {}", x + u * cos, y + v, z + u * sin).unwrap();
        }
        let first = 17 + 4 * leaf;
        writeln!(obj, "f {}/1 {}/2 {}/3 {}/4", first, first + 1, first + 2, first + 3).unwrap();
    }
    obj
}

/// JSON and binary chunk of a GLB, read by the letter of the format and by nothing of foliar.
#[track_caller]
pub fn open_glb(path: &Path) -> (Value, Vec<u8>) {
    let bytes = std::fs::read(path).unwrap();
    let number = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()) as usize;
    assert_eq!((&bytes[..4], number(4), number(8)), (&b"glTF"[..], 2, bytes.len()));
    let json = number(12);
    let value = serde_json::from_slice(&bytes[20..20 + json]).unwrap();
    let rest = 20 + json;
    let binary = if rest < bytes.len() { bytes[rest + 8..rest + 8 + number(rest)].to_vec() } else { Vec::new() };
    (value, binary)
}

/// The bytes of a GLB.
pub fn glb(json: &Value, binary: &[u8]) -> Vec<u8> {
    let padded = |bytes: &[u8], fill: u8| [bytes, &vec![fill; bytes.len().next_multiple_of(4) - bytes.len()]].concat();
    let json = padded(json.to_string().as_bytes(), b' ');
    let binary = padded(binary, 0);
    let word = |n: usize| (n as u32).to_le_bytes();
    let total = 12 + 8 + json.len() + 8 + binary.len();
    let parts: [&[u8]; 9] =
        [b"glTF", &word(2), &word(total), &word(json.len()), b"JSON", &json, &word(binary.len()), b"BIN\0", &binary];
    parts.concat()
}
