//! From a path to a plant: import and structure.

use crate::config::{Given, Settings};
use crate::gather::Sources;
use crate::options::{Options, is_dash};
use crate::{Failure, record};
use foliar_bake::Layer;
use foliar_carrier::{Asset, Document, SourceKind};
use foliar_plant::{Base, Plant};
use foliar_schema::{Finding, Import, Severity, Up, code, names};
use foliar_structure::{PartEvidence, StructureParams};
use std::io::Read;
use std::path::{Path, PathBuf};

/// A plant with everything that is known of where it came from.
pub struct Loaded {
    /// What was given for it.
    pub settings: Settings,
    /// The base glTF.
    pub document: Document,
    /// Base and structure.
    pub plant: Plant,
    /// Hash of the base.
    pub base_hash: String,
    /// The layer of structure.
    pub structure: Layer,
    /// Whether the file held layers already.
    pub is_master: bool,
    /// The other layers that the file held.
    pub layers: Vec<Layer>,
    /// Why each part has its role; empty where the file's own structure was taken.
    pub evidence: Vec<PartEvidence>,
    /// What was noticed.
    pub findings: Vec<Finding>,
    /// Every file that was really read, configuration included.
    pub files: Vec<PathBuf>,
    /// What kind of file it was.
    pub source: SourceKind,
}

/// Reads an asset and finds its structure.
///
/// # Errors
/// [`Failure`] with file, place and remedy.
pub fn load(sources: &Sources, options: &Options, input: &Path) -> Result<Loaded, Failure> {
    let asset = asset(sources, options, input)?;
    let records: Vec<_> = asset.layers.iter().map(|layer| &layer.record).collect();
    let (given_before, mut findings) = record::settings(sources.fields, &records, input);
    let settings = sources.gather(options, input, given_before)?;
    let Asset { document, base, base_hash, layers, findings: import_findings, files, source } = asset;
    findings.splice(0..0, import_findings);
    let is_master = !layers.is_empty();
    let (own, layers): (Vec<Layer>, Vec<Layer>) =
        layers.into_iter().partition(|layer| layer.record.room == names::ROOM_STRUCTURE);
    let kept = own.into_iter().find(|layer| still_valid(layer, &settings, &base_hash));
    let found = find_structure(&base, &settings, kept, options.explain_roles)?;
    let remedy = lying_remedy(source, settings.section::<Import>("import")?.up);
    findings.extend(found.findings.into_iter().map(|finding| with_remedy(finding, remedy)));
    let plant = Plant::new(base, found.structure).map_err(|e| Failure::Input(format!("{}: {e}", input.display())))?;
    Ok(Loaded {
        settings,
        document,
        plant,
        base_hash,
        structure: found.layer,
        is_master,
        layers,
        evidence: found.parts,
        findings,
        files,
        source,
    })
}

/// Reads an asset alone; its files include the configuration.
///
/// # Errors
/// [`Failure`] with file, place and remedy.
pub fn asset(sources: &Sources, options: &Options, input: &Path) -> Result<Asset, Failure> {
    let settings = sources.gather(options, input, Settings::default())?;
    let mut asset = read(input, &settings.section::<Import>("import")?)?;
    asset.findings.extend(ignored_for_gltf(&sources.flags, asset.source, input));
    asset.files.extend(settings.files);
    Ok(asset)
}

/// Reads a layer file.
///
/// # Errors
/// [`Failure::Input`].
pub fn layer(file: &Path) -> Result<Layer, Failure> {
    let name = file.display().to_string();
    let unreadable = |e| Failure::Input(format!("{name}: cannot be read: {e}: name a .layer file"));
    let bytes = std::fs::read(file).map_err(unreadable)?;
    Ok(foliar_carrier::layer_from_bytes(&bytes, &name)?)
}

/// What flags say of axis and unit of a glTF, which says both itself.
fn ignored_for_gltf(flags: &Settings, source: SourceKind, input: &Path) -> Vec<Finding> {
    let given = ["import.up", "import.unit", "import.height_m"].into_iter().filter_map(|name| flags.get(name));
    let finding = |given: &Given| {
        let text = format!("a glTF is Y up in meters: {} is ignored; turn or scale it in the modeller", given.origin);
        let finding = Finding::new(&code::IMPORT_IGNORED, text).in_file(input.display().to_string());
        Finding { severity: Severity::Warning, ..finding }
    };
    if source == SourceKind::Obj { Vec::new() } else { given.map(finding).collect() }
}

/// What helps a trunk that lies on its side: only an OBJ is turned at import, about one axis.
fn lying_remedy(source: SourceKind, up: Option<Up>) -> &'static str {
    match (source, up) {
        (SourceKind::Obj, Some(Up::Z)) => "if Y is up in this file, say --up y; else turn it in the modeller",
        (SourceKind::Obj, _) => "if Z is up in this file, say --up z; else turn it in the modeller",
        _ => "a glTF is Y up and is never turned: turn it in the modeller and export it again",
    }
}

/// Structure does not know what kind of file lies there, and so not what would help.
fn with_remedy(finding: Finding, remedy: &str) -> Finding {
    if finding.code != code::IMPORT_LYING.code {
        return finding;
    }
    Finding { message: format!("{}: {remedy}", finding.message), ..finding }
}

/// Reads a file, or standard input where its name is `-`.
///
/// # Errors
/// [`Failure::Input`] with file, place and remedy.
fn read(input: &Path, import: &Import) -> Result<Asset, Failure> {
    if !is_dash(input) {
        return Ok(foliar_carrier::read(input, import)?);
    }
    let mut bytes = Vec::new();
    let unreadable =
        |e| Failure::Input(format!("standard input: cannot be read: {e}: pipe an .obj, .gltf or .glb into it"));
    std::io::stdin().lock().read_to_end(&mut bytes).map_err(unreadable)?;
    Ok(foliar_carrier::read_bytes(bytes, "standard input", Path::new(""), import)?)
}

/// Whether a master's own structure is what analyzing it with these settings stands for. It knows
/// which vertices an OBJ connected, which its glTF no longer says: so it is kept where it can be.
fn still_valid(layer: &Layer, settings: &Settings, base_hash: &str) -> bool {
    let record = &layer.record;
    record.version == foliar_structure::VERSION
        && record.given == record::given(settings, names::ROOM_STRUCTURE)
        && record.reads.get("base").map(String::as_str) == Some(base_hash)
}

fn find_structure(
    base: &Base,
    settings: &Settings,
    kept: Option<Layer>,
    explain: bool,
) -> Result<foliar_structure::Analysis, Failure> {
    let roles = settings.section("roles")?;
    let params: StructureParams = settings.section(names::ROOM_STRUCTURE)?;
    let Some(layer) = kept else {
        let mut analysis = foliar_structure::analyze(base, &roles, &params)?;
        analysis.layer.record.given = record::given(settings, names::ROOM_STRUCTURE);
        return Ok(analysis);
    };
    let structure = foliar_structure::from_layer(&layer, base)?;
    let parts = if explain { foliar_structure::analyze(base, &roles, &params)?.parts } else { Vec::new() };
    Ok(foliar_structure::Analysis { structure, layer, parts, findings: Vec::new() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_flag_is_advised_only_where_it_acts() {
        let said = |source, up| with_remedy(Finding::new(&code::IMPORT_LYING, "lies"), lying_remedy(source, up));
        assert!(said(SourceKind::Obj, None).message.contains("--up z"));
        assert!(said(SourceKind::Obj, Some(Up::Z)).message.contains("--up y"));
        for source in [SourceKind::Gltf, SourceKind::Glb] {
            assert!(!said(source, Some(Up::Z)).message.contains("--"));
        }
        let other = Finding::new(&code::IMPORT_UP, "up");
        assert_eq!(with_remedy(other.clone(), "x"), other);
    }
}
