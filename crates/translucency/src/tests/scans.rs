//! Scans: closed forms, the reference, holes, inverted faces, frames.

use crate::map::by_rule::{LeafMesh, WIDTH_MM, form, leaf_mesh};
use crate::scan::{Frame, Leafscan, Scan, ScanError, Solid, between_heights, in_texture, project};
use foliar_bake::{BakeError, Baker, FloatRaster, Inputs, Layer, MapRaster, Maps, Quiet, Request, run};
use foliar_plant::{Base, Part, Plant, Structure};
use foliar_schema::{Finding, Role, names};
use glam::{DQuat, DVec2, DVec3, EulerRot};
use serde_json::{Value, json};

const STRAIGHT: Frame = Frame { x: DVec3::X, y: DVec3::Y, z: DVec3::Z };

fn solid(mesh: &LeafMesh) -> Solid {
    Solid::new(&mesh.triangles, mesh.texture.clone()).unwrap()
}

/// A wedge of 40 x 60 mm, symmetric about z = 0: .5 mm thick in the middle, .01 mm more per mm to the right.
fn wedge() -> LeafMesh {
    let point = |x: f64, y: f64, side: f64| DVec3::new(x, y, side * (0.25 + 0.005 * x));
    let ring = [(-20.0, -30.0), (20.0, -30.0), (20.0, 30.0), (-20.0, 30.0)];
    let [front, back] = [1.0, -1.0].map(|side| ring.map(|(x, y)| point(x, y, side)));
    let mut triangles = vec![
        [front[0], front[1], front[2]],
        [front[0], front[2], front[3]],
        [back[0], back[2], back[1]],
        [back[0], back[3], back[2]],
    ];
    for i in 0..4 {
        let j = (i + 1) % 4;
        triangles.push([front[i], back[i], back[j]]);
        triangles.push([front[i], back[j], front[j]]);
    }
    LeafMesh { texture: vec![[DVec2::ZERO; 3]; triangles.len()], triangles }
}

#[test]
fn a_wedge_meets_its_closed_form() {
    let solid = solid(&wedge());
    assert!(solid.faults.none() && !solid.faults.inside_out);
    let frame = Frame::of(&solid, DVec3::Z);
    assert!(
        frame.z.distance(DVec3::Z) < 1e-9 && frame.y.distance(DVec3::Y) < 1e-9 && frame.x.distance(DVec3::X) < 1e-9
    );
    let scan = project(&solid, &frame, 64);
    assert_eq!((scan.width, scan.height, scan.covered()), (44, 64, 40 * 60));
    let n = DVec3::new(-0.005, 0.0, 1.0).normalize().as_vec3();
    for at in (0..scan.thickness_mm.len()).filter(|at| scan.thickness_mm[*at] > 0.0) {
        let x = (at % scan.width) as f64 + 0.5 - 22.0;
        assert!((f64::from(scan.thickness_mm[at]) - 0.5 - 0.01 * x).abs() < 1e-6);
        assert!((f64::from(scan.heights_mm[1][at]) - 0.25 - 0.005 * x).abs() < 1e-6);
        // On both sides x is the image's right.
        for side in [0, 1] {
            assert!(glam::Vec3::from(scan.normals[side][at]).distance(n) < 1e-5, "{side} {:?}", scan.normals[side][at]);
        }
    }
}

/// Rms miss of thickness, relative, of a scan in the picture of the leaf by rule, a texel inside the rim: at the rim rays
/// may leave through the wall.
fn within(scan: &Scan) -> f64 {
    let size = scan.width;
    let leaf = |x: usize, y: usize| scan.thickness_mm[y * size + x] > 0.0;
    let inside = |x: usize, y: usize| (0..3).all(|dy| (0..3).all(|dx| leaf(x + dx - 1, y + dy - 1)));
    let places = (0..(size - 2) * (size - 2)).map(|i| (1 + i % (size - 2), 1 + i / (size - 2)));
    let error = |(x, y): (usize, usize)| {
        let exact = form(DVec2::new(x as f64 + 0.5, y as f64 + 0.5) / size as f64).0;
        f64::from(scan.thickness_mm[y * size + x]) / exact - 1.0
    };
    let errors: Vec<f64> = places.filter(|(x, y)| inside(*x, *y)).map(error).collect();
    (errors.iter().map(|e| e * e).sum::<f64>() / errors.len() as f64).sqrt()
}

/// Points of the mesh stand on the texels' middles: what is left is f32, the rays' lean from the leaf's plane, and the rim.
#[test]
fn the_leaf_by_rule_comes_out_of_its_mesh() {
    let size = 128;
    let mesh = leaf_mesh(2 * size);
    let solid = solid(&mesh);
    assert!(solid.faults.none(), "{:?}", solid.faults);
    let scan = in_texture(&solid, size, 2.0).unwrap();
    assert!(scan.broken.is_empty() && scan.overlapping == 0);
    let error = within(&scan);
    println!("in texture: rms {error} of {} texels", scan.covered());
    assert!(scan.covered() > 6000);
    // Rays lean by a degree or two where veins tilt the mean of the surface: a shift by that share of the thickness.
    assert!(error < 0.02, "{error}");
    // Straight down the picture nothing leans.
    let scan = project(&solid, &STRAIGHT, size);
    let all = || mesh.triangles.iter().flatten();
    let middle =
        all().fold(DVec3::INFINITY, |a, p| a.min(*p)) / 2.0 + all().fold(DVec3::NEG_INFINITY, |a, p| a.max(*p)) / 2.0;
    let mut worst = [0.0f64; 2];
    for at in (0..scan.thickness_mm.len()).filter(|at| scan.thickness_mm[*at] > 0.0) {
        let x = ((at % scan.width) as f64 + 0.5 - scan.width as f64 / 2.0) * scan.texel_mm[0] + middle.x;
        let y = (scan.height as f64 / 2.0 - (at / scan.width) as f64 - 0.5) * scan.texel_mm[1] + middle.y;
        let exact = form(DVec2::new(x / WIDTH_MM + 0.5, 0.5 - y / WIDTH_MM));
        let front = f64::from(scan.heights_mm[0][at]) + middle.z;
        let off = [f64::from(scan.thickness_mm[at]) - exact.0, front - exact.1].map(f64::abs);
        worst = [worst[0].max(off[0]), worst[1].max(off[1])];
    }
    println!("{worst:?}");
    // Between the mesh's points, .3 mm apart, the surface is straight: of the net (.022 mm high, .13 mm wide) it may miss all, of
    // a side vein (.1 mm high, .4 mm wide) an eighth of its curvature 2 / width^2 times the cell squared: .014 mm.
    assert!(worst[0] < 0.06 && worst[1] < 0.06, "{worst:?}");
}

#[test]
fn holes_and_inverted_faces_are_said_and_left_empty() {
    let whole = leaf_mesh(64);
    let sound = project(&solid(&whole), &STRAIGHT, 64);
    assert!(sound.broken.is_empty());
    // A patch of the front, which is first of each pair.
    let patch = |i: usize| {
        let [a, b, c] = whole.triangles[i];
        let middle = (a + b + c) / 3.0;
        middle.truncate().length() < 8.0 && (b - a).cross(c - a).z > 0.0
    };
    let keep: Vec<usize> = (0..whole.triangles.len()).filter(|i| !patch(*i)).collect();
    let torn = LeafMesh {
        triangles: keep.iter().map(|i| whole.triangles[*i]).collect(),
        texture: keep.iter().map(|i| whole.texture[*i]).collect(),
    };
    let mut turned = whole.clone();
    (0..whole.triangles.len()).filter(|i| patch(*i)).for_each(|i| turned.triangles[i].swap(1, 2));
    for (mesh, open) in [(torn, true), (turned, false)] {
        let solid = solid(&mesh);
        assert_eq!((solid.faults.open_edges > 0, solid.faults.turned_edges > 0), (open, !open));
        let scan = project(&solid, &STRAIGHT, 64);
        assert!(scan.broken.len() > 100, "{}", scan.broken.len());
        assert!(scan.broken.iter().all(|at| scan.thickness_mm[*at] <= 0.0 && sound.thickness_mm[*at] > 0.0));
        let kept = |at: &usize| !scan.broken.contains(at);
        assert!((0..64 * 64).filter(|at| *at < sound.thickness_mm.len()).filter(kept).all(|at| {
            // At the rim of a hole the ray may have been moved by thousandths of a texel of 1.2 mm, where veins slope by .3.
            (scan.thickness_mm[at] - sound.thickness_mm[at]).abs() < 2e-3
        }));
    }
}

#[test]
fn a_mesh_that_faces_inward_is_said_and_turned_over() {
    let mesh = leaf_mesh(48);
    let mut inward = mesh.clone();
    inward.triangles.iter_mut().for_each(|t| t.swap(1, 2));
    inward.texture.iter_mut().for_each(|t| t.swap(1, 2));
    let (out, back) = (solid(&mesh), solid(&inward));
    assert!(!out.faults.inside_out && back.faults.inside_out && back.faults.none());
    assert_eq!(project(&out, &STRAIGHT, 48), project(&back, &STRAIGHT, 48));
}

/// Neither how the mesh lies nor where, nor what it is measured in, changes a leaf.
#[test]
fn scans_are_free_of_frames() {
    let mesh = leaf_mesh(64);
    let sound = solid(&mesh);
    let there = Frame::of(&sound, DVec3::Z);
    let scan = project(&sound, &there, 64);
    for (turn, shift, size) in [
        (DQuat::from_euler(EulerRot::XYZ, 0.4, -1.1, 2.0), DVec3::new(3e4, 1.0, -7.0), 1.0),
        (DQuat::from_rotation_x(-1.57), DVec3::ZERO, 1e-4),
        (DQuat::from_rotation_y(0.3), DVec3::ONE, 1e5),
    ] {
        let moved: Vec<[DVec3; 3]> = mesh.triangles.iter().map(|t| t.map(|p| turn * p * size + shift * size)).collect();
        let other = Solid::new(&moved, mesh.texture.clone()).unwrap();
        assert!(other.faults.none());
        let frame = Frame { x: turn * there.x, y: turn * there.y, z: turn * there.z };
        let found = Frame::of(&other, frame.z);
        assert!(found.z.distance(frame.z) < 1e-6 && found.y.dot(frame.y).abs() > 1.0 - 1e-9, "{found:?} {frame:?}");
        let other = project(&other, &frame, 64);
        assert_eq!((other.width, other.height), (scan.width, scan.height));
        let pairs = scan.thickness_mm.iter().zip(&other.thickness_mm);
        // The rim may move by a texel, where a ray passes within rounding of it.
        let off = pairs.filter(|(a, b)| (f64::from(**a) - f64::from(**b) / size).abs() > 1e-4).count();
        assert!(off <= 4, "{off} texels, size {size}");
    }
}

#[test]
fn a_leaf_over_itself_gives_its_front() {
    let mesh = leaf_mesh(32);
    let below: Vec<[DVec3; 3]> = mesh.triangles.iter().map(|t| t.map(|p| p - DVec3::Z * 5.0)).collect();
    let both = LeafMesh {
        triangles: mesh.triangles.iter().copied().chain(below).collect(),
        texture: mesh.texture.iter().chain(&mesh.texture).copied().collect(),
    };
    let (one, two) = (project(&solid(&mesh), &STRAIGHT, 32), project(&solid(&both), &STRAIGHT, 32));
    assert_eq!(two.folded, two.covered());
    assert!(one.thickness_mm.iter().zip(&two.thickness_mm).all(|(a, b)| (a - b).abs() < 1e-5));
}

#[test]
fn what_is_no_mesh_is_refused() {
    assert_eq!(Solid::new(&[], Vec::new()).unwrap_err(), ScanError::Empty);
    assert_eq!(Solid::new(&[[DVec3::ONE; 3]], Vec::new()).unwrap_err(), ScanError::Empty);
    let mut mesh = wedge();
    mesh.triangles[3][1].y = f64::NAN;
    assert!(Solid::new(&mesh.triangles, Vec::new()).unwrap_err().to_string().starts_with("triangle 3 has a corner"));
    assert_eq!(in_texture(&solid(&wedge()), 8, 1.0).unwrap_err(), ScanError::NoTexture);
}

/// Heights of both sides are a scan already: they come out as they went in.
#[test]
fn heights_of_both_sides_are_a_leaf() {
    let scan = project(&solid(&leaf_mesh(64)), &STRAIGHT, 64);
    let again = between_heights(&scan.heights_mm[0], &scan.heights_mm[1], scan.width, scan.texel_mm);
    assert_eq!(again.normals, scan.normals);
    let off =
        |a: &Scan, b: &Scan| a.thickness_mm.iter().zip(&b.thickness_mm).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
    assert!(off(&scan, &again) < 1e-6);
}

/// A leaf of millimeters as a plant of meters, without structure.
pub(super) fn plant(mesh: &LeafMesh) -> Plant {
    let corners = || mesh.triangles.iter().flatten();
    let part = Part {
        positions: corners().map(|p| (p / 1000.0).as_vec3()).collect(),
        uvs: mesh.texture.iter().flatten().map(|uv| uv.as_vec2()).collect(),
        triangles: (0..mesh.triangles.len() as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect(),
        position_ids: (0..corners().count() as u32).collect(),
        ..Part::default()
    };
    let base = Base { position_count: part.positions.len() as u32, parts: vec![part], ..Base::default() };
    let structure = Structure { roles: vec![Role::Leaf], leaf_ids: vec![Vec::new()], ..Structure::default() };
    Plant::new(base, structure).unwrap()
}

fn bake(plant: Option<&Plant>, maps: &Maps, given: Value) -> Result<(Layer, Vec<Finding>), BakeError> {
    let request = Request { given: given.as_object().unwrap().clone(), ..Request::default() };
    run(&Leafscan, &Inputs { plant, maps, neighbors: &[] }, &request, &Quiet)
}

/// Law 5, and law 4: rays by the tree of boxes against every triangle in f64, on any number of threads.
#[test]
fn each_rung_meets_the_reference() {
    let plant = plant(&leaf_mesh(40));
    for rung in Leafscan.ladder() {
        let (layer, findings) = bake(Some(&plant), &Maps::new(), Value::Object(rung.params.clone())).unwrap();
        assert!(findings.is_empty(), "{findings:?}");
        let inputs = Inputs { plant: Some(&plant), maps: &Maps::new(), neighbors: &[] };
        let exact = Leafscan.reference(&inputs, &layer.record.resolved).unwrap();
        assert_eq!(exact.rasters.len(), 5);
        for (name, raster) in &exact.rasters {
            let step = foliar_schema::raster(name).unwrap().visible_step;
            let squares: f64 =
                raster.data.iter().zip(&layer.rasters[name].data).map(|(a, b)| f64::from(a - b).powi(2)).sum();
            let rms = (squares / raster.data.len() as f64).sqrt() / step;
            assert!(rms <= rung.promise_steps, "{} {name}: {rms} steps", rung.name);
        }
        for threads in [1, 3] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let other = pool.install(|| bake(Some(&plant), &Maps::new(), Value::Object(rung.params.clone()))).unwrap();
            assert_eq!(other.0.rasters, layer.rasters);
        }
    }
}

#[test]
fn two_maps_of_heights_bake_as_the_mesh_does() {
    let map = |heights: &[f32], width: usize| MapRaster {
        raster: FloatRaster {
            width: width as u32,
            height: (heights.len() / width) as u32,
            channels: 1,
            data: heights.to_vec(),
        },
        bits: 32,
    };
    let scan = project(&solid(&leaf_mesh(64)), &STRAIGHT, 64);
    let maps = Maps::from([
        (names::MAP_HEIGHT_FRONT.into(), map(&scan.heights_mm[0], scan.width)),
        (names::MAP_HEIGHT_BACK.into(), map(&scan.heights_mm[1], scan.width)),
    ]);
    let layer = bake(None, &maps, json!({"texel_mm": scan.texel_mm[0]})).unwrap().0;
    let found = &layer.rasters[names::MAP_THICKNESS].data;
    assert!(found.iter().zip(&scan.thickness_mm).all(|(a, b)| (a - b).abs() < 1e-6));
    let says = |maps: &Maps, given: Value, word: &str| {
        let error = bake(None, maps, given).unwrap_err().to_string();
        assert!(error.contains(word), "{error}");
    };
    says(&maps, json!({}), "texel_mm");
    says(&Maps::new(), json!({}), "a closed mesh of a leaf, or height maps");
    let mut torn = maps.clone();
    torn.get_mut(names::MAP_HEIGHT_BACK).unwrap().raster.data[7] = f32::NAN;
    says(&torn, json!({"texel_mm": 1.0}), "is NaN at column 7, row 0");
    let mut other = maps.clone();
    other.insert(names::MAP_HEIGHT_BACK.into(), map(&[0.1; 4], 2));
    says(&other, json!({"texel_mm": 1.0}), "one size");
    let mut whole = maps;
    whole.get_mut(names::MAP_HEIGHT_BACK).unwrap().bits = 16;
    says(&whole, json!({"texel_mm": 1.0}), "height_scale_mm");
}

/// A leaf bent over a cylinder: in its texture it is as thick as it was flat, on a plane it says too much and says so.
#[test]
fn a_bent_leaf_is_measured_along_its_own_normals() {
    let radius = 40.0;
    let mut mesh = leaf_mesh(96);
    let bend = |p: DVec3| {
        let angle = p.x / radius;
        DVec3::new((radius + p.z) * libm::sin(angle), p.y, (radius + p.z) * libm::cos(angle) - radius)
    };
    mesh.triangles.iter_mut().for_each(|t| *t = t.map(bend));
    let solid = solid(&mesh);
    let scan = in_texture(&solid, 48, 2.0).unwrap();
    let rms = within(&scan);
    println!("bent: {rms} of {} texels", scan.covered());
    assert!(rms < 0.03 && scan.covered() > 800, "{rms}");
    assert!(scan.bend() < 0.1 && project(&solid, &STRAIGHT, 48).bend() > 0.2);
    let findings = bake(Some(&plant(&mesh)), &Maps::new(), json!({"resolution": 48})).unwrap().1;
    assert!(findings.iter().any(|f| f.code == "SCAN-BENT"), "{findings:?}");
}
