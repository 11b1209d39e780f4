//! Pictures of OBJ materials: what passes unchanged, what becomes PNG, joined alpha, bump maps, loose
//! images, and what cannot be read.

use super::{Converted, converted_in, findings, keep, second_reader};
use foliar_carrier::images::{self, Format};
use foliar_carrier::obj::convert;
use foliar_schema::Import;
use image::{ImageFormat, RgbaImage};
use std::path::Path;

const FACE: &str = "mtllib t.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl a\nf 1/1 2/2 3/3\n";

fn picture(format: ImageFormat, pixel: impl Fn(u32, u32) -> [u8; 4]) -> Vec<u8> {
    let rgba = RgbaImage::from_fn(8, 8, |x, y| image::Rgba(pixel(x, y)));
    let mut bytes = std::io::Cursor::new(Vec::new());
    if format == ImageFormat::Jpeg {
        image::DynamicImage::ImageRgba8(rgba).into_rgb8().write_to(&mut bytes, format).unwrap();
    } else {
        rgba.write_to(&mut bytes, format).unwrap();
    }
    bytes.into_inner()
}

fn opaque(x: u32, y: u32) -> [u8; 4] {
    [x as u8 * 30, y as u8 * 30, 40, 255]
}

fn cut_out(x: u32, y: u32) -> [u8; 4] {
    [x as u8 * 30, y as u8 * 30, 40, if x < 4 { 255 } else { 0 }]
}

/// Converts a triangle with this library beside these files, and leaves it for the validator.
fn tree(mtl: &str, files: &[(&str, Vec<u8>)], import: &Import) -> Converted {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("t.mtl"), mtl).unwrap();
    files.iter().for_each(|(name, bytes)| std::fs::write(folder.path().join(name), bytes).unwrap());
    let converted = converted_in(folder.path(), FACE, import);
    let words: String = mtl.chars().filter(char::is_ascii_alphanumeric).collect();
    let bytes: usize = files.iter().map(|(_, bytes)| bytes.len()).sum();
    keep(&format!("texture_{words}_{bytes}"), &converted.document);
    converted
}

/// Bytes and MIME type of an image of the document.
fn image_of(converted: &Converted, index: usize) -> (&[u8], &str) {
    let json = &converted.document.json;
    let image = &json["images"][index];
    let view = &json["bufferViews"][image["bufferView"].as_u64().unwrap() as usize];
    let [start, length] = ["byteOffset", "byteLength"].map(|k| view[k].as_u64().unwrap() as usize);
    (&converted.document.buffers[0][start..start + length], image["mimeType"].as_str().unwrap())
}

#[test]
fn png_and_jpeg_pass_unchanged_and_others_become_png() {
    for (format, mime) in [
        (ImageFormat::Png, "image/png"),
        (ImageFormat::Jpeg, "image/jpeg"),
        (ImageFormat::Tiff, "image/png"),
        (ImageFormat::Tga, "image/png"),
        (ImageFormat::Bmp, "image/png"),
    ] {
        let bytes = picture(format, opaque);
        // The name lies about the format: only the bytes count.
        let converted = tree("newmtl a\nmap_Kd leaf.dat\n", &[("leaf.dat", bytes.clone())], &Import::default());
        let (found, found_mime) = image_of(&converted, 0);
        assert_eq!(found_mime, mime, "{format:?}");
        let passes = matches!(format, ImageFormat::Png | ImageFormat::Jpeg);
        assert_eq!(found == bytes, passes, "{format:?}");
        let (ours, theirs) =
            (images::decode(found, "a").unwrap(), image::load_from_memory_with_format(&bytes, format).unwrap());
        assert_eq!(ours.rgba, theirs.into_rgba8().into_raw(), "{format:?}");
        assert_eq!(converted.document.json["materials"][0].get("alphaMode"), None);
    }
}

#[test]
fn what_is_no_picture_goes_without_and_is_said() {
    let mut exr = b"\x76\x2F\x31\x01".to_vec();
    exr.extend([0; 60]);
    let mut webp = b"RIFF\x20\0\0\0WEBPVP8 ".to_vec();
    webp.extend([0; 60]);
    let cut = picture(ImageFormat::Png, opaque)[..60].to_vec();
    for (bytes, what) in [
        (exr, "EXR"),
        (webp, "WebP"),
        (b"hello".to_vec(), "no known picture"),
        (Vec::new(), "no known"),
        (cut, "damaged PNG"),
    ] {
        let converted = tree("newmtl a\nmap_Kd leaf.png\nKd 1 0 0\n", &[("leaf.png", bytes)], &Import::default());
        let said = findings(&converted, "IMPORT-TEXTURE");
        assert!(said.len() == 1 && said[0].contains(what), "{said:?}");
        assert_eq!(converted.document.json.get("images"), None);
        assert_eq!(converted.document.json["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"][1], 0.0);
    }
    let missing = tree("newmtl a\nmap_Kd leaf.png\n", &[], &Import::default());
    assert!(findings(&missing, "IMPORT-TEXTURE")[0].contains("leaf.png is missing"));
}

#[test]
fn a_picture_outside_is_refused_with_the_librarys_line() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("t.mtl"), "newmtl a\nKd 1 1 1\nmap_Kd C:\\maps\\leaf.png\n").unwrap();
    let error = convert(FACE.as_bytes(), "tree.obj", folder.path(), &Import::default()).unwrap_err().to_string();
    assert!(
        error.contains("t.mtl, line 3: \"C:\\\\maps\\\\leaf.png\" is an absolute path") && error.contains("--search"),
        "{error}"
    );
    let maps = tempfile::tempdir().unwrap();
    std::fs::write(maps.path().join("leaf.png"), picture(ImageFormat::Png, opaque)).unwrap();
    let import = Import { search: vec![maps.path().to_str().unwrap().into()], ..Import::default() };
    let converted = convert(FACE.as_bytes(), "tree.obj", folder.path(), &import).unwrap();
    assert_eq!(converted.document.json["images"].as_array().unwrap().len(), 1);
}

#[test]
fn alpha_in_the_color_picture_cuts_out_and_passes_unchanged() {
    let png = picture(ImageFormat::Png, cut_out);
    for mtl in ["newmtl a\nmap_Kd leaf.png\n", "newmtl a\nKd 0 0 0\nd 0.5\nmap_Kd leaf.png\nmap_d -s 1 1 1 leaf.png\n"]
    {
        let converted = tree(mtl, &[("leaf.png", png.clone())], &Import::default());
        assert!(image_of(&converted, 0).0 == png);
        let material = &converted.document.json["materials"][0];
        assert_eq!((material["alphaMode"].as_str(), material["alphaCutoff"].as_f64()), (Some("MASK"), Some(0.5)));
        assert_eq!(material["pbrMetallicRoughness"]["baseColorFactor"], serde_json::json!([1.0, 1.0, 1.0, 1.0]));
        assert_eq!(converted.document.json["images"].as_array().unwrap().len(), 1);
    }
}

#[test]
fn alpha_of_another_picture_is_joined() {
    let gray = picture(ImageFormat::Bmp, |x, _| if x < 4 { [255; 4] } else { [0, 0, 0, 255] });
    let color = picture(ImageFormat::Jpeg, opaque);
    let files = [("leaf.jpg", color.clone()), ("mask.bmp", gray)];
    let converted = tree("newmtl a\nmap_Kd leaf.jpg\nmap_d mask.bmp\n", &files, &Import::default());
    let (bytes, mime) = image_of(&converted, 0);
    let joined = images::decode(bytes, "joined").unwrap();
    let alone = images::decode(&color, "color").unwrap();
    assert_eq!((mime, joined.has_alpha), ("image/png", true));
    for (pixel, (ours, theirs)) in joined.rgba.chunks(4).zip(alone.rgba.chunks(4)).enumerate() {
        assert_eq!(ours, [theirs[0], theirs[1], theirs[2], if pixel % 8 < 4 { 255 } else { 0 }]);
    }
    assert_eq!(converted.document.json["materials"][0]["alphaMode"], "MASK");
    let again = tree("newmtl a\nmap_Kd leaf.jpg\nmap_d mask.bmp\n", &files, &Import::default());
    assert!(again.document == converted.document);
}

#[test]
fn a_mask_alone_cuts_out_the_material_color() {
    let mask = picture(ImageFormat::Png, |x, _| if x < 4 { [255; 4] } else { [0, 0, 0, 255] });
    let converted = tree("newmtl a\nKd 0 0.5 0\nmap_d mask.png\n", &[("mask.png", mask)], &Import::default());
    let material = &converted.document.json["materials"][0];
    assert_eq!(material["pbrMetallicRoughness"]["baseColorFactor"], serde_json::json!([0.0, 0.5, 0.0, 1.0]));
    assert_eq!(material["alphaMode"], "MASK");
}

#[test]
fn bump_maps_are_heights_unless_they_are_normals() {
    let normals = picture(ImageFormat::Png, |x, _| [118 + (x as u8 % 2) * 20, 128, 250, 255]);
    let heights = picture(ImageFormat::Png, |x, _| {
        [x as u8 * 30; 3].map(|c| c).into_iter().chain([255]).collect::<Vec<_>>().try_into().unwrap()
    });
    for (key, bytes, unchanged, said) in [
        ("map_Bump", &normals, true, "is a normal map"),
        ("bump -bm 0.3", &heights, false, "holds heights"),
        ("norm", &normals, true, ""),
    ] {
        let converted = tree(&format!("newmtl a\n{key} b.png\n"), &[("b.png", bytes.clone())], &Import::default());
        assert_eq!(image_of(&converted, 0).0 == *bytes, unchanged, "{key}");
        assert_eq!(converted.document.json["materials"][0]["normalTexture"]["index"], 0);
        assert_eq!(second_reader(&converted.document)[0].tangents.len(), 3);
        let found = findings(&converted, "IMPORT-BUMP");
        assert!(
            if said.is_empty() { found.is_empty() } else { found.len() == 1 && found[0].contains(said) },
            "{found:?}"
        );
    }
}

#[test]
fn loose_pictures_go_to_their_part() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("loose leaf.png");
    std::fs::write(&file, picture(ImageFormat::Png, cut_out)).unwrap();
    let text = FACE.replace("mtllib t.mtl\n", "");
    for named in [file.to_str().unwrap(), "loose leaf.png"] {
        let import = Import { texture: vec![format!("a={named}")], ..Import::default() };
        let converted = converted_in(folder.path(), &text, &import);
        assert_eq!(converted.document.json["materials"][0]["alphaMode"], "MASK", "{named}");
    }
    for (given, what) in [("b=x.png", "name one of [\"a\"]"), ("x.png", "PART=FILE")] {
        let import = Import { texture: vec![given.into()], ..Import::default() };
        let error = convert(text.as_bytes(), "tree.obj", folder.path(), &import).unwrap_err().to_string();
        assert!(error.contains(what), "{error}");
    }
}

#[test]
fn a_textured_material_on_faces_without_coordinates_goes_plain() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("t.mtl"), "newmtl a\nKd 1 0 0\nmap_Kd leaf.png\n").unwrap();
    std::fs::write(folder.path().join("leaf.png"), picture(ImageFormat::Png, opaque)).unwrap();
    let converted = converted_in(folder.path(), &format!("{FACE}o bare\nf 1 2 3\n"), &Import::default());
    let materials = converted.document.json["materials"].as_array().unwrap();
    assert_eq!(materials.len(), 2);
    assert!(materials[1]["pbrMetallicRoughness"].get("baseColorTexture").is_none());
    assert!(findings(&converted, "IMPORT-TEXTURE")[0].contains("no texture coordinates"));
}

#[test]
fn formats_are_told_by_their_bytes() {
    for (format, expected) in [
        (ImageFormat::Png, Format::Png),
        (ImageFormat::Jpeg, Format::Jpeg),
        (ImageFormat::Tiff, Format::Tiff),
        (ImageFormat::Tga, Format::Tga),
        (ImageFormat::Bmp, Format::Bmp),
    ] {
        assert_eq!(images::sniff(&picture(format, opaque)), expected);
    }
    let text = std::fs::read(Path::new(env!("CARGO_MANIFEST_DIR")).join("Cargo.toml")).unwrap();
    assert_eq!(images::sniff(&text), Format::Unknown);
}
