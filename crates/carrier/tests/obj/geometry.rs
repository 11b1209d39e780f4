//! Geometry: forms of faces, names, line ends, encodings, damage, frame and unit, normals.

use super::{converted, findings, keep, read, refused, second_reader};
use foliar_carrier::obj::{Corner, NONE, parse};
use foliar_schema::{Import, Unit, Up};
use std::fmt::Write as _;

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
const CORNERS: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nvn 0 0 1\n";

fn corner(v: u32, vt: u32, vn: u32) -> Corner {
    Corner { v, vt, vn }
}

#[test]
fn all_four_forms_of_a_face() {
    for (face, vt, vn) in
        [("1 2 3", NONE, NONE), ("1/1 2/1 3/1", 0, NONE), ("1//1 2//1 3//1", NONE, 0), ("1/1/1 2/1/1 3/1/1", 0, 0)]
    {
        let file = read(&format!("{CORNERS}f {face}\n"));
        assert_eq!(file.triangles, [[corner(0, vt, vn), corner(1, vt, vn), corner(2, vt, vn)]], "{face}");
    }
}

#[test]
fn negative_indices_count_from_the_lines_so_far() {
    let file = read(&format!("{CORNERS}f -3/-3/-1 -2/-2/-1 -1/-1/-1\nv 9 9 9\nf -4 -3 -2\n"));
    assert_eq!(file.triangles[0], [corner(0, 0, 0), corner(1, 1, 0), corner(2, 2, 0)]);
    assert_eq!(file.triangles[1].map(|c| c.v), [0, 1, 2]);
    assert!(refused("v 0 0 0\nv 1 0 0\nf -1 -2 -3\n").contains("line 3: a negative v index"));
}

#[test]
fn negative_indices_reach_back_over_chunks() {
    // The same faces by absolute and by relative indices, over several chunks of a mebibyte.
    let (mut absolute, mut relative) = (String::new(), String::new());
    for i in 1..60_000 {
        let vertex = format!("v {i} 0.{i} 1.25\nvt 0.5 0.{i}\n");
        absolute.push_str(&vertex);
        relative.push_str(&vertex);
        if i > 50 {
            writeln!(absolute, "f {0}/{0} {1}/{1} {2}/{2}", i, i - 1, i - 50).unwrap();
            relative.push_str("f -1/-1 -2/-2 -51/-51\n");
        }
    }
    assert!(relative.len() > 3 << 20);
    assert!(read(&absolute).triangles == read(&relative).triangles);
}

#[test]
fn an_index_out_of_range_is_named_with_line_and_count() {
    let message = refused("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 4\n");
    assert!(message.contains("line 5: v index 4 is out of range: the file has 3 v lines"), "{message}");
    let message = refused(format!("{CORNERS}f 1/1/1 2/9/1 3/1/1\n"));
    assert!(message.contains("line 8: vt index 9") && message.contains("3 vt lines"), "{message}");
    for index in ["0", "99999999999", "-99999999999"] {
        assert!(refused(format!("{TRIANGLE}f 1 2 {index}\n")).contains("line 5"), "{index}");
    }
}

#[test]
fn a_damaged_face_or_number_is_named_with_its_line() {
    for (line, what) in [
        ("f 1 2 3/", ""),
        ("f 1 2 x", "line 5: face corner \"x\""),
        ("f 1/2/3/4 2 3", "line 5: face corner \"1/2/3/4\""),
        ("f 1.5 2 3", "line 5: face corner \"1.5\""),
        ("v 1 2", "line 5: z is missing"),
        ("v 1,5 2,5 3,5", "decimals need a point, not a comma"),
        ("v 1 nan 3", "line 5: y = NaN"),
        ("v inf 2 3", "line 5: x = inf"),
        ("v 1 2 1e30", "line 5: z = 1e30"),
        ("vt nan 0", "line 5: u = NaN"),
        ("vn a b c", "line 5: nx = \"a\""),
        ("v 1 2 3x", "line 5: z = \"3x\""),
        ("\u{1}\u{2}", "line 5: starts with"),
    ] {
        let text = format!("{TRIANGLE}{line}\n");
        if what.is_empty() {
            assert_eq!(read(&text).triangles.len(), 2, "a stroke without an index is tolerated");
        } else {
            assert!(refused(&text).contains(what), "{line}: {}", refused(&text));
        }
    }
}

#[test]
fn the_first_of_several_errors_is_named_whatever_the_chunk() {
    // Two chunks with an error each: threads finish in any order.
    let filler = "v 0 0 0\n".repeat(200_000);
    for _ in 0..8 {
        let message = refused(format!("{filler}v x 0 0\n{filler}v y 0 0\n"));
        assert!(message.contains("line 200001:"), "{message}");
    }
}

#[test]
fn concave_polygons_are_cut_inside() {
    // A fan from the first corner would leave it.
    let file = read("v 0 0 0\nv 2 -1 0\nv 1 0 0\nv 2 1 0\nv 1 1 0\nf 2 3 4 5 1\n");
    let area = |t: &[Corner; 3]| {
        let [a, b, c] = t.map(|c| file.positions[c.v as usize]);
        0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))
    };
    let areas: Vec<f64> = file.triangles.iter().map(area).collect();
    // By the shoelace formula the polygon has area 1.5.
    assert_eq!(areas.len(), 3);
    assert!(areas.iter().all(|&a| a >= 0.0) && (areas.iter().sum::<f64>() - 1.5).abs() < 1e-15, "{areas:?}");
}

#[test]
fn a_mix_of_faces_with_and_without_normals_gets_all_normals() {
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvn 0 0 1\nf 1//1 2//1 3//1\nf 1 4 2\n";
    let converted = converted(text, &Import::default());
    keep("mixed_normals", &converted.document);
    let mesh = &second_reader(&converted.document)[0];
    assert_eq!(mesh.normals.len(), mesh.positions.len());
    assert_eq!(mesh.positions.len(), 6, "a corner with a normal and one without are two vertices");
    assert!(mesh.normals[..3].iter().all(|n| *n == [0.0, 0.0, 1.0]));
    assert!(mesh.normals.iter().all(is_unit));
}

#[test]
fn normals_that_cannot_be_used_are_computed() {
    for bad in ["0 0 0", "nan nan nan", "inf 0 0", "1e-40 0 0", "-nan(ind) 0 0"] {
        let text = format!("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn {bad}\nf 1//1 2//1 3//1\n");
        let Ok(_) = parse(text.as_bytes(), "a.obj") else {
            assert!(bad.contains("ind"), "{bad}");
            continue;
        };
        let mesh = &second_reader(&converted(&text, &Import::default()).document)[0];
        assert!(mesh.normals.iter().all(|n| *n == [0.0, 0.0, 1.0]), "{bad}: {:?}", mesh.normals);
    }
}

#[test]
fn long_and_short_normals_become_unit() {
    for n in ["0 0 7", "0 0 1e-12", "3e30 3e30 0", "1 1 1"] {
        let mesh =
            &second_reader(&converted(&format!("{TRIANGLE}vn {n}\nf 1//1 2//1 3//1\n"), &Import::default()).document)
                [0];
        assert!(mesh.normals.iter().all(is_unit), "{n}");
    }
}

fn is_unit(n: &[f32; 3]) -> bool {
    // Rounding three components to f32 moves the length by less than two units in the last place.
    (n.iter().map(|c| f64::from(*c).powi(2)).sum::<f64>().sqrt() - 1.0).abs() < 2.0 * f64::from(f32::EPSILON)
}

#[test]
fn lines_and_points_are_no_triangles() {
    let converted = converted(&format!("{TRIANGLE}l 1 2 3\np 1\nl 1 2\nf 1 2\n"), &Import::default());
    assert_eq!(second_reader(&converted.document)[0].indices.len(), 3);
    let ignored = findings(&converted, "IMPORT-IGNORED");
    assert_eq!(ignored.len(), 2, "{ignored:?}");
    assert!(ignored[0].starts_with("3 lines and points"), "{ignored:?}");
}

#[test]
fn vertex_colors_on_some_vertices_are_left_out_and_said() {
    let converted = converted("v 0 0 0 1 0 0\nv 1 0 0\nv 0 1 0 0 1 0\nf 1 2 3\n", &Import::default());
    let ignored = findings(&converted, "IMPORT-IGNORED");
    assert!(ignored[0].starts_with("2 vertices with a color"), "{ignored:?}");
    assert_eq!(second_reader(&converted.document)[0].positions[1], [1.0, 0.0, 0.0]);
}

#[test]
fn line_ends_marks_and_continued_lines() {
    let plain = read("v 0 0 0\nv 1 0 0\nv 0 1 0\no a b\nf 1 2 3\n");
    for text in [
        "v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\no a b\r\nf 1 2 3\r\n",
        "v 0 0 0\rv 1 0 0\rv 0 1 0\ro a b\rf 1 2 3\r",
        "\u{FEFF}v 0 0 0\nv 1 0 0\nv 0 1 0\no a b\nf 1 2 3",
        "v 0 \\\n0 0\nv 1 0 0\nv 0 1 0\no a b\nf 1 \\\r\n 2 \\\n 3\n",
        "\tv  0 0\t0 \n\n v 1 0 0\n# v 5 5 5\\\nv 0 1 0\no  a b \nf 1 2 3",
    ] {
        let file = read(text);
        assert_eq!((file.positions, file.triangles), (plain.positions.clone(), plain.triangles.clone()), "{text:?}");
        assert_eq!(file.objects, ["a b"], "{text:?}");
    }
}

#[test]
fn a_line_after_a_continued_one_keeps_its_number() {
    assert!(refused("v 0 \\\n0 \\\n0\nv x 0 0\n").contains("line 4"));
    assert!(refused("v 0 \\\n0 \\\nx\nv 0 0 0\n").contains("line 1"));
}

#[test]
fn what_is_no_obj_is_refused_with_a_remedy() {
    for (bytes, what) in [
        (&b""[..], "no faces (0 vertices)"),
        (b"v 0 0 0\nv 1 1 1\n", "no faces (2 vertices)"),
        (b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR", "zero byte"),
        (b"glTF\x02\0\0\0\x10\0\0\0", "zero byte"),
        (b"\xFF\xFEv\0 \x000\0", "UTF-16"),
        (b"\xD4\xC3\xB2\xA1 \xFF\xFF\n", "no OBJ statement"),
    ] {
        assert!(refused(bytes).contains(what), "{}", refused(bytes));
    }
}

#[test]
fn latin_1_names_are_read_and_said() {
    let text = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl \xE9corce\nf 1 2 3\n";
    let converted = foliar_carrier::obj::convert(text, "a.obj", "".as_ref(), &Import::default()).unwrap();
    assert_eq!(converted.document.json["materials"][0]["name"], "écorce");
    assert_eq!(findings(&converted, "IMPORT-ENCODING").len(), 1);
}

#[test]
fn one_mesh_per_object_and_material_in_order() {
    let text = format!(
        "{CORNERS}o trunk\nusemtl old bark\nf 1 2 3\nusemtl moss\nf 1 2 3\no crown\nusemtl old bark\nf 1 2 3\no trunk\nf 3 2 1\n"
    );
    let converted = converted(&text, &Import::default());
    let json = &converted.document.json;
    let names: Vec<_> = json["nodes"].as_array().unwrap().iter().map(|n| n["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["trunk", "trunk", "crown"]);
    assert_eq!(second_reader(&converted.document)[0].indices.len(), 6);
    keep("objects_and_materials", &converted.document);
    let materials: Vec<_> = (0..3).map(|m| json["meshes"][m]["primitives"][0]["material"].as_u64().unwrap()).collect();
    assert_eq!(materials, [0, 1, 0]);
    assert_eq!(json["materials"][0]["name"], "old bark");
}

#[test]
fn groups_are_objects_where_there_are_none_and_few() {
    let text = format!("{CORNERS}g stem one\nf 1 2 3\ng leaves\nf 1 2 3\n");
    assert_eq!(read(&text).objects, ["stem one", "leaves"]);
    assert_eq!(read(&format!("o tree\n{text}")).objects, ["tree"]);
    let mut many = CORNERS.to_string();
    (0..100).for_each(|i| writeln!(many, "g leaf{i}\nf 1 2 3").unwrap());
    let converted = converted(&many, &Import::default());
    assert_eq!(second_reader(&converted.document).len(), 1);
    assert!(findings(&converted, "IMPORT-IGNORED")[0].starts_with("100 groups"));
}

#[test]
fn vertices_keep_the_files_own_indices() {
    let text = "v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 1\nusemtl a\nf 2/1 3/1 4/1\nf 2/2 4/1 3/1\nusemtl b\nf 4/1 3/1 2/1\n";
    let converted = converted(text, &Import::default());
    assert_eq!(converted.position_ids, [vec![1, 2, 3, 1], vec![3, 2, 1]]);
    assert_eq!(converted.position_count, 4);
    let meshes = second_reader(&converted.document);
    for (mesh, ids) in meshes.iter().zip(&converted.position_ids) {
        assert_eq!(mesh.positions.len(), ids.len());
    }
    assert_eq!(meshes[0].indices, [0, 1, 2, 3, 2, 1]);
    assert_eq!(meshes[0].uvs[3], [1.0, 0.0], "v runs downward in glTF");
    assert!(findings(&converted, "IMPORT-DEGENERATE")[0].starts_with("1 vertices"));
}

#[test]
fn axis_unit_and_height_are_applied_to_the_vertices() {
    let text = "v 100 200 0\nv 100 0 0\nv 0 0 400\nvn 0 0 1\nf 1//1 2//1 3//1\n";
    let at = |import: Import| {
        let mesh = second_reader(&converted(text, &import).document).remove(0);
        (mesh.positions[0], mesh.positions[2], mesh.normals[0])
    };
    let z_up = Import { up: Some(Up::Z), unit: Some(Unit::Cm), ..Import::default() };
    assert_eq!(at(z_up), ([1.0, 0.0, -2.0], [0.0, 4.0, 0.0], [0.0, 1.0, 0.0]));
    let high = Import { height_m: Some(5.0), ..Import::default() };
    assert_eq!(at(high), ([2.5, 5.0, 0.0], [0.0, 0.0, 10.0], [0.0, 0.0, 1.0]));
    let none = converted(text, &Import::default());
    assert_eq!((findings(&none, "IMPORT-UP").len(), findings(&none, "IMPORT-UNIT").len()), (1, 1));
    let both = converted(text, &Import { up: Some(Up::Y), unit: Some(Unit::M), ..Import::default() });
    assert_eq!(both.findings, []);
}

#[test]
fn a_flat_file_has_no_height_to_scale() {
    let import = Import { height_m: Some(5.0), ..Import::default() };
    let text = b"v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n";
    let error = foliar_carrier::obj::convert(text, "a.obj", "".as_ref(), &import).unwrap_err().to_string();
    assert!(error.contains("--height-m 5"), "{error}");
}
