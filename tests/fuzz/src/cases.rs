//! Mutated files given to the programs: whatever a file holds, they end by themselves, in time, in bounds, with a status
//! that is no fault of ours; and what they write is whole.

use super::mutate::{Dice, Form, mutated};
use std::io::{Error, Result};
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

/// Seconds of the processor that a program may take.
const MOST_SECONDS: u64 = 10;
/// Seconds that it may last, however busy the machine is.
const LONGEST_WAIT_S: u64 = 60;
/// Memory that it may take: this, and so many times what it is given.
const MOST_BYTES: u64 = 200 << 20;
const MOST_TIMES: u64 = 10;
/// Statuses that say something of the files: done, found, configuration, input.
const STATUSES: [i32; 4] = [0, 1, 2, 3];

/// A file to mutate, and the asset that is then read.
#[derive(Clone, Debug)]
pub struct Seed {
    /// The asset.
    pub asset: PathBuf,
    /// What is mutated: the asset itself or a file beside it.
    pub file: PathBuf,
    form: Form,
}

/// How a file is built, by its ending.
fn form(file: &Path) -> Option<Form> {
    Some(match file.extension()?.to_str()? {
        "obj" | "mtl" | "toml" => Form::Lines,
        "gltf" => Form::Json,
        "glb" => Form::Glb,
        "layer" => Form::Layer,
        "png" | "jpg" | "tif" | "tga" | "bmp" | "exr" | "bin" => Form::Bytes,
        _ => return None,
    })
}

fn is_asset(file: &Path) -> bool {
    matches!(file.extension().and_then(|e| e.to_str()), Some("obj" | "gltf" | "glb"))
}

/// A map that is baked by itself, as [`make`] names it.
fn is_map(file: &Path) -> bool {
    file.file_stem().is_some_and(|stem| stem == MAP)
}

/// Files of a folder, by name.
fn files(folder: &Path) -> Result<Vec<PathBuf>> {
    let entries = std::fs::read_dir(folder)?.map(|entry| entry.map(|entry| entry.path()));
    let mut files: Vec<PathBuf> = entries.collect::<Result<_>>()?;
    files.retain(|file| file.is_file());
    files.sort();
    Ok(files)
}

/// What an asset reads beside itself: all of its folder but other assets; nothing where it is a GLB.
fn beside(asset: &Path) -> Result<Vec<PathBuf>> {
    if is_map(asset) || asset.extension().is_some_and(|ending| ending == "glb") {
        return Ok(Vec::new());
    }
    let all = files(asset.parent().unwrap_or(Path::new("")))?;
    Ok(all.into_iter().filter(|file| !is_asset(file) && form(file).is_some()).collect())
}

/// Every file of these folders that is an asset or lies beside one, and how it is built. An asset counts several times:
/// there is more to get wrong in it than in a picture.
pub fn seeds(folders: &[PathBuf]) -> Result<Vec<Seed>> {
    const TIMES: usize = 4;
    let mut seeds = Vec::new();
    for folder in folders {
        for asset in files(folder)?.into_iter().filter(|file| is_asset(file) || is_map(file)) {
            let own = std::iter::repeat_n(asset.clone(), TIMES);
            for file in own.chain(beside(&asset)?) {
                seeds.extend(form(&file).map(|form| Seed { asset: asset.clone(), file, form }));
            }
        }
    }
    Ok(seeds)
}

/// Where programs are, and where cases are laid out.
pub struct Ground {
    /// Folder of the programs.
    pub programs: PathBuf,
    /// Folder that cases may fill.
    pub scratch: PathBuf,
}

impl Ground {
    /// Lays one case out in the folder `place` and runs it: nothing where all is well, else what went wrong and where
    /// the file lies. Case 0 is the file as it is.
    ///
    /// # Errors
    /// Where files cannot be written or programs not started.
    pub fn judge(&self, seed: &Seed, other: &Path, case: u64, place: &str) -> Result<Option<String>> {
        let here = self.scratch.join(place);
        _ = std::fs::remove_dir_all(&here);
        std::fs::create_dir_all(&here)?;
        let mut size = 0;
        for file in beside(&seed.asset)?.iter().chain([&seed.asset]) {
            let bytes = std::fs::read(file)?;
            size += bytes.len() as u64;
            std::fs::write(here.join(name(file)), bytes)?;
        }
        let mut what = "as it is".into();
        if case > 0 {
            let (bytes, other) = (std::fs::read(&seed.file)?, std::fs::read(other)?);
            let mutated = mutated(&bytes, &other, seed.form, &mut Dice::new(case));
            std::fs::write(here.join(name(&seed.file)), mutated.0)?;
            what = mutated.1;
        }
        for words in tries(&name(&seed.asset), &name(&seed.file), case) {
            if let Some(wrong) = self.run(&here, &words, size)? {
                let place = here.join(name(&seed.file));
                return Ok(Some(format!("{}: case {case} ({what}): {}: {wrong}", place.display(), words.join(" "))));
            }
        }
        std::fs::remove_dir_all(&here)?;
        Ok(None)
    }

    /// Runs a program within its bounds; what is wrong with how it ended.
    fn run(&self, here: &Path, words: &[String], size: u64) -> Result<Option<String>> {
        let is_ours = words[1] == OUTPUT;
        // Nothing was written: nothing to look at.
        if is_ours && !here.join(OUTPUT).exists() {
            return Ok(None);
        }
        let kilobytes = (MOST_BYTES + MOST_TIMES * size) >> 10;
        let mut command = Command::new("sh");
        // What waits takes no time of the processor.
        let limits = "ulimit -d \"$1\" && ulimit -t \"$2\" && shift 2 && exec timeout -s KILL \"$@\"";
        command.args(["-c", limits, "sh"]);
        command.args([kilobytes.to_string(), MOST_SECONDS.to_string(), LONGEST_WAIT_S.to_string()]);
        command.arg(self.programs.join(&words[0])).args(&words[1..]).args(["--threads", "1"]);
        for (variable, _) in std::env::vars_os().filter(|(name, _)| name.to_string_lossy().starts_with("FOLIAR_")) {
            command.env_remove(variable);
        }
        let output = command.current_dir(here).stdin(Stdio::null()).output()?;
        Ok(wrong(&output, is_ours))
    }
}

/// What a bake writes.
const OUTPUT: &str = "out.glb";

fn name(file: &Path) -> String {
    file.file_name().unwrap_or_default().to_string_lossy().into_owned()
}

/// Other commands that read assets.
const MORE: [&str; 8] = [
    "foliar-translucency FILE --thickness-from photo --leaf-width-mm 400 -o lit.glb",
    "foliar-leafscan FILE --resolution 32 -o scan.exr",
    "foliar inspect FILE",
    "foliar diff FILE FILE",
    "foliar-check --after FILE --master FILE --format json",
    "foliar strip FILE -o stripped.glb",
    "foliar-pack FILE --for core -o packed.glb",
    "foliar-view FILE -o view.png --width-px 64 --height-px 48 --samples 1",
];

/// What is done with an asset one of whose files was mutated, the last time with what came of it.
fn tries(asset: &str, file: &str, case: u64) -> Vec<Vec<String>> {
    let line = match Path::new(file).extension().and_then(|ending| ending.to_str()) {
        Some("layer") => format!("foliar assemble {asset} {file} -o {OUTPUT}"),
        Some("png" | "exr") if is_map(Path::new(file)) => {
            let own = "--thickness FILE --texel-mm 0.5 --thickness-scale-mm 0.4 -o lit.exr";
            let heights = "--height-front FILE --height-back FILE --texel-mm 1 --height-scale-mm 0.4 -o scan.exr";
            return words(&format!("foliar-translucency {own}|foliar-leafscan {heights}").replace("FILE", file));
        }
        Some("toml") => format!("foliar config {asset}|foliar bake {asset} -o {OUTPUT}"),
        _ => format!("foliar-check {asset} --format json|foliar bake {asset} -o {OUTPUT}"),
    };
    // Of what else reads assets one each time.
    let more = MORE[case as usize % MORE.len()].replace("FILE", asset);
    words(&format!("{line}|foliar-check {OUTPUT} --format json|{more}"))
}

fn words(lines: &str) -> Vec<Vec<String>> {
    lines.split('|').map(|line| line.split(' ').map(Into::into).collect()).collect()
}

/// Codes that nothing that foliar wrote may have. A mirror or a label that was damaged before is not ours to replace:
/// that one is told of.
const BROKEN: [&str; 9] = [
    "FILE-BROKEN",
    "FILE-COMPRESSED",
    "CONTRACT-CHANNEL",
    "CONTRACT-DECLARED",
    "CONTRACT-ID",
    "CONTRACT-RANGE",
    "CONTRACT-RECORD",
    "CONTRACT-TABLE",
    "CONTRACT-UNIT",
];

fn wrong(output: &Output, is_ours: bool) -> Option<String> {
    let said = String::from_utf8_lossy(&output.stderr);
    let said = said.lines().next_back().unwrap_or_default();
    match output.status.code() {
        None => Some(format!("ended by a signal: {}: {said}", output.status)),
        Some(status) if !STATUSES.contains(&status) => Some(format!("status {status}: {said}")),
        Some(_) if is_ours => {
            let found = String::from_utf8_lossy(&output.stdout);
            let is = |code: &str| found.contains(&format!("\"{code}"));
            let code = BROKEN.iter().find(|code| is(code));
            code.map(|code| format!("what was written has a finding {code}: {found}"))
        }
        Some(_) => None,
    }
}

/// Fills a folder with what is made of a tree: a plant with its layers and a configuration beside it, and a master.
///
/// # Errors
/// Where a program does not end well.
pub fn make(programs: &Path, tree: &Path, folder: &Path) -> Result<()> {
    std::fs::create_dir_all(folder.join("master"))?;
    let tree = std::path::absolute(tree)?.display().to_string();
    let commands = [
        ("foliar-import", tree.as_str(), "plant.gltf"),
        ("foliar-density", "plant.gltf", "density.layer"),
        ("foliar-wind", "plant.gltf", "wind.layer"),
        ("foliar-density", "plant.gltf", "master/master.glb"),
    ];
    for (program, input, output) in commands {
        let mut command = Command::new(programs.join(program));
        let run = command.args([input, "-o", output]).current_dir(folder).output()?;
        if !run.status.success() {
            return Err(Error::other(format!("{program} {input}: {}", String::from_utf8_lossy(&run.stderr))));
        }
    }
    let maps = folder.join("maps");
    std::fs::create_dir_all(&maps)?;
    std::fs::write(maps.join("slab.obj"), SLAB)?;
    for ending in ["png", "exr"] {
        let mut command = Command::new(programs.join("foliar-leafscan"));
        command.args(["slab.obj", "--unit", "mm", "--resolution", "24", "-o"]).arg(format!("{MAP}.{ending}"));
        let run = command.current_dir(&maps).output()?;
        if !run.status.success() {
            return Err(Error::other(format!("foliar-leafscan: {}", String::from_utf8_lossy(&run.stderr))));
        }
    }
    std::fs::write(folder.join("foliar.toml"), CONFIGURATION)
}

/// Name of a map that is baked by itself.
const MAP: &str = "thickness";

/// A leaf of 40 x 30 x .3 mm.
const SLAB: &str = "v 0 0 0\nv 40 0 0\nv 40 30 0\nv 0 30 0\nv 0 0 .3\nv 40 0 .3\nv 40 30 .3\nv 0 30 .3\nf 4 3 2 1\nf 5 6 7 8\n\
    f 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

/// A bit of every kind of value.
const CONFIGURATION: &str = "[import]\nsearch = ['maps', 'more']\n[roles]\nleaf = ['*leaf*']\n[scene.camera]\nnearest_m = 2.5\n\
    [scene.light]\nambient = 'density'\nsoft_normals = true\n[density]\nradius_m = 0.4\nself = 'include'\n[wind]\nlevels = 2\n\
    exponents = [2.0, 1.5, 1.5, 1.0]\n[check]\nrequire = ['density']\n";
