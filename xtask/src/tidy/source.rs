//! Just enough of Rust's grammar to tell code, comments and strings apart.

/// What a character of a source file belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Code.
    Code,
    /// A comment, doc comments included.
    Comment,
    /// The inside of a string literal.
    Text,
}

/// The characters of a source file, each with what it belongs to.
pub fn classify(source: &str) -> Vec<(char, Kind)> {
    let chars: Vec<char> = source.chars().collect();
    let mut out = Vec::with_capacity(chars.len());
    let mut at = 0;
    while at < chars.len() {
        let (end, kind) = token(&chars, at);
        out.extend(chars[at..end].iter().map(|&c| (c, kind)));
        at = end;
    }
    out
}

/// The source with everything of other kinds turned to spaces, line for line.
pub fn only(source: &str, kind: Kind) -> String {
    classify(source).into_iter().map(|(c, k)| if k == kind || c == '\n' { c } else { ' ' }).collect()
}

/// The string literals of a source file, with their line numbers.
pub fn literals(source: &str) -> Vec<(usize, String)> {
    let (mut found, mut line, mut open) = (Vec::new(), 1, None::<(usize, String)>);
    for (c, kind) in classify(source) {
        match (kind, &mut open) {
            (Kind::Text, Some((_, text))) => text.push(c),
            (Kind::Text, None) => open = Some((line, c.to_string())),
            _ => found.extend(open.take()),
        }
        line += usize::from(c == '\n');
    }
    found
}

/// End and kind of what begins at `at`.
fn token(chars: &[char], at: usize) -> (usize, Kind) {
    let ahead = |n: usize| chars.get(at + n).copied().unwrap_or(' ');
    let before = at.checked_sub(1).map_or(' ', |i| chars[i]);
    match (chars[at], ahead(1)) {
        ('/', '/') => (find(chars, at, |i| chars[i] == '\n'), Kind::Comment),
        ('/', '*') => (block_comment(chars, at), Kind::Comment),
        ('r', '"' | '#') if !word(before) || before == 'b' => raw_string(chars, at),
        ('"', _) => (string(chars, at), Kind::Text),
        ('\'', _) => (character(chars, at), Kind::Code),
        _ => (at + 1, Kind::Code),
    }
}

fn word(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

fn find(chars: &[char], from: usize, is: impl Fn(usize) -> bool) -> usize {
    (from..chars.len()).find(|&i| is(i)).unwrap_or(chars.len())
}

fn block_comment(chars: &[char], at: usize) -> usize {
    let (mut depth, mut i) = (0, at);
    while i + 1 < chars.len() {
        match (chars[i], chars[i + 1]) {
            ('/', '*') => (depth, i) = (depth + 1, i + 2),
            ('*', '/') => (depth, i) = (depth - 1, i + 2),
            _ => i += 1,
        }
        if depth == 0 {
            return i;
        }
    }
    chars.len()
}

fn raw_string(chars: &[char], at: usize) -> (usize, Kind) {
    let hashes = chars[at + 1..].iter().take_while(|c| **c == '#').count();
    if chars.get(at + 1 + hashes) != Some(&'"') {
        return (at + 1, Kind::Code);
    }
    let closes = |i: usize| chars[i] == '"' && chars[i + 1..].iter().take_while(|c| **c == '#').count() >= hashes;
    (find(chars, at + hashes + 2, closes) + 1 + hashes, Kind::Text)
}

fn string(chars: &[char], at: usize) -> usize {
    let mut i = at + 1;
    while i < chars.len() && chars[i] != '"' {
        i += if chars[i] == '\\' { 2 } else { 1 };
    }
    (i + 1).min(chars.len())
}

/// A character literal, or only the quote of a lifetime.
fn character(chars: &[char], at: usize) -> usize {
    match (chars.get(at + 1), chars.get(at + 2)) {
        (Some('\\'), _) => find(chars, at + 3, |i| chars[i] == '\'') + 1,
        (Some(_), Some('\'')) => at + 3,
        _ => at + 1,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strings_comments_and_lifetimes_are_told_apart() {
        let source = "let a = \"x // y\"; // \"z\"\nfn f<'a>(c: char) { '\"'; r#\"raw \" { \"#; }";
        assert_eq!(
            literals(source).iter().map(|l| l.1.as_str()).collect::<Vec<_>>(),
            ["\"x // y\"", "r#\"raw \" { \"#"]
        );
        assert_eq!(only(source, Kind::Comment).trim(), "// \"z\"");
        assert_eq!(only(source, Kind::Code).matches('{').count(), 1);
    }
}
