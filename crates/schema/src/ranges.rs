//! One walker that enforces the ranges which a schema documents (`minimum`, `maximum`,
//! `exclusiveMinimum`, `exclusiveMaximum`, array lengths), for files, flags and library callers alike.

use serde_json::Value;

/// A value outside the range that its schema states.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{pointer} = {value}: must be {expected} ({doc})")]
pub struct RangeError {
    /// Where, with dots: `camera.nearest_m`.
    pub pointer: String,
    /// What was given.
    pub value: String,
    /// What would be right.
    pub expected: String,
    /// What the parameter is.
    pub doc: String,
}

/// Checks every number of `value` against `schema` (a JSON Schema object as schemars makes it).
pub fn check_ranges(schema: &Value, value: &Value) -> Result<(), RangeError> {
    walk(schema, schema, value, &mut Vec::new())
}

fn walk(root: &Value, schema: &Value, value: &Value, path: &mut Vec<String>) -> Result<(), RangeError> {
    let schema = resolve(root, schema);
    if let Some(number) = value.as_f64() {
        check_number(schema, number, path)?;
    }
    if let Some(items) = value.as_array() {
        for (index, item) in items.iter().enumerate() {
            path.push(index.to_string());
            walk(root, &schema["items"], item, path)?;
            path.pop();
        }
    }
    if let Some(object) = value.as_object() {
        for (key, item) in object {
            path.push(key.clone());
            walk(root, &schema["properties"][key], item, path)?;
            path.pop();
        }
    }
    Ok(())
}

/// Follows `$ref`, and the one non-null branch of an `anyOf`.
fn resolve<'a>(root: &'a Value, schema: &'a Value) -> &'a Value {
    if let Some(reference) = schema["$ref"].as_str() {
        return root.pointer(reference.trim_start_matches('#')).unwrap_or(schema);
    }
    if let Some(branches) = schema["anyOf"].as_array()
        && let Some(branch) = branches.iter().find(|b| b["type"] != "null")
    {
        return resolve(root, branch);
    }
    schema
}

fn check_number(schema: &Value, number: f64, path: &[String]) -> Result<(), RangeError> {
    type Holds = fn(f64, f64) -> bool;
    let limits: [(&str, &str, Holds); 4] = [
        ("minimum", "at least", |n, limit| n >= limit),
        ("maximum", "at most", |n, limit| n <= limit),
        ("exclusiveMinimum", "above", |n, limit| n > limit),
        ("exclusiveMaximum", "below", |n, limit| n < limit),
    ];
    for (key, words, holds) in limits {
        if let Some(limit) = schema[key].as_f64()
            && !holds(number, limit)
        {
            return Err(RangeError {
                pointer: path.join("."),
                value: number.to_string(),
                expected: format!("{words} {limit}"),
                doc: schema["description"].as_str().unwrap_or("no description").replace('\n', " "),
            });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn scene_schema() -> Value {
        serde_json::to_value(schemars::schema_for!(crate::Scene)).unwrap()
    }

    #[test]
    fn a_value_on_an_exclusive_limit_is_refused_with_its_place() {
        let error = check_ranges(&scene_schema(), &json!({"camera": {"nearest_m": 0.0}})).unwrap_err();
        assert_eq!(error.pointer, "camera.nearest_m");
        assert!(error.to_string().contains("above 0"), "{error}");
    }

    #[test]
    fn values_inside_pass() {
        assert_eq!(
            check_ranges(&scene_schema(), &json!({"camera": {"nearest_m": 0.5}, "budget": {"quality": 4}})),
            Ok(())
        );
    }

    #[test]
    fn options_are_looked_into() {
        let schema = serde_json::to_value(schemars::schema_for!(crate::Import)).unwrap();
        assert!(check_ranges(&schema, &json!({"height_m": -2})).is_err());
        assert!(check_ranges(&schema, &json!({"height_m": null})).is_ok());
    }
}
