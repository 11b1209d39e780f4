//! What may lie at the top, and what no committed text may say.

/// Entries of the top level beside dotfiles.
const TOP: [&str; 10] = [
    "Cargo.toml",
    "Cargo.lock",
    "crates",
    "xtask",
    "fixtures",
    "tests",
    "docs",
    "README.md",
    "CHANGELOG.md",
    "LICENSE-",
];

/// Hosts that texts may name: where a standard or a paper lives, and those reserved for examples.
const HOSTS: [&str; 11] = [
    "json-schema.org",
    "json.schemastore.org",
    "doi.org",
    "www.w3.org",
    "github.com/KhronosGroup",
    "registry.khronos.org",
    "example.com",
    "example.org",
    "example.invalid",
    "localhost",
    "127.0.0.1",
];

/// Starts of paths that exist on one machine only.
const PLACES: [&str; 5] = ["/work/", "/home/", "/root/", "/Users/", "C:\\Users"];

/// Complaints about entries of the top level.
pub fn top_level(files: &[String]) -> Vec<String> {
    let mut tops: Vec<&str> = files.iter().filter_map(|f| f.split('/').next()).collect();
    tops.dedup();
    tops.retain(|top| !top.starts_with('.') && !TOP.contains(top) && !top.starts_with("LICENSE-"));
    tops.iter().map(|top| format!("{top}: the top level holds {} and dotfiles only", TOP.join(", "))).collect()
}

/// Complaints about one text.
pub fn check(file: &str, text: &str) -> Vec<String> {
    // Licenses and the lock file are not ours to word; this file lists what it forbids.
    if file.starts_with("LICENSE-") || file.ends_with("Cargo.lock") || file == "xtask/src/tidy/texts.rs" {
        return Vec::new();
    }
    let mut complaints = Vec::new();
    for (number, line) in text.lines().enumerate().map(|(i, l)| (i + 1, l)) {
        if let Some(place) = PLACES.iter().find(|p| line.contains(**p)) {
            complaints.push(format!("{file}:{number}: names {place}, a place on one machine"));
        }
        for (at, _) in line.match_indices("://") {
            let scheme = line[..at].chars().next_back();
            let host = line[at + 3..].split(['"', '>', ')', ' ', '`']).next().unwrap_or_default();
            if scheme.is_some_and(|c| c == 'p' || c == 's')
                && !HOSTS.iter().any(|h| host.starts_with(h))
                && !host.is_empty()
            {
                complaints.push(format!("{file}:{number}: names the host {host:?}; allowed are {}", HOSTS.join(", ")));
            }
        }
    }
    complaints
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_and_hosts_are_told() {
        let text = "see /home/me/x\nsee https://registry.example.net/a and https://doi.org/10.1 and file://x";
        assert_eq!(check("docs/a.md", text).len(), 2, "{:?}", check("docs/a.md", text));
    }

    #[test]
    fn strange_entries_at_the_top_are_told() {
        let files = [".ci/run", "Cargo.toml", "gates.toml", "LICENSE-MIT"].map(String::from);
        assert_eq!(top_level(&files).len(), 1);
    }
}
