//! What an OBJ or MTL file is as text: byte order marks, UTF-16, binary data, Latin-1 names, line ends.

use crate::CarrierError;
use std::borrow::Cow;

/// UTF-8's byte order mark.
const BOM: &[u8] = b"\xEF\xBB\xBF";

/// How far a file is searched for bytes that no text holds.
const SNIFF_BYTES: usize = 4096;

/// Text as bytes with `\n` at the end of lines (a `\r` before it may remain).
pub(crate) struct Text<'a> {
    /// The bytes without a byte order mark.
    pub bytes: Cow<'a, [u8]>,
    /// Whether there was a byte order mark.
    pub had_bom: bool,
}

/// Takes a byte order mark off and refuses what is no 8-bit text.
pub(crate) fn prepare<'a>(bytes: &'a [u8], file: &str, what: &str) -> Result<Text<'a>, CarrierError> {
    let had_bom = bytes.starts_with(BOM);
    let body = if had_bom { &bytes[BOM.len()..] } else { bytes };
    let head = &body[..body.len().min(SNIFF_BYTES)];
    let utf16_mark = head.starts_with(b"\xFF\xFE") || head.starts_with(b"\xFE\xFF");
    let zeros = memchr::memchr_iter(0, head).count();
    // ASCII in UTF-16 has a zero in every other byte.
    if utf16_mark || (head.len() >= 4 && zeros * 2 + 2 >= head.len() && looks_interleaved(head)) {
        return Err(CarrierError::input(file, "byte 0", "is UTF-16 text", format!("save the {what} as UTF-8")));
    }
    if let Some(at) = memchr::memchr(0, head) {
        let problem = "holds a zero byte, so it is no text";
        return Err(CarrierError::input(
            file,
            format!("byte {at}"),
            problem,
            format!("name a text file of format {what}"),
        ));
    }
    // Files of the old Mac end their lines with \r alone.
    let old_mac = memchr::memchr(b'\n', body).is_none() && memchr::memchr(b'\r', body).is_some();
    let bytes = if old_mac {
        Cow::Owned(body.iter().map(|&b| if b == b'\r' { b'\n' } else { b }).collect())
    } else {
        Cow::Borrowed(body)
    };
    Ok(Text { bytes, had_bom })
}

/// Whether zeros stand only at even or only at odd places.
fn looks_interleaved(head: &[u8]) -> bool {
    let at_even = head.iter().step_by(2).any(|&b| b == 0);
    let at_odd = head.iter().skip(1).step_by(2).any(|&b| b == 0);
    at_even != at_odd
}

/// A name as text: UTF-8, else Latin-1, in which every byte is the code point of its value. Says
/// whether it was Latin-1.
pub(crate) fn name(bytes: &[u8]) -> (String, bool) {
    match std::str::from_utf8(bytes) {
        Ok(text) => (text.to_string(), false),
        Err(_) => (bytes.iter().map(|&b| char::from(b)).collect(), true),
    }
}

/// A piece of a line for a message: short, without control characters.
pub(crate) fn excerpt(bytes: &[u8]) -> String {
    const LONGEST: usize = 40;
    let (text, _) = name(bytes);
    let mut short: String = text.chars().take(LONGEST).map(|c| if c.is_control() { '?' } else { c }).collect();
    if text.chars().count() > LONGEST {
        short.push_str("...");
    }
    short
}

/// The line without blanks at both ends (`\r` is one).
pub(crate) fn trim(line: &[u8]) -> &[u8] {
    line.trim_ascii()
}

/// First word and the trimmed rest of a line.
pub(crate) fn split_word(line: &[u8]) -> (&[u8], &[u8]) {
    let line = line.trim_ascii_start();
    let end = line.iter().position(u8::is_ascii_whitespace).unwrap_or(line.len());
    (&line[..end], line[end..].trim_ascii())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn utf16_with_and_without_a_mark_is_refused_with_the_remedy() {
        let plain: Vec<u8> = "v 1 2 3\nf 1 1 1\n".encode_utf16().flat_map(u16::to_le_bytes).collect();
        let marked = [&b"\xFF\xFE"[..], &plain].concat();
        for bytes in [plain, marked] {
            let error = prepare(&bytes, "a.obj", "OBJ").err().unwrap().to_string();
            assert!(error.contains("UTF-16") && error.contains("UTF-8") && error.contains("a.obj"), "{error}");
        }
    }

    #[test]
    fn a_byte_order_mark_is_taken_off() {
        let text = prepare(b"\xEF\xBB\xBFv 1 2 3", "a.obj", "OBJ").unwrap();
        assert!(text.had_bom);
        assert_eq!(&*text.bytes, b"v 1 2 3");
    }

    #[test]
    fn a_name_that_is_no_utf8_is_latin_1() {
        assert_eq!(name(b"\xE9corce"), ("écorce".to_string(), true));
        assert_eq!(name("écorce".as_bytes()), ("écorce".to_string(), false));
    }
}
