//! One value of one source, checked by itself: kind, finiteness, range.

use super::{Field, Kind};
use foliar_schema::check_ranges;
use serde_json::{Map, Number, Value};

/// The value that a text (flag, environment) gives a field.
///
/// # Errors
/// A sentence with name, value and what would be right.
pub fn from_text(field: &Field, text: &str) -> Result<Value, String> {
    let value = parse(&field.kind, text).ok_or_else(|| refuse(field, text))?;
    in_range(field, value)
}

/// The value that a file or record gives a field.
///
/// # Errors
/// A sentence with name, value and what would be right.
pub fn from_json(field: &Field, value: &Value) -> Result<Value, String> {
    let value = convert(&field.kind, value).ok_or_else(|| refuse(field, &value.to_string()))?;
    in_range(field, value)
}

fn refuse(field: &Field, text: &str) -> String {
    let doc = field.doc.replace('\n', " ");
    format!("{} = {text}: must be {} ({doc})", field.dotted(), expected(&field.kind))
}

/// What would be right, in words.
fn expected(kind: &Kind) -> String {
    match kind {
        Kind::Number => "a finite number".into(),
        Kind::Integer => "a whole number".into(),
        Kind::Bool => "true or false".into(),
        Kind::Text => "text".into(),
        Kind::Choice(words) => {
            let words: Vec<&str> = words.iter().map(|(word, _)| word.as_str()).collect();
            format!("one of {}", words.join(", "))
        }
        Kind::List(item) => format!("a list, each {}", expected(item)),
        Kind::Array(item, count) => format!("a list of {count}, each {}", expected(item)),
    }
}

fn parse(kind: &Kind, text: &str) -> Option<Value> {
    match kind {
        Kind::Number => finite(text.trim().parse().ok()?),
        Kind::Integer => text.trim().parse::<i64>().ok().map(Value::from),
        Kind::Bool => text.trim().parse::<bool>().ok().map(Value::from),
        Kind::Text => Some(text.into()),
        Kind::Choice(words) => words.iter().any(|(word, _)| word == text).then(|| text.into()),
        Kind::List(item) | Kind::Array(item, _) if !text.trim_start().starts_with('[') => {
            let items: Option<Vec<Value>> = text.split(',').map(|piece| parse(item, piece)).collect();
            convert(kind, &items?.into())
        }
        Kind::List(_) | Kind::Array(..) => convert(kind, &serde_json::from_str(text).ok()?),
    }
}

fn convert(kind: &Kind, value: &Value) -> Option<Value> {
    match (kind, value) {
        (Kind::Number, _) => finite(value.as_f64()?),
        (Kind::Integer, Value::Number(number)) if !number.is_f64() => Some(value.clone()),
        (Kind::Bool, Value::Bool(_)) | (Kind::Text, Value::String(_)) => Some(value.clone()),
        (Kind::Choice(_), Value::String(word)) => parse(kind, word),
        (Kind::List(item), Value::Array(items)) => {
            items.iter().map(|one| convert(item, one)).collect::<Option<Vec<_>>>().map(Value::Array)
        }
        (Kind::Array(item, count), Value::Array(items)) if items.len() == *count => {
            items.iter().map(|one| convert(item, one)).collect::<Option<Vec<_>>>().map(Value::Array)
        }
        _ => None,
    }
}

/// NaN and infinities have no JSON: they are refused here, before anything is merged.
fn finite(number: f64) -> Option<Value> {
    Number::from_f64(number).map(Value::Number)
}

fn in_range(field: &Field, value: Value) -> Result<Value, String> {
    let name = field.dotted();
    let schema = serde_json::json!({ "properties": { &name: field.schema } });
    let object = Value::Object(Map::from_iter([(name, value.clone())]));
    match check_ranges(&schema, &object) {
        Ok(()) => Ok(value),
        Err(error) => Err(format!(
            "{} = {}: must be {} ({})",
            error.pointer,
            error.value,
            error.expected,
            field.doc.replace('\n', " ")
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::Fields;

    fn parsed(name: &str, text: &str) -> Result<Value, String> {
        from_text(Fields::new(&[]).unwrap().find(name).unwrap(), text)
    }

    #[test]
    fn numbers_are_finite_and_in_range() {
        assert_eq!(parsed("scene.camera.nearest_m", "2"), Ok(2.0.into()));
        for bad in ["nan", "inf", "-inf", "1e999", "two", ""] {
            assert!(parsed("scene.camera.nearest_m", bad).unwrap_err().contains("a finite number"), "{bad}");
        }
        let error = parsed("scene.camera.nearest_m", "0").unwrap_err();
        assert!(error.starts_with("scene.camera.nearest_m = 0: must be above 0 (Nearest distance"), "{error}");
    }

    #[test]
    fn null_is_no_value() {
        let fields = Fields::new(&[]).unwrap();
        assert!(from_json(fields.find("import.up").unwrap(), &Value::Null).is_err());
        assert!(parsed("import.height_m", "null").is_err());
    }

    #[test]
    fn words_lists_and_arrays() {
        assert_eq!(parsed("import.up", "z"), Ok("z".into()));
        assert!(parsed("import.up", "x").unwrap_err().contains("one of y, z"));
        assert_eq!(parsed("roles.leaf", "*leaf*,Twig*"), Ok(serde_json::json!(["*leaf*", "Twig*"])));
        assert_eq!(parsed("roles.leaf", r#"["a,b"]"#), Ok(serde_json::json!(["a,b"])));
        assert_eq!(parsed("scene.light.sun_direction", "0,1,0.5"), Ok(serde_json::json!([0.0, 1.0, 0.5])));
        assert!(parsed("scene.light.sun_direction", "0,1").unwrap_err().contains("a list of 3"));
        assert!(parsed("scene.camera.height_px", "1.5").unwrap_err().contains("a whole number"));
    }
}
