//! The programs of foliar: their mains, and the rooms that there are.

use foliar_bake::Baker;

/// Every baker of this version: rooms in the order in which files list them, then those of libraries.
pub const BAKERS: &[&dyn Baker] = &[
    &foliar_wind::Wind,
    &foliar_light::Light,
    &foliar_density::Density,
    &foliar_translucency::Translucency,
    // Bakers of libraries.
    &foliar_wind::Noise,
    &foliar_translucency::Leafscan,
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_registry_is_the_contracts_list_after_structure() {
        let rooms: Vec<_> = BAKERS.iter().filter(|b| !b.needs().nothing()).map(|baker| baker.room()).collect();
        assert_eq!(rooms, foliar_schema::ROOMS[2..], "structure and branches are no rooms of their own");
    }

    #[test]
    fn parameters_of_every_room_are_of_kinds_that_flags_can_give() {
        let fields = foliar_shell::config::Fields::new(BAKERS).unwrap();
        for program in foliar_shell::Program::all(BAKERS) {
            foliar_shell::commands(&program, BAKERS, &fields).debug_assert();
        }
    }
}
