//! `foliar-translucency`: every flag does what it says, from scans, photographs and maps.

use crate::common::{LEAFSCAN, TRANSLUCENCY, VIEW, folder, run_in, text};
use crate::translucency::{normals, thickness, with_flags};
use foliar_carrier::images::read_map;
use image::{ImageBuffer, Rgb, Rgba};
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::Path;

/// R, G, B, A of an EXR.
fn texels(file: &Path) -> Vec<f32> {
    let read = read_map(&std::fs::read(file).unwrap(), &file.display().to_string()).unwrap();
    let (color, alpha) = (read.map.raster.data, read.alpha.unwrap().raster.data);
    color.chunks(3).zip(alpha).flat_map(|(color, alpha)| [color[0], color[1], color[2], alpha]).collect()
}

fn record(here: &Path, stem: &str) -> Value {
    let text = std::fs::read_to_string(here.join(format!("{stem}.json"))).unwrap();
    serde_json::from_str::<Value>(&text).unwrap()["record"].clone()
}

/// Each flag makes another map than every other, and the record tells which it was.
#[test]
fn every_flag_counts() {
    let here = folder();
    let here = here.path();
    thickness(here, "t.png", 24, 0.1);
    normals(here, "nb.png", 24);
    let flags: [&[&str]; 18] = [
        &["--preset", "dark"],
        &["--wavelength-nm", "550"],
        &["--model", "multipole"],
        &["--model", "diffusion"],
        &["--entry", "lambert"],
        &["--entry", "fresnel"],
        &["--fit", "cosine"],
        &["--curve", "fitted"],
        &["--spread", "none"],
        &["--texel-height-mm", "1"],
        &["--layer", "1,8,0.8,0.3", "--layer", "4,10,0.8,0.7"],
        &["--fit-rt", "0.1,0.06"],
        &["--fit-rt", "0.1,0.06", "--mirror", "excluded"],
        &["--normal-frame", "right-handed"],
        &["--normal-y", "down"],
        &["--normalize", "mean"],
        &["--normalize", "diffuse"],
        &["--coarsest-mm", "11"],
    ];
    let mut made = BTreeMap::new();
    for flags in [&[][..]].into_iter().chain(flags) {
        let arguments = ["--thickness", "t.png", "--normal-back", "nb.png", "--sides", "front", "-o", "leaf.exr"];
        run_in(here, TRANSLUCENCY, &with_flags(&[&arguments, flags].concat())).expect(0, &[]);
        for pair in flags.chunks(2) {
            let key = pair[0].trim_start_matches("--").replace('-', "_");
            let said = &record(here, "leaf")["given"][&key];
            let said = said.as_str().map_or_else(|| said.to_string(), String::from);
            assert!(said.contains(pair[1]), "{flags:?}: {said}");
        }
        let bytes = std::fs::read(here.join("leaf.exr")).unwrap();
        assert_eq!(made.insert(bytes, flags), None, "{flags:?} makes the map of another");
    }
    // How many filters stand for the spread shows where light spreads over several texels.
    let fine = |flags: &[&str]| {
        let sized = ["--thickness", "t.png", "--thickness-scale-mm", "0.4", "--texel-mm", "0.05", "-o", "fine.exr"];
        run_in(here, TRANSLUCENCY, &[&sized, flags].concat()).expect(0, &[]);
        texels(&here.join("fine.exr"))
    };
    assert_ne!(fine(&["--filters", "2"]), fine(&[]));
}

/// A photograph without a tree: PNG with alpha, or JPEG; veins and mean as they are said.
#[test]
fn a_photograph_alone_is_enough() {
    let here = folder();
    let here = here.path();
    let color = |x: u32, y: u32| {
        let vein = if (x + y) % 12 < 2 { 200 } else { 110 };
        [vein / 2, vein, vein / 3]
    };
    let disk = |x: u32, y: u32| (x as i32 - 24).pow(2) + (y as i32 - 24).pow(2) < 500;
    let leaf = |x: u32, y: u32| {
        let [r, g, b] = color(x, y);
        Rgba([r as u8, g as u8, b as u8, if disk(x, y) { 255 } else { 0 }])
    };
    ImageBuffer::from_fn(48, 48, leaf).save(here.join("p.png")).unwrap();
    ImageBuffer::from_fn(48, 48, |x, y| Rgb(color(x, y).map(|v| v as u8))).save(here.join("p.jpg")).unwrap();
    let bake = |photo: &str, more: &[&str]| {
        let flags = ["--thickness", photo, "--thickness-from", "photo", "--leaf-width-mm", "60", "-o", "leaf.exr"];
        let run = run_in(here, TRANSLUCENCY, &[&flags, more].concat()).expect(0, &["MAP-ESTIMATED", "estimated"]);
        assert!(!run.stderr.contains("MAP-COLOR"), "colors are what a photograph is for: {run:?}");
        (texels(&here.join("leaf.exr")), record(here, "leaf")["facts"].clone())
    };
    let (masked, facts) = bake("p.png", &["--thickness-mean-mm", "0.25"]);
    let covered = masked.chunks(4).filter(|texel| texel[3] > 0.0).count();
    assert_eq!(covered, (0..48 * 48).filter(|i| disk(i % 48, i / 48)).count(), "alpha says where the leaf is");
    let median = facts["thicknessMm"]["median"].as_f64().unwrap();
    assert!((0.15..0.3).contains(&median), "{median}");
    assert!(facts["colorEstimate"][1].as_f64().unwrap() > 0.999, "light through a green leaf is green: {facts}");
    let (whole, _) = bake("p.jpg", &[]);
    assert!(whole.chunks(4).all(|texel| texel[3] > 0.0), "a JPEG has no alpha: all of it is leaf");
    let thick = bake("p.png", &["--thickness-mean-mm", "0.5"]).0;
    assert!(masked.chunks(4).zip(thick.chunks(4)).filter(|(a, _)| a[3] > 0.0).all(|(a, b)| a[3] > b[3]));
    assert_ne!(bake("p.png", &["--veins", "dark"]).0, bake("p.png", &["--veins", "light"]).0);
}

/// From a scanned mesh to coefficients: far from its rim a plate of half a millimeter is a plate of half a millimeter.
#[test]
fn a_scan_goes_all_the_way() {
    let here = folder();
    let here = here.path();
    crate::leafscan::leaf(here, &[]);
    for (ending, scale) in [("exr", &[][..]), ("png", &["--thickness-scale-mm", "0.5"])] {
        let maps = |name: &str| format!("maps{name}.{ending}");
        let scan = ["leaf.obj", "--unit", "mm", "--up", "y", "--resolution", "64", "-o", &maps("")];
        run_in(here, LEAFSCAN, &scan).expect(0, &[]);
        let (thickness, back) = (maps(""), maps("-normal-back"));
        let leaf = ["--thickness", &thickness, "--normal-back", &back, "--texel-mm", "1", "-o", "leaf.exr"];
        run_in(here, TRANSLUCENCY, &[&leaf, scale].concat()).expect(0, &[]);
        let plate = texels(&here.join("leaf.exr"));
        let flat = vec![0.5; 44 * 64];
        let raster = foliar_bake::FloatRaster { width: 44, height: 64, channels: 1, data: flat };
        let bytes = foliar_carrier::encode_raster(&raster, "thickness", Path::new("a.exr")).unwrap();
        std::fs::write(here.join("flat.exr"), bytes).unwrap();
        let flat = ["--thickness", "flat.exr", "--texel-mm", "1", "-o", "flat-leaf.exr"];
        run_in(here, TRANSLUCENCY, &flat).expect(0, &[]);
        let middle = 4 * (32 * 44 + 22);
        let [own, exact] = [&plate, &texels(&here.join("flat-leaf.exr"))].map(|map| map[middle..middle + 4].to_vec());
        // Half floats keep .05 %, 16 bits of a normal .002 of a degree.
        assert!(own.iter().zip(&exact).all(|(a, b)| (a - b).abs() < 1e-3 * b.abs()), "{ending}: {own:?} {exact:?}");
    }
}

/// Whatever a map is divided by, a stock viewer sees the same light: factor times A.
#[test]
fn a_stock_viewer_sees_as_much_light_whatever_a_map_was_divided_by() {
    let here = folder();
    let source = crate::common::tree(here.path(), 10);
    thickness(here.path(), "t.png", 24, 0.1);
    let map = here.path().join("t.png");
    let baked = here.path().join("x.glb");
    let light = |normalize: &str| {
        let (source, map, baked) = (source.to_str().unwrap(), map.to_str().unwrap(), baked.to_str().unwrap());
        let flags = [source, "--thickness", map, "--sides", "front", "--normalize", normalize, "-o", baked];
        crate::common::run(TRANSLUCENCY, &with_flags(&flags)).expect(0, &[]);
        let (json, binary) = crate::common::open_glb(Path::new(baked));
        let shown = json["materials"].as_array().unwrap().iter();
        let mut shown = shown.map(|material| &material["extensions"]["KHR_materials_diffuse_transmission"]);
        let factor = shown.find_map(|value| value["diffuseTransmissionFactor"].as_f64()).unwrap();
        let view = json["images"].as_array().unwrap().iter().find_map(|image| image["bufferView"].as_u64()).unwrap();
        let view = &json["bufferViews"][view as usize];
        let number = |key: &str| view[key].as_u64().unwrap_or(0) as usize;
        let png = &binary[number("byteOffset")..number("byteOffset") + number("byteLength")];
        let picture = image::load_from_memory(png).unwrap().to_rgba8();
        let alphas: Vec<f64> = picture.pixels().map(|p| f64::from(p.0[3]) / 255.0).collect();
        factor * alphas.iter().sum::<f64>() / alphas.len() as f64
    };
    let physical = light("none");
    for normalize in ["mean", "diffuse"] {
        let found = light(normalize);
        // Texels beyond the leaf are filled, and count here too.
        assert!((found / physical - 1.0).abs() < 0.1, "{normalize}: {found}, not {physical}");
    }
}

/// What ships: heights become the thickness that lies beside them, and a leaf of a tree is drawn.
#[test]
fn the_leaf_that_ships_goes_through_every_program() {
    let here = folder();
    let ships = |file: &str| Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures").join(file);
    let leaf = |name: &str| ships(&format!("leaf/{name}.png"));
    let [thickness, front, back] = ["thickness", "height-front", "height-back"].map(leaf);
    let heights = ["--height-front", text(&front), "--height-back", text(&back), "--height-scale-mm", "1"];
    let scan = ["--height-offset-mm=-0.4", "--texel-mm", "0.3125", "-o", "scan.exr"];
    run_in(here.path(), LEAFSCAN, &[&heights[..], &scan].concat()).expect(0, &[]);
    let bytes = std::fs::read(here.path().join("scan.exr")).unwrap();
    let scanned = read_map(&bytes, "scan.exr").unwrap().map.raster;
    let bytes = std::fs::read(&thickness).unwrap();
    let own = read_map(&bytes, "thickness.png").unwrap().map.raster;
    let most = scanned.data.iter().zip(&own.data).map(|(a, b)| (a - 0.5 * b).abs()).fold(0.0, f32::max);
    // Each height is right to half a step of 1 / 65,535 mm, the thickness to half of that; the EXR holds half floats.
    assert!(most < 1.25 / 65_535.0 + 0.5 / 4096.0, "{most}");
    let linden = ships("linden/linden.obj");
    let size = ["--thickness-scale-mm", "0.5", "--leaf-width-mm", "80"];
    let bake = [text(&linden), "--thickness", text(&thickness), "-o", "linden.glb"];
    run_in(here.path(), TRANSLUCENCY, &[&bake[..], &size, &heights].concat()).expect(0, &[]);
    let view = |more: &[&str], status, said: &[&str]| {
        run_in(here.path(), VIEW, &[&["linden.glb", "-o", "leaf.png"], more].concat()).expect(status, said)
    };
    view(&["--light-through"], 0, &[]);
    let sheet = image::open(here.path().join("leaf.png")).unwrap();
    view(&["--light-through=bread"], 2, &["which leaf", "there are: "]);
    view(&["--light-through", "--sheet"], 2, &["--light-through"]);
    view(&["--light-through", "--against", "linden.glb"], 0, &[]);
    let held = image::open(here.path().join("leaf.png")).unwrap();
    assert!(sheet.height() > held.height() && sheet.width() > held.width());
    run_in(here.path(), VIEW, &[text(&linden), "--light-through", "-o", "none.png"]).expect(2, &["bake them first"]);
    assert!(!here.path().join("none.png").exists());
}
