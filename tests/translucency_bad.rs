//! Bad maps and parameters of a leaf: file, place and remedy in the message, and nothing written.

use crate::common::{FOLIAR, TRANSLUCENCY, folder, run_in, tree, tree_text};
use crate::translucency::thickness;
use foliar_bake::FloatRaster;
use image::{ImageBuffer, Luma, Rgb};
use std::path::Path;

/// What is wrong, the arguments, exit status, and what is said.
type Row<'a> = (&'a str, Vec<&'a str>, i32, Vec<&'a str>);

const SIZE: [&str; 2] = ["--texel-mm", "0.1"];

fn gray(here: &Path, name: &str, width: u32, height: u32, value: u16) {
    ImageBuffer::from_pixel(width, height, Luma([value])).save(here.join(name)).unwrap();
}

/// An EXR of one channel.
fn exr(here: &Path, name: &str, data: Vec<f32>) {
    let raster = FloatRaster { width: 4, height: data.len() as u32 / 4, channels: 1, data };
    let bytes = foliar_carrier::encode_raster(&raster, "thickness", Path::new("a.exr")).unwrap();
    std::fs::write(here.join(name), bytes).unwrap();
}

/// A PNG whose header claims 100,000 x 100,000 texels.
fn enormous_png(here: &Path) {
    gray(here, "enormous.png", 4, 4, 9);
    let mut bytes = std::fs::read(here.join("enormous.png")).unwrap();
    bytes[16..20].copy_from_slice(&100_000u32.to_be_bytes());
    bytes[20..24].copy_from_slice(&100_000u32.to_be_bytes());
    let sum = crc32(&bytes[12..29]);
    bytes[29..33].copy_from_slice(&sum.to_be_bytes());
    std::fs::write(here.join("enormous.png"), bytes).unwrap();
}

fn crc32(bytes: &[u8]) -> u32 {
    let step = |crc: u32, byte: &u8| {
        (0..8).fold(crc ^ u32::from(*byte), |c, _| if c & 1 == 1 { 0xEDB8_8320 ^ (c >> 1) } else { c >> 1 })
    };
    !bytes.iter().fold(u32::MAX, step)
}

/// An EXR and a TIFF that claim as much: the numbers in their headers, wherever they stand.
fn enormous_exr_and_tiff(here: &Path) {
    exr(here, "enormous.exr", vec![0.2; 16]);
    let mut bytes = std::fs::read(here.join("enormous.exr")).unwrap();
    // dataWindow and displayWindow: box2i of (0, 0, 3, 3).
    for name in [&b"dataWindow\0box2i\0"[..], b"displayWindow\0box2i\0"] {
        let at = bytes.windows(name.len()).position(|window| window == name).unwrap() + name.len() + 4 + 8;
        bytes[at..at + 4].copy_from_slice(&99_999i32.to_le_bytes());
        bytes[at + 4..at + 8].copy_from_slice(&99_999i32.to_le_bytes());
    }
    std::fs::write(here.join("enormous.exr"), bytes).unwrap();
    gray(here, "enormous.tif", 4, 4, 9);
    let mut bytes = std::fs::read(here.join("enormous.tif")).unwrap();
    for tag in [256u16, 257] {
        let entry = bytes.windows(2).enumerate().skip(8).filter(|(_, window)| *window == tag.to_le_bytes());
        let at = entry.map(|(at, _)| at).find(|at| matches!(bytes[at + 2], 3 | 4) && bytes[at + 4] == 1).unwrap();
        bytes[at + 2..at + 4].copy_from_slice(&4u16.to_le_bytes());
        bytes[at + 8..at + 12].copy_from_slice(&100_000u32.to_le_bytes());
    }
    std::fs::write(here.join("enormous.tif"), bytes).unwrap();
}

fn write_maps(here: &Path) {
    thickness(here, "t.png", 16, 0.1);
    gray(here, "zero.png", 16, 16, 0);
    gray(here, "small.png", 8, 8, 20_000);
    ImageBuffer::from_pixel(8, 16, Rgb([128u8, 128, 255])).save(here.join("narrow.png")).unwrap();
    let mut data = vec![0.2; 16];
    data[9] = f32::NAN;
    exr(here, "nan.exr", data);
    exr(here, "flat.exr", vec![0.2; 16]);
    enormous_png(here);
    enormous_exr_and_tiff(here);
    let whole = std::fs::read(here.join("t.png")).unwrap();
    std::fs::write(here.join("cut.png"), &whole[..whole.len() / 2]).unwrap();
    std::fs::write(here.join("words.png"), "no picture").unwrap();
}

#[test]
fn bad_maps_and_parameters_are_refused_and_nothing_is_written() {
    let here = folder();
    write_maps(here.path());
    let before = names(here.path());
    for (what, arguments, status, said) in refused().into_iter().chain(refused_parameters()) {
        let run = run_in(here.path(), TRANSLUCENCY, &[&arguments[..], &["-o", "leaf.exr"]].concat());
        assert_eq!(run.status, status, "{what}: {run:?}");
        assert!(said.iter().all(|word| run.stderr.contains(word)), "{what}: {said:?} in {}", run.stderr);
        assert_eq!(names(here.path()), before, "{what}: something was written");
    }
    run_in(here.path(), TRANSLUCENCY, &[&sized("t.png")[..], &["-o", "leaf.glb"]].concat()).expect(2, &[".exr"]);
    run_in(here.path(), TRANSLUCENCY, &sized("t.png")).expect(2, &["-o"]);
}

/// Names beside `-o` may be those of maps: nothing that was read is written over, nor taken away.
#[test]
fn maps_that_were_read_are_left_alone() {
    let here = folder();
    thickness(here.path(), "leaf.png", 16, 0.1);
    let own = std::fs::read(here.path().join("leaf.png")).unwrap();
    let exr = [sized("leaf.png"), vec!["-o", "leaf.exr"]].concat();
    run_in(here.path(), TRANSLUCENCY, &exr).expect(2, &["leaf.png", "written over", "another output"]);
    assert!(std::fs::read(here.path().join("leaf.png")).unwrap() == own && !here.path().join("leaf.exr").exists());
    // A plan looks for its files, too.
    let planned = [sized("none.png"), vec!["-o", "x.exr", "--dry-run"]].concat();
    run_in(here.path(), TRANSLUCENCY, &planned).expect(3, &["none.png"]);
    // What an earlier bake left and nothing names any more goes.
    let with = |more: &[&'static str]| [sized("leaf.png"), vec!["-o", "x.exr"], more.to_vec()].concat();
    run_in(here.path(), TRANSLUCENCY, &with(&["--bands", "rgb"])).expect(0, &[]);
    assert!(here.path().join("x-back-red.exr").exists());
    run_in(here.path(), TRANSLUCENCY, &with(&["--sides", "front"])).expect(0, &[]);
    assert_eq!(names(here.path()), ["leaf.png", "x.exr", "x.json", "x.png"]);
}

/// A header that claims 10^10 texels is refused with 100 MB at hand: before memory is taken.
#[cfg(unix)]
#[test]
fn absurd_headers_take_no_memory() {
    let here = folder();
    write_maps(here.path());
    for map in ["enormous.png", "enormous.exr", "enormous.tif", "t.png"] {
        let limited = ["-c", "ulimit -d 100000 && exec \"$@\"", "sh", TRANSLUCENCY, "--threads", "1", "-o", "leaf.exr"];
        let run = run_in(here.path(), "sh", &[&limited[..], &sized(map)].concat());
        // The last shows that what is sound has room enough.
        run.expect(if map == "t.png" { 0 } else { 3 }, &[]);
    }
}

fn sized(map: &'static str) -> Vec<&'static str> {
    vec!["--thickness", map, "--leaf-width-mm", "60", "--thickness-scale-mm", "0.4"]
}

/// Name, arguments, status and words of maps that are refused.
fn refused() -> Vec<Row<'static>> {
    let with2 = |map: &'static str, more: &[&'static str]| [sized(map), more.to_vec()].concat();
    let with = |more: &[&'static str]| with2("t.png", more);
    vec![
        ("no map", vec!["--leaf-width-mm", "60"], 2, vec!["--thickness FILE"]),
        ("no size", vec!["--thickness", "t.png", "--thickness-scale-mm", "1"], 2, vec!["leaf_width_mm", "texel_mm"]),
        ("two sizes", with(&["--texel-mm", "1"]), 2, vec!["not both"]),
        ("no scale", vec!["--thickness", "t.png", "--leaf-width-mm", "60"], 2, vec!["thickness_scale_mm"]),
        ("nothing there", sized("none.png"), 3, vec!["none.png", "cannot be read", "name a readable PNG"]),
        ("no picture", sized("words.png"), 3, vec!["words.png", "convert it"]),
        ("cut", sized("cut.png"), 3, vec!["cut.png", "export"]),
        ("all zero", sized("zero.png"), 3, vec!["zero.png", "0 everywhere", "alpha"]),
        ("NaN", sized("nan.exr"), 3, vec!["nan.exr", "NaN", "column 1, row 2", "write it again"]),
        (
            "NaN in a relief",
            [vec!["--thickness", "flat.exr", "--height-back", "nan.exr"], SIZE.to_vec()].concat(),
            3,
            vec!["nan.exr", "column 1, row 2", "write it again"],
        ),
        (
            "NaN in an alpha",
            [vec!["--thickness", "flat.exr", "--alpha", "nan.exr"], SIZE.to_vec()].concat(),
            3,
            vec!["nan.exr", "column 1, row 2", "write it again"],
        ),
        (
            "other size of an alpha",
            with(&["--alpha", "small.png"]),
            3,
            vec!["small.png", "8 x 8", "16 x 16", "one size"],
        ),
        (
            "other size of a relief",
            with(&["--height-back", "small.png", "--height-scale-mm", "1"]),
            3,
            vec!["small.png", "8 x 8", "one size"],
        ),
        ("other size", with(&["--normal-back", "narrow.png"]), 3, vec!["narrow.png", "8 x 16", "16 x 16", "one size"]),
        (
            "zero under an alpha",
            with2("zero.png", &["--alpha", "t.png"]),
            3,
            vec!["zero.png", "0 everywhere", "this leaf"],
        ),
        ("alpha of nothing", with(&["--alpha", "zero.png"]), 3, vec!["zero.png", "map alpha", "covers no texel"]),
        ("kilometers", with(&["--thickness-offset-mm", "1e9"]), 3, vec!["t.png", "texels", "millimeters"]),
        ("no normals", with(&["--normal-back", "t.png"]), 3, vec!["t.png", "three channels"]),
        ("enormous PNG", sized("enormous.png"), 3, vec!["enormous.png", "100000 x 100000", "scale it down"]),
        ("enormous EXR", sized("enormous.exr"), 3, vec!["enormous.exr", "100000 x 100000", "scale it down"]),
        ("enormous TIFF", sized("enormous.tif"), 3, vec!["enormous.tif", "100000 x 100000", "scale it down"]),
    ]
}

/// The same of parameters.
fn refused_parameters() -> Vec<Row<'static>> {
    let with = |more: &[&'static str]| [sized("t.png"), more.to_vec()].concat();
    vec![
        ("thin index", with(&["--index", "0.9"]), 2, vec!["index", "at least 1"]),
        ("negative absorption", with(&["--absorption", "-1"]), 2, vec!["absorption", "at least 0"]),
        ("too bright", with(&["--fit-rt", "0.8,0.4"]), 2, vec!["fit_rt", "R + T", "below 1"]),
        ("no pair", with(&["--fit-rt", "0.8"]), 2, vec!["R,T"]),
        ("curve without transport", with(&["--curve", "fitted", "--entry", "lambert"]), 2, vec!["transport"]),
        (
            "two tissues",
            with(&["--fit-rt", "0.1,0.06", "--absorption", "1"]),
            2,
            vec!["absorption", "fit_rt", "one of them"],
        ),
        (
            "layers and a measurement",
            with(&["--layer", "1,8,0.8,1", "--fit-rt", "0.1,0.06"]),
            2,
            vec!["fit_rt", "layer"],
        ),
        ("a mirror of nothing", with(&["--mirror", "excluded"]), 2, vec!["mirror", "fit_rt"]),
        ("infrared", with(&["--wavelength-nm", "900"]), 2, vec!["wavelength_nm", "680"]),
        ("twice", with(&["--thickness", "small.png"]), 2, vec!["twice", "small.png"]),
        ("photograph alone", with(&["--backlit", "t.png"]), 2, vec!["name the tree"]),
        ("override of no tree", with(&["--for-material", "x:preset=dark"]), 2, vec!["--for-material", "name the tree"]),
        ("embedded into no tree", with(&["--embed-all"]), 2, vec!["--embed-all", "name the tree"]),
        ("material of no tree", with(&["--height-back", "oak=small.png"]), 2, vec!["--height-back", "name the tree"]),
        ("role of no tree", with(&["--leaf", "oak"]), 2, vec!["--leaf", "leave it out", "name the tree"]),
        ("cache of no tree", with(&["--cache", "there"]), 2, vec!["--cache", "leave it out"]),
        ("roles of no tree", with(&["--explain-roles"]), 2, vec!["--explain-roles", "leave it out"]),
        ("scene of no tree", with(&["--set", "scene.camera.nearest_m=2"]), 2, vec!["scene.camera", "leave it out"]),
    ]
}

fn names(folder: &Path) -> Vec<String> {
    let files = std::fs::read_dir(folder).unwrap().map(|file| file.unwrap().file_name().to_string_lossy().into_owned());
    let mut names: Vec<String> = files.collect();
    names.sort();
    names
}

#[test]
fn bad_maps_of_a_tree_leave_it_as_it_was() {
    let here = folder();
    write_maps(here.path());
    let two = tree_text(20).replacen("f 57/", "usemtl needles\nf 57/", 1);
    std::fs::write(here.path().join("two.obj"), two).unwrap();
    tree(here.path(), 10);
    let materials = "newmtl bark\nKd .4 .3 .2\nnewmtl leaves\nKd .2 .5 .2\nnewmtl needles\nKd .2 .5 .2\n";
    std::fs::write(here.path().join("tree.mtl"), materials).unwrap();
    std::fs::write(here.path().join("out.glb"), "old").unwrap();
    let rows: Vec<Row> = vec![
        (
            "which of two",
            vec!["two.obj", "--leaf", "leaves", "--leaf", "needles", "--thickness", "t.png"],
            2,
            vec!["leaves, needles", "--material"],
        ),
        ("no such material", vec!["tree.obj", "--thickness", "bread=t.png"], 2, vec!["bread", "leaves"]),
        (
            "bad override",
            vec!["tree.obj", "--thickness", "t.png", "--for-material", "x"],
            2,
            vec!["MATERIAL:KEY=VALUE"],
        ),
        (
            "override of no material",
            vec!["tree.obj", "--thickness", "t.png", "--for-material", "bread:preset=dark"],
            2,
            vec!["bread", "there are: leaves"],
        ),
        (
            "bad photograph",
            vec!["tree.obj", "--thickness", "t.png", "--backlit", "nan.exr"],
            3,
            vec!["nan.exr", "PNG or JPEG"],
        ),
        ("only a normal map", vec!["tree.obj", "--normal-back", "narrow.png"], 2, vec!["thickness", "leaves"]),
        ("all zero", vec!["tree.obj", "--thickness", "zero.png"], 3, vec!["zero.png", "0 everywhere", "alpha map"]),
    ];
    for (what, arguments, status, said) in rows {
        let flags = ["-o", "out.glb", "--leaf-width-mm", "60", "--thickness-scale-mm", "0.4"];
        let run = run_in(here.path(), TRANSLUCENCY, &[&arguments[..], &flags].concat());
        assert_eq!(run.status, status, "{what}: {run:?}");
        assert!(said.iter().all(|word| run.stderr.contains(word)), "{what}: {said:?} in {}", run.stderr);
        assert_eq!(std::fs::read(here.path().join("out.glb")).unwrap(), b"old", "{what}");
        assert!(!here.path().join("out.foliar").exists(), "{what}");
    }
    // A project's file may name maps of other trees: said, not refused.
    std::fs::write(here.path().join("foliar.toml"), "[translucency]\nthickness = ['oak=t.png']\n").unwrap();
    run_in(here.path(), FOLIAR, &["bake", "tree.obj", "-o", "fine.glb"]).expect(0, &["MAP-UNUSED", "oak"]);
}

/// What has no say is said: by the room through its parameters, and of a map of the side that no light falls on.
#[test]
fn what_has_no_say_is_said() {
    let here = folder();
    thickness(here.path(), "t.png", 16, 0.1);
    ImageBuffer::from_pixel(16, 16, Rgb([32_768u16, 32_768, 65_535])).save(here.path().join("n.png")).unwrap();
    let bake = |more: &[&'static str], said: &[&str]| {
        let run = run_in(here.path(), TRANSLUCENCY, &[&sized("t.png")[..], &["-o", "leaf.exr"], more].concat());
        run.expect(0, said);
    };
    bake(&["--wavelength-nm", "600", "--bands", "rgb"], &["PARAM-IDLE", "[translucency] wavelength_nm", "550"]);
    bake(&["--normal-front", "n.png", "--sides", "front"], &["MAP-UNUSED", "n.png", "lit from the back"]);
    bake(&["--thickness-offset-mm", "200"], &["MAP-UNIT", "t.png", "millimeters"]);
    bake(&["--height-back", "n.png", "--height-scale-mm", "1"], &["MAP-COLOR", "n.png", "red alone"]);
}

/// What is warned of, not refused: few bits, tags of color; and the smallest maps.
#[test]
fn doubtful_maps_are_warned_of_with_what_they_cost() {
    let here = folder();
    let coarse = ImageBuffer::from_fn(16, 16, |x, _| Luma([100 + x as u8]));
    coarse.save(here.path().join("coarse.png")).unwrap();
    let sized = ["--texel-mm", "0.1", "--thickness-scale-mm", "0.4", "-o", "leaf.exr", "--thickness"];
    let bake = |map: &str, said: &[&str]| {
        let run = run_in(here.path(), TRANSLUCENCY, &[&sized[..], &[map]].concat()).expect(0, &[]);
        let is_said = |line: &str| said.iter().all(|word| line.contains(word));
        assert!(said.is_empty() || run.stderr.lines().any(is_said), "no line says {said:?}: {}", run.stderr);
    };
    bake("coarse.png", &["MAP-BITS", "8 bits make steps", "% of the light", "16 bits", "coarse.png"]);
    // A chunk sRGB after the header.
    thickness(here.path(), "t.png", 16, 0.1);
    let bytes = std::fs::read(here.path().join("t.png")).unwrap();
    let chunk = [&b"sRGB"[..], &[0]].concat();
    let tag = [&1u32.to_be_bytes()[..], &chunk, &crc32(&chunk).to_be_bytes()].concat();
    std::fs::write(here.path().join("tagged.png"), [&bytes[..33], &tag, &bytes[33..]].concat()).unwrap();
    bake("tagged.png", &["MAP-COLOR", "sRGB", "2.3 times", "tagged.png"]);
    coarse.save(here.path().join("coarse.jpg")).unwrap();
    bake("coarse.jpg", &["MAP-COLOR", "JPEG", "coarse.jpg"]);
    for (name, width, height) in [("one.png", 1, 1), ("row.png", 9, 1), ("column.png", 1, 9)] {
        gray(here.path(), name, width, height, 30_000);
        bake(name, &[]);
    }
}
