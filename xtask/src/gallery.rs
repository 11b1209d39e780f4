//! Bakes every shared tree and the linden: plain, baked and difference with figures on one page, and one
//! contact sheet, in target/gallery.

use crate::bench::{correlation, density};
use crate::{repo, shared_trees};
use anyhow::{Context, Result};
use foliar_bake::Layer;
use foliar_plant::Plant;
use foliar_view::{Difference, Panel, Shading, ViewParams, contact_sheet, difference, png_bytes, render};
use std::path::{Path, PathBuf};

const FOLDER: &str = "target/gallery";
/// Pictures per row of the contact sheet: plain, baked and difference of two trees.
const COLUMNS: usize = 6;

/// The picture of the README: plain and baked.
const README_PICTURE: &str = "docs/pictures/linden.png";

/// Draws every tree whose name contains `name` and says where the pictures are.
pub fn run(name: Option<&str>) -> Result<()> {
    let folder = repo::root().join(FOLDER);
    std::fs::create_dir_all(&folder).context("target/gallery cannot be made")?;
    let mut trees = vec![shared_trees::linden()];
    match shared_trees::all() {
        Ok(shared) => trees.extend(shared),
        Err(error) => println!("skipped: {error:#}"),
    }
    trees.retain(|tree| name.is_none_or(|name| tree.name.contains(name)));
    let (mut rows, mut panels) = (String::new(), Vec::new());
    for tree in trees {
        println!("{}", tree.name);
        let read = tree.read().with_context(|| tree.name.clone())?;
        let baked = density::bake(&read.plant)?;
        let pictures = Pictures::draw(&read.plant, &[&read.layer, &baked])?;
        rows += &row(&tree.name, &tree.slug(), &figures(&read.plant, &baked, &pictures.changed));
        pictures.save(&folder, &tree.slug())?;
        if tree.name == shared_trees::LINDEN {
            pictures.save_for_readme()?;
        }
        panels.extend(pictures.panels(&tree.name));
    }
    let sheet = contact_sheet(&panels, &["foliar: every shared tree, plain, baked and difference".into()], COLUMNS);
    std::fs::write(folder.join("sheet.png"), png_bytes(&sheet)?)?;
    let page = folder.join("index.html");
    std::fs::write(&page, PAGE.replace("ROWS", &rows)).context("index.html cannot be written")?;
    println!("{}\n{}", page.display(), folder.join("sheet.png").display());
    Ok(())
}

struct Pictures {
    plain: image::RgbaImage,
    baked: image::RgbaImage,
    changed: Difference,
}

impl Pictures {
    fn draw(plant: &Plant, layers: &[&Layer]) -> Result<Pictures> {
        let params = ViewParams { width_px: 420, height_px: 420, samples: 9, ..ViewParams::default() };
        let plain = render(plant, layers, &Shading::Plain, &params)?;
        let baked = render(plant, layers, &Shading::Baked, &params)?;
        let changed = difference(&plain, &baked)?;
        Ok(Pictures { plain, baked, changed })
    }

    fn save(&self, folder: &Path, slug: &str) -> Result<()> {
        for (kind, picture) in [("plain", &self.plain), ("baked", &self.baked), ("difference", &self.changed.picture)] {
            let path: PathBuf = folder.join(format!("{slug}_{kind}.png"));
            std::fs::write(&path, png_bytes(picture)?).with_context(|| format!("{}", path.display()))?;
        }
        Ok(())
    }

    fn save_for_readme(&self) -> Result<()> {
        let panels = [Panel::new("plain", self.plain.clone()), Panel::new("baked", self.baked.clone())];
        let path = repo::root().join(README_PICTURE);
        std::fs::create_dir_all(path.parent().context("a picture lies in a folder")?)?;
        std::fs::write(&path, png_bytes(&contact_sheet(&panels, &[], 2))?).context(README_PICTURE)
    }

    fn panels(self, name: &str) -> [Panel; 3] {
        [
            Panel::new(format!("{name}: plain"), self.plain),
            Panel::new("baked", self.baked),
            Panel::new("difference", self.changed.picture),
        ]
    }
}

/// What is said of a tree beside its pictures.
fn figures(plant: &Plant, baked: &Layer, changed: &Difference) -> String {
    let correlation = correlation::of(plant, baked).map_or("none".into(), |r| format!("{r:.2}"));
    let (rim, inside) = correlation::rim_and_inside(plant, baked);
    format!(
        "{} leaves<br>k<sub>a</sub> at the rim {rim:.2}, inside {inside:.2}<br>correlation with depth {correlation}<br>\
         changed {:.1} steps on average over {:.0} % of the picture",
        plant.leaves().len(),
        changed.mean_steps,
        100.0 * changed.share
    )
}

fn row(name: &str, slug: &str, figures: &str) -> String {
    let picture = |kind: &str| format!("<td><img src=\"{slug}_{kind}.png\" alt=\"{name}, {kind}\"></td>");
    format!(
        "<tr><th>{name}<p>{figures}</p></th>{}{}{}</tr>\n",
        picture("plain"),
        picture("baked"),
        picture("difference")
    )
}

const PAGE: &str = "<!doctype html>\n<html lang=\"en\"><meta charset=\"utf-8\"><title>foliar: gallery</title>\n\
<style>body{font:14px sans-serif;background:#222;color:#ddd}img{width:420px}th{text-align:left;max-width:22em}\
p{font-weight:normal}</style>\n<h1>Every shared tree</h1>\n<table><tr><th></th><th>plain</th><th>baked</th>\
<th>difference</th></tr>\nROWS</table></html>\n";
