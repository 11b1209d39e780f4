//! Rules of pictures: there, whole, what they claim to be, and of a kind that the format takes.

use crate::{Report, Subject};
use foliar_carrier::SourceKind;
use foliar_carrier::images::Format;
use foliar_carrier::survey::{Found, Picture};
use foliar_schema::{CodeInfo, code};

pub(crate) fn check(subject: &Subject, report: &mut Report) {
    for picture in &subject.seen.pictures {
        let is_obj = subject.seen.source == Some(SourceKind::Obj);
        if let Some((info, message)) = fault(picture, is_obj) {
            let message = format!("picture {}: {message}", picture.name);
            report.say(info, &picture.place, message);
            if let Some(last) = report.findings.last_mut() {
                last.file = Some(picture.file.clone());
            }
        }
    }
    for (part, _) in subject.parts().filter(|(part, _)| part.uvs.is_empty()) {
        let picture = part.material.and_then(|m| subject.seen.base_pictures.get(m as usize).copied().flatten());
        if let Some(picture) = picture {
            let name = &subject.seen.pictures[picture].name;
            let message = format!("part {:?} has picture {name} and no texture coordinates", part.name());
            report.say(&code::TEXTURE_UNMAPPED, subject.seen.place(part), message);
        }
    }
}

/// The gravest thing that is wrong with a picture.
fn fault(picture: &Picture, is_obj: bool) -> Option<(&'static CodeInfo, String)> {
    let format = match &picture.found {
        Found::Missing(why) => return Some((&code::TEXTURE_MISSING, format!("not there: {why}"))),
        Found::Broken(why) => return Some((&code::TEXTURE_BROKEN, why.clone())),
        Found::Picture { format, .. } => *format,
    };
    let name = format.name();
    if let Some((claim, claimed)) = picture.claims.iter().find(|(_, claimed)| *claimed != format) {
        let message = format!("{claim} says {}, its bytes are {name}", claimed.name());
        return Some((&code::TEXTURE_MISLABELED, message));
    }
    let is_fit = if is_obj {
        matches!(format, Format::Png | Format::Jpeg | Format::Tiff | Format::Tga | Format::Bmp)
    } else {
        !picture.in_core || format.gltf_mime().is_some()
    };
    let takes = if is_obj { "PNG, JPEG, TIFF, TGA and BMP are read" } else { "glTF takes PNG and JPEG there" };
    (!is_fit).then(|| (&code::TEXTURE_FORMAT, format!("is {name}; {takes}: convert it to PNG")))
}
