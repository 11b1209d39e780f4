//! Bytes to a document: the containers .glb and .gltf, their lengths checked before anything is
//! taken, and the buffers that the JSON names (glTF 2.0 section 4.4 and chapter 5).

use crate::document::index_of;
use crate::{CarrierError, Document, paths};
use base64::Engine;
use base64::alphabet;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};
use foliar_schema::{Finding, Import, code};
use serde_json::Value;
use std::path::{Path, PathBuf};

/// First four bytes of a GLB.
pub(crate) const GLB_MAGIC: &[u8; 4] = b"glTF";
/// Type of the first chunk.
pub(crate) const CHUNK_JSON: &[u8; 4] = b"JSON";
/// Type of the second chunk.
pub(crate) const CHUNK_BIN: &[u8; 4] = b"BIN\0";
const HEADER_LENGTH: usize = 12;
const CHUNK_HEADER_LENGTH: usize = 8;
const EXPORT_AGAIN: &str = "export or download it again";
/// Decodes what gltf-transform knows and writes it plain; tried with its version 4.
const DECODE_COMMAND: &str = "decode it first with `npx @gltf-transform/cli copy IN.glb OUT.glb`";

/// Base64 as data URIs have it in the wild: padded or not.
const BASE64: GeneralPurpose = GeneralPurpose::new(
    &alphabet::STANDARD,
    GeneralPurposeConfig::new()
        .with_decode_padding_mode(DecodePaddingMode::Indifferent)
        .with_decode_allow_trailing_bits(true),
);

/// A document as it came out of its container.
pub(crate) struct Opened {
    pub document: Document,
    pub findings: Vec<Finding>,
    pub files: Vec<PathBuf>,
}

/// Opens a GLB.
pub(crate) fn open_glb(bytes: &[u8], file: &str, folder: &Path, import: &Import) -> Result<Opened, CarrierError> {
    let (json, bin, mut findings) = split_glb(bytes, file)?;
    let json = parse_json(json, file)?;
    let mut opened = load(json, Some(bin), file, folder, import)?;
    opened.findings.append(&mut findings);
    Ok(opened)
}

/// Opens a glTF in JSON.
pub(crate) fn open_gltf(bytes: &[u8], file: &str, folder: &Path, import: &Import) -> Result<Opened, CarrierError> {
    load(parse_json(bytes, file)?, None, file, folder, import)
}

fn load(json: Value, bin: Option<&[u8]>, file: &str, folder: &Path, import: &Import) -> Result<Opened, CarrierError> {
    check_version(&json, file)?;
    check_compression(&json, file)?;
    let mut document = Document { json, folder: Some(folder.to_path_buf()), ..Document::default() };
    let mut files = Vec::new();
    let mut buffers = Vec::new();
    for index in 0..document.list("buffers").len() {
        let source = BufferSource { index, bin, file, folder, import };
        buffers.push(source.load(&document.list("buffers")[index], &mut files)?);
    }
    document.buffers = buffers;
    Ok(Opened { document, findings: Vec::new(), files })
}

type Split<'a> = (&'a [u8], &'a [u8], Vec<Finding>);

/// The JSON and BIN chunks of a GLB.
pub(crate) fn split_glb<'a>(bytes: &'a [u8], file: &str) -> Result<Split<'a>, CarrierError> {
    let fail = |place: &str, problem: String, remedy: &str| Err(CarrierError::input(file, place, problem, remedy));
    if bytes.len() < HEADER_LENGTH {
        return fail("byte 0", format!("{} bytes are no GLB header (12)", bytes.len()), EXPORT_AGAIN);
    }
    let version = word(bytes, 4);
    if version != 2 {
        return fail("byte 4", format!("GLB version {version}"), "version 2 is read: export it as glTF 2.0");
    }
    let length = word(bytes, 8) as usize;
    if length != bytes.len() {
        let problem = format!("the header says {length} bytes, the file has {}", bytes.len());
        return fail("byte 8", problem, EXPORT_AGAIN);
    }
    let mut chunks = Vec::new();
    let mut offset = HEADER_LENGTH;
    while offset < bytes.len() {
        let Some(end) = chunk_end(bytes, offset) else {
            let left = bytes.len() - offset;
            return fail(
                &format!("byte {offset}"),
                format!("a chunk does not fit the {left} bytes left"),
                EXPORT_AGAIN,
            );
        };
        chunks.push((&bytes[offset + 4..offset + 8], &bytes[offset + CHUNK_HEADER_LENGTH..end]));
        offset = end;
    }
    let Some((_, json)) = chunks.first().filter(|(kind, _)| kind == CHUNK_JSON) else {
        return fail("byte 12", "the first chunk is not JSON".into(), EXPORT_AGAIN);
    };
    let bin = chunks.get(1).filter(|(kind, _)| kind == CHUNK_BIN);
    let known = 1 + usize::from(bin.is_some());
    let findings = (chunks.len() > known).then(|| {
        let count = chunks.len() - known;
        Finding::new(&code::IMPORT_IGNORED, format!("{count} GLB chunks beside JSON and BIN were left out"))
            .in_file(file)
    });
    Ok((json, bin.map_or(&[], |(_, data)| data), findings.into_iter().collect()))
}

/// Where the bytes of the second chunk start, behind a JSON chunk of so many bytes.
pub(crate) fn bin_start(json: usize) -> usize {
    HEADER_LENGTH + CHUNK_HEADER_LENGTH + json + CHUNK_HEADER_LENGTH
}

fn word(bytes: &[u8], offset: usize) -> u32 {
    u32::from_le_bytes([bytes[offset], bytes[offset + 1], bytes[offset + 2], bytes[offset + 3]])
}

/// Where the chunk at `offset` ends; `None` where that lies past the bytes.
fn chunk_end(bytes: &[u8], offset: usize) -> Option<usize> {
    let start = offset + CHUNK_HEADER_LENGTH;
    let end = (start <= bytes.len()).then(|| start.checked_add(word(bytes, offset) as usize))??;
    (end <= bytes.len()).then_some(end)
}

/// Parses JSON, a UTF-8 byte order mark allowed.
pub(crate) fn parse_json(bytes: &[u8], file: &str) -> Result<Value, CarrierError> {
    let text = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    let json: Value = serde_json::from_slice(text).map_err(|error| {
        let place = format!("line {} column {}", error.line(), error.column());
        CarrierError::input(file, place, format!("no JSON ({error})"), EXPORT_AGAIN)
    })?;
    if json.is_object() { Ok(json) } else { Err(CarrierError::input(file, "", "the JSON is no object", EXPORT_AGAIN)) }
}

pub(crate) fn check_version(json: &Value, file: &str) -> Result<(), CarrierError> {
    let version = json.pointer("/asset/version").and_then(Value::as_str).unwrap_or("");
    if version.starts_with("2.") {
        return Ok(());
    }
    let problem = format!("glTF version {version:?}");
    Err(CarrierError::input(file, "/asset/version", problem, "version \"2.0\" is read: export it as glTF 2.0"))
}

/// Refuses geometry that only a decoder can read. Draco also where plain accessors stand beside it:
/// loaders prefer the compressed vertices, whose order differs from theirs.
pub(crate) fn check_compression(json: &Value, file: &str) -> Result<(), CarrierError> {
    const DRACO: &str = "KHR_draco_mesh_compression";
    const MESHOPT: &str = "EXT_meshopt_compression";
    let items = |value: &Value, key: &str| value.get(key).and_then(Value::as_array).cloned().unwrap_or_default();
    for (m, mesh) in items(json, "meshes").iter().enumerate() {
        for (p, primitive) in items(mesh, "primitives").iter().enumerate() {
            if primitive.pointer("/extensions").and_then(|e| e.get(DRACO)).is_some() {
                let place = format!("/meshes/{m}/primitives/{p}");
                return Err(CarrierError::input(file, place, format!("{DRACO} is in use"), DECODE_COMMAND));
            }
        }
    }
    for (b, buffer) in items(json, "buffers").iter().enumerate() {
        let fallback = buffer.get("extensions").and_then(|e| e.get(MESHOPT)).and_then(|e| e.get("fallback"));
        if fallback == Some(&Value::Bool(true)) && buffer.get("uri").is_none() {
            let problem = format!("{MESHOPT} is in use and its fallback buffer holds no data");
            return Err(CarrierError::input(file, format!("/buffers/{b}"), problem, DECODE_COMMAND));
        }
    }
    Ok(())
}

/// Where one buffer's bytes come from.
pub(crate) struct BufferSource<'a> {
    pub index: usize,
    pub bin: Option<&'a [u8]>,
    pub file: &'a str,
    pub folder: &'a Path,
    pub import: &'a Import,
}

impl BufferSource<'_> {
    pub fn load(&self, buffer: &Value, files: &mut Vec<PathBuf>) -> Result<Vec<u8>, CarrierError> {
        let place = format!("/buffers/{}", self.index);
        let fail = |problem: String, remedy: &str| Err(CarrierError::input(self.file, place.clone(), problem, remedy));
        let Some(length) = index_of(buffer, "byteLength") else {
            return fail("byteLength is missing or no whole number".into(), EXPORT_AGAIN);
        };
        let mut bytes = match (buffer.get("uri").and_then(Value::as_str), self.bin) {
            (Some(uri), _) => read_uri(uri, &place, self.file, self.folder, self.import, files)?,
            (None, Some(bin)) if self.index == 0 => {
                // Cut before it is copied: the chunk may be longer by its padding.
                bin[..length.min(bin.len())].to_vec()
            }
            (None, _) => return fail("it has neither uri nor chunk".into(), EXPORT_AGAIN),
        };
        if bytes.len() < length {
            return fail(format!("byteLength is {length}, there are {} bytes", bytes.len()), EXPORT_AGAIN);
        }
        bytes.truncate(length);
        Ok(bytes)
    }
}

/// The bytes of a data URI or of a file beside the asset; files that were read join `files`.
pub(crate) fn read_uri(
    uri: &str,
    place: &str,
    file: &str,
    folder: &Path,
    import: &Import,
    files: &mut Vec<PathBuf>,
) -> Result<Vec<u8>, CarrierError> {
    if let Some(data) = uri.strip_prefix("data:") {
        return decode_data_uri(data).map_err(|problem| CarrierError::input(file, place, problem, EXPORT_AGAIN));
    }
    let path = paths::resolve_at(uri, folder, &import.search, file, place)?;
    let bytes = std::fs::read(&path).map_err(|source| CarrierError::Open {
        file: path.display().to_string(),
        source,
        remedy: format!("{file} names it at {place}: put it there, or name its folder with --search"),
    })?;
    files.push(path);
    Ok(bytes)
}

/// What stands after `data:`.
fn decode_data_uri(data: &str) -> Result<Vec<u8>, String> {
    let Some((kind, payload)) = data.split_once(',') else { return Err("a data URI has no comma".into()) };
    if kind.ends_with(";base64") {
        return BASE64.decode(payload).map_err(|error| format!("the data URI is no base64: {error}"));
    }
    Ok(percent_encoding::percent_decode_str(payload).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn data_uris_of_both_kinds_decode() {
        assert_eq!(decode_data_uri("application/octet-stream;base64,AAEC").unwrap(), [0, 1, 2]);
        assert_eq!(decode_data_uri("application/octet-stream;base64,AAE").unwrap(), [0, 1], "padding may be missing");
        assert_eq!(decode_data_uri(",a%00").unwrap(), [b'a', 0]);
        assert!(decode_data_uri("none").is_err());
        assert!(decode_data_uri(";base64,***").is_err());
    }

    #[test]
    fn a_version_1_header_says_what_would_be_right() {
        let mut bytes = b"glTF".to_vec();
        bytes.extend([1, 0, 0, 0, 12, 0, 0, 0]);
        let error = split_glb(&bytes, "a.glb").unwrap_err().to_string();
        assert!(error.contains("a.glb, byte 4: GLB version 1") && error.contains("2.0"), "{error}");
    }
}
