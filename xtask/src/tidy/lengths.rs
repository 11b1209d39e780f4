//! Short files, short functions, short mains, and a first line that says what lives here.

use super::source::{Kind, only};

/// A file stays below this many lines.
const FILE_LINES: usize = 400;
/// A function stays below this many lines.
const FUNCTION_LINES: usize = 60;
/// A program's main file has at most this many lines of code.
const MAIN_LINES: usize = 5;

/// Complaints about one Rust file.
pub fn check(file: &str, text: &str) -> Vec<String> {
    let mut complaints = Vec::new();
    let lines = text.lines().count();
    if lines >= FILE_LINES {
        complaints.push(format!("{file}: {lines} lines, must be below {FILE_LINES}: split it"));
    }
    if !text.starts_with("//! ") {
        complaints.push(format!("{file}:1: the first line must say what lives here (//! ...)"));
    }
    let code = only(text, Kind::Code);
    for (line, name, length) in functions(&code) {
        if length >= FUNCTION_LINES {
            complaints.push(format!("{file}:{line}: fn {name} has {length} lines, must be below {FUNCTION_LINES}"));
        }
    }
    if file.contains("/src/bin/") {
        let lines = code.lines().filter(|l| !l.trim().is_empty()).count();
        if lines > MAIN_LINES {
            complaints.push(format!("{file}: {lines} lines of code, a main has at most {MAIN_LINES}"));
        }
    }
    complaints
}

/// Line, name and number of lines of each function with a body.
fn functions(code: &str) -> Vec<(usize, String, usize)> {
    let mut found = Vec::new();
    for (start, _) in code.match_indices("fn ") {
        let name: String = code[start + 3..].chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
        let word_before = code[..start].chars().next_back().is_some_and(|c| c.is_alphanumeric() || c == '_');
        if word_before || name.is_empty() {
            continue;
        }
        if let Some(body) = body(&code[start..]) {
            let line = code[..start].matches('\n').count() + 1;
            found.push((line, name, code[start..start + body].matches('\n').count() + 1));
        }
    }
    found
}

/// Bytes up to the brace that closes the body; none for a declaration.
fn body(code: &str) -> Option<usize> {
    let (mut round, mut curly) = (0, 0);
    for (index, c) in code.char_indices() {
        match c {
            '(' | '[' => round += 1,
            ')' | ']' => round -= 1,
            ';' if round == 0 && curly == 0 => return None,
            '{' => curly += 1,
            '}' => curly -= 1,
            _ => {}
        }
        if c == '}' && curly == 0 {
            return Some(index);
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_are_counted_over_the_body() {
        let code = "trait T { fn f(&self); }\nfn g(a: [u8; 3]) {\n  if a { }\n}\n";
        assert_eq!(functions(code), [(2, "g".into(), 3)]);
    }

    #[test]
    fn long_functions_and_missing_first_lines_are_told() {
        let text = format!("fn long() {{\n{}}}\n", "    x();\n".repeat(FUNCTION_LINES));
        assert_eq!(check("crates/x/src/lib.rs", &text).len(), 2);
    }
}
