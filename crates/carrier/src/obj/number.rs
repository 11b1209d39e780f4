//! Numbers straight from the bytes of an OBJ line, each with the reason why it is refused.

use super::text::excerpt;

/// Largest coordinate: its square is still a finite f32 (the limit that plants keep).
pub(crate) const LARGEST_COORDINATE: f64 = 1e15;

/// What is wrong with a line, and what would be right.
#[derive(Debug)]
pub(crate) struct LineError {
    /// Line, counted from 1 within what was scanned.
    pub line: u32,
    /// What is wrong.
    pub problem: String,
    /// What would be right.
    pub remedy: String,
}

impl LineError {
    /// An error whose line the caller fills in.
    pub fn new(problem: impl Into<String>, remedy: impl Into<String>) -> Self {
        LineError { line: 0, problem: problem.into(), remedy: remedy.into() }
    }
}

/// Reads blank-separated numbers from the rest of a line.
pub(crate) struct Cursor<'a> {
    rest: &'a [u8],
}

impl<'a> Cursor<'a> {
    /// Starts at the beginning of `rest`.
    pub fn new(rest: &'a [u8]) -> Self {
        Cursor { rest }
    }

    /// Skips blanks and says whether anything is left.
    pub fn has_more(&mut self) -> bool {
        let blanks = self.rest.iter().take_while(|b| b.is_ascii_whitespace()).count();
        self.rest = &self.rest[blanks..];
        !self.rest.is_empty()
    }

    /// The next word, empty at the end of the line.
    pub fn word(&mut self) -> &'a [u8] {
        self.has_more();
        let end = self.rest.iter().position(u8::is_ascii_whitespace).unwrap_or(self.rest.len());
        let (word, rest) = self.rest.split_at(end);
        self.rest = rest;
        word
    }

    /// The next number, whatever it is; `what` names it in messages.
    pub fn number(&mut self, what: &str) -> Result<f64, LineError> {
        if !self.has_more() {
            return Err(LineError::new(format!("{what} is missing"), "write all numbers of the statement"));
        }
        match fast_float2::parse_partial::<f64, _>(self.rest) {
            Ok((value, used)) if self.rest.get(used).is_none_or(u8::is_ascii_whitespace) => {
                self.rest = &self.rest[used..];
                Ok(value)
            }
            parsed => Err(self.no_number(what, parsed.is_ok_and(|(_, used)| self.rest.get(used) == Some(&b',')))),
        }
    }

    /// The next number, finite and small enough for a coordinate.
    pub fn coordinate(&mut self, what: &str) -> Result<f64, LineError> {
        let value = self.number(what)?;
        if value.abs() < LARGEST_COORDINATE {
            return Ok(value);
        }
        let remedy = format!("coordinates must be finite and below {LARGEST_COORDINATE:e}; export the model again");
        Err(LineError::new(format!("{what} = {value:e}"), remedy))
    }

    fn no_number(&mut self, what: &str, comma: bool) -> LineError {
        let word = excerpt(self.word());
        let remedy = if comma {
            "decimals need a point, not a comma: export with an English locale"
        } else {
            "write a number such as 0.5 or -1e-3"
        };
        LineError::new(format!("{what} = {word:?} is no number"), remedy)
    }
}

/// A whole number at the start of `bytes` and how many bytes it took; `None` where there is none or
/// it has more than 18 digits.
pub(crate) fn integer(bytes: &[u8]) -> Option<(i64, usize)> {
    const MOST_DIGITS: usize = 18;
    let sign = usize::from(matches!(bytes.first(), Some(b'-' | b'+')));
    let mut value = 0i64;
    let mut used = sign;
    while let Some(digit) = bytes.get(used).filter(|b| b.is_ascii_digit()) {
        if used - sign == MOST_DIGITS {
            return None;
        }
        value = value * 10 + i64::from(digit - b'0');
        used += 1;
    }
    (used > sign).then(|| (if bytes[0] == b'-' { -value } else { value }, used))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_decimal_comma_is_named() {
        let error = Cursor::new(b"1,5 2").number("x").unwrap_err();
        assert!(error.problem.contains("1,5") && error.remedy.contains("comma"), "{error:?}");
    }

    #[test]
    fn what_is_no_coordinate_is_refused_with_the_number() {
        for (text, shown) in [("nan", "NaN"), ("inf", "inf"), ("-inf", "-inf"), ("1e30", "1e30"), ("1e400", "inf")] {
            let error = Cursor::new(text.as_bytes()).coordinate("x").unwrap_err();
            assert!(error.problem.contains(shown), "{text}: {error:?}");
        }
        assert!(Cursor::new(b"-nan(ind)").coordinate("x").is_err());
    }

    #[test]
    fn integers_stop_where_they_end() {
        assert_eq!(integer(b"12/3"), Some((12, 2)));
        assert_eq!(integer(b"-4"), Some((-4, 2)));
        assert_eq!(integer(b"-"), None);
        assert_eq!(integer(b""), None);
        assert_eq!(integer(b"9999999999999999999999"), None);
    }
}
