//! The second reader of property tables: class, type, rows, bytes and values of every column of the contract.

use super::{Master, Problem, coded, ensure, float, is_unit, items, number};
use foliar_schema::{COLUMNS, Column, Element, REFERENCES, code, names};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};

/// A property table as it was found.
pub(super) struct Table {
    pub class: String,
    pub rows: usize,
    /// Greatest number of each column whose numbers are rows of a table.
    greatest: BTreeMap<String, f64>,
}

impl Master<'_> {
    /// All tables of the file in their order, foliar's verified: under their own class names.
    pub fn tables(&self, root: &Value, writes: &BTreeSet<&str>, found: &mut Vec<Problem>) -> Vec<Table> {
        let metadata = &self.json["extensions"][names::STRUCTURAL_METADATA];
        let mut own: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
        let is_map = |w: &&&str| w.starts_with(names::WRITES_RASTER) || w.starts_with(names::WRITES_PICTURE);
        for (class, property) in writes.iter().filter(|w| !is_map(w)).filter_map(|w| w.split_once('/')) {
            own.entry(class).or_default().insert(property);
        }
        let mut tables: Vec<Table> = Vec::new();
        for (t, table) in items(&metadata["propertyTables"]) {
            let name = table["class"].as_str().unwrap_or("");
            let class = own.keys().find(|class| root["renamed"][**class].as_str().unwrap_or(class) == name);
            let rows = number(&table["count"]);
            let place = format!("/extensions/{}/propertyTables/{t}", names::STRUCTURAL_METADATA);
            let mut greatest = BTreeMap::new();
            if let Some(class) = class {
                let once = ensure(tables.iter().all(|t| t.class != *class), || format!("a second table of {class}"));
                found.extend(coded(&code::CONTRACT_COLLISION, once).map_err(|p| p.at(&place)).err());
                let definitions = &metadata["schema"]["classes"][name]["properties"];
                for property in &own[class] {
                    let view = &self.json["bufferViews"][number(&table["properties"][property]["values"])];
                    let column = self.column(class, property, (&definitions[property], view), rows, &mut greatest);
                    found.extend(column.map_err(|problem| problem.at(&place)).err());
                }
            }
            tables.push(Table { class: class.map_or(name, |c| c).into(), rows, greatest });
        }
        let there: BTreeSet<String> = tables.iter().map(|t| t.class.clone()).collect();
        for (class, properties) in own.iter().filter(|(class, _)| !there.contains(**class)) {
            match self.named_table(root, class, properties, found) {
                Ok(table) => tables.push(table),
                Err(text) => found.extend(coded::<()>(&code::CONTRACT_TABLE, Err(text)).err()),
            }
        }
        found.extend(lost_rows(&tables));
        tables
    }

    /// A table that the root extension holds by the names of its views.
    fn named_table(
        &self,
        root: &Value,
        class: &str,
        properties: &BTreeSet<&str>,
        found: &mut Vec<Problem>,
    ) -> Result<Table, String> {
        let named = &root["tables"][class];
        let rows = named["count"].as_u64().ok_or(format!("there is no table {class}"))? as usize;
        let mut greatest = BTreeMap::new();
        for property in properties.iter().filter(|_| rows > 0) {
            let definition = &named["properties"][property];
            let views = &self.json["bufferViews"];
            let view = items(views).map(|(_, v)| v).find(|v| v["name"] == definition["bufferView"]);
            let view = view.ok_or(format!("{class}/{property} has no view"))?;
            found.extend(self.column(class, property, (definition, view), rows, &mut greatest).err());
        }
        Ok(Table { class: class.into(), rows, greatest })
    }

    /// Verifies a column; notes the greatest of its numbers where they are rows of a table.
    fn column(
        &self,
        class: &str,
        property: &str,
        (definition, view): (&Value, &Value),
        rows: usize,
        greatest: &mut BTreeMap<String, f64>,
    ) -> Result<(), Problem> {
        let Some(column) = COLUMNS.iter().find(|c| c.class == class && c.name == property) else { return Ok(()) };
        let at = format!("{class}/{property}");
        let bytes = coded(&code::CONTRACT_TABLE, self.column_bytes(column, definition, view, rows));
        let bytes = bytes.map_err(|p| Problem { text: format!("{at}: {}", p.text), ..p })?;
        let values = numbers(column, bytes);
        let range = |holds: bool, what: &str| coded(&code::CONTRACT_RANGE, ensure(holds, || format!("{at} {what}")));
        range(values.iter().all(|v| v.is_finite()), "is not finite")?;
        let [least, most] = column.range.map(f64::from);
        let outside = values.iter().position(|v| *v < least || *v > most);
        let text = |at: usize| format!("of row {} is {}, not {least} to {most}", at / column.width, values[at]);
        range(outside.is_none(), &outside.map(text).unwrap_or_default())?;
        range(property != "normal" || values.chunks(3).all(is_unit), "holds a normal that is not unit")?;
        let is_row = REFERENCES.iter().any(|(owner, name, _)| (*owner, *name) == (class, property));
        let circle = ensure(property != "parent" || !runs_in_a_circle(&values), || format!("{at} runs in a circle"));
        coded(&code::CONTRACT_ID, circle)?;
        let most = values.iter().copied().filter(|_| is_row).reduce(f64::max);
        greatest.extend(most.map(|most| (property.to_owned(), most)));
        Ok(())
    }

    fn column_bytes(&self, column: &Column, definition: &Value, view: &Value, rows: usize) -> Result<&[u8], String> {
        let kind = if column.array { "SCALAR" } else { ["SCALAR", "VEC2", "VEC3", "VEC4"][column.width - 1] };
        let component = if column.element == Element::F32 { "FLOAT32" } else { "INT32" };
        let fits = definition["type"] == kind && definition["componentType"] == component;
        ensure(fits, || format!("its class says {definition}"))?;
        let bytes = self.view(view, 8)?;
        let wanted = rows.saturating_mul(column.width * 4);
        ensure(bytes.len() == wanted, || format!("{} bytes for {rows} rows", bytes.len()))?;
        Ok(bytes)
    }
}

/// Columns that name rows which their table has not.
fn lost_rows(tables: &[Table]) -> Vec<Problem> {
    let rows = |class: &str| tables.iter().find(|t| t.class == class).map_or(0, |t| t.rows);
    let lost = |(class, property, target): (&str, &str, &str)| {
        let most = tables.iter().find(|t| t.class == class)?.greatest.get(property)?;
        let text = || format!("{class}/{property} names row {most} of {target}, which has {}", rows(target));
        coded(&code::CONTRACT_ID, ensure(*most < rows(target) as f64, text)).err()
    };
    REFERENCES.into_iter().filter_map(lost).collect()
}

/// Whether parents lead from a row back to it.
fn runs_in_a_circle(parents: &[f64]) -> bool {
    // Walk each row up until a row that a former walk ended well on; more steps than rows are a circle.
    let mut ends = vec![false; parents.len()];
    for start in 0..parents.len() {
        let (mut at, mut way) = (start, Vec::new());
        while !ends[at] {
            way.push(at);
            match parents[at] {
                up if up >= 0.0 && (up as usize) < parents.len() && way.len() <= parents.len() => at = up as usize,
                up if up >= 0.0 && (up as usize) < parents.len() => return true,
                _ => break,
            }
        }
        way.into_iter().for_each(|row| ends[row] = true);
    }
    false
}

/// All numbers of a column.
fn numbers(column: &Column, bytes: &[u8]) -> Vec<f64> {
    let whole = |b: &[u8]| f64::from(i32::from_le_bytes([b[0], b[1], b[2], b[3]]));
    match column.element {
        Element::F32 => (0..bytes.len() / 4).filter_map(|i| float(bytes, i * 4)).collect(),
        Element::I32 => bytes.chunks_exact(4).map(whole).collect(),
    }
}
