//! What a bake leaves behind: where it goes, the bytes, and the lists that build systems read.

use crate::Failure;
use crate::options::{Options, is_dash};
use foliar_bake::Layer;
use foliar_carrier::{Document, OutputFile};
use foliar_schema::names;
use serde::Serialize;
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// One input and where its output goes.
pub struct Job {
    /// Input file or `-`.
    pub input: PathBuf,
    /// Output file, `-`, or none where nothing is written.
    pub output: Option<PathBuf>,
}

/// Pairs inputs with outputs.
///
/// # Errors
/// [`Failure::Usage`] where one file is named for several inputs.
pub fn jobs(options: &Options) -> Result<Vec<Job>, Failure> {
    if options.inputs.len() > 1 {
        let single = [(&options.output, "-o"), (&options.picture, "--picture"), (&options.surface, "--surface")];
        for (given, flag) in single {
            if given.is_some() {
                let text = format!("{flag} names one file for {} inputs: use -d DIR", options.inputs.len());
                return Err(Failure::usage(text));
            }
        }
    }
    let mut jobs = Vec::new();
    for input in &options.inputs {
        let output = match (&options.output, &options.directory) {
            (Some(output), _) => Some(output.clone()),
            (None, Some(directory)) => Some(directory.join(glb_name(input)?)),
            (None, None) => None,
        };
        jobs.push(Job { input: input.clone(), output });
    }
    Ok(jobs)
}

fn glb_name(input: &Path) -> Result<String, Failure> {
    match input.file_stem() {
        Some(stem) if !is_dash(input) => Ok(format!("{}.glb", stem.to_string_lossy())),
        _ => Err(Failure::usage(format!("{}: has no name for an output in a folder: use -o", input.display()))),
    }
}

/// Refuses files that would take the place of what was read: names beside `-o` are ours, and one of them may be a map's.
///
/// # Errors
/// [`Failure::Usage`] with the file.
pub fn refuse_inputs(files: &[OutputFile], read: &[PathBuf]) -> Result<(), Failure> {
    let whole = |path: &Path| std::fs::canonicalize(path).ok();
    let read: Vec<PathBuf> = read.iter().filter_map(|path| whole(path)).collect();
    let old = files.iter().flat_map(|file| foliar_carrier::side_files(&file.path));
    let mut gone = files.iter().map(|file| file.path.clone()).chain(old);
    match gone.find(|path| whole(path).is_some_and(|path| read.contains(&path))) {
        None => Ok(()),
        Some(path) => Err(Failure::usage(format!(
            "{}: was read as a map, and would be written over or taken away: name another output with -o",
            path.display()
        ))),
    }
}

/// Refuses two outputs of one name.
///
/// # Errors
/// [`Failure::Usage`] with both purposes.
pub fn refuse_duplicates(options: &Options, jobs: &[Job]) -> Result<(), Failure> {
    let mut seen = BTreeMap::new();
    let outputs = jobs.iter().filter_map(|job| Some((job.output.clone()?, job.input.display().to_string())));
    let lists = [
        (&options.picture, "--picture"),
        (&options.surface, "--surface"),
        (&options.report, "--report"),
        (&options.depfile, "--depfile"),
        (&options.outputs, "--outputs"),
    ];
    let lists = lists.into_iter().filter_map(|(path, flag)| Some((path.clone()?, flag.to_owned())));
    for (path, who) in outputs.chain(lists) {
        let full = std::path::absolute(&path).unwrap_or_else(|_| path.clone());
        if let Some(other) = seen.insert(full, who.clone()) {
            let text = format!("{other} and {who} would both write {}: give each a name of its own", path.display());
            return Err(Failure::usage(text));
        }
    }
    Ok(())
}

/// Refuses an output whose ending says nothing, before any work is done.
///
/// # Errors
/// [`Failure::Usage`] with the endings that there are.
pub fn check_ending(output: &Path, layers_too: bool) -> Result<(), Failure> {
    let ending = output.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase);
    match ending.as_deref() {
        _ if is_dash(output) => Ok(()),
        Some("glb" | "gltf") => Ok(()),
        Some(names::LAYER_ENDING) if layers_too => Ok(()),
        _ => {
            let also = if layers_too { ", .layer" } else { "" };
            Err(Failure::usage(format!("-o {}: must end in .glb, .gltf{also}, or be -", output.display())))
        }
    }
}

/// Refuses a surface that could not be told for a glTF in one file.
///
/// # Errors
/// [`Failure::Usage`] with the ending.
pub fn check_surface(options: &Options) -> Result<(), Failure> {
    match &options.surface {
        Some(path) if !path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("glb")) => {
            Err(Failure::usage(format!("--surface {}: must end in .glb", path.display())))
        }
        _ => Ok(()),
    }
}

/// Whether an output is a layer of its own.
pub fn is_layer(output: &Path) -> bool {
    output.extension().is_some_and(|ending| ending.eq_ignore_ascii_case(names::LAYER_ENDING))
}

/// The files of a document at its output; standard output takes a GLB.
///
/// # Errors
/// As the carrier's.
pub fn encode(document: &Document, output: &Path) -> Result<Vec<OutputFile>, Failure> {
    if !is_dash(output) {
        return Ok(foliar_carrier::encode(document, output)?);
    }
    let mut files = foliar_carrier::encode(document, Path::new("standard-output.glb"))?;
    for file in &mut files {
        file.path = output.to_path_buf();
    }
    Ok(files)
}

/// The file of a layer.
///
/// # Errors
/// As the carrier's.
pub fn encode_layer(layer: &Layer, output: &Path) -> Result<Vec<OutputFile>, Failure> {
    Ok(vec![OutputFile { path: output.to_path_buf(), bytes: foliar_carrier::layer_to_bytes(layer)? }])
}

/// Writes a list or report all or nothing, leaving an equal file untouched.
///
/// # Errors
/// [`Failure::Output`].
pub fn write_text(path: &Path, text: String) -> Result<(), Failure> {
    foliar_carrier::write_files(&[OutputFile { path: path.to_path_buf(), bytes: text.into_bytes() }])?;
    Ok(())
}

/// What is told, as JSON.
///
/// # Errors
/// [`Failure::Fault`] for what is no JSON.
pub fn value(told: &impl Serialize) -> Result<Value, Failure> {
    serde_json::to_value(told).map_err(|e| Failure::Fault(format!("the report cannot be written: {e}")))
}

/// Pretty JSON with a newline at its end.
pub fn pretty(value: &Value) -> String {
    format!("{value:#}\n")
}

/// Rules for make or ninja: `output: every file that was read`.
pub fn depfile(rules: &[(PathBuf, Vec<PathBuf>)]) -> String {
    let rule = |(target, read): &(PathBuf, Vec<PathBuf>)| {
        let mut read: Vec<String> = read.iter().filter(|file| !is_dash(file)).map(|file| escape(file)).collect();
        read.sort();
        read.dedup();
        format!("{}: {}\n", escape(target), read.join(" ")).replace(": \n", ":\n")
    };
    rules.iter().map(rule).collect()
}

/// A path as make reads it.
fn escape(path: &Path) -> String {
    path.display().to_string().replace('$', "$$").replace(' ', "\\ ").replace('#', "\\#")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn options(inputs: &[&str]) -> Options {
        Options { inputs: inputs.iter().map(PathBuf::from).collect(), ..Options::default() }
    }

    #[test]
    fn inputs_of_one_name_in_two_folders_are_refused() {
        let two = Options { directory: Some("out".into()), ..options(&["a/tree.obj", "b/tree.obj"]) };
        let text = refuse_duplicates(&two, &jobs(&two).unwrap()).unwrap_err().to_string();
        assert!(text.contains("a/tree.obj and b/tree.obj would both write out/tree.glb"), "{text}");
    }

    #[test]
    fn one_file_for_two_inputs_or_two_purposes_is_refused() {
        let two = Options { output: Some("x.glb".into()), ..options(&["a.obj", "b.obj"]) };
        assert!(jobs(&two).is_err());
        let same = Options { output: Some("x.glb".into()), report: Some("./x.glb".into()), ..options(&["a.obj"]) };
        let both = refuse_duplicates(&same, &jobs(&same).unwrap()).unwrap_err().to_string();
        assert!(both.contains("--report"), "{both}");
    }

    #[test]
    fn in_place_is_allowed() {
        let job = jobs(&Options { output: Some("a.glb".into()), ..options(&["a.glb"]) }).unwrap();
        assert_eq!(job[0].output.as_deref(), Some(Path::new("a.glb")));
    }

    #[test]
    fn make_can_read_odd_names() {
        let rules = [(PathBuf::from("a b.glb"), vec![PathBuf::from("c$#.obj"), PathBuf::from("-")])];
        assert_eq!(depfile(&rules), "a\\ b.glb: c$$\\#.obj\n");
        assert_eq!(depfile(&[("a".into(), vec![])]), "a:\n");
    }

    #[test]
    fn an_ending_that_says_nothing_is_refused() {
        assert!(check_ending(Path::new("a.obj"), true).is_err());
        assert!(check_ending(Path::new("a.layer"), false).is_err());
        assert!(check_ending(Path::new("a.GLB"), false).is_ok());
    }
}
