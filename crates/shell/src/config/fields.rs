//! The list of all parameters, from the JSON Schemas of the sections: each is defined once, as a
//! struct field, and flags, environment names, file keys and help texts come from here.

use foliar_bake::Baker;
use foliar_schema::{Check, Import, Pack, Roles, Scene, names};
use serde_json::{Value, json};

/// What a parameter holds.
#[derive(Clone, Debug, PartialEq)]
pub enum Kind {
    /// A finite number.
    Number,
    /// A whole number.
    Integer,
    /// true or false.
    Bool,
    /// Text.
    Text,
    /// One of these words, each with its meaning.
    Choice(Vec<(String, String)>),
    /// A list of any length.
    List(Box<Kind>),
    /// So many of them.
    Array(Box<Kind>, usize),
}

/// One parameter.
#[derive(Clone, Debug)]
pub struct Field {
    /// Section of the configuration: `scene`.
    pub section: String,
    /// Place in the section: `["camera", "nearest_m"]`.
    pub path: Vec<String>,
    /// What it holds.
    pub kind: Kind,
    /// Its default; null where nothing is the default.
    pub default: Value,
    /// What it means.
    pub doc: String,
    /// Its own schema, for ranges.
    pub schema: Value,
    /// Name of its flag, where that is not the field's (`x-flag` in the schema).
    pub own_flag: Option<String>,
    /// Name of the map that its entries name files of (`x-map` in the schema).
    pub map: Option<String>,
}

impl Field {
    /// Place with dots: `scene.camera.nearest_m`.
    pub fn dotted(&self) -> String {
        format!("{}.{}", self.section, self.path.join("."))
    }

    /// Name in the environment: `FOLIAR_SCENE_CAMERA_NEAREST_M`.
    pub fn env_name(&self) -> String {
        format!("FOLIAR_{}_{}", self.section, self.path.join("_")).to_uppercase()
    }

    /// Name of the direct flag: `nearest-m`, from the last step of the place, unless the schema says another.
    pub fn flag(&self) -> String {
        self.own_flag.clone().unwrap_or_else(|| self.last_step())
    }

    fn last_step(&self) -> String {
        self.path.last().map_or_else(String::new, |name| name.replace('_', "-"))
    }

    /// Meaning, unit, range and default in one text.
    pub fn help(&self) -> String {
        let mut facts: Vec<String> = unit(&self.flag()).into_iter().map(String::from).collect();
        for (key, words) in LIMITS {
            facts.extend(self.schema.get(key).and_then(Value::as_f64).map(|limit| format!("{words} {limit}")));
        }
        let says_nothing = self.default.is_null() || self.default == Value::Bool(false) || self.default == json!([]);
        if !says_nothing {
            facts.push(format!("default {}", self.default));
        }
        let doc = self.doc.replace('\n', " ");
        if facts.is_empty() { doc } else { format!("{doc} [{}]", facts.join(", ")) }
    }
}

/// Words of a schema's limits.
const LIMITS: [(&str, &str); 4] =
    [("minimum", "at least"), ("exclusiveMinimum", "above"), ("maximum", "at most"), ("exclusiveMaximum", "below")];

/// The unit that a name ends in.
fn unit(flag: &str) -> Option<&'static str> {
    match flag.rsplit('-').next() {
        Some("m") => Some("meters"),
        Some("mm") => Some("millimeters"),
        Some("nm") => Some("nanometers"),
        Some("deg") => Some("degrees"),
        Some("px") => Some("pixels"),
        _ => None,
    }
}

/// All parameters of a program.
#[derive(Clone, Debug, Default)]
pub struct Fields {
    all: Vec<Field>,
    schemas: Vec<(String, Value)>,
}

impl Fields {
    /// The parameters of every section that a program with these bakers knows.
    ///
    /// # Errors
    /// A sentence that names a field of a kind that cannot be a flag.
    pub fn new(bakers: &[&dyn Baker]) -> Result<Fields, String> {
        let mut fields = Fields::default();
        fields.add("import", schemars::schema_for!(Import).to_value())?;
        fields.add("roles", schemars::schema_for!(Roles).to_value())?;
        fields.add("structure", schemars::schema_for!(foliar_structure::StructureParams).to_value())?;
        fields.add(names::ROOM_BRANCHES, schemars::schema_for!(foliar_structure::branches::BranchParams).to_value())?;
        fields.add("scene", schemars::schema_for!(Scene).to_value())?;
        fields.add("pack", schemars::schema_for!(Pack).to_value())?;
        fields.add("check", schemars::schema_for!(Check).to_value())?;
        fields.add("view", foliar_view::ViewParams::schema())?;
        for baker in bakers {
            fields.add(baker.room(), baker.schema())?;
        }
        Ok(fields)
    }

    fn add(&mut self, section: &str, schema: Value) -> Result<(), String> {
        let walk = Walk { section, root: &schema };
        walk.object(&schema, &schema["default"], &mut Vec::new(), &mut self.all)?;
        self.schemas.push((section.into(), schema));
        Ok(())
    }

    /// All fields, section by section.
    pub fn all(&self) -> &[Field] {
        &self.all
    }

    /// The fields of one section.
    pub fn section<'a>(&'a self, section: &'a str) -> impl Iterator<Item = &'a Field> {
        self.all.iter().filter(move |field| field.section == section)
    }

    /// Sections with their schemas, in order.
    pub fn schemas(&self) -> &[(String, Value)] {
        &self.schemas
    }

    /// The field of this place (`scene.camera.nearest_m`).
    ///
    /// # Errors
    /// A sentence with the nearest known name.
    pub fn find(&self, dotted: &str) -> Result<&Field, String> {
        self.all.iter().find(|field| field.dotted() == dotted).ok_or_else(|| self.unknown(dotted))
    }

    fn unknown(&self, dotted: &str) -> String {
        let section = dotted.split('.').next().unwrap_or_default();
        if foliar_schema::LATER_ROOMS.contains(&section) {
            return format!("{dotted}: {section}: not in this version");
        }
        let names: Vec<String> = self.all.iter().map(Field::dotted).collect();
        format!("{dotted}: no such parameter{}", nearest(dotted, names.iter().map(String::as_str)))
    }
}

/// "; did you mean X?", or the advice to list all.
pub fn nearest<'a>(name: &str, known: impl Iterator<Item = &'a str>) -> String {
    /// Below this likeness a suggestion helps nobody.
    const ALIKE: f64 = 0.6;
    let scored = known.map(|candidate| (strsim::normalized_damerau_levenshtein(name, candidate), candidate));
    let best = scored.fold(None, |best: Option<(f64, &str)>, next| match best {
        Some(best) if best.0 >= next.0 => Some(best),
        _ => Some(next),
    });
    match best {
        Some((score, candidate)) if score >= ALIKE => format!("; did you mean {candidate}?"),
        _ => "; `foliar config` lists all".into(),
    }
}

struct Walk<'a> {
    section: &'a str,
    root: &'a Value,
}

impl Walk<'_> {
    /// Fields of an object schema; `default` is what the containing struct has in this place.
    fn object(
        &self,
        schema: &Value,
        default: &Value,
        path: &mut Vec<String>,
        out: &mut Vec<Field>,
    ) -> Result<(), String> {
        let properties = schema["properties"].as_object().ok_or_else(|| self.refuse(path, "no named fields"))?;
        for (name, property) in properties {
            path.push(name.clone());
            let target = self.resolve(property);
            let own_default = property.get("default").or_else(|| default.get(name)).unwrap_or(&Value::Null);
            if target.get("properties").is_some() {
                if path.len() > 1 {
                    return Err(self.refuse(path, "a second level of nesting"));
                }
                self.object(target, own_default, path, out)?;
            } else {
                out.push(self.field(property, target, own_default, path)?);
            }
            path.pop();
        }
        Ok(())
    }

    fn field(&self, property: &Value, target: &Value, default: &Value, path: &[String]) -> Result<Field, String> {
        let doc = property["description"].as_str().or(target["description"].as_str());
        Ok(Field {
            section: self.section.into(),
            path: path.to_vec(),
            kind: self.kind(target, path)?,
            default: default.clone(),
            doc: doc.ok_or_else(|| self.refuse(path, "no doc comment"))?.into(),
            schema: target.clone(),
            own_flag: property["x-flag"].as_str().map(String::from),
            map: property["x-map"].as_str().map(String::from),
        })
    }

    fn kind(&self, schema: &Value, path: &[String]) -> Result<Kind, String> {
        let schema = self.resolve(schema);
        if let Some(choices) = choices(schema) {
            return Ok(Kind::Choice(choices));
        }
        match type_name(schema) {
            Some("number") => Ok(Kind::Number),
            Some("integer") => Ok(Kind::Integer),
            Some("boolean") => Ok(Kind::Bool),
            Some("string") => Ok(Kind::Text),
            Some("array") => {
                let item = Box::new(self.kind(&schema["items"], path)?);
                let (least, most) = (schema["minItems"].as_u64(), schema["maxItems"].as_u64());
                match (least, most) {
                    (None, None) => Ok(Kind::List(item)),
                    (Some(a), Some(b)) if a == b => Ok(Kind::Array(item, a as usize)),
                    _ => Err(self.refuse(path, "a list with length limits")),
                }
            }
            _ => Err(self.refuse(path, "a kind that cannot be a flag")),
        }
    }

    /// Follows `$ref` and the one non-null branch of an `anyOf`.
    fn resolve<'s>(&'s self, schema: &'s Value) -> &'s Value {
        if let Some(reference) = schema["$ref"].as_str() {
            return self.root.pointer(reference.trim_start_matches('#')).unwrap_or(schema);
        }
        let branches = schema["anyOf"].as_array();
        match branches.and_then(|b| b.iter().find(|branch| branch["type"] != "null")) {
            Some(branch) => self.resolve(branch),
            None => schema,
        }
    }

    fn refuse(&self, path: &[String], what: &str) -> String {
        format!(
            "{}.{}: {what}: parameters are numbers, text, words, lists or one level of them",
            self.section,
            path.join(".")
        )
    }
}

/// The one non-null type of a schema.
fn type_name(schema: &Value) -> Option<&str> {
    match &schema["type"] {
        Value::String(name) => Some(name),
        Value::Array(names) => names.iter().filter_map(Value::as_str).find(|name| *name != "null"),
        _ => None,
    }
}

/// Words of a unit enum, with or without a doc comment each.
fn choices(schema: &Value) -> Option<Vec<(String, String)>> {
    let words = |list: &Value| -> Option<Vec<(String, String)>> {
        list.as_array()?.iter().map(|word| Some((word.as_str()?.to_owned(), String::new()))).collect()
    };
    if schema["enum"].is_array() {
        return words(&schema["enum"]);
    }
    let documented = |variant: &Value| match variant["const"].as_str() {
        Some(word) => Some(vec![(word.to_owned(), variant["description"].as_str().unwrap_or_default().to_owned())]),
        None => words(&variant["enum"]),
    };
    let variants: Option<Vec<_>> = schema["oneOf"].as_array()?.iter().map(documented).collect();
    Some(variants?.concat())
}

#[cfg(test)]
mod tests {
    use super::*;
    use schemars::JsonSchema;
    use serde::{Deserialize, Serialize};

    #[test]
    fn every_section_of_the_contract_is_made_of_allowed_kinds() {
        let fields = Fields::new(&[]).unwrap();
        assert_eq!(fields.find("scene.camera.nearest_m").unwrap().env_name(), "FOLIAR_SCENE_CAMERA_NEAREST_M");
        assert_eq!(
            fields.find("import.up").unwrap().kind,
            Kind::Choice(vec![
                ("y".into(), "Y up, as glTF has it.".into()),
                ("z".into(), "Z up: turned by -90 degrees about X.".into()),
            ])
        );
        assert_eq!(fields.find("scene.light.sun_direction").unwrap().kind, Kind::Array(Box::new(Kind::Number), 3));
        assert_eq!(fields.find("scene.camera.height_px").unwrap().default, 1080);
        assert!(fields.find("scene.camera.nearest_m").unwrap().help().contains("[meters, above 0, default 3.0]"));
    }

    #[test]
    fn names_in_the_environment_are_unique() {
        let fields = Fields::new(&[]).unwrap();
        let mut names: Vec<_> = fields.all().iter().map(Field::env_name).collect();
        names.sort();
        assert!(names.windows(2).all(|pair| pair[0] != pair[1]), "{names:?}");
    }

    #[test]
    fn an_unknown_name_gets_the_nearest_and_a_later_room_is_named() {
        let fields = Fields::new(&[]).unwrap();
        assert!(fields.find("scene.camera.nearst_m").unwrap_err().contains("did you mean scene.camera.nearest_m?"));
        assert!(fields.find("fall.levels").unwrap_err().contains("fall: not in this version"));
    }

    /// What house rules forbid: an enum that carries data.
    #[derive(Default, Serialize, Deserialize, JsonSchema)]
    #[serde(default)]
    struct Carrying {
        /// Doc.
        size: Option<Size>,
    }

    #[derive(Serialize, Deserialize, JsonSchema)]
    enum Size {
        /// Doc.
        Fixed(f64),
        /// Doc.
        Range(f64, f64),
    }

    #[test]
    fn an_enum_that_carries_data_is_refused() {
        let mut fields = Fields::default();
        let error = fields.add("bad", schemars::schema_for!(Carrying).to_value());
        assert!(error.is_err_and(|e| e.contains("bad.size")));
    }
}
