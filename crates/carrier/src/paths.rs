//! URIs and paths inside assets, resolved safely: a file may only name what lies in the asset's own
//! folder or in a folder that a person allowed by `--search`.

use crate::CarrierError;
use percent_encoding::percent_decode_str;
use std::borrow::Cow;
use std::path::{Component, Path, PathBuf};

/// The file that a relative, percent-encoded URI or path in `file` means: inside `folder` (`""` is
/// the current one), or inside one of `search`. Windows' backslashes are taken for slashes; where no
/// file has exactly this name, one that differs only in case is taken (the first by its bytes).
/// Nothing there at all is no error: the path where it should lie comes back.
///
/// # Errors
/// [`CarrierError::Input`] for absolute paths, URIs with a scheme, and for `..` and links that leave
/// all these folders.
pub fn resolve(uri: &str, folder: &Path, search: &[String], file: &str) -> Result<PathBuf, CarrierError> {
    resolve_at(uri, folder, search, file, "")
}

/// As [`resolve`], with the place in `file` for messages.
pub(crate) fn resolve_at(
    uri: &str,
    folder: &Path,
    search: &[String],
    file: &str,
    place: &str,
) -> Result<PathBuf, CarrierError> {
    let refuse = |why: &str| {
        let remedy = "put it beside the asset and name it relatively, or allow its folder with --search FOLDER";
        CarrierError::input(file, place, format!("{uri:?} {why}"), remedy)
    };
    if let Some(scheme) = scheme(uri) {
        let problem = format!("{uri:?} is a {scheme}: URI, and foliar reads files by relative paths only");
        return Err(CarrierError::input(file, place, problem, "save the file beside the asset and name it relatively"));
    }
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let searched: Vec<&Path> = search.iter().map(Path::new).collect();
    let mut outside = false;
    for spelled in spellings(uri) {
        let absolute = is_absolute(&spelled);
        let bases = searched.iter().copied();
        let bases: Vec<&Path> = if absolute { bases.collect() } else { std::iter::once(folder).chain(bases).collect() };
        let whole = bases.iter().filter_map(|base| locate(base, &spelled));
        let by_name = searched.iter().filter_map(|base| locate(base, last_name(&spelled)));
        for found in whole.chain(by_name) {
            if is_inside(&found, &bases) {
                return Ok(found);
            }
            outside = true;
        }
        if absolute {
            return Err(refuse("is an absolute path"));
        }
        if leaves(&spelled) {
            return Err(refuse("leaves the asset's folder"));
        }
    }
    if outside {
        return Err(refuse("leads out of the asset's folder through a link"));
    }
    Ok(folder.join(spellings(uri).swap_remove(0)))
}

/// The scheme of a URI; one letter is a Windows drive, not a scheme.
fn scheme(uri: &str) -> Option<&str> {
    let (scheme, _) = uri.split_once(':')?;
    let allowed = |c: char| c.is_ascii_alphanumeric() || matches!(c, '+' | '-' | '.');
    let is_scheme = scheme.len() > 1 && scheme.starts_with(|c: char| c.is_ascii_alphabetic());
    (is_scheme && scheme.chars().all(allowed)).then_some(scheme)
}

/// The path percent-decoded, and as it is where that differs (a file may be called `50%25.png`).
fn spellings(uri: &str) -> Vec<String> {
    let decoded = percent_decode_str(uri).decode_utf8().unwrap_or(Cow::Borrowed(uri));
    let mut spelled = vec![decoded.replace('\\', "/"), uri.replace('\\', "/")];
    spelled.dedup();
    spelled
}

fn is_absolute(path: &str) -> bool {
    path.starts_with('/') || path.as_bytes().get(1) == Some(&b':')
}

fn last_name(path: &str) -> &str {
    path.rsplit('/').next().unwrap_or(path)
}

/// Whether `..` climbs above the start.
fn leaves(path: &str) -> bool {
    let mut depth = 0i64;
    Path::new(path).components().any(|component| {
        match component {
            Component::ParentDir => depth -= 1,
            Component::Normal(_) => depth += 1,
            _ => {}
        }
        depth < 0
    })
}

/// The existing file at `base`/`path`, by its exact name or, part by part, ignoring case.
fn locate(base: &Path, path: &str) -> Option<PathBuf> {
    if path.is_empty() {
        return None;
    }
    let exact = base.join(path);
    if exact.exists() {
        return Some(exact);
    }
    if is_absolute(path) {
        return None;
    }
    path.split('/').filter(|part| !part.is_empty()).try_fold(base.to_path_buf(), |at, part| child(&at, part))
}

fn child(folder: &Path, name: &str) -> Option<PathBuf> {
    let exact = folder.join(name);
    if exact.exists() {
        return Some(exact);
    }
    let alike = |found: &std::ffi::OsStr| found.to_str().is_some_and(|f| f.to_lowercase() == name.to_lowercase());
    let names = std::fs::read_dir(folder).ok()?.filter_map(Result::ok).map(|entry| entry.file_name());
    names.filter(|found| alike(found)).min().map(|found| folder.join(found))
}

/// Whether a file lies in one of the folders after every link is followed.
fn is_inside(file: &Path, folders: &[&Path]) -> bool {
    let Ok(real) = file.canonicalize() else { return false };
    folders.iter().filter_map(|f| f.canonicalize().ok()).any(|folder| real.starts_with(folder))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// asset/{leaf.png, Textures/Bark.PNG, a b.png}, elsewhere/oak.png
    fn folders() -> (tempfile::TempDir, PathBuf, String) {
        let root = tempfile::tempdir().unwrap();
        let asset = root.path().join("asset");
        let elsewhere = root.path().join("elsewhere");
        std::fs::create_dir_all(asset.join("Textures")).unwrap();
        std::fs::create_dir_all(&elsewhere).unwrap();
        for file in ["leaf.png", "Textures/Bark.PNG", "a b.png", "50%25.png"] {
            std::fs::write(asset.join(file), b"x").unwrap();
        }
        std::fs::write(elsewhere.join("oak.png"), b"x").unwrap();
        let elsewhere = elsewhere.to_str().unwrap().to_string();
        (root, asset, elsewhere)
    }

    #[test]
    fn what_lies_inside_is_found_by_any_spelling() {
        let (_root, asset, _) = folders();
        for (uri, found) in [
            ("leaf.png", "leaf.png"),
            ("./Textures/../leaf.png", "./Textures/../leaf.png"),
            ("a%20b.png", "a b.png"),
            ("50%25.png", "50%25.png"),
            ("textures\\bark.png", "Textures/Bark.PNG"),
            ("LEAF.PNG", "leaf.png"),
        ] {
            assert_eq!(resolve(uri, &asset, &[], "t.mtl").unwrap(), asset.join(found), "{uri}");
        }
    }

    #[test]
    fn what_is_missing_is_no_error() {
        let (_root, asset, _) = folders();
        assert_eq!(resolve("none.png", &asset, &[], "t.mtl").unwrap(), asset.join("none.png"));
    }

    #[test]
    fn what_leaves_is_refused_with_its_name_and_the_flag() {
        let (root, asset, elsewhere) = folders();
        let absolute = asset.join("leaf.png").to_str().unwrap().to_string();
        for uri in [
            "/etc/hostname",
            absolute.as_str(),
            "C:\\trees\\oak.png",
            "\\\\server\\oak.png",
            "../elsewhere/oak.png",
            "Textures/../../elsewhere/oak.png",
            "%2e%2e/elsewhere/oak.png",
            "../none.png",
            "file:///etc/hostname",
            "https://example.org/oak.png",
        ] {
            let error = resolve(uri, &asset, &[], "t.mtl").unwrap_err().to_string();
            let remedy = if uri.contains("://") { "save the file beside the asset" } else { "--search" };
            assert!(error.contains("t.mtl") && error.contains(remedy) && !error.contains("link"), "{uri}: {error}");
            assert!(error.contains(&format!("{uri:?}")), "{error}");
        }
        drop((root, elsewhere));
    }

    #[test]
    fn a_searched_folder_allows_what_lies_in_it() {
        let (_root, asset, elsewhere) = folders();
        let search = [elsewhere.clone()];
        let oak = format!("{elsewhere}/oak.png");
        for uri in ["oak.png", "../elsewhere/oak.png", &oak, "C:\\trees\\oak.png", "maps/oak.png"] {
            let found = resolve(uri, &asset, &search, "t.mtl").unwrap();
            assert_eq!(found.canonicalize().unwrap(), Path::new(&oak).canonicalize().unwrap(), "{uri}");
        }
        assert!(resolve("/etc/hostname", &asset, &search, "t.mtl").is_err());
        assert!(resolve("https://example.org/oak.png", &asset, &search, "t.mtl").is_err());
    }

    #[cfg(unix)]
    #[test]
    fn a_link_that_leaves_is_refused() {
        let (_root, asset, elsewhere) = folders();
        std::os::unix::fs::symlink(format!("{elsewhere}/oak.png"), asset.join("linked.png")).unwrap();
        let error = resolve("linked.png", &asset, &[], "t.mtl").unwrap_err().to_string();
        assert!(error.contains("link"), "{error}");
        assert!(resolve("linked.png", &asset, &[elsewhere], "t.mtl").is_ok());
    }
}
