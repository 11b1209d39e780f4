//! Papers that comments and documents name resolve in docs/references.md.

use super::source::{Kind, only};
use crate::repo;
use anyhow::Result;

const LIST: &str = "docs/references.md";
/// Words that look like a key and are none.
const WORDS: [&str; 9] = ["Base64", "Utf16", "Utf32", "Float32", "Float64", "Int32", "Uint32", "Png16", "Crc32"];

/// Complaints about all Rust files and documents.
pub fn check(files: &[String]) -> Result<Vec<String>> {
    let list = repo::text(LIST).unwrap_or_default();
    let mut complaints = Vec::new();
    for file in files.iter().filter(|f| *f != LIST && (f.ends_with(".rs") || f.ends_with(".md"))) {
        let text = repo::text(file)?;
        let prose = if file.ends_with(".rs") { only(&text, Kind::Comment) } else { text };
        for (number, line) in prose.lines().enumerate().map(|(i, l)| (i + 1, l)) {
            let missing = keys(line).into_iter().filter(|key| !resolves(&list, key));
            complaints.extend(missing.map(|key| format!("{file}:{number}: {key:?} does not resolve in {LIST}")));
        }
    }
    Ok(complaints)
}

/// Keys such as `Luft07`, and authors with a year such as `Runions et al. 2007`.
fn keys(line: &str) -> Vec<String> {
    let words: Vec<&str> = line.split_whitespace().map(|w| w.trim_matches(|c: char| !c.is_alphanumeric())).collect();
    let mut keys: Vec<String> = words.iter().filter(|w| is_key(w)).map(|w| (*w).to_string()).collect();
    for (index, year) in words.iter().enumerate().filter(|(_, w)| is_year(w)) {
        let author = match &words[..index] {
            [.., author, "et", "al"] | [.., author] => author,
            [] => continue,
        };
        if author.len() > 2
            && author.chars().all(char::is_alphabetic)
            && author.starts_with(char::is_uppercase)
            && !MONTHS.contains(author)
        {
            keys.push(format!("{author} {year}"));
        }
    }
    keys
}

const MONTHS: [&str; 12] = [
    "January",
    "February",
    "March",
    "April",
    "May",
    "June",
    "July",
    "August",
    "September",
    "October",
    "November",
    "December",
];

fn is_key(word: &str) -> bool {
    let letters = word.trim_end_matches(|c: char| c.is_ascii_digit());
    word.len() == letters.len() + 2
        && letters.len() >= 3
        && letters.starts_with(|c: char| c.is_ascii_uppercase())
        && letters.chars().skip(1).all(|c| c.is_ascii_lowercase())
        && !WORDS.contains(&word)
}

fn is_year(word: &str) -> bool {
    word.len() == 4 && word.chars().all(|c| c.is_ascii_digit()) && (word.starts_with("19") || word.starts_with("20"))
}

fn resolves(list: &str, key: &str) -> bool {
    list.lines().any(|line| key.split(' ').all(|part| line.contains(part)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_and_years_are_found() {
        assert_eq!(
            keys("// Luft07 eq. 4, (Neumaier 1974), Runions et al. 2007."),
            ["Luft07", "Neumaier 1974", "Runions 2007"]
        );
        assert!(keys("// 960 x 720, Vec3, UTF-16, 2000 leaves, May 2007").is_empty());
    }

    #[test]
    fn a_key_resolves_on_one_line() {
        assert!(resolves("- Neumaier, A. 1974. Sums.", "Neumaier 1974"));
        assert!(!resolves("- Neumaier, A.\n- 1974", "Neumaier 1974"));
    }
}
