//! Pictures that a document takes along: where it is written to another folder, those that it would have
//! to climb out of that folder for become part of its buffer, since readers (ours too) refuse such paths,
//! and data URIs in a GLB make validators warn. Layers are lifted off meanwhile, so that the pictures
//! lie in the base and a later strip still finds it whole.

use crate::output::set_byte_lengths;
use crate::{CarrierError, Document, assemble, images, rebase, takeout};
use serde_json::{Value, json};
use std::path::Path;

/// A picture that moves into the buffer.
struct Picture {
    image: usize,
    mime: &'static str,
    bytes: Vec<u8>,
}

/// The document as it goes to `path`.
pub(crate) fn take_along(document: &Document, path: &Path) -> Result<Document, CarrierError> {
    let pictures: Vec<Picture> = rebase::outside(document, path)
        .into_iter()
        .filter_map(|(image, file)| {
            let bytes = std::fs::read(file).ok()?;
            Some(Picture { image, mime: images::sniff(&bytes).gltf_mime()?, bytes })
        })
        .collect();
    if pictures.is_empty() {
        return Ok(document.clone());
    }
    let takeout::Taken { document: mut base, layers, .. } =
        takeout::take_out(document.clone(), &path.display().to_string())?;
    for picture in pictures {
        embed(&mut base, picture);
    }
    set_byte_lengths(&mut base);
    Ok(assemble::assemble(&base, &layers)?.0)
}

/// Appends one picture to the first buffer and points its image there.
fn embed(document: &mut Document, picture: Picture) {
    let Some(root) = document.json.as_object_mut() else { return };
    if document.buffers.is_empty() {
        document.buffers.push(Vec::new());
        root.insert("buffers".into(), json!([{"byteLength": 0}]));
    }
    let buffer = &mut document.buffers[0];
    buffer.resize(buffer.len().next_multiple_of(4), 0);
    let view = json!({"buffer": 0, "byteOffset": buffer.len(), "byteLength": picture.bytes.len()});
    buffer.extend_from_slice(&picture.bytes);
    let views = root.entry("bufferViews").or_insert_with(|| json!([]));
    let Some(views) = views.as_array_mut() else { return };
    views.push(view);
    let index = views.len() - 1;
    let image = root.get_mut("images").and_then(|i| i.get_mut(picture.image)).and_then(Value::as_object_mut);
    if let Some(image) = image {
        image.shift_remove("uri");
        image.insert("bufferView".into(), index.into());
        image.insert("mimeType".into(), picture.mime.into());
    }
}
