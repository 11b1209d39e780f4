//! A look at a file for checking: it never fails, but says what cannot be read and where, and gives the rest.
//! Pictures are told by their headers; a few small ones are decoded, for what their alpha says of a role.

mod gltf;
mod obj;
mod picture;

pub use picture::{Found, Picture};

use crate::{CarrierError, Document, SourceKind, read};
use foliar_plant::{Base, Part};
use foliar_schema::{Finding, Import, names};
use serde_json::Value;
use std::path::{Path, PathBuf};

/// What kind of trouble a place is in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Trouble {
    /// It is not what its format says.
    Broken,
    /// Numbers that are not finite.
    NotFinite,
    /// An index that names nothing.
    Index,
    /// Only a decoder can read it.
    Compressed,
}

/// A place that could not be read.
#[derive(Clone, Debug)]
pub struct Problem {
    /// What kind of trouble.
    pub trouble: Trouble,
    /// JSON pointer, `line 12`, `byte 20`, or empty.
    pub place: String,
    /// What is wrong, and what would be right.
    pub text: String,
    /// The file concerned, where it is not the asset itself.
    pub file: Option<String>,
}

impl Problem {
    fn new(trouble: Trouble, error: CarrierError) -> Self {
        match error {
            CarrierError::Input { file, place, problem, remedy } => {
                Problem { trouble, place, text: format!("{problem}: {remedy}"), file: Some(file) }
            }
            other => Problem { trouble, place: String::new(), text: other.to_string(), file: None },
        }
    }
}

/// What a file was found to hold.
#[derive(Clone, Debug)]
pub struct Survey {
    /// What kind of file; `None` where even that is not known.
    pub source: Option<SourceKind>,
    /// The glTF as it stands, layers and all; empty for an OBJ.
    pub document: Document,
    /// Parts that could be read, materials, and the few pictures that were decoded.
    pub base: Base,
    /// Pictures that materials name.
    pub pictures: Vec<Picture>,
    /// Per material: its base color picture, index into `pictures`.
    pub base_pictures: Vec<Option<usize>>,
    /// Materials of an OBJ whose alpha is a picture of its own (`map_d`), beside a color without any.
    pub own_masks: std::collections::BTreeSet<usize>,
    /// Number of an OBJ's `v` lines that no face uses.
    pub unused_positions: usize,
    /// What could not be read.
    pub problems: Vec<Problem>,
    /// What import would say.
    pub findings: Vec<Finding>,
    /// Files that were read beside the asset.
    pub files: Vec<PathBuf>,
}

impl Survey {
    /// Where a part stands, in words of its format.
    pub fn place(&self, part: &Part) -> String {
        if self.source != Some(SourceKind::Obj) {
            return format!("/meshes/{}/primitives/{}", part.place.mesh, part.place.primitive);
        }
        let named = |what: &str, name: &Option<String>| name.as_ref().map(|name| format!("{what} {name}"));
        let words = [named("object", &part.object_name), named("material", &part.material_name)];
        words.into_iter().flatten().collect::<Vec<_>>().join(", ")
    }

    /// What the root of the file says of layers: the extension, else its mirror.
    pub fn foliage(&self) -> Option<&Value> {
        let json = &self.document.json;
        let root = json.get("extensions").and_then(|e| e.get(names::EXTENSION));
        root.or_else(|| json.pointer("/asset/extras").and_then(|e| e.get(names::EXTENSION))).filter(|v| v.is_object())
    }

    /// Every number of an attribute of a primitive; `None` where there is none, or it cannot be read.
    pub fn attribute(&self, primitive: &Value, name: &str) -> Option<Attribute> {
        let index = crate::document::index_of(primitive.get("attributes")?, name)?;
        let accessor = self.document.item("accessors", index)?;
        let width = crate::accessor::type_width(accessor.get("type")?.as_str()?)?;
        let source = crate::accessor::Source { document: &self.document, file: "" };
        Some(Attribute { values: source.floats(index, width).ok()?, width, accessor: index })
    }
}

/// Whether the base has changed since records were baked.
#[derive(Clone, Debug)]
pub enum Stale {
    /// Looked at: a finding for each record that is.
    Known(Vec<Finding>),
    /// Not looked at: so many pixels would have to be decoded.
    Unknown(u64),
}

/// Most pixels that are decoded to find out whether a base has changed: 64 MB of them.
const MOST_COMPARED: u64 = 16 << 20;

impl Survey {
    /// Every number of a column of a property table, row by row, as its four bytes; `None` where it is not there.
    pub fn column(&self, class: &str, property: &str) -> Option<Vec<[u8; 4]>> {
        let renamed = self.foliage().and_then(|root| root["renamed"][class].as_str()).unwrap_or(class);
        let metadata = self.document.json.get("extensions")?.get(names::STRUCTURAL_METADATA)?;
        let table = metadata["propertyTables"].as_array()?.iter().find(|table| table["class"] == renamed)?;
        let view = table["properties"][property]["values"].as_u64()?;
        let source = crate::accessor::Source { document: &self.document, file: "" };
        let bytes = source.view(usize::try_from(view).ok()?).ok()?;
        Some(bytes.chunks_exact(4).map(|b| [b[0], b[1], b[2], b[3]]).collect())
    }

    /// Whether the base has changed since the records of a master were baked. Takes the survey apart for its memory.
    ///
    /// # Errors
    /// [`CarrierError`] where layers or base cannot be read.
    pub fn stale(self, name: &str, import: &Import) -> Result<Stale, CarrierError> {
        let used: std::collections::BTreeSet<usize> = self.base_pictures.iter().flatten().copied().collect();
        let pixels = used.iter().map(|index| match self.pictures[*index].found {
            Found::Picture { format, pixels, .. } if format.decoder().is_some() => pixels,
            _ => 0,
        });
        let pixels = pixels.fold(0, u64::saturating_add);
        if pixels > MOST_COMPARED {
            return Ok(Stale::Unknown(pixels));
        }
        let Survey { document, base, .. } = self;
        drop(base);
        read::stale_records(document, name, import).map(Stale::Known)
    }
}

/// The numbers of one attribute.
#[derive(Clone, Debug)]
pub struct Attribute {
    /// Vertex by vertex.
    pub values: Vec<f32>,
    /// Numbers per vertex.
    pub width: usize,
    /// Index of its accessor.
    pub accessor: usize,
}

/// Looks at bytes; `name` stands in messages, files beside it are looked for in `folder`.
pub fn survey(bytes: Vec<u8>, name: &str, folder: &Path, import: &Import) -> Survey {
    let mut seen = Survey {
        source: None,
        document: Document { folder: Some(folder.to_path_buf()), ..Document::default() },
        base: Base::default(),
        pictures: Vec::new(),
        base_pictures: Vec::new(),
        own_masks: std::collections::BTreeSet::new(),
        unused_positions: 0,
        problems: Vec::new(),
        findings: Vec::new(),
        files: Vec::new(),
    };
    let looked = read::kind(&bytes, name).and_then(|kind| {
        seen.source = Some(kind);
        match kind {
            SourceKind::Obj => obj::look(&bytes, name, folder, import, &mut seen),
            _ => gltf::look(bytes, name, folder, import, &mut seen),
        }
    });
    if let Err(error) = looked {
        seen.problems.push(Problem::new(Trouble::Broken, error));
    }
    seen.decode_a_few();
    seen
}
