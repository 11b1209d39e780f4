//! The page in docs/examples/minimal, which knows a baked file by docs/FOLIAR_foliage.md alone, in a real browser:
//! what it draws is what the file says.

use crate::common::{FOLIAR, folder, open_glb, run, skip, text};
use crate::outsiders::{packaged, repository, starts};
use image::{Rgba, RgbaImage};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// What the page is asked for, by the name of the picture.
const PAGES: [(&str, &str); 6] = [
    ("lit", ""),
    ("lit-without-ambient", "ambient=off"),
    ("lit-without-soft", "soft=off"),
    // Light of the sky alone, and the crown cut open at its middle: each pixel is base color times k_a.
    ("sky", "sun=off&cut=on"),
    ("sky-without-ambient", "sun=off&cut=on&ambient=off"),
    ("again", "sun=off&cut=on"),
];

/// The browser: what CHROMIUM names, else chromium.
fn browser() -> Option<String> {
    let named = std::env::var("CHROMIUM").unwrap_or_else(|_| "chromium".into());
    if starts(Command::new(&named).arg("--version")) {
        return Some(named);
    }
    skip(&format!("the example page: {named} does not start: install chromium, or name it in CHROMIUM"));
    None
}

fn pictures(browser: &str, tree: &Path, here: &Path) -> [RgbaImage; 6] {
    let script = repository().join("xtask/consumer/shoot.mjs");
    let pages = PAGES.map(|(name, query)| format!("{name}={query}"));
    let mut node = Command::new("node");
    node.arg(script).arg(browser).args([tree, here]).args(&pages).stdin(Stdio::null());
    let output = node.output().unwrap();
    let said = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success(), "{said}{}", String::from_utf8_lossy(&output.stderr));
    // One mesh of leaves, with both channels; wood has k_a alone.
    assert!(said.contains(r#""soft":1"#) && said.contains(r#""ambient":2"#), "{said}");
    assert!(said.contains(r#""leaf":1"#) && said.contains(r#""wood":1"#), "{said}");
    PAGES.map(|(name, _)| image::open(here.join(format!("{name}.png"))).unwrap().into_rgba8())
}

/// Linear light of an sRGB byte.
#[expect(clippy::disallowed_methods, reason = "compared with a tolerance, stored nowhere")]
fn linear(byte: u8) -> f64 {
    let share = f64::from(byte) / 255.0;
    if share <= 0.04045 { share / 12.92 } else { ((share + 0.055) / 1.055).powf(2.4) }
}

/// Where leaves are wholly seen, bright enough to divide by, and what they lose to k_a: x, y, ratio.
fn shares(with: &RgbaImage, without: &RgbaImage) -> Vec<[f64; 3]> {
    let is_leaf = |p: &Rgba<u8>| p.0[3] == 255 && p.0[1] > p.0[0] && p.0[1] > 96;
    let share = |(x, y, p): (u32, u32, &Rgba<u8>)| {
        let ratio = linear(with.get_pixel(x, y).0[1]) / linear(p.0[1]);
        [f64::from(x), f64::from(y), ratio]
    };
    without.enumerate_pixels().filter(|(.., p)| is_leaf(p)).map(share).collect()
}

fn mean(values: impl Iterator<Item = f64> + Clone) -> f64 {
    values.clone().sum::<f64>() / values.count() as f64
}

/// Distance of each place from the middle of all, in units of how far they spread across and up.
fn radii(shares: &[[f64; 3]]) -> Vec<f64> {
    let middle = [0, 1].map(|axis| mean(shares.iter().map(|s| s[axis])));
    let spread = [0, 1].map(|axis| mean(shares.iter().map(|s| (s[axis] - middle[axis]).powi(2))).sqrt());
    let radius =
        |s: &[f64; 3]| glam::DVec2::from_array([0, 1].map(|axis| (s[axis] - middle[axis]) / spread[axis])).length();
    shares.iter().map(radius).collect()
}

/// Least and greatest ambient coefficient of the file, by the letter of the format.
fn ambient(tree: &Path) -> [f64; 2] {
    let (json, binary) = open_glb(tree);
    let number = |value: &serde_json::Value| value.as_u64().unwrap_or(0) as usize;
    let mut ends = [f64::INFINITY, f64::NEG_INFINITY];
    for mesh in json["meshes"].as_array().unwrap() {
        let accessor = &json["accessors"][number(&mesh["primitives"][0]["attributes"]["_AMBIENT"])];
        let view = &json["bufferViews"][number(&accessor["bufferView"])];
        let start = number(&view["byteOffset"]) + number(&accessor["byteOffset"]);
        for bytes in binary[start..].chunks_exact(4).take(number(&accessor["count"])) {
            let value = f64::from(f32::from_le_bytes(bytes.try_into().unwrap()));
            ends = [ends[0].min(value), ends[1].max(value)];
        }
    }
    ends
}

#[test]
fn the_example_page_shows_what_was_baked() {
    if packaged("docs/examples/minimal", "three/package.json").is_none() {
        return;
    }
    let Some(browser) = browser() else { return };
    let here = folder();
    let tree: PathBuf = here.path().join("linden.glb");
    let linden = repository().join("fixtures/linden/linden.obj");
    run(FOLIAR, &["bake", text(&linden), "-o", text(&tree), "--only", "density"]).expect(0, &[]);
    let [lit, no_ambient, no_soft, sky, plain_sky, again] = pictures(&browser, &tree, here.path());
    assert_eq!(sky, again, "the same page, the same picture");
    let solid = lit.pixels().filter(|p| p.0[3] == 255).count();
    assert!(solid > lit.len() / 4 / 20, "a tree fills more than a twentieth of the picture: {solid} pixels");
    let differ = |a: &RgbaImage, b: &RgbaImage| a.pixels().zip(b.pixels()).filter(|(a, b)| a != b).count();
    assert!(differ(&lit, &no_ambient) > solid / 2, "k_a is in the light");
    assert!(differ(&lit, &no_soft) > solid / 4, "soft normals are in the light");
    let shares = shares(&sky, &plain_sky);
    assert!(shares.len() > solid / 20, "{} leaf pixels of {solid}", shares.len());
    let [low, high] = ambient(&tree);
    // One step of sRGB at 96 of 255 is 2.6 % of the light; both pictures are rounded by half a step.
    let slack = 0.026;
    let odd = shares.iter().filter(|s| !(low - slack..=high + slack).contains(&s[2])).count();
    assert_eq!(odd, 0, "pixels whose share of the sky is not between {low} and {high}");
    let radii = radii(&shares);
    let mut sorted = radii.clone();
    sorted.sort_unstable_by(f64::total_cmp);
    let (near, far) = (sorted[sorted.len() / 4], sorted[sorted.len() * 3 / 4]);
    let of = |keep: &dyn Fn(f64) -> bool| {
        mean(radii.iter().zip(&shares).filter(|(r, _)| keep(**r)).map(|(_, s)| s[2]).collect::<Vec<_>>().into_iter())
    };
    let (inside, rim) = (of(&|r| r < near), of(&|r| r > far));
    assert!(inside + 1.0 / 255.0 < rim, "darker inside ({inside:.3}) than at the rim ({rim:.3})");
}

/// Whoever writes their own has this page to read: it stays short.
#[test]
fn the_page_is_short() {
    let page = std::fs::read_to_string(repository().join("docs/examples/minimal/index.html")).unwrap();
    assert!(page.lines().count() <= 150, "{} lines", page.lines().count());
}
