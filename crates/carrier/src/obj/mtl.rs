//! Material libraries: what each `newmtl` says, with line numbers and unknown keys in file order.

use super::number::{Cursor, LineError};
use super::text::{name, prepare, split_word, trim};
use crate::CarrierError;

/// A picture that a material names.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Map {
    /// File name as written, options stripped.
    pub file: String,
    /// Line, from 1.
    pub line: u64,
    /// `-bm`, the strength of a bump map.
    pub strength: Option<f64>,
    /// Whether `-s`, `-o` or `-t` move or scale it (foliar leaves that out).
    pub moved: bool,
}

/// One `newmtl`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Material {
    /// Its name.
    pub name: String,
    /// Line of its `newmtl`, from 1.
    pub line: u64,
    /// Diffuse color.
    pub kd: Option<[f64; 3]>,
    /// Specular color.
    pub ks: Option<[f64; 3]>,
    /// Emitted color.
    pub ke: Option<[f64; 3]>,
    /// Shininess, 0 to 1000.
    pub ns: Option<f64>,
    /// Opacity: `d`, else 1 - `Tr`.
    pub opacity: Option<f64>,
    /// Color texture.
    pub map_kd: Option<Map>,
    /// Opacity texture.
    pub map_d: Option<Map>,
    /// Heights, or normals where the picture is such.
    pub bump: Option<Map>,
    /// Normals for sure.
    pub norm: Option<Map>,
    /// Keys that foliar does not know and their values, in the order of the file.
    pub unknown: Vec<(String, String)>,
}

/// What a material library holds.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Contents {
    /// Its materials, in their order.
    pub materials: Vec<Material>,
    /// Names and lines (from 1) of the libraries that it names in turn, which no reader follows.
    pub nested: Vec<(String, u64)>,
}

/// Keys that say nothing about what foliar needs: read over in silence.
const UNUSED: &[&str] = &[
    "ka",
    "ni",
    "illum",
    "tf",
    "sharpness",
    "map_ka",
    "map_ks",
    "map_ke",
    "map_ns",
    "map_refl",
    "map_aat",
    "refl",
    "disp",
    "map_disp",
    "decal",
    "pr",
    "pm",
    "ps",
    "pc",
    "pcr",
    "aniso",
    "anisor",
    "map_pr",
    "map_pm",
    "map_ps",
];

/// Reads a material library; `file` stands in messages.
///
/// # Errors
/// [`CarrierError::Input`] with the line, for numbers that are none, UTF-16 and binary data.
pub fn parse_mtl(bytes: &[u8], file: &str) -> Result<Contents, CarrierError> {
    let text = prepare(bytes, file, "MTL")?;
    let mut found = Contents::default();
    for (index, line) in text.bytes.split(|&b| b == b'\n').enumerate() {
        let number = index as u64 + 1;
        let (keyword, rest) = split_word(trim(line));
        if keyword.is_empty() || keyword[0] == b'#' {
            continue;
        }
        let keyword = name(keyword).0;
        if keyword.eq_ignore_ascii_case("newmtl") {
            found.materials.push(Material { name: name(rest).0, line: number, ..Material::default() });
        } else if keyword.eq_ignore_ascii_case("mtllib") {
            found.nested.push((name(rest).0, number));
        } else if let Some(material) = found.materials.last_mut() {
            material
                .key(&keyword, rest, number)
                .map_err(|error| CarrierError::input(file, format!("line {number}"), error.problem, error.remedy))?;
        }
    }
    Ok(found)
}

impl Material {
    fn key(&mut self, keyword: &str, rest: &[u8], line: u64) -> Result<(), LineError> {
        match keyword.to_ascii_lowercase().as_str() {
            "kd" => self.kd = color(rest, "Kd")?.or(self.kd),
            "ks" => self.ks = color(rest, "Ks")?.or(self.ks),
            "ke" => self.ke = color(rest, "Ke")?.or(self.ke),
            "ns" => self.ns = Some(Cursor::new(rest).coordinate("Ns")?),
            "d" => self.opacity = Some(opacity(rest, "d")?),
            // Where both are given they should agree; `d` is the one that exporters mean.
            "tr" => self.opacity = self.opacity.or(Some(1.0 - opacity(rest, "Tr")?)),
            "map_kd" => self.map_kd = map(rest, line),
            "map_d" | "map_opacity" => self.map_d = map(rest, line),
            "bump" | "map_bump" => self.bump = map(rest, line),
            "norm" | "map_norm" | "map_kn" => self.norm = map(rest, line),
            other if UNUSED.contains(&other) => {}
            _ => self.unknown.push((keyword.to_string(), name(rest).0)),
        }
        Ok(())
    }
}

/// `r [g b]`; `None` for the forms `spectral` and `xyz`, which no exporter of trees writes.
fn color(rest: &[u8], what: &str) -> Result<Option<[f64; 3]>, LineError> {
    if rest.starts_with(b"spectral") || rest.starts_with(b"xyz") {
        return Ok(None);
    }
    let mut cursor = Cursor::new(rest);
    let red = cursor.coordinate(what)?;
    let green = if cursor.has_more() { cursor.coordinate(what)? } else { red };
    let blue = if cursor.has_more() { cursor.coordinate(what)? } else { red };
    Ok(Some([red, green, blue].map(|c| c.clamp(0.0, 1.0))))
}

/// `[-halo] factor`
fn opacity(rest: &[u8], what: &str) -> Result<f64, LineError> {
    let (word, more) = split_word(rest);
    let rest = if word == b"-halo" { more } else { rest };
    Ok(Cursor::new(rest).coordinate(what)?.clamp(0.0, 1.0))
}

/// `[options] file name with spaces`
fn map(rest: &[u8], line: u64) -> Option<Map> {
    let mut map = Map { line, ..Map::default() };
    let mut rest = rest;
    loop {
        let (word, after) = split_word(rest);
        let (at_most, numbers_only) = match word {
            b"-o" | b"-s" | b"-t" => (3, true),
            b"-mm" => (2, true),
            b"-bm" | b"-boost" | b"-texres" => (1, true),
            b"-blendu" | b"-blendv" | b"-clamp" | b"-cc" | b"-imfchan" | b"-type" => (1, false),
            _ => break,
        };
        let mut arguments = Vec::new();
        rest = after;
        while arguments.len() < at_most {
            let (argument, after) = split_word(rest);
            let number = fast_float2::parse::<f64, _>(argument).ok();
            // The last word of a line is the file, even one that is called "1".
            if after.is_empty() || (numbers_only && number.is_none()) {
                break;
            }
            arguments.push(number);
            rest = after;
        }
        map.option(word, &arguments);
    }
    map.file = name(rest.trim_ascii()).0;
    let quoted = map.file.strip_prefix('"').and_then(|f| f.strip_suffix('"')).map(str::to_string);
    map.file = quoted.unwrap_or(map.file);
    (!map.file.is_empty()).then_some(map)
}

impl Map {
    fn option(&mut self, word: &[u8], arguments: &[Option<f64>]) {
        let neutral = |value: f64| arguments.iter().flatten().all(|n| n.to_bits() == value.to_bits());
        match word {
            b"-bm" => self.strength = arguments.first().copied().flatten().filter(|n| n.is_finite()),
            b"-s" => self.moved |= !neutral(1.0),
            b"-o" | b"-t" => self.moved |= !neutral(0.0),
            _ => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn one(text: &str) -> Material {
        parse_mtl(text.as_bytes(), "a.mtl").unwrap().materials.remove(0)
    }

    fn file(line: &str) -> String {
        one(&format!("newmtl a\nmap_Kd {line}\n")).map_kd.unwrap().file
    }

    #[test]
    fn options_are_stripped_and_names_keep_their_blanks() {
        for line in [
            "-s 1 1 1 oak leaf.png",
            "-clamp on oak leaf.png",
            "-blendu off -s 2 2 -o 0.5 oak leaf.png",
            "-mm 0 1 -imfchan r -boost 2 oak leaf.png",
            "\"oak leaf.png\"",
            "  oak leaf.png \r",
        ] {
            assert_eq!(file(line), "oak leaf.png", "{line}");
        }
        assert_eq!(file("-s 1 1 1 1.png"), "1.png");
        assert_eq!(file("-s 2 2 2 7"), "7");
        assert_eq!(file("-strange.png"), "-strange.png");
    }

    #[test]
    fn strength_and_movement_are_kept() {
        let bump = one("newmtl a\nmap_Bump -bm 0.3 -s 1 1 1 b.png").bump.unwrap();
        assert_eq!((bump.strength, bump.moved, bump.line), (Some(0.3), false, 2));
        assert!(one("newmtl a\nmap_Kd -s 2 2 2 b.png").map_kd.unwrap().moved);
    }

    #[test]
    fn unknown_keys_come_in_file_order() {
        let keys = ["zeta", "alpha", "mu", "beta"];
        let text: String = keys.iter().map(|k| format!("{k} 1\n")).collect();
        let found: Vec<_> = one(&format!("newmtl a\n{text}")).unknown.into_iter().map(|(k, _)| k).collect();
        assert_eq!(found, keys);
    }

    #[test]
    fn a_bad_number_is_named_with_its_line() {
        let error = parse_mtl(b"newmtl a\nKd 0,5 0,5 0,5\n", "a.mtl").unwrap_err().to_string();
        assert!(error.contains("a.mtl, line 2") && error.contains("comma"), "{error}");
    }

    #[test]
    fn d_wins_over_tr() {
        for text in ["newmtl a\nd 0.25\nTr 0.1", "newmtl a\nTr 0.1\nd 0.25", "newmtl a\nTr 0.75"] {
            assert_eq!(one(text).opacity, Some(0.25), "{text}");
        }
    }

    #[test]
    fn names_may_have_blanks_and_be_latin_1() {
        let found = parse_mtl(b"newmtl twig leaves \r\nnewmtl \xE9corce\n", "a.mtl").unwrap();
        assert_eq!(found.materials.iter().map(|m| m.name.as_str()).collect::<Vec<_>>(), ["twig leaves", "écorce"]);
    }
}
