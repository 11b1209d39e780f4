//! `foliar-view`: pictures of what a file holds.

use crate::common::{FOLIAR, TRANSLUCENCY, VIEW, folder, output, run, text, tree};

const SMALL: [&str; 6] = ["--width-px", "64", "--height-px", "48", "--samples", "1"];

#[test]
fn a_baked_tree_a_raw_one_and_a_channel_are_drawn() {
    let (here, baked) = (folder(), output("view.glb"));
    let obj = tree(here.path(), 60);
    run(FOLIAR, &["bake", text(&obj), "-o", text(&baked)]).expect(0, &[]);
    let drawn = |name: &str, input, more: &[&str]| {
        let picture = here.path().join(name);
        run(VIEW, &[&[input, "-o", text(&picture)], &SMALL[..], more].concat()).expect(0, &[]);
        std::fs::read(picture).unwrap()
    };
    let raw = drawn("raw.png", text(&obj), &["--look", "plain"]);
    let lit = drawn("lit.png", text(&baked), &[]);
    let channel = drawn("channel.png", text(&baked), &["--channel", "_AMBIENT"]);
    let roles = drawn("roles.png", text(&obj), &["--channel", "role"]);
    let turning = drawn("turning.png", text(&baked), &["--turntable", "3"]);
    let beside = drawn("beside.png", text(&obj), &["--against", text(&baked)]);
    let all = [&raw, &lit, &channel, &roles, &turning, &beside];
    assert!((1..all.len()).all(|i| !all[..i].contains(&all[i])), "six pictures of six things");
    assert_eq!(turning.windows(4).filter(|w| w == b"fcTL").count(), 3, "three frames");
    assert_eq!(drawn("again.png", text(&baked), &[]), lit);
}

#[test]
fn a_neighbor_stands_where_it_is_put() {
    let here = folder();
    let obj = tree(here.path(), 60);
    // Smaller: of two equal trees, framed together, nobody could tell which one is the neighbor.
    let place = |x: &str| format!("{}@{x},0,0,0,0.7", text(&obj));
    let drawn = |name: &str, more: &[&str]| {
        let picture = here.path().join(name);
        run(VIEW, &[&[text(&obj), "-o", text(&picture)], &SMALL[..], more].concat()).expect(0, &[]);
        std::fs::read(picture).unwrap()
    };
    let alone = drawn("alone.png", &["--azimuth-deg", "0"]);
    let [left, right] =
        ["-1.2", "1.2"].map(|x| drawn(&format!("{x}.png"), &["--azimuth-deg", "0", "--neighbor", &place(x)]));
    let both = drawn("both.png", &["--azimuth-deg", "0", "--neighbor", &place("1.2"), "--neighbor", &place("-1.2")]);
    let pictures = [&alone, &left, &right, &both];
    let differ = |i: usize| pictures.iter().skip(i + 1).all(|other| *other != pictures[i]);
    assert!((0..4).all(differ), "four pictures of four things");
    run(VIEW, &[text(&obj), "-o", "x.png", "--neighbor", "gone.obj@1,0,0"]).expect(3, &["gone.obj"]);
    run(VIEW, &[text(&obj), "-o", "x.png", "--neighbor", "gone.obj"]).expect(2, &["must be FILE@x,y,z"]);
}

/// Wherever a tree is drawn, so is what stands around it.
#[test]
fn sheets_and_comparisons_have_neighbors_too() {
    let (here, baked) = (folder(), output("view-among.glb"));
    let obj = tree(here.path(), 40);
    run(FOLIAR, &["bake", text(&obj), "-o", text(&baked), "--only", "density", "--only", "wind", "--only", "branches"])
        .expect(0, &[]);
    let place = format!("{}@1.2,0,0,0,0.7", text(&obj));
    let drawn = |name: &str, more: &[&str]| {
        let picture = here.path().join(name);
        run(VIEW, &[&[text(&baked), "-o", text(&picture)], &SMALL[..], more].concat()).expect(0, &[]);
        std::fs::read(picture).unwrap()
    };
    let ways: [&[&str]; 5] =
        [&["--sheet"], &["--channels"], &["--against", text(&obj)], &["--sway", "2"], &["--sway", "2", "--sheet"]];
    for (index, way) in ways.into_iter().enumerate() {
        let alone = drawn(&format!("{index}-alone.png"), way);
        let among = drawn(&format!("{index}-among.png"), &[way, &["--neighbor", &place]].concat());
        assert_ne!(alone, among, "{way:?}");
    }
}

/// The surface around a crown is a file, and a file is drawn: alone, or with the tree inside it.
#[test]
fn the_surface_of_a_crown_is_drawn() {
    let here = folder();
    let obj = tree(here.path(), 60);
    let (crown, out) = (here.path().join("crown.glb"), here.path().join("out.glb"));
    run(FOLIAR, &["bake", text(&obj), "-o", text(&out), "--only", "density", "--surface", text(&crown)]).expect(0, &[]);
    let drawn = |input: &str, more: &[&str]| {
        let picture = here.path().join("x.png");
        run(VIEW, &[&[input, "-o", text(&picture), "--scale", "none"], &SMALL[..], more].concat()).expect(0, &[]);
        image::open(picture).unwrap().to_rgba8()
    };
    let seen = drawn(text(&crown), &["--background", "clear", "--ground", "none"]);
    let covered = seen.pixels().filter(|pixel| pixel.0[3] == 255).count();
    assert!(covered > 200, "{covered} pixels of 64 x 48 show the surface");
    let inside = format!("{}@0,0,0", text(&crown));
    assert_ne!(drawn(text(&out), &["--neighbor", &inside]), drawn(text(&out), &[]));
}

#[test]
fn a_channel_that_is_not_there_and_a_bad_ending_are_refused() {
    let here = folder();
    let obj = tree(here.path(), 60);
    let picture = here.path().join("x.png");
    run(VIEW, &[text(&obj), "-o", text(&picture), "--channel", "_WIND_WEIGHTS"])
        .expect(2, &["_WIND_WEIGHTS", "layers hold"]);
    run(VIEW, &[text(&obj), "-o", "x.jpg"]).expect(2, &["must end in .png"]);
}

/// A leaf's own layer is shown lit from behind; beside another bake, what differs.
#[test]
fn a_leaf_is_drawn_lit_from_behind() {
    let here = folder();
    crate::translucency::thickness(here.path(), "t.png", 24, 0.1);
    for (name, nm) in [("a.layer", "510"), ("b.layer", "550")] {
        let flags = ["--thickness", "t.png", "--wavelength-nm", nm, "-o", name];
        crate::common::run_in(here.path(), TRANSLUCENCY, &crate::translucency::with_flags(&flags)).expect(0, &[]);
    }
    let draw = |name: &str, more: &[&str]| {
        let flags = [&["a.layer", "-o", name], more].concat();
        crate::common::run_in(here.path(), VIEW, &flags).expect(0, &[]);
        image::open(here.path().join(name)).unwrap().to_rgba8()
    };
    let (alone, same, other) =
        (draw("x.png", &[]), draw("y.png", &["--against", "a.layer"]), draw("z.png", &["--against", "b.layer"]));
    assert!(alone.width() > 300 && same != other, "another wavelength lets other light through");
    crate::common::run_in(here.path(), VIEW, &["none.layer", "-o", "n.png"]).expect(3, &["none.layer"]);
    assert!(!here.path().join("n.png").exists());
}

/// Exposure scales what is seen; a trunk of 45 m has a bar of its size and a person that is a speck.
#[test]
fn exposure_and_scale_are_what_they_say() {
    let here = folder();
    let obj = tree(here.path(), 40);
    let drawn = |input: &str, more: &[&str]| {
        let picture = here.path().join("x.png");
        run(VIEW, &[&[input, "-o", text(&picture)], &SMALL[..], more].concat()).expect(0, &[]);
        image::open(picture).unwrap().to_rgb8()
    };
    let mean = |exposure: &str| {
        let seen = drawn(text(&obj), &["--exposure", exposure, "--background", "black", "--ground", "none"]);
        seen.pixels().map(|p| u64::from(p.0[1])).sum::<u64>()
    };
    let (dim, plain, bright) = (mean("0.5"), mean("1"), mean("2"));
    assert!(dim < plain && plain < bright, "{dim} {plain} {bright}");
    let trunk = here.path().join("trunk.obj");
    let ring =
        |y: &str| ["-1 Y -1", "1 Y -1", "1 Y 1", "-1 Y 1"].map(|p| format!("v {}\n", p.replace('Y', y))).concat();
    let sides = "f 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
    std::fs::write(&trunk, ring("0") + &ring("45") + sides).unwrap();
    let [with, without] =
        ["person", "bar"].map(|scale| drawn(text(&trunk), &["--scale", scale, "--unit", "m", "--up", "y"]));
    let changed = with.pixels().zip(without.pixels()).filter(|(a, b)| a != b).count();
    // A person of 1.7 m beside 45 m is a twenty-sixth of the height: two pixels of 48; the rest is its words and the bar.
    assert!((1..64 * 48 / 8).contains(&changed), "{changed} pixels");
}
