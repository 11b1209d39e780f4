//! What a tool lost in part: channels and roles of some primitives, columns of tables, maps of leaves.

use super::{carried_by, name, primitives};
use crate::Report;
use foliar_carrier::survey::Survey;
use foliar_schema::{Channel, code, names};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};

/// Role of a primitive.
pub fn role(primitive: &Value) -> Option<&str> {
    ["extensions", "extras"].iter().find_map(|place| primitive[place][names::EXTENSION]["role"].as_str())
}

/// Name of a primitive's material: tools that join and split primitives keep it.
fn material<'a>(seen: &'a Survey, primitive: &Value) -> Option<&'a str> {
    seen.document.list("materials").get(primitive["material"].as_u64()? as usize)?["name"].as_str()
}

/// The one role of every material that has one.
fn roles(seen: &Survey) -> BTreeMap<&str, &str> {
    let mut roles: BTreeMap<&str, BTreeSet<Option<&str>>> = BTreeMap::new();
    for (_, primitive) in primitives(seen) {
        if let Some(material) = material(seen, primitive) {
            roles.entry(material).or_default().insert(role(primitive));
        }
    }
    let one = |(material, roles): (_, BTreeSet<_>)| {
        let role: Option<&str> = roles.first().copied().flatten().filter(|_| roles.len() == 1);
        Some((material, role?))
    };
    roles.into_iter().filter_map(one).collect()
}

/// Roles that some primitives have lost, or have another of.
pub fn lost_roles(after: &Survey, master: &Survey, report: &mut Report) {
    let known = roles(master);
    let (mut without, mut other) = (0, BTreeSet::new());
    for (_, primitive) in primitives(after) {
        let Some(material) = material(after, primitive) else { continue };
        match (known.get(material), role(primitive)) {
            (Some(_), None) => without += 1,
            (Some(old), Some(new)) if *old != new => {
                other.insert(format!("material {material:?} is {old} in the master and {new} here"));
            }
            _ => {}
        }
    }
    if without > 0 {
        report.say(
            &code::LOST_ROLE,
            "",
            format!("{without} primitives whose material has a role in the master have none"),
        );
    }
    other.into_iter().for_each(|text| report.say(&code::LOST_ROLE, "", text));
}

/// Primitives of a role that have lost a channel which every primitive of that role has in the master.
pub fn lost_channel(after: &Survey, master: &Survey, channel: &Channel, report: &mut Report) {
    let name = name(master, channel.name);
    let count = |seen: &Survey, wanted: &str| {
        let of_role = primitives(seen).filter(|(_, p)| role(p) == Some(wanted));
        of_role.fold((0, 0), |(with, all), (_, p)| (with + usize::from(carried_by(p, name)), all + 1))
    };
    for wanted in ["leaf", "wood"] {
        let ((had, all), (has, now)) = (count(master, wanted), count(after, wanted));
        if had == all && all > 0 && has < now {
            let message = format!("{name} stood on every {wanted} primitive of the master, and here on {has} of {now}");
            report.say(&code::LOST_CHANNEL, "", message);
        }
    }
}

/// Columns by table: classes that foliar's records say were written.
fn columns(seen: &Survey) -> BTreeMap<String, (u64, BTreeSet<String>)> {
    let mut columns = BTreeMap::new();
    let keys = |table: &Value| -> BTreeSet<String> {
        table["properties"].as_object().into_iter().flat_map(|all| all.keys().cloned()).collect()
    };
    let metadata = &seen.document.json["extensions"][names::STRUCTURAL_METADATA]["propertyTables"];
    for table in metadata.as_array().into_iter().flatten() {
        let class = table["class"].as_str().unwrap_or_default().to_owned();
        columns.insert(class, (table["count"].as_u64().unwrap_or(0), keys(table)));
    }
    let named = seen.document.json["extensions"][names::EXTENSION]["tables"].as_object();
    for (class, table) in named.into_iter().flatten() {
        columns.insert(class.clone(), (table["count"].as_u64().unwrap_or(0), keys(table)));
    }
    columns
}

/// Tables of foliar and their columns.
pub fn lost_tables(after: &Survey, master: &Survey, report: &mut Report) {
    let records = master.foliage().map_or(&Value::Null, |root| &root["records"]);
    let writes = records.as_array().into_iter().flatten().flat_map(|r| r["writes"].as_array().into_iter().flatten());
    let is_map = |write: &&str| write.starts_with(names::WRITES_RASTER) || write.starts_with(names::WRITES_PICTURE);
    let written = writes.filter_map(Value::as_str).filter(|write| !is_map(write));
    let own: BTreeSet<&str> =
        written.filter_map(|write| write.split_once('/')).map(|(class, _)| name(master, class)).collect();
    let now = columns(after);
    for (class, (rows, held)) in columns(master).iter().filter(|(class, _)| own.contains(class.as_str())) {
        match now.get(class) {
            None => report.say(&code::LOST_TABLE, "", format!("table {class} of the master, {rows} rows, is gone")),
            Some((left, _)) if left != rows => {
                report.say(&code::LOST_TABLE, "", format!("table {class}: {rows} rows in the master, {left} here"));
            }
            Some((_, has)) => {
                let gone: Vec<&str> = held.difference(has).map(String::as_str).collect();
                if !gone.is_empty() {
                    report.say(&code::LOST_TABLE, "", format!("table {class} has lost {}", gone.join(", ")));
                }
            }
        }
    }
}

/// Textures of foliar's maps, by the names that the master gives them.
pub fn lost_maps(after: &Survey, master: &Survey, report: &mut Report) {
    let sheets = master.foliage().and_then(|root| root[names::ROOM_TRANSLUCENCY].as_object());
    let maps = |sheet: &Value| sheet["maps"].as_object().cloned().unwrap_or_default();
    let wanted: BTreeSet<String> = sheets
        .into_iter()
        .flatten()
        .flat_map(|(_, sheet)| maps(sheet))
        .filter_map(|(_, link)| link["texture"].as_str().map(String::from))
        .collect();
    let held: BTreeSet<&str> = after.document.list("textures").iter().filter_map(|t| t["name"].as_str()).collect();
    let gone: Vec<&str> = wanted.iter().map(String::as_str).filter(|name| !held.contains(name)).collect();
    if !gone.is_empty() {
        let message = format!("{} of the master are gone, or lost their names", gone.join(", "));
        report.say(&code::LOST_CHANNEL, "", message);
    }
    let shows = |seen: &Survey| {
        let shown =
            |m: &&Value| !m["extensions"]["KHR_materials_diffuse_transmission"]["diffuseTransmissionTexture"].is_null();
        seen.document.list("materials").iter().filter(shown).count()
    };
    if !wanted.is_empty() && shows(master) > 0 && shows(after) == 0 {
        report.say(&code::LOST_CHANNEL, "", "no material shows the maps of light through leaves any more");
    }
}
