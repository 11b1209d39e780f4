//! Reading a large OBJ, beside tobj on the same file.

use super::{Figure, least_seconds};
use crate::fixtures;
use anyhow::{Context, Result};
use foliar_schema::{Import, Unit, Up};
use std::path::Path;

/// Bytes to faces, over tobj's triangulated reading.
pub fn parse() -> Result<Figure> {
    let path = fixtures::write_large()?;
    let ours = || {
        let bytes = std::fs::read(&path)?;
        foliar_carrier::obj::parse(&bytes, "large.obj")?;
        Ok(())
    };
    let options = tobj::LoadOptions { triangulate: true, ..tobj::LoadOptions::default() };
    ratio(&path, ours, &options)
}

/// File to base and glTF document, over tobj's vertex buffers.
pub fn read() -> Result<Figure> {
    let path = fixtures::write_large()?;
    let import = Import { up: Some(Up::Y), unit: Some(Unit::M), ..Import::default() };
    let ours = || Ok(foliar_carrier::read(&path, &import).map(drop)?);
    ratio(&path, ours, &tobj::GPU_LOAD_OPTIONS)
}

fn ratio(path: &Path, ours: impl Fn() -> Result<()>, options: &tobj::LoadOptions) -> Result<Figure> {
    let megabytes = std::fs::metadata(path)?.len() as f64 / 1e6;
    // In turn, so that a disturbance hits both.
    let (mut our_seconds, mut their_seconds) = (f64::INFINITY, f64::INFINITY);
    for _ in 0..3 {
        our_seconds = our_seconds.min(least_seconds(1, &ours)?);
        their_seconds = their_seconds
            .min(least_seconds(1, || tobj::load_obj(path, options).map(drop).context("tobj cannot read the file"))?);
    }
    let peer = format!("tobj {their_seconds:.3} s, foliar {our_seconds:.3} s, {megabytes:.1} MB");
    Ok(Figure::new(our_seconds / their_seconds, peer))
}
