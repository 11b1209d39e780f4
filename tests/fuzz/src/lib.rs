//! What is fed with bytes from anywhere: by the fuzz targets, and by the test that replays what they found.

use foliar_bake::{Inputs, Layer, Maps, Quiet, Request, run};
use foliar_carrier::{Asset, assemble, encode, layer_from_bytes, layer_to_bytes, read_bytes};
use foliar_check::Settings;
use foliar_plant::Plant;
use foliar_programs::BAKERS;
use foliar_schema::{Import, Roles, names};
use foliar_shell::config::{Fields, from_toml};
use foliar_structure::branches::{self, BranchParams};
use foliar_structure::{StructureParams, analyze};
use std::path::Path;

/// What the bytes pretend to be; the ending of a file that holds them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Wavefront OBJ.
    Obj,
    /// Its material library.
    Mtl,
    /// glTF as JSON, or GLB: the content tells.
    Gltf,
    /// A layer file.
    Layer,
    /// A configuration file.
    Toml,
    /// A picture that holds numbers: PNG, EXR, TIFF, by its bytes.
    Map,
}

impl Kind {
    /// The kind of a file, by its ending.
    pub fn of(file: &Path) -> Option<Kind> {
        match file.extension()?.to_str()? {
            "obj" => Some(Kind::Obj),
            "mtl" => Some(Kind::Mtl),
            "gltf" | "glb" => Some(Kind::Gltf),
            "layer" => Some(Kind::Layer),
            "toml" => Some(Kind::Toml),
            "png" | "exr" | "tif" => Some(Kind::Map),
            _ => None,
        }
    }
}

/// Goes the way that a file of this kind goes, as far as the bytes let it. Whatever they are, this ends, and without a panic.
pub fn feed(kind: Kind, bytes: &[u8]) {
    match kind {
        Kind::Obj => asset(bytes, "fuzz.obj"),
        Kind::Gltf => asset(bytes, "fuzz.gltf"),
        Kind::Mtl => _ = foliar_carrier::obj::parse_mtl(bytes, "fuzz.mtl"),
        Kind::Layer => layer(bytes),
        Kind::Toml => configuration(bytes),
        Kind::Map => map(bytes),
    }
}

/// A folder in which no file lies: what bytes name is not there.
const NOWHERE: &str = "/nowhere";

/// Checked, read, taken apart, baked, written.
fn asset(bytes: &[u8], name: &str) {
    let folder = Path::new(NOWHERE);
    _ = foliar_check::check(bytes.to_vec(), name, folder, &Settings::default(), None);
    let Ok(read) = read_bytes(bytes.to_vec(), name, folder, &Import::default()) else { return };
    let Ok(analysis) = analyze(&read.base, &Roles::default(), &StructureParams::default()) else { return };
    let Asset { document, base, base_hash, layers, .. } = read;
    let Ok(plant) = Plant::new(base, analysis.structure) else { return };
    let mut baked = layers;
    if baked.is_empty() {
        baked = bake(plant, analysis.layer, &base_hash);
    }
    if let Ok((document, _)) = assemble(&document, &baked) {
        _ = encode(&document, Path::new("fuzz.glb"));
    }
}

/// Layers of all rooms of a tree, with those of structure and branches.
fn bake(plant: Plant, mut structure: Layer, base_hash: &str) -> Vec<Layer> {
    structure.record.reads.insert("base".into(), base_hash.into());
    let hash = structure.content_hash();
    let Ok(found) = branches::find(plant.base(), plant.structure(), &BranchParams::default()) else {
        return vec![structure];
    };
    let limbs = branches::to_layer(&found, plant.base(), plant.structure(), &hash);
    let Ok(plant) = plant.with_branches(found.branches) else { return vec![structure] };
    let inputs = Inputs { plant: Some(&plant), maps: &Maps::new(), neighbors: &[] };
    let reads = [("base", base_hash), (names::ROOM_STRUCTURE, &hash)];
    let reads = reads.map(|(name, hash)| (name.to_owned(), hash.to_owned())).into();
    let request = Request { reads, ..Request::default() };
    let rooms = BAKERS.iter().filter(|baker| baker.needs().plant);
    let layers = rooms.filter_map(|baker| run(*baker, &inputs, &request, &Quiet).ok().map(|(layer, _)| layer));
    [structure, limbs].into_iter().chain(layers).collect()
}

/// Read, and written again: the same layer.
fn layer(bytes: &[u8]) {
    let Ok(layer) = layer_from_bytes(bytes, "fuzz.layer") else { return };
    _ = layer.content_hash();
    if let Ok(bytes) = layer_to_bytes(&layer) {
        let again = layer_from_bytes(&bytes, "fuzz.layer").map(|again| again.content_hash());
        assert_eq!(again.ok(), Some(layer.content_hash()), "a layer that was read is written and read again");
    }
}

/// Read as numbers, and where it is small baked: as thickness with a relief, as a photograph, as two heights.
fn map(bytes: &[u8]) {
    const MOST_NUMBERS: usize = 1 << 12;
    let Ok(read) = foliar_carrier::images::read_map(bytes, "fuzz") else { return };
    if read.map.raster.data.len() > MOST_NUMBERS {
        return;
    }
    let (leaf, scan) = (names::ROOM_TRANSLUCENCY, "leafscan");
    let [thickness, relief] = [names::MAP_THICKNESS, names::MAP_HEIGHT_BACK];
    let bakes: [(&str, &[&str], &str); 3] = [
        (leaf, &[thickness, relief, names::MAP_NORMAL_FRONT], r#"{"thickness_scale_mm": 0.4, "height_scale_mm": 0.1}"#),
        (leaf, &[thickness], r#"{"thickness_from": "photo"}"#),
        (scan, &[relief, names::MAP_HEIGHT_FRONT], r#"{"height_scale_mm": 0.1}"#),
    ];
    for (room, shown, given) in bakes {
        let maps: Maps = shown.iter().map(|name| ((*name).to_owned(), read.map.clone())).collect();
        let Ok(settings) = serde_json::from_str::<serde_json::Map<_, _>>(given) else { continue };
        let given = settings.into_iter().chain([("texel_mm".to_owned(), 0.1.into())]).collect();
        let inputs = Inputs { plant: None, maps: &maps, neighbors: &[] };
        let request = Request { given, ..Request::default() };
        for baker in BAKERS.iter().filter(|baker| baker.room() == room) {
            _ = run(*baker, &inputs, &request, &Quiet);
        }
    }
}

/// Read, and every section taken out of it.
fn configuration(bytes: &[u8]) {
    let (Ok(text), Ok(fields)) = (std::str::from_utf8(bytes), Fields::new(BAKERS)) else { return };
    let Ok(settings) = from_toml(&fields, Path::new("foliar.toml"), text) else { return };
    _ = settings.section::<Import>("import");
    _ = settings.section::<Roles>("roles");
    _ = settings.section::<foliar_schema::Scene>("scene");
    _ = settings.section::<foliar_schema::Check>("check");
    for baker in BAKERS {
        _ = foliar_bake::resolve_params(*baker, &settings.given(baker.room()), &Default::default());
    }
}
