//! Bytes that nobody meant well with: whatever comes, no panic, and what is accepted is sound.

use super::{converted, second_reader, shared};
use foliar_carrier::images;
use foliar_carrier::obj::{convert, parse, parse_mtl};
use foliar_schema::Import;
use proptest::prelude::*;
use std::path::Path;

/// Converts; what is accepted must be sound: finite, unit normals, indices in range.
fn never_panics(bytes: &[u8]) {
    let Ok(converted) = convert(bytes, "a.obj", Path::new("/nowhere"), &Import::default()) else { return };
    for (mesh, ids) in second_reader(&converted.document).iter().zip(&converted.position_ids) {
        assert!(mesh.indices.iter().all(|&i| (i as usize) < mesh.positions.len()));
        assert!(mesh.positions.iter().flatten().all(|c| c.is_finite()));
        assert!(mesh.normals.iter().all(|n| (n.iter().map(|c| c * c).sum::<f32>() - 1.0).abs() < 1e-5));
        assert_eq!(ids.len(), mesh.positions.len());
        assert!(ids.iter().all(|&id| id < converted.position_count));
    }
}

fn line() -> impl Strategy<Value = String> {
    let number = prop_oneof![-3i32..12, Just(0), Just(i32::MIN), Just(i32::MAX)];
    let corner = proptest::collection::vec(number, 1..4).prop_map(|c| {
        c.iter().map(|i| if *i == 0 { String::new() } else { i.to_string() }).collect::<Vec<_>>().join("/")
    });
    let face = proptest::collection::vec(corner, 0..8).prop_map(|c| format!("f {}", c.join(" ")));
    let vertex = proptest::collection::vec(-2i32..3, 2..5)
        .prop_map(|c| format!("v {}", c.iter().map(i32::to_string).collect::<Vec<_>>().join(" ")));
    let fixed = prop_oneof![
        Just("vt 0 1"),
        Just("vn 0 0 1"),
        Just("vn 0 0 0"),
        Just("usemtl a b"),
        Just("o x"),
        Just("g y"),
        Just("s off"),
        Just("mtllib none.mtl"),
        Just("mtllib"),
        Just("l 1 2"),
        Just("\\"),
        Just("f 1 2 3 \\"),
        Just("#"),
        Just("vt nan"),
    ];
    prop_oneof![3 => face, 6 => vertex, 3 => fixed.prop_map(str::to_string)]
}

proptest! {
    #[test]
    fn random_bytes(bytes in proptest::collection::vec(any::<u8>(), 0..400)) {
        never_panics(&bytes);
        let _ = parse_mtl(&bytes, "a.mtl");
        let _ = images::decode(&bytes, "a.png");
    }

    #[test]
    fn random_statements(lines in proptest::collection::vec(line(), 0..40)) {
        // Most such files are refused for one bad index: the sound part comes first.
        let sound = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvn 0 1 0\nf 1 2 3\n";
        never_panics(format!("{sound}{}", lines.join("\n")).as_bytes());
    }

    #[test]
    fn random_polygons(points in proptest::collection::vec((-3i8..4, -3i8..4, -1i8..2), 3..12)) {
        // Small whole coordinates: doubled corners, straight edges and crossings are common.
        let mut text: String = points.iter().map(|(x, y, z)| format!("v {x} {y} {z}\n")).collect();
        text.push_str(&format!("f {}\n", (1..=points.len()).map(|i| i.to_string()).collect::<Vec<_>>().join(" ")));
        let file = parse(text.as_bytes(), "a.obj").unwrap();
        prop_assert_eq!(file.triangles.len(), points.len() - 2);
        never_panics(text.as_bytes());
    }
}

#[test]
fn real_files_cut_short_anywhere() {
    let Some(shared) = shared() else { return };
    for (file, step) in [("quaternius_lowpoly/Bush_1.obj", 97), ("proctree_default/proctree.obj", 20_011)] {
        let bytes = std::fs::read(shared.join("trees").join(file)).unwrap();
        for end in (0..bytes.len()).step_by(step) {
            never_panics(&bytes[..end]);
        }
    }
}

#[test]
fn real_pictures_cut_short_anywhere() {
    let Some(shared) = shared() else { return };
    for file in ["ez_bush_2/oak_normal_1k.jpg", "proton_scatter/t_pine_branch.png"] {
        let bytes = std::fs::read(shared.join("trees").join(file)).unwrap();
        for end in (0..bytes.len().min(4000)).step_by(401) {
            let error = images::decode(&bytes[..end], file).unwrap_err().to_string();
            assert!(error.contains(file), "{error}");
        }
    }
}

#[test]
fn a_header_that_claims_too_much_is_refused_before_memory_is_taken() {
    let mut png = b"\x89PNG\r\n\x1a\n\0\0\0\x0DIHDR\0\x01\x86\xA0\0\x01\x86\xA0\x08\x06\0\0\0".to_vec();
    png.extend([0xF2, 0x5B, 0x10, 0x5C]);
    let mut bmp = b"BM\0\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0".to_vec();
    bmp.extend(60_000u32.to_le_bytes().into_iter().chain(60_000u32.to_le_bytes()));
    bmp.extend([1, 0, 24, 0]);
    bmp.extend([0; 24]);
    let mut tga = vec![0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xFF, 0xFF, 0xFF, 0xFF, 32, 0];
    tga.extend([0; 16]);
    for (bytes, name) in [(png, "a.png"), (bmp, "a.bmp"), (tga, "a.tga")] {
        let error = images::decode(&bytes, name).unwrap_err().to_string();
        assert!(error.contains(name), "{error}");
    }
}

#[test]
fn a_jpeg_whose_size_was_damaged_is_refused_before_memory_is_taken() {
    let picture = image::RgbImage::from_fn(256, 256, |x, y| image::Rgb([x as u8, y as u8, (x * y) as u8]));
    let mut jpeg = Vec::new();
    image::codecs::jpeg::JpegEncoder::new(&mut jpeg).encode_image(&picture).unwrap();
    assert_eq!(images::decode(&jpeg, "a.jpg").unwrap().width, 256);
    let frame = jpeg.windows(2).position(|marker| marker == [0xFF, 0xC0]).unwrap();
    // 20,480 x 20,480: decoding would take 3 bytes for each.
    jpeg[frame + 5..frame + 9].copy_from_slice(&[0x50, 0, 0x50, 0]);
    let error = images::decode(&jpeg, "a.jpg").unwrap_err().to_string();
    assert!(error.contains("a.jpg") && error.contains("20480 x 20480"), "{error}");
}

#[test]
fn the_same_for_any_number_of_threads() {
    // Several chunks, with indices that reach back into earlier ones and polygons of all sizes.
    let mut text = String::new();
    for i in 0..40_000 {
        let (x, y) = (i % 200, i / 200);
        text.push_str(&format!("v {x}.125 {y}.25 {}\nvt 0.{x} 0.{y}\n", (i * 7919) % 13));
        if i > 100_000 / 3 || i % 5 == 4 {
            text.push_str("f -1/-1 -2/-2 -5/-5\nf -1 -2 -3 -5\n");
        }
        if i % 9000 == 0 {
            text.push_str(&format!("o part {i}\nusemtl m{}\n", i % 2));
        }
    }
    assert!(text.len() > 1 << 20, "{}", text.len());
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| converted(&text, &Import::default()))
    };
    let (one, four) = (with(1), with(4));
    assert!(one.document == four.document && one.position_ids == four.position_ids);
    assert_eq!(one.findings, four.findings);
}
