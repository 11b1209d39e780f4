//! `foliar-leafscan`: a closed mesh of a leaf in, maps out; what is not closed is said.

use crate::common::{LEAFSCAN, folder, run_in};
use foliar_carrier::images::read_map;
use serde_json::Value;
use std::path::Path;

/// A leaf of 40 x 60 units, .5 thick, without these faces of its twelve.
pub fn leaf(here: &Path, without: &[usize]) {
    let mut text = String::new();
    for z in [0.25, -0.25] {
        for (x, y) in [(-20, -30), (20, -30), (20, 30), (-20, 30)] {
            text += &format!("v {x} {y} {z}\n");
        }
    }
    let faces = [
        [1, 2, 3],
        [1, 3, 4],
        [5, 7, 6],
        [5, 8, 7],
        [1, 5, 6],
        [1, 6, 2],
        [2, 6, 7],
        [2, 7, 3],
        [3, 7, 8],
        [3, 8, 4],
        [4, 8, 5],
        [4, 5, 1],
    ];
    for (_, [a, b, c]) in faces.into_iter().enumerate().filter(|(i, _)| !without.contains(i)) {
        text += &format!("f {a} {b} {c}\n");
    }
    std::fs::write(here.join("leaf.obj"), text).unwrap();
}

const SCAN: [&str; 7] = ["leaf.obj", "--unit", "mm", "--up", "y", "--resolution", "64"];

fn json(here: &Path, file: &str) -> Value {
    serde_json::from_str(&std::fs::read_to_string(here.join(file)).unwrap()).unwrap()
}

#[test]
fn a_mesh_becomes_maps_in_millimeters() {
    let here = folder();
    let here = here.path();
    leaf(here, &[]);
    let said = run_in(here, LEAFSCAN, &[&SCAN[..], &["-o", "maps.png"]].concat()).expect(0, &["a texel is 1.000000"]);
    assert!(!said.stderr.contains("SCAN-"), "{}", said.stderr);
    let facts = json(here, "maps.json")["record"]["facts"].clone();
    assert!((facts["texelMm"][0].as_f64().unwrap() - 1.0).abs() < 1e-6);
    let white = facts["stored"]["thickness"]["white"].as_f64().unwrap();
    assert!((white - 0.5).abs() < 1e-6);
    let picture = image::open(here.join("maps.png")).unwrap();
    assert_eq!((picture.width(), picture.height(), picture.color()), (44, 64, image::ColorType::L16));
    assert_eq!(picture.to_luma16().get_pixel(20, 30).0, [65_535]);
    assert_eq!(picture.to_luma16().get_pixel(0, 0).0, [0]);
    for name in ["height-front", "height-back", "normal-front", "normal-back"] {
        assert!(here.join(format!("maps-{name}.png")).exists(), "{name}");
    }
    let straight = image::open(here.join("maps-normal-back.png")).unwrap().to_rgb16();
    assert_eq!(straight.get_pixel(20, 30).0, [32_768, 32_768, 65_535]);
}

#[test]
fn holes_are_said_and_can_fail_a_pipeline() {
    let here = folder();
    let here = here.path();
    leaf(here, &[0]);
    let holed = [&SCAN[..], &["-o", "maps.exr"]].concat();
    run_in(here, LEAFSCAN, &[&holed[..], &["--fail-on", "warning"]].concat()).expect(1, &["SCAN-OPEN", "SCAN-BROKEN"]);
    assert!(!here.join("maps.exr").exists() && !here.join("maps.json").exists());
    run_in(here, LEAFSCAN, &holed).expect(0, &["SCAN-OPEN", "3 edges", "SCAN-BROKEN", "left empty"]);
    assert!(here.join("maps.exr").exists());
}

/// glTF is read as OBJ is, and texture coordinates of the mesh's own hold the same leaf.
#[test]
fn a_mesh_comes_as_gltf_or_with_its_own_texture_coordinates() {
    let here = folder();
    let here = here.path();
    leaf(here, &[]);
    let flags = ["leaf.obj", "--unit", "mm", "--up", "y", "-o", "leaf.glb"];
    run_in(here, crate::common::IMPORT, &flags).expect(0, &[]);
    run_in(here, LEAFSCAN, &["leaf.glb", "--resolution", "64", "-o", "maps.exr"]).expect(0, &["a texel is 1.000000"]);
    assert!((json(here, "maps.json")["record"]["facts"]["thicknessMm"]["median"].as_f64().unwrap() - 0.5).abs() < 1e-4);
    let text = std::fs::read_to_string(here.join("leaf.obj")).unwrap();
    let places = ["0 0", "1 0", "1 1", "0 1"].repeat(2).iter().map(|uv| format!("vt {uv}\n")).collect::<String>();
    let corner = |word: &str| word.parse::<u32>().map_or(word.to_owned(), |i| format!("{i}/{i}"));
    let face = |line: &str| match line.strip_prefix("f ") {
        Some(rest) => format!("f {}\n", rest.split(' ').map(corner).collect::<Vec<_>>().join(" ")),
        None => format!("{line}\n"),
    };
    std::fs::write(here.join("leaf.obj"), places + &text.lines().map(face).collect::<String>()).unwrap();
    let said =
        run_in(here, LEAFSCAN, &[&SCAN[..], &["--unwrap", "uv", "-o", "uv.exr"]].concat()).expect(0, &["a texel is"]);
    // 40 x 60 mm over a square of 64 texels: two edges.
    assert!(said.stderr.contains("0.625000 x 0.937500 mm"), "{}", said.stderr);
}

/// A face turned over, and a leaf that lies over itself.
#[test]
fn turned_faces_and_folds_are_said() {
    let here = folder();
    let here = here.path();
    leaf(here, &[]);
    let whole = std::fs::read_to_string(here.join("leaf.obj")).unwrap();
    std::fs::write(here.join("leaf.obj"), whole.replace("f 1 2 3", "f 1 3 2")).unwrap();
    let scan = [&SCAN[..], &["-o", "maps.exr"]].concat();
    run_in(here, LEAFSCAN, &scan).expect(0, &["SCAN-TURNED", "across 3 edges"]);
    // The same leaf again, 3 units higher.
    let moved = |line: &str| {
        let words: Vec<&str> = line.split(' ').collect();
        match words[0] {
            "v" => format!("v {} {} {}\n", words[1], words[2], words[3].parse::<f64>().unwrap() + 3.0),
            _ => {
                words[1..].iter().fold("f".to_owned(), |line, i| format!("{line} {}", i.parse::<u32>().unwrap() + 8))
                    + "\n"
            }
        }
    };
    let twice = whole.clone() + &whole.lines().map(moved).collect::<String>();
    std::fs::write(here.join("leaf.obj"), twice).unwrap();
    run_in(here, LEAFSCAN, &scan).expect(0, &["SCAN-FOLDED", "lies over itself"]);
}

#[test]
fn what_is_no_leaf_is_refused_with_a_remedy() {
    let here = folder();
    let here = here.path();
    // One triangle: nothing has a back.
    std::fs::write(here.join("leaf.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
    let flat = [&SCAN[..], &["-o", "maps.exr"]].concat();
    run_in(here, LEAFSCAN, &flat)
        .expect(3, &["leaf.obj", "no texel of the maps holds any", "edge", "look at the unit"]);
    leaf(here, &[]);
    run_in(here, LEAFSCAN, &[&SCAN[..], &["-o", "maps.jpg"]].concat()).expect(2, &[".exr, .png or .layer"]);
    run_in(here, LEAFSCAN, &[&flat[..], &["--unwrap", "uv"]].concat()).expect(3, &["no texture coordinates"]);
    run_in(here, LEAFSCAN, &[&SCAN[..5], &["-o", "maps.exr", "--resolution", "4"]].concat()).expect(2, &["resolution"]);
    let vast = ["-o", "maps.exr", "--resolution", "16384"];
    run_in(here, LEAFSCAN, &[&SCAN[..5], &vast].concat()).expect(2, &["resolution", "at most 8192"]);
    assert!(!here.join("maps.exr").exists());
}

/// Two height maps are a leaf too: what a mesh's maps said is what comes of their heights.
#[test]
fn two_height_maps_become_the_maps_of_a_leaf() {
    let here = folder();
    let here = here.path();
    leaf(here, &[]);
    run_in(here, LEAFSCAN, &[&SCAN[..], &["-o", "mesh.exr"]].concat()).expect(0, &[]);
    let heights = ["--height-front", "mesh-height-front.exr", "--height-back", "mesh-height-back.exr"];
    let sized = [&heights[..], &["--texel-mm", "1", "-o", "maps.exr"]].concat();
    run_in(here, LEAFSCAN, &sized).expect(0, &["a texel is 1.000000", "thickness 0.500000 to 0.500000"]);
    for name in ["", "-height-back", "-normal-front"] {
        let [own, mesh] = ["maps", "mesh"].map(|stem| {
            let file = format!("{stem}{name}.exr");
            read_map(&std::fs::read(here.join(&file)).unwrap(), &file).unwrap().map.raster.data
        });
        assert!(own.len() == mesh.len() && own.iter().zip(&mesh).all(|(a, b)| (a - b).abs() < 1e-5), "{name}");
    }
    // Pictures of whole numbers are read again with what is said beside them: a height has its black, too.
    let said = run_in(here, LEAFSCAN, &[&SCAN[..], &["-o", "mesh.png"]].concat()).expect(0, &["--height-scale-mm"]);
    let flags = said.stderr.lines().find(|line| line.contains("--height-offset-mm")).unwrap();
    let number = |flag: &str| flags.split(flag).nth(1).unwrap().split_whitespace().next().unwrap().to_owned();
    let (scale, offset) = (number("--height-scale-mm"), number("--height-offset-mm"));
    let pictures = ["--height-front", "mesh-height-front.png", "--height-back", "mesh-height-back.png"];
    let read = ["--texel-mm", "1", "--height-scale-mm", &scale, "--height-offset-mm", &offset, "-o", "again.exr"];
    run_in(here, LEAFSCAN, &[&pictures[..], &read].concat()).expect(0, &["median 0.5000"]);
    // One of them is no leaf, neither is one without a size, and a mesh beside them is one too many.
    run_in(here, LEAFSCAN, &[&heights[..2], &["-o", "one.exr"]].concat()).expect(2, &["--height-back FILE"]);
    run_in(here, LEAFSCAN, &[&heights[..], &["-o", "one.exr"]].concat()).expect(2, &["texel_mm", "must be given"]);
    run_in(here, LEAFSCAN, &[&SCAN[..], &heights, &["-o", "one.exr"]].concat()).expect(2, &["and not both"]);
    let wrong = |front: &[f32], back: &[f32], said: &[&str]| {
        for (name, data) in [("f.exr", front), ("b.exr", back)] {
            let (width, height) = (4, data.len() as u32 / 4);
            let raster = foliar_bake::FloatRaster { width, height, channels: 1, data: data.to_vec() };
            let bytes = foliar_carrier::encode_raster(&raster, "height", Path::new("a.exr")).unwrap();
            std::fs::write(here.join(name), bytes).unwrap();
        }
        let both = ["--height-front", "f.exr", "--height-back", "b.exr", "--texel-mm", "1", "-o", "one.exr"];
        run_in(here, LEAFSCAN, &both).expect(3, said);
    };
    wrong(&[0.1; 16], &[0.1; 8], &["b.exr", "4 x 2", "4 x 4", "one size"]);
    let mut far = [0.1; 16];
    far[6] = 2000.0;
    wrong(&far, &[0.1; 16], &["a leaf within a meter", "column 2, row 1", "--unit"]);
    let mut hole = [0.1; 16];
    hole[9] = f32::NAN;
    wrong(&hole, &[0.1; 16], &["f.exr", "NaN at column 1, row 2", "write it again"]);
    std::fs::write(here.join("cut.exr"), &std::fs::read(here.join("mesh-height-back.exr")).unwrap()[..300]).unwrap();
    let cut =
        ["--height-front", "mesh-height-front.exr", "--height-back", "cut.exr", "--texel-mm", "1", "-o", "one.exr"];
    run_in(here, LEAFSCAN, &cut).expect(3, &["cut.exr"]);
    assert!(!here.join("one.exr").exists() && !here.join("one.json").exists());
}
