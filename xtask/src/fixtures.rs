//! Fixtures are functions first, files second: writes them, and says whether the files are what the functions give.

mod leaf;
mod near;
mod plant;
mod rules;

use crate::obj_text::{self, Detail};
use crate::repo;
use anyhow::{Context, Result, bail};
use foliar_plant::{Base, Raster, sample::Recipe};
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder};
use std::path::PathBuf;

const LINDEN: &str = "fixtures/linden";

/// Writes fixtures/.
pub fn write() -> Result<()> {
    for (file, bytes) in all()? {
        let path = repo::root().join(&file);
        let folder = path.parent().context("a fixture has no folder")?;
        std::fs::create_dir_all(folder).context("fixtures/ cannot be made")?;
        std::fs::write(&path, &bytes).with_context(|| format!("{file} cannot be written"))?;
        println!("{file}: {} bytes", bytes.len());
    }
    Ok(())
}

/// Compares fixtures/ with what the generator gives.
pub fn check() -> Result<()> {
    let files = all()?;
    let differs =
        |(file, bytes): &(String, Vec<u8>)| std::fs::read(repo::root().join(file)).ok().as_ref() != Some(bytes);
    let stale: Vec<&str> = files.iter().filter(|f| differs(f)).map(|(file, _)| file.as_str()).collect();
    if !stale.is_empty() {
        bail!("{} differ from what the generator gives: run cargo xtask fixtures", stale.join(", "));
    }
    println!("fixtures: {} files are what the generator gives", files.len());
    Ok(())
}

/// Writes the large OBJ of the reading benchmark and says where it is.
pub fn write_large() -> Result<PathBuf> {
    const LEAST_BYTES: usize = 60_000_000;
    let folder = repo::root().join("target/large");
    std::fs::create_dir_all(&folder).context("target/large cannot be made")?;
    let plant = Recipe { leaf_rows: 2, texture_px: 0, ..Recipe::bench_200k() }.grow();
    let text = obj_text::write(plant.base(), "large.mtl", Detail { normals: true })?;
    if text.len() < LEAST_BYTES {
        bail!("large.obj has {} bytes, must have {LEAST_BYTES}: give the recipe more leaves", text.len());
    }
    let path = folder.join("large.obj");
    std::fs::write(&path, text).context("target/large/large.obj cannot be written")?;
    std::fs::write(folder.join("large.mtl"), "newmtl bark\nKd 0.4 0.3 0.2\nnewmtl leaf\nKd 0.3 0.5 0.2\n")?;
    Ok(path)
}

/// Every fixture, by path from the root.
fn all() -> Result<Vec<(String, Vec<u8>)>> {
    Ok(linden()?.into_iter().chain(leaf::files()?).chain(rules::files()?).collect())
}

/// Files of the linden, by path from the root.
fn linden() -> Result<Vec<(String, Vec<u8>)>> {
    let plant = Recipe::linden().grow();
    let base = plant.base();
    let mut files = vec![
        (format!("{LINDEN}/linden.obj"), obj_text::write(base, "linden.mtl", Detail::default())?.into_bytes()),
        (format!("{LINDEN}/linden.mtl"), materials(base).into_bytes()),
    ];
    for raster in &base.rasters {
        files.push((format!("{LINDEN}/{}", raster.name), png(raster)?));
    }
    Ok(files)
}

fn materials(base: &Base) -> String {
    let mut text = String::from("# made by rule: cargo xtask fixtures\n");
    for material in &base.materials {
        let Some(raster) = material.base_color_raster.map(|r| &base.rasters[r as usize]) else { continue };
        let name = material.name.as_deref().unwrap_or("none");
        text += &format!("newmtl {name}\nKd 1 1 1\nKs 0.04 0.04 0.04\nNs 20\nmap_Kd {}\n", raster.name);
        if raster.has_alpha {
            text += &format!("map_d {}\n", raster.name);
        }
    }
    text
}

fn png(raster: &Raster) -> Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let encoder = PngEncoder::new_with_quality(&mut bytes, CompressionType::Best, FilterType::Adaptive);
    if raster.has_alpha {
        encoder.write_image(&raster.rgba, raster.width, raster.height, ExtendedColorType::Rgba8)?;
    } else {
        let rgb: Vec<u8> = raster.rgba.chunks(4).flat_map(|p| [p[0], p[1], p[2]]).collect();
        encoder.write_image(&rgb, raster.width, raster.height, ExtendedColorType::Rgb8)?;
    }
    Ok(bytes)
}
