//! Structured mutation of files: bits, cuts, splices, lines, numbers, JSON values and indices. The same seed gives the
//! same case on every machine.

use serde_json::Value;

/// SplitMix64: small, and the same everywhere.
pub struct Dice(u64);

impl Dice {
    /// Dice of a seed.
    pub fn new(seed: u64) -> Dice {
        Dice(seed)
    }

    fn roll(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let a = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let b = (a ^ (a >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        b ^ (b >> 31)
    }

    /// A number below `count`; 0 where there is none.
    pub fn below(&mut self, count: usize) -> usize {
        (self.roll() % count.max(1) as u64) as usize
    }

    fn of<T: Copy>(&mut self, list: &[T]) -> T {
        list[self.below(list.len())]
    }
}

/// How a file is built.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// Lines of words: OBJ, MTL, TOML.
    Lines,
    /// JSON: glTF.
    Json,
    /// JSON and numbers in a GLB.
    Glb,
    /// JSON and numbers in a safetensors file.
    Layer,
    /// Anything else: pictures.
    Bytes,
}

/// Numbers that readers trip over.
const NUMBERS: [&str; 16] = [
    "0",
    "-1",
    "1",
    "-0",
    "65535",
    "65536",
    "2147483647",
    "2147483648",
    "4294967295",
    "4294967296",
    "9007199254740993",
    "18446744073709551615",
    "1e308",
    "-1e308",
    "1e-320",
    "nan",
];

/// Keys of a glTF whose numbers point at something or count something.
const KEYS: [&str; 22] = [
    "bufferView",
    "buffer",
    "byteOffset",
    "byteLength",
    "byteStride",
    "count",
    "componentType",
    "accessor",
    "indices",
    "POSITION",
    "NORMAL",
    "mesh",
    "material",
    "source",
    "index",
    "scene",
    "children",
    "nodes",
    "mode",
    "sampler",
    "values",
    "attribute",
];

type Mutation = (&'static str, fn(&[u8], &[u8], Form, &mut Dice) -> Vec<u8>);

const ANY: &[Mutation] =
    &[("flip", flip), ("truncate", truncate), ("splice", splice), ("delete", delete), ("double", double)];
const LINES: &[Mutation] = &[("number", number), ("index", index), ("line", line), ("word", word)];
const JSON: &[Mutation] = &[("json value", json_value), ("json key", json_key), ("json index", json_index)];
const BINARY: &[Mutation] = &[("stored number", stored)];

/// A file changed by one to three mutations, and what they were. `other` is a file to take pieces from.
pub fn mutated(bytes: &[u8], other: &[u8], form: Form, dice: &mut Dice) -> (Vec<u8>, String) {
    let special: &[&[Mutation]] = match form {
        Form::Lines => &[LINES],
        Form::Json => &[LINES, JSON],
        Form::Glb | Form::Layer => &[JSON, BINARY],
        Form::Bytes => &[],
    };
    let (mut bytes, mut names) = (bytes.to_vec(), Vec::new());
    for _ in 0..1 + dice.below(3) {
        // Half of them know the format: bytes alone seldom come past the first check.
        let kind = if special.is_empty() || dice.below(2) == 0 { ANY } else { dice.of(special) };
        let (name, mutation) = dice.of(kind);
        bytes = mutation(&bytes, other, form, dice);
        names.push(name);
    }
    (bytes, names.join(", "))
}

/// A place: in half of all cases near the start, where headers are.
fn place(bytes: &[u8], dice: &mut Dice) -> usize {
    let span = if dice.below(2) == 0 { bytes.len().min(512) } else { bytes.len() };
    dice.below(span)
}

fn range(bytes: &[u8], dice: &mut Dice) -> std::ops::Range<usize> {
    let start = place(bytes, dice);
    let most = (bytes.len() - start).min(1 << dice.below(17));
    start..start + dice.below(most + 1)
}

fn flip(bytes: &[u8], _: &[u8], _: Form, dice: &mut Dice) -> Vec<u8> {
    let mut out = bytes.to_vec();
    for _ in 0..1 + dice.below(16) {
        let at = place(&out, dice);
        if let Some(byte) = out.get_mut(at) {
            *byte ^= 1 << dice.below(8);
        }
    }
    out
}

fn truncate(bytes: &[u8], _: &[u8], _: Form, dice: &mut Dice) -> Vec<u8> {
    bytes[..place(bytes, dice)].to_vec()
}

fn splice(bytes: &[u8], other: &[u8], _: Form, dice: &mut Dice) -> Vec<u8> {
    let (at, from) = (range(bytes, dice), range(other, dice));
    [&bytes[..at.start], &other[from], &bytes[at.end..]].concat()
}

fn delete(bytes: &[u8], _: &[u8], _: Form, dice: &mut Dice) -> Vec<u8> {
    let at = range(bytes, dice);
    [&bytes[..at.start], &bytes[at.end..]].concat()
}

fn double(bytes: &[u8], _: &[u8], _: Form, dice: &mut Dice) -> Vec<u8> {
    let at = range(bytes, dice);
    [&bytes[..at.end], &bytes[at.start..]].concat()
}

/// Another number in the place of one.
fn number(bytes: &[u8], _: &[u8], _: Form, dice: &mut Dice) -> Vec<u8> {
    let new = dice.of(&NUMBERS);
    replace_word(bytes, dice, |word| word.first().is_some_and(|c| c.is_ascii_digit() || *c == b'-'), new.as_bytes())
}

/// An index of a face (or any number, where there is none) beyond what there is.
fn index(bytes: &[u8], _: &[u8], form: Form, dice: &mut Dice) -> Vec<u8> {
    let new = dice.of(&["0", "-1", "-2147483648", "99999999", "1/99999999", "1//0", "-99999999/1/1", "//", "1/"]);
    let face = |word: &[u8]| form != Form::Lines || word.contains(&b'/');
    replace_word(bytes, dice, face, new.as_bytes())
}

/// Any word, by one of the same file.
fn word(bytes: &[u8], _: &[u8], _: Form, dice: &mut Dice) -> Vec<u8> {
    let at = range(bytes, dice);
    let taken =
        bytes[at].split(|c| c.is_ascii_whitespace()).max_by_key(|w| w.len().min(40)).unwrap_or_default().to_vec();
    replace_word(bytes, dice, |word| !word.is_empty(), &taken)
}

/// The first word from a random place on that is of a kind, replaced.
fn replace_word(bytes: &[u8], dice: &mut Dice, is: impl Fn(&[u8]) -> bool, new: &[u8]) -> Vec<u8> {
    let ends = |c: &u8| c.is_ascii_whitespace() || matches!(c, b',' | b'[' | b']' | b'{' | b'}' | b':' | b'=');
    let mut at = place(bytes, dice);
    for _ in 0..4096 {
        let start = at + bytes[at..].iter().position(ends).map_or(bytes.len() - at, |n| n + 1);
        if start >= bytes.len() {
            break;
        }
        let end = start + bytes[start..].iter().position(ends).unwrap_or(bytes.len() - start);
        if is(&bytes[start..end]) {
            return [&bytes[..start], new, &bytes[end..]].concat();
        }
        at = end.min(bytes.len() - 1);
    }
    bytes.to_vec()
}

/// A line dropped, doubled, moved to the end or made long.
fn line(bytes: &[u8], _: &[u8], _: Form, dice: &mut Dice) -> Vec<u8> {
    let at = place(bytes, dice);
    let start = bytes[..at].iter().rposition(|c| *c == b'\n').map_or(0, |n| n + 1);
    let end = at + bytes[at..].iter().position(|c| *c == b'\n').map_or(bytes.len() - at, |n| n + 1);
    let (before, this, after) = (&bytes[..start], &bytes[start..end], &bytes[end..]);
    match dice.below(4) {
        0 => [before, after].concat(),
        1 => [before, this, this, after].concat(),
        2 => [before, after, this].concat(),
        _ => [before, &this[..this.len().saturating_sub(1)], &vec![b' '; 70_000], b"1\n", after].concat(),
    }
}

/// A number stored in the second half of a file, by one that is none, or far out.
fn stored(bytes: &[u8], _: &[u8], _: Form, dice: &mut Dice) -> Vec<u8> {
    let mut out = bytes.to_vec();
    let (first, words) = (out.len() / 8, out.len() / 4);
    if words <= first {
        return out;
    }
    let at = 4 * (first + dice.below(words - first));
    let new = dice.of(&[u32::MAX, f32::NAN.to_bits(), f32::INFINITY.to_bits(), 1e38f32.to_bits(), 0x8000_0000, 0xFFFF]);
    out[at..at + 4].copy_from_slice(&new.to_le_bytes());
    out
}

/// JSON of a file, changed and put back with lengths that are right.
fn with_json(bytes: &[u8], form: Form, change: impl FnOnce(&mut Value)) -> Vec<u8> {
    let head = match form {
        Form::Glb => 20,
        Form::Layer => 8,
        _ => 0,
    };
    let at = if form == Form::Glb { 12 } else { 0 };
    let length = bytes.get(at..at + 4).and_then(|b| b.try_into().ok()).map_or(0, u32::from_le_bytes) as usize;
    let end = if head == 0 { bytes.len() } else { head + length };
    let Some(mut json) = bytes.get(head..end).and_then(|json| serde_json::from_slice(json).ok()) else {
        return bytes.to_vec();
    };
    change(&mut json);
    let mut text = json.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let rest = &bytes[end..];
    let size = (text.len() as u32).to_le_bytes();
    match form {
        Form::Glb => {
            let total = ((20 + text.len() + rest.len()) as u32).to_le_bytes();
            [&bytes[..8], &total, &size, &bytes[16..20], &text, rest].concat()
        }
        Form::Layer => [&(text.len() as u64).to_le_bytes(), &text[..], rest].concat(),
        _ => text,
    }
}

/// A random value below another, by pointer.
fn pointers(value: &Value, at: &str, out: &mut Vec<String>) {
    let mut below = |key: &str, value: &Value| {
        let pointer = format!("{at}/{}", key.replace('~', "~0").replace('/', "~1"));
        pointers(value, &pointer, out);
        out.push(pointer);
    };
    match value {
        Value::Object(map) => map.iter().for_each(|(key, value)| below(key, value)),
        // The first few of a long list stand for all of it.
        Value::Array(list) => list.iter().take(64).enumerate().for_each(|(i, value)| below(&i.to_string(), value)),
        _ => {}
    }
}

fn json_value(bytes: &[u8], _: &[u8], form: Form, dice: &mut Dice) -> Vec<u8> {
    with_json(bytes, form, |json| {
        let mut all = Vec::new();
        pointers(json, "", &mut all);
        let texts = [
            "null",
            "[]",
            "{}",
            "\"\"",
            "true",
            "-1",
            "1e308",
            "4294967295",
            "[[[[]]]]",
            "18446744073709551615",
            "0.5",
        ];
        let new = serde_json::from_str(dice.of(texts.as_slice())).unwrap_or(Value::Null);
        if let Some(slot) = all.get(dice.below(all.len())).and_then(|pointer| json.pointer_mut(pointer)) {
            *slot = new;
        }
    })
}

fn json_key(bytes: &[u8], _: &[u8], form: Form, dice: &mut Dice) -> Vec<u8> {
    with_json(bytes, form, |json| {
        let mut all = Vec::new();
        pointers(json, "", &mut all);
        let Some((parent, key)) = all.get(dice.below(all.len())).and_then(|pointer| pointer.rsplit_once('/')) else {
            return;
        };
        match json.pointer_mut(parent) {
            Some(Value::Object(map)) => _ = map.remove(key),
            Some(Value::Array(list)) => {
                // A list that ends early, or one that says everything twice.
                let twice = list.clone();
                if dice.below(2) == 0 { list.truncate(key.parse().unwrap_or(0)) } else { list.extend(twice) }
            }
            _ => {}
        }
    })
}

/// A number that points or counts: by its neighbor, by one beyond everything, by itself in a circle.
fn json_index(bytes: &[u8], _: &[u8], form: Form, dice: &mut Dice) -> Vec<u8> {
    with_json(bytes, form, |json| {
        let mut all = Vec::new();
        pointers(json, "", &mut all);
        all.retain(|pointer| json.pointer(pointer).is_some_and(Value::is_number));
        all.retain(|pointer| pointer.split('/').any(|key| KEYS.contains(&key)));
        let Some(pointer) = all.get(dice.below(all.len())) else { return };
        let own = pointer.split('/').filter_map(|key| key.parse::<u64>().ok()).next().unwrap_or(0);
        let old = json.pointer(pointer).and_then(Value::as_u64).unwrap_or(0);
        let new =
            dice.of(&[own, old + 1, old.wrapping_sub(1), old * 2, 1 << 31, u64::from(u32::MAX), 1 << 53, 1 << 20, 0]);
        if let Some(slot) = json.pointer_mut(pointer) {
            *slot = new.into();
        }
    })
}
