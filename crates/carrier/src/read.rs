//! From bytes of any kind to an asset: open, take the layers out, expand, extract.

use crate::accessor::Source;
use crate::extract::{Extraction, OwnIds};
use crate::takeout::Taken;
use crate::{Asset, CarrierError, Document, Selection, SourceKind, container, instances, obj, takeout};
use foliar_bake::{Layer, base_hash};
use foliar_schema::{Finding, Import, code};
use std::path::{Path, PathBuf};

/// A file that was opened, whatever kind it was.
struct Opened {
    document: Document,
    own_ids: Option<(Vec<Vec<u32>>, u32)>,
    findings: Vec<Finding>,
    files: Vec<PathBuf>,
    source: SourceKind,
}

/// Reads an asset from bytes.
pub(crate) fn asset(bytes: &[u8], name: &str, folder: &Path, import: &Import) -> Result<Asset, CarrierError> {
    let Opened { document, own_ids, mut findings, mut files, source } = open(bytes, name, folder, import)?;
    let Taken { mut document, layers, findings: taken, files: sides } = takeout::take_out(document, name)?;
    findings.extend(taken);
    files.extend(sides);
    document.selection = chosen(&document, import);
    if import.expand_instances {
        instances::expand(&mut document, name)?;
    }
    let ids = own_ids.as_ref().map(|(per_mesh, count)| OwnIds { per_mesh, count: *count });
    let extraction =
        Extraction { source: Source { document: &document, file: name }, selection: &document.selection, import, ids };
    let base = extraction.run(&mut findings, &mut files)?;
    let base_hash = base_hash(&base);
    findings.extend(layers.iter().filter_map(|layer| stale(layer, &base_hash, name)));
    Ok(Asset { document, base, base_hash, layers, findings, files, source })
}

/// What the layers of a master say of its base: a finding for each that was baked from another.
pub(crate) fn stale_records(document: Document, name: &str, import: &Import) -> Result<Vec<Finding>, CarrierError> {
    let Taken { mut document, layers, mut findings, .. } = takeout::take_out(document, name)?;
    document.selection = chosen(&document, import);
    let selection = &document.selection;
    let extraction = Extraction { source: Source { document: &document, file: name }, selection, import, ids: None };
    // Import's own findings were told when the parts were read.
    let base = extraction.run(&mut Vec::new(), &mut Vec::new())?;
    let hash = base_hash(&base);
    findings.extend(layers.iter().filter_map(|layer| stale(layer, &hash, name)));
    Ok(findings)
}

/// What is baked: what is asked for, else what the file remembers.
fn chosen(document: &Document, import: &Import) -> Selection {
    Selection {
        scene: import.scene.or(document.selection.scene),
        node: import.node.clone().or(document.selection.node.clone()),
    }
}

fn stale(layer: &Layer, base_hash: &str, file: &str) -> Option<Finding> {
    let read = layer.record.reads.get("base").filter(|read| *read != base_hash)?;
    let message = format!("{} was baked from the base {read}, this one is {base_hash}", layer.record.room);
    Some(Finding::new(&code::STALE, message).in_file(file))
}

/// What the bytes look like.
pub(crate) fn kind(bytes: &[u8], name: &str) -> Result<SourceKind, CarrierError> {
    let ending = Path::new(name).extension().map(|e| e.to_string_lossy().to_lowercase()).unwrap_or_default();
    let fail = |problem: &str, remedy: &str| Err(CarrierError::input(name, "byte 0", problem, remedy));
    if bytes.is_empty() {
        return fail("the file is empty", "export or download it again");
    }
    if bytes.starts_with(b"\xFF\xFE") || bytes.starts_with(b"\xFE\xFF") || bytes.get(..2) == Some(b"{\0") {
        return fail("the text is UTF-16", "save it as UTF-8");
    }
    if bytes.starts_with(container::GLB_MAGIC) {
        return Ok(SourceKind::Glb);
    }
    let text = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes).trim_ascii_start();
    match ending.as_str() {
        "glb" => fail("it does not start with \"glTF\", as a GLB does", "export or download it again"),
        "gltf" => Ok(SourceKind::Gltf),
        _ if text.starts_with(b"{") => Ok(SourceKind::Gltf),
        "obj" | "" => Ok(SourceKind::Obj),
        // Standard input has any name: text is taken for OBJ there.
        _ if std::str::from_utf8(&text[..text.len().min(256)]).is_ok_and(|t| t.contains("v ")) => Ok(SourceKind::Obj),
        other => fail(&format!("files of kind {other:?} are not read"), "export it as .obj, .gltf or .glb"),
    }
}

fn open(bytes: &[u8], name: &str, folder: &Path, import: &Import) -> Result<Opened, CarrierError> {
    let source = kind(bytes, name)?;
    let opened = match source {
        SourceKind::Glb => container::open_glb(bytes, name, folder, import)?,
        SourceKind::Gltf => container::open_gltf(bytes, name, folder, import)?,
        SourceKind::Obj => {
            let found = obj::convert(bytes, name, folder, import)?;
            let own_ids = Some((found.position_ids, found.position_count));
            return Ok(Opened {
                document: found.document,
                own_ids,
                findings: found.findings,
                files: found.files,
                source,
            });
        }
    };
    Ok(Opened { document: opened.document, own_ids: None, findings: opened.findings, files: opened.files, source })
}
