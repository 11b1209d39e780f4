//! Which triangles belong to which object and material.

use super::file::{Cut, Library, ObjFile};
use super::scan::{Chunk, Statement};
use std::collections::{BTreeMap, BTreeSet};

/// More groups than this are no parts but single leaves or branches: they are not told apart.
const MOST_GROUPS: usize = 64;

/// Triangles of one object and material that follow each other.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Run {
    /// Index into `ObjFile::objects`.
    pub object: Option<u32>,
    /// Index into `ObjFile::materials`.
    pub material: Option<u32>,
    /// First triangle.
    pub start: usize,
    /// One past the last triangle.
    pub end: usize,
}

/// Names in the order in which they first came.
#[derive(Default)]
struct Names {
    list: Vec<String>,
    known: BTreeMap<String, u32>,
}

impl Names {
    /// Number of a name; an empty one is none.
    fn number(&mut self, name: &str) -> Option<u32> {
        if name.is_empty() {
            return None;
        }
        if let Some(&number) = self.known.get(name) {
            return Some(number);
        }
        let number = self.list.len() as u32;
        self.list.push(name.to_string());
        self.known.insert(name.to_string(), number);
        Some(number)
    }
}

/// Which statement names objects.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Naming {
    /// `o`: where a file has one at all.
    Objects,
    /// `g`: where there is no `o`, and few enough groups.
    Groups,
    /// Nothing does.
    Nothing,
}

fn naming(chunks: &[Chunk], file: &mut ObjFile) -> Naming {
    let statements = || chunks.iter().flat_map(|c| &c.events).map(|e| &e.statement);
    if statements().any(|s| matches!(s, Statement::Object(_))) {
        return Naming::Objects;
    }
    let groups: BTreeSet<&str> = statements().filter_map(Statement::group).collect();
    if groups.len() > MOST_GROUPS {
        file.merged_groups = groups.len();
        return Naming::Nothing;
    }
    Naming::Groups
}

impl Statement {
    fn group(&self) -> Option<&str> {
        if let Statement::Group(name) = self { Some(name) } else { None }
    }
}

/// Walks the statements of all chunks and writes names, libraries and runs into `file`. `lines` are
/// the numbers of lines before each chunk.
pub(crate) fn find(chunks: &[Chunk], cut: &[Cut], lines: &[u64], file: &mut ObjFile) {
    let naming = naming(chunks, file);
    let (mut objects, mut materials) = (Names::default(), Names::default());
    let mut current = Run::default();
    let mut before = 0;
    for ((chunk, cut), line) in chunks.iter().zip(cut).zip(lines) {
        for event in &chunk.events {
            let (mut object, mut material) = (current.object, current.material);
            match &event.statement {
                Statement::Object(name) if naming == Naming::Objects => object = objects.number(name),
                Statement::Group(name) if naming == Naming::Groups => object = objects.number(name),
                Statement::Material(name) => material = materials.number(name),
                Statement::Library(name) => {
                    file.libraries.push(Library { name: name.clone(), line: line + u64::from(event.line) });
                }
                Statement::Object(_) | Statement::Group(_) => {}
            }
            if (object, material) != (current.object, current.material) {
                let start = before + cut.starts[event.face as usize];
                finish(Run { end: start, ..current }, file);
                current = Run { object, material, start, end: start };
            }
        }
        before += cut.triangles.len();
    }
    finish(Run { end: before, ..current }, file);
    (file.objects, file.materials) = (objects.list, materials.list);
}

fn finish(run: Run, file: &mut ObjFile) {
    if run.end > run.start {
        file.runs.push(run);
    }
}
