//! What each room may write, a file for each: its name, channels, columns and rasters; and the lists that
//! come of them.

mod branches;
mod density;
mod leafscan;
mod light;
mod noise;
mod structure;
mod translucency;
mod wind;

use crate::{Channel, Column, RasterInfo};

/// What one room may write.
struct Room {
    /// Name of room, section, layer and program.
    name: &'static str,
    channels: &'static [Channel],
    columns: &'static [Column],
    rasters: &'static [RasterInfo],
}

/// Makes the lists of files and names out of the lists of rooms.
macro_rules! rooms {
    (tree: $($tree:ident)*; library: $($library:ident)*;) => {
        /// Steps and rooms in the order in which files list them.
        pub const ROOMS: &[&str] = &[$($tree::ROOM.name),*];
        /// All channels, in the order in which files list them.
        pub const CHANNELS: &[Channel] = &joined::<_, { total(CHANNEL_LISTS) }>(CHANNEL_LISTS);
        /// All columns, in the order in which files list them.
        pub const COLUMNS: &[Column] = &joined::<_, { total(COLUMN_LISTS) }>(COLUMN_LISTS);
        /// All rasters.
        pub const RASTERS: &[RasterInfo] = &joined::<_, { total(RASTER_LISTS) }>(RASTER_LISTS);
        const CHANNEL_LISTS: &[&[Channel]] = &[$($tree::ROOM.channels),* $(, $library::ROOM.channels)*];
        const COLUMN_LISTS: &[&[Column]] = &[$($tree::ROOM.columns),* $(, $library::ROOM.columns)*];
        const RASTER_LISTS: &[&[RasterInfo]] = &[$($tree::ROOM.rasters),* $(, $library::ROOM.rasters)*];

        /// The names that the files of the rooms spell.
        pub(crate) mod names {
            $(pub use super::$tree::*;)*
            $(pub use super::$library::*;)*
        }
    };
}

// Files list the rooms of a tree in this order: a new one goes to the end. A library's rooms bake from maps or from nothing.
rooms! {
    tree: structure branches wind light density translucency;
    library: noise leafscan;
}

/// Rooms that the plan names and this version has not.
pub const LATER_ROOMS: &[&str] = &["occlusion", "fall"];

/// Length of all lists together.
const fn total<T>(lists: &[&[T]]) -> usize {
    let (mut total, mut list) = (0, 0);
    while list < lists.len() {
        total += lists[list].len();
        list += 1;
    }
    total
}

/// All lists, one after the other.
const fn joined<T: Copy, const N: usize>(lists: &[&[T]]) -> [T; N] {
    let mut list = 0;
    while lists[list].is_empty() {
        list += 1;
    }
    let mut all = [lists[list][0]; N];
    let (mut at, mut from) = (0, 0);
    while at < N {
        if from == lists[list].len() {
            (list, from) = (list + 1, 0);
        } else {
            all[at] = lists[list][from];
            (at, from) = (at + 1, from + 1);
        }
    }
    all
}
