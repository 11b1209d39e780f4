//! Writing: the bytes of .glb and .gltf, and files that appear complete or not at all.

use crate::{CarrierError, Document, Outcome, OutputFile, container, pictures, rebase, sides};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde_json::Value;
use std::io::Write;
use std::path::{Path, PathBuf};

/// A step of writing, for [`write_files_with`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    /// A temporary file is about to be made.
    Create,
    /// Half of its bytes are written.
    Half,
    /// It is about to be flushed to the disk.
    Sync,
    /// It is about to take its target's place.
    Rename,
}

/// The files of a document at `path`.
pub(crate) fn encode(document: &Document, path: &Path) -> Result<Vec<OutputFile>, CarrierError> {
    let is_gltf = rebase::is_gltf(path);
    // A .gltf that stays in its folder names its pictures as it did, wherever they lie.
    let stays = is_gltf && !rebase::moves(document, path);
    let mut document = if stays { document.clone() } else { pictures::take_along(document, path)? };
    rebase::move_to(&mut document, path)?;
    let mut files = sides::files(&mut document, path);
    if !is_gltf {
        files.push(OutputFile { path: path.into(), bytes: glb(document, &path.display().to_string())? });
        return Ok(files);
    }
    if !document.buffers.is_empty() {
        let bin = path.with_extension("bin");
        let name = bin.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
        set_uri(&mut document.json, 0, Some(rebase::encode_uri(&name)));
        files.push(OutputFile { path: bin, bytes: std::mem::take(&mut document.buffers[0]) });
    }
    for index in 1..document.buffers.len() {
        let uri = document.json["buffers"][index].get("uri").and_then(Value::as_str);
        if uri.is_none_or(|uri| !stays && uri.starts_with("..")) {
            let uri = data_uri(&document.buffers[index]);
            set_uri(&mut document.json, index, Some(uri));
        }
    }
    files.push(OutputFile { path: path.into(), bytes: document.json.to_string().into_bytes() });
    Ok(files)
}

/// One GLB: the first buffer becomes the BIN chunk, further ones data URIs.
pub(crate) fn glb(mut document: Document, file: &str) -> Result<Vec<u8>, CarrierError> {
    if !document.buffers.is_empty() {
        set_uri(&mut document.json, 0, None);
    }
    for index in 1..document.buffers.len() {
        let uri = data_uri(&document.buffers[index]);
        set_uri(&mut document.json, index, Some(uri));
    }
    let mut json = document.json.to_string().into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    let bin = document.buffers.first().map(Vec::as_slice).filter(|b| !b.is_empty());
    let bin_length = bin.map_or(0, |b| 8 + b.len().next_multiple_of(4));
    let total = 12 + 8 + json.len() + bin_length;
    let Ok(total_word) = u32::try_from(total) else {
        return Err(CarrierError::input(file, "", format!("{total} bytes do not fit a GLB (4 GiB)"), "write .gltf"));
    };
    let mut out = Vec::with_capacity(total);
    out.extend(container::GLB_MAGIC);
    out.extend(2u32.to_le_bytes());
    out.extend(total_word.to_le_bytes());
    out.extend((json.len() as u32).to_le_bytes());
    out.extend(container::CHUNK_JSON);
    out.extend(json);
    if let Some(bin) = bin {
        out.extend((bin.len().next_multiple_of(4) as u32).to_le_bytes());
        out.extend(container::CHUNK_BIN);
        out.extend(bin);
        out.resize(total, 0);
    }
    Ok(out)
}

fn data_uri(bytes: &[u8]) -> String {
    format!("data:application/octet-stream;base64,{}", STANDARD.encode(bytes))
}

/// Sets or takes the URI of a buffer, the other members in their order.
fn set_uri(json: &mut Value, index: usize, uri: Option<String>) {
    let Some(buffer) = json["buffers"].get_mut(index).and_then(Value::as_object_mut) else { return };
    match uri {
        Some(uri) => {
            buffer.insert("uri".into(), uri.into());
        }
        None => {
            buffer.shift_remove("uri");
        }
    }
}

/// Keeps `byteLength` of every buffer equal to its bytes.
pub(crate) fn set_byte_lengths(document: &mut Document) {
    let list = document.json.get_mut("buffers").and_then(Value::as_array_mut);
    for (buffer, bytes) in list.into_iter().flatten().zip(&document.buffers) {
        if let Some(buffer) = buffer.as_object_mut() {
            buffer.insert("byteLength".into(), bytes.len().into());
        }
    }
}

/// Whether all files are on disk already, byte for byte.
pub(crate) fn is_unchanged(files: &[OutputFile]) -> bool {
    files.iter().all(|file| {
        let same_length =
            std::fs::metadata(&file.path).is_ok_and(|m| m.is_file() && m.len() == file.bytes.len() as u64);
        same_length && std::fs::read(&file.path).is_ok_and(|old| old == file.bytes)
    })
}

/// `write_files` with a hook before each step, whose error stops it there: how tests prove that a
/// full disk or a kill at any moment leaves the old output whole.
///
/// # Errors
/// [`CarrierError::Output`].
pub fn write_files_with(
    files: &[OutputFile],
    hook: &mut dyn FnMut(&Path, Step) -> std::io::Result<()>,
) -> Result<Outcome, CarrierError> {
    let changed: Vec<&OutputFile> = files.iter().filter(|file| !is_unchanged(std::slice::from_ref(*file))).collect();
    if changed.is_empty() {
        return Ok(Outcome::Unchanged);
    }
    let made = sides::make_folders(&changed).map_err(|(path, source)| output_error(&path, source))?;
    let outcome = put_in_place(changed, hook);
    if outcome.is_err() {
        sides::remove_folders(&made);
    }
    outcome
}

fn put_in_place(
    changed: Vec<&OutputFile>,
    hook: &mut dyn FnMut(&Path, Step) -> std::io::Result<()>,
) -> Result<Outcome, CarrierError> {
    let mut ready = Vec::new();
    for file in changed {
        let made = stage(file, hook).map_err(|source| output_error(&file.path, source))?;
        ready.extend(made.map(|(temporary, target)| (temporary, target, &file.path)));
    }
    for (temporary, target, named) in ready {
        hook(named, Step::Rename).map_err(|source| output_error(named, source))?;
        temporary.persist(&target).map_err(|error| output_error(named, error.error))?;
        sync_folder(&target);
    }
    Ok(Outcome::Written)
}

pub(crate) fn write_files(files: &[OutputFile]) -> Result<Outcome, CarrierError> {
    write_files_with(files, &mut |_, _| Ok(()))
}

type Staged = Option<(tempfile::NamedTempFile, PathBuf)>;

/// Writes one file beside its target. What is no regular file (a device, a pipe) cannot be renamed
/// over: it is written straight away, and nothing is staged.
fn stage(file: &OutputFile, hook: &mut dyn FnMut(&Path, Step) -> std::io::Result<()>) -> std::io::Result<Staged> {
    // A link keeps pointing where it points: its target is replaced.
    let target = std::fs::canonicalize(&file.path).unwrap_or_else(|_| file.path.clone());
    if let Ok(old) = std::fs::metadata(&target) {
        if !old.is_file() && !old.is_dir() {
            return std::fs::OpenOptions::new().write(true).open(&target)?.write_all(&file.bytes).map(|()| None);
        }
        if old.is_dir() {
            return Err(std::io::ErrorKind::IsADirectory.into());
        }
        if old.permissions().readonly() {
            return Err(std::io::ErrorKind::PermissionDenied.into());
        }
    }
    hook(&file.path, Step::Create)?;
    let folder = target.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut temporary = temporary_for(&target, folder)?;
    let (front, back) = file.bytes.split_at(file.bytes.len() / 2);
    temporary.write_all(front)?;
    hook(&file.path, Step::Half)?;
    temporary.write_all(back)?;
    hook(&file.path, Step::Sync)?;
    temporary.as_file().sync_all()?;
    Ok(Some((temporary, target)))
}

/// A temporary file whose mode is what the umask leaves of 0666, as for any new file. It is named for
/// its target and its process, so that what a killed process left can be told from work in progress.
fn temporary_for(target: &Path, folder: &Path) -> std::io::Result<tempfile::NamedTempFile> {
    let front = format!(".{}.foliar-", target.file_name().unwrap_or_default().to_string_lossy());
    remove_leftovers(folder, &front);
    let prefix = format!("{front}{}-", std::process::id());
    let mut builder = tempfile::Builder::new();
    builder.prefix(&prefix).suffix(".part");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(std::fs::Permissions::from_mode(0o666));
    }
    builder.tempfile_in(folder)
}

/// Removes temporary files of processes that are gone, where the system tells (`/proc`). What cannot
/// be removed is in nobody's way.
fn remove_leftovers(folder: &Path, front: &str) {
    if !Path::new("/proc/self").exists() {
        return;
    }
    for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
        let name = entry.file_name().to_string_lossy().into_owned();
        let process = name.strip_prefix(front).and_then(|rest| rest.split_once('-')?.0.parse::<u32>().ok());
        if process.is_some_and(|id| !Path::new(&format!("/proc/{id}")).exists()) {
            let _ = std::fs::remove_file(entry.path());
        }
    }
}

/// Makes the rename itself durable, where the system can.
fn sync_folder(target: &Path) {
    let folder = target.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let _ = std::fs::File::open(folder).and_then(|f| f.sync_all());
}

fn output_error(path: &Path, source: std::io::Error) -> CarrierError {
    use std::io::ErrorKind;
    let remedy = match source.kind() {
        ErrorKind::PermissionDenied | ErrorKind::ReadOnlyFilesystem => {
            "make the file and its folder writable, or choose another output"
        }
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded | ErrorKind::FileTooLarge => {
            "free some space, or choose another output"
        }
        ErrorKind::NotFound => "create the folder first, or choose another output",
        ErrorKind::IsADirectory => "name a file, not a folder",
        _ => "choose another output",
    };
    CarrierError::Output { file: path.display().to_string(), source, remedy: remedy.into() }
}
